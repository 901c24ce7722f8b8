#include "lift_slam/simulation/rendering/lens_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lift_slam/simulation/rendering/lens_rays.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kWidestSingleViewCosine = 0.5;  // 60 degrees off the axis
constexpr double kMarginSamples = 3.0;           // around what is used, for interpolation

// Directions of views: forward, then (for a cube) right, left, down, up. Rows are the view's axes.
std::vector<Matrix3d> ViewRotations(bool is_cube) {
  std::vector<Matrix3d> views = {Matrix3d::Identity()};
  if (!is_cube) return views;
  views.push_back((Matrix3d() << 0, 0, -1, 0, 1, 0, 1, 0, 0).finished());
  views.push_back((Matrix3d() << 0, 0, 1, 0, 1, 0, -1, 0, 0).finished());
  views.push_back((Matrix3d() << 1, 0, 0, 0, 0, -1, 0, 1, 0).finished());
  views.push_back((Matrix3d() << 1, 0, 0, 0, 0, 1, 0, -1, 0).finished());
  return views;
}

// A ray's place in the view it belongs to: the one whose axis is nearest.
struct Place {
  std::size_t view;
  Vector2d normalized;  // x / z, y / z in the view
};
Place Find(const Vector3d& ray, const std::vector<Matrix3d>& rotations) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < rotations.size(); ++i) {
    if (rotations[i].row(2).dot(ray) > rotations[best].row(2).dot(ray)) best = i;
  }
  return {best, (rotations[best] * ray).hnormalized()};
}

// Lowest cosine between optical axis and ray.
double WidestCosine(const LensRays& rays, const Camera& camera) {
  double lowest = std::numeric_limits<double>::infinity();
  for (int y = -1; y <= rays.Height(); ++y) {
    for (int x = -1; x <= rays.Width(); ++x) {
      if (const auto ray = rays.At(x, y)) lowest = std::min(lowest, ray->z());
    }
  }
  if (lowest <= 1.0) return lowest;
  throw InputError(
      fmt::format("{}: the distortion of the camera can be inverted at no pixel, expected a "
                  "usable {} model",
                  camera.source.empty() ? "camera" : camera.source, camera.ModelName()));
}

// Least distance of neighbouring pixels in the plane z = 1 of their view.
double FinestStep(const LensRays& rays, const std::vector<Matrix3d>& rotations) {
  double finest = std::numeric_limits<double>::infinity();
  const auto compare = [&](const Place& a, int x, int y) {
    const auto ray = rays.At(x, y);
    if (!ray) return;
    const Place b = Find(*ray, rotations);
    if (a.view == b.view) finest = std::min(finest, (a.normalized - b.normalized).norm());
  };
  for (int y = 0; y < rays.Height(); ++y) {
    for (int x = 0; x < rays.Width(); ++x) {
      const auto ray = rays.At(x, y);
      if (!ray) continue;
      const Place place = Find(*ray, rotations);
      compare(place, x + 1, y);
      compare(place, x, y + 1);
    }
  }
  return finest;
}

// Samples a unit of the plane z = 1. Twice the camera's own focal length is enough for any lens
// that is not folded at its rim.
double ViewFocal(const LensRays& rays, const std::vector<Matrix3d>& rotations, const Camera& camera,
                 int supersampling) {
  const double highest = 2.0 * std::max(camera.pinhole.fx, camera.pinhole.fy);
  return supersampling * std::min(1.0 / FinestStep(rays, rotations), highest);
}

LensSample ToSample(const std::optional<Vector3d>& ray, const std::vector<Matrix3d>& rotations,
                    double focal) {
  if (!ray) return {};
  const Place place = Find(*ray, rotations);
  const Vector2d at = focal * place.normalized;
  return {static_cast<float>(at.x()), static_cast<float>(at.y()), static_cast<int>(place.view)};
}

void PlaceSamples(const LensRays& rays, const std::vector<Matrix3d>& rotations, double focal,
                  int supersampling, LensMap& map) {
  const auto offset = [&](int i) { return (i + 0.5) / supersampling - 0.5; };
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      map.centers.push_back(ToSample(rays.At(x, y), rotations, focal));
      for (int i = 0; i < map.samples_per_pixel; ++i) {
        const auto ray = rays.Between(x + offset(i % supersampling), y + offset(i / supersampling));
        map.samples.push_back(ToSample(ray, rotations, focal));
      }
    }
  }
}

// The part of a view that samples use; empty when none does.
using Bounds = Eigen::AlignedBox2d;

std::vector<Bounds> UsedParts(const LensMap& map, std::size_t view_count) {
  std::vector<Bounds> used(view_count);
  for (const auto* list : {&map.samples, &map.centers}) {
    for (const LensSample& sample : *list) {
      if (sample.view < 0) continue;
      used[static_cast<std::size_t>(sample.view)].extend(Vector2d(sample.x, sample.y));
    }
  }
  return used;
}

PinholeView MakeView(const Bounds& used, const Matrix3d& rotation, double focal) {
  const Vector2d top_left = (used.min().array() - kMarginSamples).floor();
  const Vector2d size = (used.max() - top_left).array().ceil() + kMarginSamples + 1.0;
  return {{focal, focal, -top_left.x(), -top_left.y(), static_cast<int>(size.x()),
           static_cast<int>(size.y())},
          rotation};
}

// Renumbers the views so that only the used ones remain, and moves samples to their corners.
void CropViews(const std::vector<Matrix3d>& rotations, double focal, LensMap& map) {
  const std::vector<Bounds> used = UsedParts(map, rotations.size());
  std::vector<int> new_index(rotations.size(), -1);
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    if (used[i].isEmpty()) continue;
    new_index[i] = static_cast<int>(map.views.size());
    map.views.push_back(MakeView(used[i], rotations[i], focal));
  }
  for (auto* list : {&map.samples, &map.centers}) {
    for (LensSample& sample : *list) {
      if (sample.view < 0) continue;
      sample.view = new_index[static_cast<std::size_t>(sample.view)];
      const PinholeIntrinsics& p = map.views[static_cast<std::size_t>(sample.view)].pinhole;
      sample.x += static_cast<float>(p.cx);
      sample.y += static_cast<float>(p.cy);
    }
  }
}

}  // namespace

LensMap MakeLensMap(const Camera& camera, int supersampling) {
  const LensRays rays(camera);
  const auto rotations = ViewRotations(WidestCosine(rays, camera) < kWidestSingleViewCosine);
  const double focal = ViewFocal(rays, rotations, camera, supersampling);
  LensMap map;
  map.width = rays.Width();
  map.height = rays.Height();
  map.samples_per_pixel = supersampling * supersampling;
  PlaceSamples(rays, rotations, focal, supersampling, map);
  CropViews(rotations, focal, map);
  return map;
}

}  // namespace lift_slam
