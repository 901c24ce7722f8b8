#include "lift_slam/visualization/map_ply.h"

#include <bit>
#include <cstring>
#include <ostream>

namespace lift_slam {
namespace {

static_assert(std::endian::native == std::endian::little, "the PLY writer copies native bytes");

struct Rgb {
  std::uint8_t red, green, blue;
};
constexpr Rgb kCamera = {240, 120, 20};

void PutVertex(const Eigen::Vector3d& position, Rgb color, std::int32_t map_index,
               std::ostream& stream) {
  char bytes[19];
  const Eigen::Vector3f xyz = position.cast<float>();
  std::memcpy(bytes, xyz.data(), 12);
  std::memcpy(bytes + 12, &color, 3);
  std::memcpy(bytes + 15, &map_index, 4);
  stream.write(bytes, sizeof(bytes));
}

}  // namespace

void WriteMapPly(const RunRecord& run, std::ostream& stream) {
  stream << "ply\nformat binary_little_endian 1.0\n"
         << "comment " << run.points.size() << " map points in grey, then " << run.keyframes.size()
         << " keyframe cameras in orange; map units\n"
         << "element vertex " << run.points.size() + run.keyframes.size() << '\n'
         << "property float x\nproperty float y\nproperty float z\n"
         << "property uchar red\nproperty uchar green\nproperty uchar blue\n"
         << "property int map\nend_header\n";
  for (const PointRecord& point : run.points) {
    PutVertex(point.position, {point.gray, point.gray, point.gray}, point.map_index, stream);
  }
  for (const KeyFrameRecord& keyframe : run.keyframes) {
    PutVertex(keyframe.pose.world_from_cam.translation, kCamera, keyframe.map_index, stream);
  }
}

}  // namespace lift_slam
