#include "lift_slam/visualization/colmap_model.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <ostream>

#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

constexpr double kHalfPixel = 0.5;

// One entry of an image's POINTS2D line.
struct Point2d {
  double x, y;
  std::size_t point3d_id;
};

// Observations by keyframe, and for each observation of each point its place in that list.
struct ObservationIndex {
  std::vector<std::vector<Point2d>> by_keyframe;
  std::vector<std::vector<std::size_t>> place;  // [point][observation]
};

ObservationIndex IndexObservations(const RunRecord& run, int map_index) {
  ObservationIndex index;
  index.by_keyframe.resize(run.keyframes.size());
  index.place.resize(run.points.size());
  for (std::size_t p = 0; p < run.points.size(); ++p) {
    if (run.points[p].map_index != map_index) continue;
    for (const PointRecord::Observation& seen : run.points[p].observations) {
      const auto keyframe = static_cast<std::size_t>(seen.keyframe);
      LIFT_SLAM_CHECK(keyframe < run.keyframes.size(), "keyframe {}", seen.keyframe);
      auto& list = index.by_keyframe[keyframe];
      index.place[p].push_back(list.size());
      list.push_back({seen.x + kHalfPixel, seen.y + kHalfPixel, p + 1});
    }
  }
  return index;
}

}  // namespace

void ColmapModel::WriteCameras(std::ostream& stream) const {
  const PinholeIntrinsics& c = run.camera.pinhole;
  stream << "# Camera list with one line of data per camera:\n"
            "#   CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[fx fy cx cy]\n"
            "# Number of cameras: 1\n";
  fmt::print(stream, "1 PINHOLE {} {} {:.9f} {:.9f} {:.9f} {:.9f}\n", c.width, c.height, c.fx, c.fy,
             c.cx + kHalfPixel, c.cy + kHalfPixel);
}

void ColmapModel::WriteImages(std::ostream& stream) const {
  const ObservationIndex index = IndexObservations(run, map_index);
  stream << "# Image list with two lines of data per image:\n"
            "#   IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME\n"
            "#   POINTS2D[] as (X, Y, POINT3D_ID)\n";
  for (std::size_t k = 0; k < run.keyframes.size(); ++k) {
    const KeyFrameRecord& keyframe = run.keyframes[k];
    if (keyframe.map_index != map_index) continue;
    const Rigid3d cam_from_world = Inverse(keyframe.pose.world_from_cam);
    const Eigen::Quaterniond& q = cam_from_world.rotation;
    const Eigen::Vector3d& t = cam_from_world.translation;
    fmt::print(stream, "{} {:.12f} {:.12f} {:.12f} {:.12f} {:.12f} {:.12f} {:.12f} 1 {}\n", k + 1,
               q.w(), q.x(), q.y(), q.z(), t.x(), t.y(), t.z(),
               (keyframe.is_loaded ? "earlier_run/" : "") + image_name(keyframe.pose.frame_index));
    const char* separator = "";
    for (const Point2d& point : index.by_keyframe[k]) {
      fmt::print(stream, "{}{:.3f} {:.3f} {}", separator, point.x, point.y, point.point3d_id);
      separator = " ";
    }
    stream << '\n';
  }
}

void ColmapModel::WritePoints3d(std::ostream& stream) const {
  const ObservationIndex index = IndexObservations(run, map_index);
  stream << "# 3D point list with one line of data per point:\n"
            "#   POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)\n";
  for (std::size_t p = 0; p < run.points.size(); ++p) {
    const PointRecord& point = run.points[p];
    if (point.map_index != map_index) continue;
    const Eigen::Vector3d& x = point.position;
    fmt::print(stream, "{} {:.9f} {:.9f} {:.9f} {} {} {} {:.4f}", p + 1, x.x(), x.y(), x.z(),
               point.gray, point.gray, point.gray, point.reprojection_error_px);
    for (std::size_t i = 0; i < point.observations.size(); ++i) {
      fmt::print(stream, " {} {}", point.observations[i].keyframe + 1, index.place[p][i]);
    }
    stream << '\n';
  }
}

}  // namespace lift_slam
