#include "lift_slam/simulation/rendering/downsampling.h"

#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

// Samples that one pixel takes in one direction.
int Taps(int supersampling) { return supersampling + (supersampling % 2 == 0 ? 1 : 0); }

unsigned int Weight(int tap, int supersampling) {
  const bool is_border = supersampling % 2 == 0 && (tap == 0 || tap == supersampling);
  return is_border ? 1U : 2U;
}

// Adds weight x row to the sums; simple enough for the compiler to vectorise.
void Accumulate(const std::uint8_t* row, unsigned int weight, std::vector<std::uint16_t>& sums) {
  const auto factor = static_cast<std::uint16_t>(weight);
  for (std::size_t i = 0; i < sums.size(); ++i) {
    sums[i] = static_cast<std::uint16_t>(sums[i] + factor * row[i]);
  }
}

// Combines the sums of one row of pixels horizontally.
void CombineColumns(const std::vector<std::uint16_t>& sums, int width, int supersampling,
                    std::uint8_t* rgb) {
  const int taps = Taps(supersampling);
  const auto total = static_cast<unsigned int>(4 * supersampling * supersampling);
  for (int x = 0; x < width; ++x, rgb += 3) {
    const std::uint16_t* sample = sums.data() + 4 * std::size_t(x) * std::size_t(supersampling);
    unsigned int red = total / 2, green = total / 2, blue = total / 2;
    for (int tap = 0; tap < taps; ++tap, sample += 4) {
      const unsigned int weight = Weight(tap, supersampling);
      red += weight * sample[0];
      green += weight * sample[1];
      blue += weight * sample[2];
    }
    rgb[0] = static_cast<std::uint8_t>(red / total);
    rgb[1] = static_cast<std::uint8_t>(green / total);
    rgb[2] = static_cast<std::uint8_t>(blue / total);
  }
}

}  // namespace

PinholeIntrinsics SamplePinhole(const PinholeIntrinsics& p, int s) {
  const int extra = Taps(s) - s;
  // Sample i lies at pixel (i - s / 2) / s (integer division), see CenterSample.
  return {s * p.fx,
          s * p.fy,
          s * p.cx + s / 2,
          s * p.cy + s / 2,
          s * p.width + extra,
          s * p.height + extra};
}

std::vector<std::uint8_t> DownsampleColor(const std::vector<std::uint8_t>& samples,
                                          const PinholeIntrinsics& pinhole, int supersampling) {
  const PinholeIntrinsics fine = SamplePinhole(pinhole, supersampling);
  const std::size_t stride = 4 * std::size_t(fine.width);
  LIFT_SLAM_CHECK(samples.size() >= stride * std::size_t(fine.height), "{} bytes", samples.size());
  std::vector<std::uint8_t> rgb(3 * std::size_t(pinhole.width) * std::size_t(pinhole.height));
  std::vector<std::uint16_t> sums(stride);
  for (int y = 0; y < pinhole.height; ++y) {
    std::fill(sums.begin(), sums.end(), std::uint16_t{0});
    for (int tap = 0; tap < Taps(supersampling); ++tap) {
      const std::size_t row = std::size_t(y) * std::size_t(supersampling) + std::size_t(tap);
      Accumulate(samples.data() + row * stride, Weight(tap, supersampling), sums);
    }
    CombineColumns(sums, pinhole.width, supersampling,
                   rgb.data() + 3 * std::size_t(y) * std::size_t(pinhole.width));
  }
  return rgb;
}

std::vector<float> CenterDepth(const std::vector<float>& samples, const PinholeIntrinsics& pinhole,
                               int supersampling, const DepthRange& range) {
  const PinholeIntrinsics fine = SamplePinhole(pinhole, supersampling);
  std::vector<float> depth_m;
  depth_m.reserve(std::size_t(pinhole.width) * std::size_t(pinhole.height));
  for (int y = 0; y < pinhole.height; ++y) {
    const float* row =
        samples.data() + std::size_t(CenterSample(y, supersampling)) * std::size_t(fine.width);
    for (int x = 0; x < pinhole.width; ++x) {
      const float value = row[CenterSample(x, supersampling)];
      depth_m.push_back(value > 0.0F ? 1.0F / range.InverseDepth(value) : 0.0F);
    }
  }
  return depth_m;
}

}  // namespace lift_slam
