#include "lift_slam/image/impulse_noise.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <opencv2/core.hpp>
#include <vector>

#include "lift_slam/image/gray_histogram.h"

namespace lift_slam {
namespace {

constexpr std::uint8_t kPepper = 0, kSalt = 255;

bool IsExtreme(std::uint8_t value) { return value == kPepper || value == kSalt; }

// The values around a pixel within the image, without its own.
struct Neighbours {
  std::array<std::uint8_t, 24> values;
  int count = 0;

  void Add(std::uint8_t value) { values[static_cast<std::size_t>(count++)] = value; }
  auto begin() const { return values.begin(); }
  auto end() const { return values.begin() + count; }
};

template <class Accept>
Neighbours Around(const GrayImage& image, int x, int y, int radius, const Accept& accept) {
  Neighbours found;
  for (int v = std::max(0, y - radius); v <= std::min(image.height() - 1, y + radius); ++v) {
    for (int u = std::max(0, x - radius); u <= std::min(image.width() - 1, x + radius); ++u) {
      if ((u != x || v != y) && accept(u, v)) found.Add(image.row(v)[u]);
    }
  }
  return found;
}

// The values in use besides 0 and 255, without the rarest (a ten-thousandth on either side).
struct UsedRange {
  int darkest = 1, brightest = 254;
};

UsedRange FindUsedRange(const std::array<std::int64_t, 256>& histogram, std::int64_t num_pixels) {
  UsedRange range;
  const std::int64_t rare = num_pixels / 10000;
  for (std::int64_t seen = 0; range.darkest < 254; ++range.darkest) {
    seen += histogram[static_cast<std::size_t>(range.darkest)];
    if (seen > rare) break;
  }
  for (std::int64_t seen = 0; range.brightest > 1; --range.brightest) {
    seen += histogram[static_cast<std::size_t>(range.brightest)];
    if (seen > rare) break;
  }
  return range;
}

// Whether a pixel of 0 or 255 is off all its undamaged neighbours.
bool StandsOut(const GrayImage& image, int x, int y, const UsedRange& range, int min_difference) {
  const std::uint8_t value = image.row(y)[x];
  if (x > 0 && image.row(y)[x - 1] == value) return false;  // a flat area: the quick way out
  const Neighbours around = Around(image, x, y, 1, [&](int u, int v) {
    const std::uint8_t other = image.row(v)[u];
    return other == value || !IsExtreme(other);
  });
  if (around.count < 5) return false;
  const auto [darkest, brightest] = std::minmax_element(around.begin(), around.end());
  return value == kPepper ? *darkest - range.darkest >= min_difference
                          : range.brightest - *brightest >= min_difference;
}

std::uint8_t Median(Neighbours values) {
  const auto middle = values.values.begin() + values.count / 2;
  std::nth_element(values.values.begin(), middle, values.values.begin() + values.count);
  return *middle;
}

// In a noisy image. A black pixel in a nearly black area is as good as its neighbours.
bool IsDamaged(const GrayImage& image, int x, int y) {
  constexpr int kLeastStep = 15;  // grey levels
  const std::uint8_t value = image.row(y)[x];
  if (!IsExtreme(value)) return false;
  const Neighbours all = Around(image, x, y, 1, [](int, int) { return true; });
  if (2 * std::count(all.begin(), all.end(), value) >= all.count) return false;
  const Neighbours others =
      Around(image, x, y, 1, [&](int u, int v) { return !IsExtreme(image.row(v)[u]); });
  return others.count == 0 || std::abs(value - Median(others)) >= kLeastStep;
}

// Of a noisy image: 1 at the pixels to replace.
cv::Mat MarkDamaged(const GrayImage& image) {
  cv::Mat damaged = cv::Mat::zeros(image.height(), image.width(), CV_8UC1);
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      if (IsDamaged(image, x, y)) damaged.at<std::uint8_t>(y, x) = 1;
    }
  }
  return damaged;
}

}  // namespace

ImpulseNoiseShares MeasureImpulseNoise(const GrayImage& image, const ImpulseNoiseOptions& options) {
  ImpulseNoiseShares shares;
  const std::int64_t num_pixels = std::int64_t{image.width()} * image.height();
  if (num_pixels == 0) return shares;
  const auto histogram = GrayHistogram(image);
  const double least = options.min_share * static_cast<double>(num_pixels);
  if (static_cast<double>(std::min(histogram[kPepper], histogram[kSalt])) < least) return shares;
  const UsedRange range = FindUsedRange(histogram, num_pixels);
  std::int64_t salt = 0, pepper = 0;
  for (int y = 0; y < image.height(); ++y) {
    const std::uint8_t* row = image.row(y);
    for (int x = 0; x < image.width(); ++x) {
      if (!IsExtreme(row[x]) || !StandsOut(image, x, y, range, options.min_difference)) continue;
      ++(row[x] == kSalt ? salt : pepper);
    }
  }
  shares.salt = static_cast<double>(salt) / static_cast<double>(num_pixels);
  shares.pepper = static_cast<double>(pepper) / static_cast<double>(num_pixels);
  return shares;
}

ImpulseNoiseResult RemoveImpulseNoise(const GrayImage& image, const ImpulseNoiseOptions& options) {
  ImpulseNoiseResult result{image};
  const ImpulseNoiseShares shares = MeasureImpulseNoise(image, options);
  result.is_noisy = std::min(shares.salt, shares.pepper) >= options.min_share && !image.empty();
  if (!result.is_noisy) return result;
  const cv::Mat damaged = MarkDamaged(image);
  cv::Mat pixels = image.mat().clone();
  const auto is_good = [&](int u, int v) { return damaged.at<std::uint8_t>(v, u) == 0; };
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      if (is_good(x, y)) continue;
      Neighbours good = Around(image, x, y, 1, is_good);
      if (good.count < 3) good = Around(image, x, y, 2, is_good);
      if (good.count == 0) continue;
      pixels.at<std::uint8_t>(y, x) = Median(good);
      ++result.num_replaced;
    }
  }
  result.image = GrayImage(pixels);
  return result;
}

}  // namespace lift_slam
