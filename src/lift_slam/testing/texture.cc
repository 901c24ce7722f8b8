#include "lift_slam/testing/texture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lift_slam/util/check.h"
#include "lift_slam/util/random.h"

namespace lift_slam {
namespace {

constexpr int kSize = 1024;

// A drawing surface that wraps around at its borders.
struct Canvas {
  std::vector<float> gray = std::vector<float>(static_cast<std::size_t>(kSize) * kSize, 0.0F);
  float& At(int x, int y) {
    return gray[static_cast<std::size_t>(y & (kSize - 1)) * kSize +
                static_cast<std::size_t>(x & (kSize - 1))];
  }
};

// Value noise with cells of kSize / cells texels, smoothly interpolated.
void AddNoise(Canvas& canvas, int cells, double amplitude, Random& random) {
  std::vector<float> lattice(static_cast<std::size_t>(cells) * static_cast<std::size_t>(cells));
  for (float& value : lattice) value = static_cast<float>(amplitude * random.Uniform(-1.0, 1.0));
  const auto at = [&](int x, int y) {
    return lattice[static_cast<std::size_t>((y % cells) * cells + x % cells)];
  };
  const int step = kSize / cells;
  for (int y = 0; y < kSize; ++y) {
    const float fy = static_cast<float>(y % step) / static_cast<float>(step);
    const float wy = fy * fy * (3.0F - 2.0F * fy);
    for (int x = 0; x < kSize; ++x) {
      const float fx = static_cast<float>(x % step) / static_cast<float>(step);
      const float wx = fx * fx * (3.0F - 2.0F * fx);
      const int cx = x / step, cy = y / step;
      const float top = at(cx, cy) + wx * (at(cx + 1, cy) - at(cx, cy));
      const float bottom = at(cx, cy + 1) + wx * (at(cx + 1, cy + 1) - at(cx, cy + 1));
      canvas.At(x, y) += top + wy * (bottom - top);
    }
  }
}

// Noise at all scales from `coarsest` cells on, each octave `falloff` as strong as the one before.
void AddOctaves(Canvas& canvas, int coarsest, double amplitude, double falloff, Random& random) {
  for (int cells = coarsest; cells <= kSize / 2; cells *= 2) {
    AddNoise(canvas, cells, amplitude, random);
    amplitude *= falloff;
  }
}

// Share of a texel covered when its centre lies `inside` texels within an edge.
double Coverage(double inside) { return std::clamp(inside + 0.5, 0.0, 1.0); }

// A rectangle turned by an angle with smooth edges; shade(u, v) gives the grey value from place in
// [-1, 1]^2. What was there shines through a little.
template <class Shade>
void DrawRectangle(Canvas& canvas, double x, double y, double half_width, double half_height,
                   double angle, const Shade& shade) {
  const double c = std::cos(angle), s = std::sin(angle);
  const int reach = static_cast<int>(std::ceil(std::hypot(half_width, half_height))) + 1;
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const double u = c * dx + s * dy, v = -s * dx + c * dy;  // texels
      const double cover = Coverage(half_width - std::abs(u)) * Coverage(half_height - std::abs(v));
      if (cover <= 0.0) continue;
      float& pixel = canvas.At(x0 + dx, y0 + dy);
      const double paint = shade(u / half_width, v / half_height) + 0.3 * (pixel - 128.0);
      pixel += static_cast<float>(cover * (paint - pixel));
    }
  }
}

void DrawRandomShape(Canvas& canvas, Random& random) {
  const double x = random.Uniform(0.0, kSize), y = random.Uniform(0.0, kSize);
  const double size = 4.0 * std::pow(12.0, random.Uniform());  // many small, few large
  const double angle = random.Uniform(0.0, std::numbers::pi);
  const double first = random.Uniform(30.0, 225.0), second = random.Uniform(30.0, 225.0);
  const double stretch = random.Uniform(0.5, 2.0);
  switch (random.UniformInt(0, 3)) {
    case 0:  // checks
      DrawRectangle(canvas, x, y, size, size * stretch, angle, [&](double u, double v) {
        const int field = static_cast<int>(std::floor(2.0 * u) + std::floor(2.0 * v));
        return (field & 1) == 0 ? first : second;
      });
      break;
    case 1:  // disc with a rim
      DrawRectangle(canvas, x, y, size, size, angle,
                    [&](double u, double v) { return u * u + v * v < 0.6 ? first : second; });
      break;
    default:
      DrawRectangle(canvas, x, y, size, size * stretch, angle,
                    [&](double, double) { return first; });
  }
}

// Rows of windows with frames, curtains of differing brightness and a cross bar.
void DrawWindows(Canvas& canvas, Random& random) {
  constexpr int kColumns = 8, kRows = 8;
  constexpr double kPitch = static_cast<double>(kSize) / kColumns;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const double glass = random.Uniform(20.0, 110.0), frame = random.Uniform(140.0, 240.0);
      const double curtain = random.Uniform(-1.2, 1.0), bar = random.Uniform(-0.5, 0.5);
      const double x = (column + 0.5) * kPitch + random.Uniform(-12.0, 12.0);
      const double y = (row + 0.5) * kPitch + random.Uniform(-6.0, 6.0);
      const double half_width = random.Uniform(20.0, 40.0),
                   half_height = random.Uniform(28.0, 46.0);
      DrawRectangle(canvas, x, y, half_width, half_height, 0.0, [&](double u, double v) {
        if (std::max(std::abs(u), std::abs(v)) > 0.85 || std::abs(u - bar) < 0.06) return frame;
        return v < curtain ? glass + 70.0 : glass;
      });
    }
  }
}

void DrawCracks(Canvas& canvas, Random& random) {
  for (int crack = 0; crack < 40; ++crack) {
    double x = random.Uniform(0.0, kSize), y = random.Uniform(0.0, kSize);
    double angle = random.Uniform(0.0, 2.0 * std::numbers::pi);
    for (int step = 0; step < 150; ++step) {
      angle += random.Uniform(-0.4, 0.4);
      x += std::cos(angle);
      y += std::sin(angle);
      for (int i = 0; i < 2; ++i)
        canvas.At(static_cast<int>(x) + kSize + i, static_cast<int>(y) + kSize) = 45.0F;
    }
  }
}

std::vector<std::uint8_t> ToBytes(const std::vector<float>& gray) {
  std::vector<std::uint8_t> bytes(gray.size());
  for (std::size_t i = 0; i < gray.size(); ++i) {
    bytes[i] = static_cast<std::uint8_t>(std::clamp(gray[i] + 0.5F, 0.0F, 255.0F));
  }
  return bytes;
}

// Mean of 2 x 2 neighbours.
std::vector<float> HalfSize(const std::vector<float>& gray, std::size_t size) {
  const std::size_t half = size / 2;
  std::vector<float> out(half * half);
  for (std::size_t y = 0; y < half; ++y) {
    for (std::size_t x = 0; x < half; ++x) {
      const float* top = &gray[2 * y * size + 2 * x];
      out[y * half + x] = 0.25F * (top[0] + top[1] + top[size] + top[size + 1]);
    }
  }
  return out;
}

}  // namespace

Texture::Texture(int size, const std::vector<float>& gray) : size_(size) {
  LIFT_SLAM_CHECK(size > 0 && (size & (size - 1)) == 0, "texture size {}", size);
  LIFT_SLAM_CHECK(gray.size() == static_cast<std::size_t>(size) * static_cast<std::size_t>(size),
                  "{} values for size {}", gray.size(), size);
  std::vector<float> current = gray;
  for (int level_size = size; level_size >= 1; level_size /= 2) {
    int shift = 0;
    while ((1 << shift) < level_size) ++shift;
    levels_.push_back({level_size - 1, shift, ToBytes(current)});
    if (level_size > 1) current = HalfSize(current, static_cast<std::size_t>(level_size));
  }
}

float Texture::SampleLevel(const Level& level, float u, float v) {
  const float fu = std::floor(u), fv = std::floor(v);
  const int x0 = static_cast<int>(fu) & level.mask, y0 = static_cast<int>(fv) & level.mask;
  const int x1 = (x0 + 1) & level.mask, y1 = (y0 + 1) & level.mask;
  const float wx = u - fu, wy = v - fv;
  const auto at = [&](int x, int y) {
    return static_cast<float>(level.gray[static_cast<std::size_t>((y << level.shift) + x)]);
  };
  const float top = at(x0, y0) + wx * (at(x1, y0) - at(x0, y0));
  const float bottom = at(x0, y1) + wx * (at(x1, y1) - at(x0, y1));
  return top + wy * (bottom - top);
}

float Texture::Sample(float u, float v, float level) const {
  const float clamped = std::clamp(level, 0.0F, static_cast<float>(levels_.size() - 1));
  const auto lower = static_cast<std::size_t>(clamped);
  const float weight = clamped - static_cast<float>(lower);
  // Texel centres lie at half places, on every level.
  const float scale = 1.0F / static_cast<float>(1 << lower);
  const float fine = SampleLevel(levels_[lower], u * scale - 0.5F, v * scale - 0.5F);
  if (weight < 0.02F || lower + 1 == levels_.size()) return fine;
  const float coarse =
      SampleLevel(levels_[lower + 1], 0.5F * u * scale - 0.5F, 0.5F * v * scale - 0.5F);
  return fine + weight * (coarse - fine);
}

Texture MakeTexture(TextureKind kind, std::uint64_t seed) {
  Random random(seed);
  Canvas canvas;
  std::fill(canvas.gray.begin(), canvas.gray.end(), 128.0F);
  switch (kind) {
    case TextureKind::kClutter:
      AddOctaves(canvas, 8, 35.0, 0.7, random);
      for (int i = 0; i < 900; ++i) DrawRandomShape(canvas, random);
      AddOctaves(canvas, 128, 9.0, 0.8, random);
      break;
    case TextureKind::kFacade:
      AddOctaves(canvas, 4, 30.0, 0.75, random);
      DrawWindows(canvas, random);
      for (int i = 0; i < 60; ++i) DrawRandomShape(canvas, random);
      AddOctaves(canvas, 64, 9.0, 0.9, random);
      break;
    case TextureKind::kGround:
      AddOctaves(canvas, 16, 16.0, 1.0, random);
      DrawCracks(canvas, random);
      break;
  }
  return Texture(kSize, canvas.gray);
}

}  // namespace lift_slam
