#include "lift_slam/map/map_file_info.h"

#include <fmt/format.h>

#include <cmath>

namespace lift_slam {
namespace {

// Calibrations that differ by less are the same, read by another machine.
constexpr double kSamePixels = 1e-3;

std::string Text(const MapFileInfo& info) {
  const PinholeIntrinsics& p = info.pinhole;
  const Eigen::Vector4d& b = info.min_max_x_y;
  return fmt::format(
      "{} x {} pixels, fx {:.2f} fy {:.2f} cx {:.2f} cy {:.2f}, undistorted x {:.1f} to {:.1f}, y "
      "{:.1f} to {:.1f}",
      p.width, p.height, p.fx, p.fy, p.cx, p.cy, b[0], b[1], b[2], b[3]);
}

bool IsSameCamera(const MapFileInfo& a, const MapFileInfo& b) {
  const auto same = [](double x, double y) { return std::abs(x - y) <= kSamePixels; };
  const PinholeIntrinsics &p = a.pinhole, &q = b.pinhole;
  return p.width == q.width && p.height == q.height && same(p.fx, q.fx) && same(p.fy, q.fy) &&
         same(p.cx, q.cx) && same(p.cy, q.cy) &&
         (a.min_max_x_y - b.min_max_x_y).cwiseAbs().maxCoeff() <= kSamePixels;
}

std::string Text(const ScaleLevels& levels) {
  return fmt::format("{} levels of factor {}", levels.num_levels, levels.scale_factor);
}

}  // namespace

MapFileInfo MakeMapFileInfo(const ViewModel& view, const DescriptorKind& features,
                            std::uint64_t vocabulary_checksum) {
  return {features,
          view.pinhole,
          {view.min_x, view.max_x, view.min_y, view.max_y},
          view.levels,
          vocabulary_checksum};
}

RecordBytes InfoRecord(const MapFileInfo& info, std::size_t num_maps) {
  RecordBytes record;
  record.PutText(info.features.name);
  record.Put(static_cast<std::uint32_t>(info.features.metric));
  record.Put(static_cast<std::int32_t>(info.features.dimension));
  const PinholeIntrinsics& p = info.pinhole;
  for (const double value : {p.fx, p.fy, p.cx, p.cy}) record.Put(value);
  for (const int value : {p.width, p.height}) record.Put(static_cast<std::int32_t>(value));
  for (int i = 0; i < 4; ++i) record.Put(info.min_max_x_y[i]);
  record.Put(static_cast<std::int32_t>(info.levels.num_levels));
  record.Put(info.levels.scale_factor);
  record.Put(info.levels.sigma_px);
  record.Put(info.vocabulary_checksum);
  record.Put(static_cast<std::uint64_t>(num_maps));
  return record;
}

InfoContents TakeInfo(MapRecordReader& reader) {
  InfoContents contents;
  MapFileInfo& info = contents.info;
  info.features.name = reader.TakeText();
  info.features.metric = static_cast<DescriptorMetric>(reader.Take<std::uint32_t>());
  info.features.dimension = reader.Take<std::int32_t>();
  PinholeIntrinsics& p = info.pinhole;
  for (double* value : {&p.fx, &p.fy, &p.cx, &p.cy}) *value = reader.Take<double>();
  for (int* value : {&p.width, &p.height}) *value = reader.Take<std::int32_t>();
  for (int i = 0; i < 4; ++i) info.min_max_x_y[i] = reader.Take<double>();
  info.levels.num_levels = reader.Take<std::int32_t>();
  info.levels.scale_factor = reader.Take<double>();
  info.levels.sigma_px = reader.Take<double>();
  info.vocabulary_checksum = reader.Take<std::uint64_t>();
  contents.num_maps = reader.Take<std::uint64_t>();
  return contents;
}

void CheckInfo(const MapFileInfo& info, const MapFileInfo& expected,
               const MapRecordReader& reader) {
  if (info.features != expected.features) {
    reader.Fail(fmt::format("is a map of '{}' features, expected those of this run, '{}'",
                            info.features.name, expected.features.name));
  }
  if (info.levels.num_levels != expected.levels.num_levels ||
      info.levels.scale_factor != expected.levels.scale_factor ||
      info.levels.sigma_px != expected.levels.sigma_px) {
    reader.Fail(fmt::format("is a map of features on {}, expected those of this run, {}",
                            Text(info.levels), Text(expected.levels)));
  }
  if (!IsSameCamera(info, expected)) {
    reader.Fail(fmt::format("is a map of another camera ({}), expected that of this run ({})",
                            Text(info), Text(expected)));
  }
}

}  // namespace lift_slam
