#include "lift_slam/testing/renderer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "lift_slam/util/random.h"

namespace lift_slam {
namespace {

constexpr int kTileSize = 16;
constexpr int kMaxAnisotropy = 4;
constexpr float kSkyTop = 200.0F, kSkyBottom = 235.0F;

// A rectangle seen from the camera. For a ray r = (x, y, 1): with U = u . r, V = v . r, W = w . r,
// the ray meets the plane in front of the camera when W > 0, at the place (U / W, V / W) of the
// rectangle (inside in [0, 1]^2) and at inverse depth W * inverse_distance.
struct ProjectedQuad {
  Eigen::Vector3f u, v, w;
  float inverse_distance = 0.0F;
  const TexturedQuad* quad = nullptr;
  const Texture* texture = nullptr;
  float texels_u = 0.0F, texels_v = 0.0F;  // texels along the edges
};

// Smallest and largest value of a linear function over a box of rays.
struct Range {
  float low = 0.0F, high = 0.0F;
};

Range RangeOver(const Eigen::Vector3f& f, const Eigen::Vector2f& low, const Eigen::Vector2f& high) {
  const Eigen::Vector2f middle = 0.5F * (low + high), half = 0.5F * (high - low);
  const float value = f.x() * middle.x() + f.y() * middle.y() + f.z();
  const float spread = std::abs(f.x()) * half.x() + std::abs(f.y()) * half.y();
  return {value - spread, value + spread};
}

std::optional<ProjectedQuad> Project(const TexturedQuad& quad, const TexturedWorld& world,
                                     const Rigid3d& cam_from_world) {
  const Eigen::Vector3d corner = cam_from_world * quad.corner;
  const Eigen::Vector3d u = cam_from_world.rotation * quad.edge_u;
  const Eigen::Vector3d v = cam_from_world.rotation * quad.edge_v;
  Eigen::Vector3d normal = u.cross(v).normalized();
  if (normal.dot(corner) < 0.0) normal = -normal;
  const double distance = normal.dot(corner);
  if (distance < 1e-6) return std::nullopt;  // seen edge on
  ProjectedQuad projected;
  projected.u = ((u * distance - normal * corner.dot(u)) / u.squaredNorm()).cast<float>();
  projected.v = ((v * distance - normal * corner.dot(v)) / v.squaredNorm()).cast<float>();
  projected.w = normal.cast<float>();
  projected.inverse_distance = static_cast<float>(1.0 / distance);
  projected.quad = &quad;
  projected.texture = &world.textures[static_cast<std::size_t>(quad.texture)];
  projected.texels_u = static_cast<float>(u.norm() * quad.texels_per_metre);
  projected.texels_v = static_cast<float>(v.norm() * quad.texels_per_metre);
  return projected;
}

enum class Cover { kNone, kPart, kAll };

// Conservative: kNone and kAll are certain.
Cover CoverOf(const ProjectedQuad& quad, const Eigen::Vector2f& low, const Eigen::Vector2f& high) {
  const std::array<Eigen::Vector3f, 5> inside{quad.w, quad.u, quad.v, quad.w - quad.u,
                                              quad.w - quad.v};
  Cover cover = Cover::kAll;
  for (const Eigen::Vector3f& f : inside) {
    const Range range = RangeOver(f, low, high);
    if (range.high < 0.0F) return Cover::kNone;
    if (range.low <= 0.0F) cover = Cover::kPart;
  }
  return cover;
}

// Rectangles that may be visible in a box of rays: those in it that are not behind one that covers
// the whole box.
void FindCandidates(const std::vector<ProjectedQuad>& quads, const Eigen::Vector2f& low,
                    const Eigen::Vector2f& high, std::vector<const ProjectedQuad*>& candidates) {
  candidates.clear();
  float nearest_full = 0.0F;  // inverse depth at which the box is certainly filled
  for (const ProjectedQuad& quad : quads) {
    const Cover cover = CoverOf(quad, low, high);
    if (cover == Cover::kNone) continue;
    candidates.push_back(&quad);
    if (cover == Cover::kAll) {
      nearest_full =
          std::max(nearest_full, RangeOver(quad.w, low, high).low * quad.inverse_distance);
    }
  }
  std::erase_if(candidates, [&](const ProjectedQuad* quad) {
    return RangeOver(quad->w, low, high).high * quad->inverse_distance < nearest_full;
  });
}

// log2 of a positive number to about 0.09, enough to blend mip levels.
float FastLog2(float x) {
  const auto bits = std::bit_cast<std::uint32_t>(x);
  const float mantissa = std::bit_cast<float>((bits & 0x007FFFFFU) | 0x3F800000U);
  return static_cast<float>(static_cast<int>(bits >> 23) - 127) + mantissa - 1.0F;
}

// The texture averaged over the pixel: several samples along the longer side of its footprint,
// each blurred by the shorter one.
float Shade(const ProjectedQuad& quad, const Eigen::Vector2f& ray,
            const Eigen::Vector2f& pixel_size) {
  const auto dot = [&](const Eigen::Vector3f& f) {
    return f.x() * ray.x() + f.y() * ray.y() + f.z();
  };
  const float inverse_w = 1.0F / dot(quad.w);
  const float a = dot(quad.u) * inverse_w, b = dot(quad.v) * inverse_w;
  // Derivatives of the texture place by one pixel to the right and one down.
  const Eigen::Array2f scale = pixel_size.array() * inverse_w;
  const Eigen::Array2f du =
      (quad.u.head<2>() - a * quad.w.head<2>()).array() * scale * quad.texels_u;
  const Eigen::Array2f dv =
      (quad.v.head<2>() - b * quad.w.head<2>()).array() * scale * quad.texels_v;
  const Eigen::Array2f length = (du * du + dv * dv).sqrt();
  const int longer = length.x() > length.y() ? 0 : 1;
  const float major = length[longer], minor = std::max(length[1 - longer], 1e-6F);
  const int samples = std::clamp(static_cast<int>(major / minor + 0.5F), 1, kMaxAnisotropy);
  const float level = FastLog2(std::max(major / static_cast<float>(samples), 1.0F));
  const float u = a * quad.texels_u + static_cast<float>(quad.quad->offset_texels.x());
  const float v = b * quad.texels_v + static_cast<float>(quad.quad->offset_texels.y());
  float sum = 0.0F;
  for (int i = 0; i < samples; ++i) {
    const float place = (static_cast<float>(i) + 0.5F) / static_cast<float>(samples) - 0.5F;
    sum += quad.texture->Sample(u + place * du[longer], v + place * dv[longer], level);
  }
  return sum / static_cast<float>(samples) * static_cast<float>(quad.quad->brightness);
}

const ProjectedQuad* NearestQuad(const std::vector<const ProjectedQuad*>& candidates,
                                 const Eigen::Vector2f& ray) {
  const ProjectedQuad* nearest = nullptr;
  float nearest_inverse_depth = 0.0F;
  const auto dot = [&](const Eigen::Vector3f& f) {
    return f.x() * ray.x() + f.y() * ray.y() + f.z();
  };
  for (const ProjectedQuad* quad : candidates) {
    const float w = dot(quad->w);
    const float inverse_depth = w * quad->inverse_distance;
    if (!(inverse_depth > nearest_inverse_depth)) continue;
    const float u = dot(quad->u), v = dot(quad->v);
    if (u < 0.0F || v < 0.0F || u > w || v > w) continue;
    nearest = quad;
    nearest_inverse_depth = inverse_depth;
  }
  return nearest;
}

float Sky(const Eigen::Vector2f& ray) {
  return std::clamp(kSkyBottom + 60.0F * ray.y(), kSkyTop, kSkyBottom);
}

// Grey value of one pixel. Where rectangles meet within it, the mean of four places.
float RenderPixel(const std::vector<const ProjectedQuad*>& candidates, bool has_edges,
                  const Eigen::Vector2f& ray, const Eigen::Vector2f& pixel_size) {
  const auto shade = [&](const ProjectedQuad* quad, const Eigen::Vector2f& at) {
    return quad != nullptr ? Shade(*quad, at, pixel_size) : Sky(at);
  };
  const ProjectedQuad* middle = NearestQuad(candidates, ray);
  if (!has_edges) return shade(middle, ray);
  std::array<const ProjectedQuad*, 4> quads{};
  std::array<Eigen::Vector2f, 4> rays;
  bool same = true;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Array2f offset((i & 1U) != 0 ? 0.25F : -0.25F, (i & 2U) != 0 ? 0.25F : -0.25F);
    rays[i] = ray + (pixel_size.array() * offset).matrix();
    quads[i] = NearestQuad(candidates, rays[i]);
    same = same && quads[i] == middle;
  }
  if (same) return shade(middle, ray);
  float sum = 0.0F;
  for (std::size_t i = 0; i < 4; ++i) sum += shade(quads[i], rays[i]);
  return 0.25F * sum;
}

// Normal noise from a table: fast and the same everywhere.
class PixelNoise {
 public:
  PixelNoise(double sigma, std::uint64_t seed) : random_(seed), table_(kTableSize) {
    Random values(0);
    for (float& value : table_) value = static_cast<float>(sigma * values.Normal());
  }
  float Next() {
    if (left_ == 0) {
      bits_ = random_.Bits();
      left_ = 5;
    }
    --left_;
    const float value = table_[bits_ & (kTableSize - 1)];
    bits_ >>= 12;
    return value;
  }

 private:
  static constexpr std::size_t kTableSize = 4096;
  Random random_;
  std::vector<float> table_;
  std::uint64_t bits_ = 0;
  int left_ = 0;
};

}  // namespace

Renderer::Renderer(const Camera& camera)
    : width_(camera.pinhole.width),
      height_(camera.pinhole.height),
      pixel_size_(static_cast<float>(1.0 / camera.pinhole.fx),
                  static_cast<float>(1.0 / camera.pinhole.fy)) {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      const auto ray = camera.Unproject(Eigen::Vector2d(x, y));
      const bool usable = ray && ray->z() > 0.05;
      rays_.emplace_back(usable ? Eigen::Vector2f(ray->hnormalized().cast<float>())
                                : Eigen::Vector2f(kNone, kNone));
    }
  }
  MakeTiles();
}

void Renderer::MakeTiles() {
  for (int y = 0; y < height_; y += kTileSize) {
    for (int x = 0; x < width_; x += kTileSize) {
      Tile tile{x, y, Eigen::Vector2f::Constant(1e9F), Eigen::Vector2f::Constant(-1e9F)};
      for (int dy = 0; dy < std::min(kTileSize, height_ - y); ++dy) {
        for (int dx = 0; dx < std::min(kTileSize, width_ - x); ++dx) {
          const Eigen::Vector2f& ray = rays_[static_cast<std::size_t>((y + dy) * width_ + x + dx)];
          if (!(ray.x() == ray.x())) continue;
          tile.low = tile.low.cwiseMin(ray);
          tile.high = tile.high.cwiseMax(ray);
        }
      }
      if (!(tile.low.x() <= tile.high.x())) continue;
      tiles_.push_back(tile);
      low_ = low_.cwiseMin(tile.low);
      high_ = high_.cwiseMax(tile.high);
    }
  }
}

GrayImage Renderer::Render(const TexturedWorld& world, const Rigid3d& cam_from_world,
                           const PictureOptions& options) const {
  std::vector<ProjectedQuad> quads;
  for (const TexturedQuad& quad : world.quads) {
    const auto projected = Project(quad, world, cam_from_world);
    if (projected && CoverOf(*projected, low_, high_) != Cover::kNone) quads.push_back(*projected);
  }
  cv::Mat image = cv::Mat::zeros(height_, width_, CV_8UC1);
  PixelNoise noise(options.noise_gray, options.noise_seed);
  const float exposure = static_cast<float>(options.exposure);
  std::vector<const ProjectedQuad*> candidates;
  for (const Tile& tile : tiles_) {
    FindCandidates(quads, tile.low, tile.high, candidates);
    const bool has_edges =
        candidates.size() > 1 ||
        (candidates.size() == 1 && CoverOf(*candidates[0], tile.low, tile.high) != Cover::kAll);
    for (int y = tile.y; y < std::min(tile.y + kTileSize, height_); ++y) {
      for (int x = tile.x; x < std::min(tile.x + kTileSize, width_); ++x) {
        const Eigen::Vector2f& ray = rays_[static_cast<std::size_t>(y * width_ + x)];
        if (!(ray.x() == ray.x())) continue;
        const float gray = RenderPixel(candidates, has_edges, ray, pixel_size_);
        image.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(
            std::clamp(exposure * gray + noise.Next() + 0.5F, 0.0F, 255.0F));
      }
    }
  }
  return GrayImage(image);
}

}  // namespace lift_slam
