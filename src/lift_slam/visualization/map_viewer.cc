#include "lift_slam/visualization/map_viewer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lift_slam/util/median.h"
#include "lift_slam/visualization/axis.h"
#include "lift_slam/visualization/map_viewer_script.h"
#include "lift_slam/visualization/xml_text.h"

namespace lift_slam {
namespace {

constexpr std::size_t kMaxPoints = 30'000;
constexpr std::size_t kMaxPathPoints = 4'000;
constexpr std::size_t kMaxKeyframes = 400;

std::size_t StrideFor(std::size_t count, std::size_t max_count) {
  return std::max<std::size_t>(1, (count + max_count - 1) / max_count);
}

template <class T>
std::string Encode(const std::vector<T>& values) {
  return Base64(values.data(), values.size() * sizeof(T));
}

// Cube that holds the middle 96 % of the points on every axis, and the whole path.
struct Box {
  Eigen::Vector3d corner = Eigen::Vector3d::Zero();
  double size = 1.0;
};

struct MapPoints {
  std::vector<Eigen::Vector3d> positions;
  std::vector<std::uint8_t> grays;
};

MapPoints PointsOf(const RunRecord& run, const ReportScene& scene, const ScenePath& path) {
  MapPoints all, thinned;
  for (const PointRecord& point : run.points) {
    if (!scene.Shows(path, point.map_index)) continue;
    const Eigen::Vector3d x = scene.OnPage(point.position);
    if (!x.allFinite()) continue;
    all.positions.push_back(x);
    all.grays.push_back(point.gray);
  }
  const std::size_t stride = StrideFor(all.positions.size(), kMaxPoints);
  for (std::size_t i = 0; i < all.positions.size(); i += stride) {
    thinned.positions.push_back(all.positions[i]);
    thinned.grays.push_back(all.grays[i]);
  }
  return thinned;
}

Box BoxOf(const MapPoints& points, const ScenePath& path) {
  Box box;
  double size = 0.0;
  const std::vector<double>* axes[] = {&path.right, &path.up, &path.height};
  double path_size = 0.0;
  for (const auto* axis : axes) {
    AxisRange range;
    range.Add(*axis);
    path_size = std::max(path_size, range.length());
  }
  for (int axis = 0; axis < 3; ++axis) {
    AxisRange range;
    range.Add(*axes[axis]);
    std::vector<double> values;
    for (const auto& x : points.positions) values.push_back(x[axis]);
    std::sort(values.begin(), values.end());
    if (!values.empty()) {
      const double reach = path_size > 0.0 ? 4.0 * path_size : 1e300;
      range.Add(std::max(values[values.size() * 2 / 100], range.min - reach));
      range.Add(std::min(values[(values.size() - 1) * 98 / 100], range.max + reach));
    }
    range = WithLength(range);
    box.corner[axis] = 0.5 * (range.min + range.max);
    size = std::max(size, range.length());
  }
  box.size = size * 1.02;
  box.corner.array() -= 0.5 * box.size;
  return box;
}

// x y z of each point inside the box, in 1/65535 of its size, then all grey levels.
std::string PointData(const MapPoints& points, const Box& box, std::size_t& count) {
  std::vector<std::uint16_t> xyz;
  std::vector<std::uint8_t> gray;
  for (std::size_t i = 0; i < points.positions.size(); ++i) {
    const Eigen::Vector3d unit = (points.positions[i] - box.corner) / box.size;
    if (unit.minCoeff() < 0.0 || unit.maxCoeff() > 1.0) continue;
    for (int k = 0; k < 3; ++k) {
      xyz.push_back(static_cast<std::uint16_t>(std::lround(unit[k] * 65535.0)));
    }
    gray.push_back(points.grays[i]);
  }
  count = gray.size();
  return fmt::format("\"xyz\":\"{}\",\"gray\":\"{}\"", Encode(xyz), Encode(gray));
}

// Positions relative to the box; NaN interrupts the line.
std::string PathData(const ScenePath& path, const Box& box) {
  const std::size_t stride = StrideFor(path.right.size(), kMaxPathPoints);
  std::vector<float> values;
  for (std::size_t i = 0; i < path.right.size(); ++i) {
    const bool gap = !std::isfinite(path.right[i]);
    if (i % stride != 0 && !gap && i + 1 != path.right.size()) continue;
    const Eigen::Vector3d x(path.right[i], path.up[i], path.height[i]);
    const Eigen::Vector3f unit = ((x - box.corner) / box.size).cast<float>();
    values.insert(values.end(), unit.data(), unit.data() + 3);
  }
  return Encode(values);
}

// Depth of the drawn camera pyramids: small enough that neighbours stay apart.
double FrustumSize(const RunRecord& run, const ReportScene& scene, const ScenePath& path,
                   const Box& box) {
  std::vector<double> steps;
  std::optional<Eigen::Vector3d> before;
  for (const KeyFrameRecord& keyframe : run.keyframes) {
    if (!scene.Shows(path, keyframe.map_index)) continue;
    const Eigen::Vector3d centre = scene.OnPage(keyframe.pose.world_from_cam.translation);
    if (before) steps.push_back((centre - *before).norm() / box.size);
    before = centre;
  }
  if (steps.empty()) return 0.03;
  return std::clamp(0.8 * Median(std::move(steps)), 0.008, 0.03);
}

// Centre and the unit axes right, down and forward of each keyframe: 12 numbers.
std::string KeyframeData(const RunRecord& run, const ReportScene& scene, const ScenePath& path,
                         const Box& box) {
  std::vector<const KeyFrameRecord*> shown;
  for (const KeyFrameRecord& keyframe : run.keyframes) {
    if (scene.Shows(path, keyframe.map_index)) shown.push_back(&keyframe);
  }
  std::vector<float> values;
  for (std::size_t i = 0; i < shown.size(); i += StrideFor(shown.size(), kMaxKeyframes)) {
    const Rigid3d& world_from_cam = shown[i]->pose.world_from_cam;
    const Eigen::Vector3d centre =
        (scene.OnPage(world_from_cam.translation) - box.corner) / box.size;
    for (int k = 0; k < 3; ++k) values.push_back(static_cast<float>(centre[k]));
    const Eigen::Matrix3d axes = world_from_cam.RotationMatrix();
    for (int column = 0; column < 3; ++column) {
      const Eigen::Vector3f axis = scene.DirectionOnPage(axes.col(column)).cast<float>();
      values.insert(values.end(), axis.data(), axis.data() + 3);
    }
  }
  return Encode(values);
}

std::string SceneJson(const RunRecord& run, const ReportScene& scene, const ScenePath& path) {
  const MapPoints points = PointsOf(run, scene, path);
  const Box box = BoxOf(points, path);
  std::size_t count = 0;
  const std::string point_data = PointData(points, box, count);
  const PinholeIntrinsics& pinhole = run.camera.pinhole;
  const bool known = pinhole.fx > 0.0 && pinhole.fy > 0.0 && pinhole.width > 0;
  return fmt::format(
      "{{\"name\":\"map {}\",\"count\":{},{},\"path\":\"{}\",\"truth\":\"{}\",\"keyframes\":\"{}\","
      "\"frustum\":{:.4f},\"half\":[{:.4f},{:.4f}]}}",
      path.map_index + 1, count, point_data, PathData(path, box), PathData(scene.truth(), box),
      KeyframeData(run, scene, path, box), FrustumSize(run, scene, path, box),
      known ? 0.5 * pinhole.width / pinhole.fx : 0.6,
      known ? 0.5 * pinhole.height / pinhole.fy : 0.45);
}

}  // namespace

std::string MapViewerHtml(const RunRecord& run, const ReportScene& scene) {
  if (scene.paths().empty()) return {};
  std::string scenes, choices;
  for (const ScenePath& path : scene.paths()) {
    if (!scenes.empty()) scenes += ',';
    scenes += SceneJson(run, scene, path);
    choices += fmt::format("<option>map {}</option>", path.map_index + 1);
  }
  const bool several = scene.paths().size() > 1;
  return fmt::format(
      "<div class=\"viewer\" id=\"viewer\"><canvas tabindex=\"0\" role=\"img\" aria-label=\"Map in "
      "three dimensions: drag to turn\"></canvas>{}<p class=\"viewer-key\"><i "
      "class=\"k1\"></i>camera "
      "path <i class=\"k2\"></i>keyframes{}</p></div>\n"
      "<script type=\"application/json\" id=\"viewer-data\">[{}]</script>\n<script>{}</script>\n",
      several ? fmt::format("<select aria-label=\"map\">{}</select>", choices) : "",
      scene.truth().empty() ? "" : " <i class=\"k3\"></i>ground truth", scenes, MapViewerScript());
}

}  // namespace lift_slam
