#include "lift_slam/map/map_file_points.h"

#include <cmath>

namespace lift_slam {
namespace {

constexpr std::uint8_t kUnknownGray = 128;

template <class Matrix>
void PutMatrix(const Matrix& matrix, RecordBytes& record) {
  record.PutArray(std::span(matrix.data(), static_cast<std::size_t>(matrix.size())));
}

template <class Matrix>
void TakeMatrix(MapRecordReader& reader, Matrix& matrix) {
  reader.TakeArray(std::span(matrix.data(), static_cast<std::size_t>(matrix.size())));
}

void PutAnchor(const std::optional<MapPoint::Anchor>& anchor, RecordBytes& record) {
  record.Put(static_cast<std::uint8_t>(anchor.has_value()));
  if (!anchor) return;
  record.Put(anchor->keyframe.value);
  PutMatrix(anchor->pixel, record);
  PutMatrix(anchor->undistorted_from_patch, record);
  record.PutArray(std::span<const std::uint8_t>(anchor->patch.gray));
}

std::optional<MapPoint::Anchor> TakeAnchor(MapRecordReader& reader) {
  if (reader.Take<std::uint8_t>() == 0) return std::nullopt;
  MapPoint::Anchor anchor;
  anchor.keyframe = KeyFrameId(reader.Take<std::int32_t>());
  TakeMatrix(reader, anchor.pixel);
  TakeMatrix(reader, anchor.undistorted_from_patch);
  reader.TakeArray(std::span<std::uint8_t>(anchor.patch.gray));
  return anchor;
}

void PutObservations(const MapPoint& point, RecordBytes& record) {
  record.Put(static_cast<std::uint64_t>(point.observations.size()));
  for (const MapPoint::Observation& observation : point.observations) {
    record.Put(observation.keyframe.value);
    record.Put(static_cast<std::int32_t>(observation.feature));
    PutMatrix(observation.pixel, record);
    record.Put(static_cast<std::uint8_t>(observation.is_aligned));
  }
}

void TakeObservations(MapRecordReader& reader, MapPoint& point) {
  constexpr std::size_t kBytes = 4 + 4 + 8 + 1;
  point.observations.resize(reader.TakeCount(kBytes));
  for (MapPoint::Observation& observation : point.observations) {
    observation.keyframe = KeyFrameId(reader.Take<std::int32_t>());
    observation.feature = reader.Take<std::int32_t>();
    TakeMatrix(reader, observation.pixel);
    observation.is_aligned = reader.Take<std::uint8_t>() != 0;
  }
}

void PutPoint(const MapPoint& point, std::uint8_t gray, RecordBytes& record) {
  record.Put(point.id.value);
  record.Put(point.created_by.value);
  PutMatrix(point.position, record);
  PutMatrix(point.normal, record);
  record.Put(point.min_distance);
  record.Put(point.max_distance);
  record.Put(static_cast<std::int32_t>(point.num_visible));
  record.Put(static_cast<std::int32_t>(point.num_found));
  record.Put(gray);
  record.Put(static_cast<std::uint64_t>(point.descriptor.size()));
  record.PutArray(std::span<const std::byte>(point.descriptor));
  PutAnchor(point.anchor, record);
  PutObservations(point, record);
}

std::unique_ptr<MapPoint> TakePoint(MapRecordReader& reader, const DescriptorKind& features,
                                    std::uint8_t& gray) {
  auto point = std::make_unique<MapPoint>();
  point->id = MapPointId(reader.Take<std::int32_t>());
  point->created_by = KeyFrameId(reader.Take<std::int32_t>());
  TakeMatrix(reader, point->position);
  TakeMatrix(reader, point->normal);
  point->min_distance = reader.Take<double>();
  point->max_distance = reader.Take<double>();
  if (!point->position.allFinite() || !point->normal.allFinite() ||
      !std::isfinite(point->min_distance) || !std::isfinite(point->max_distance)) {
    reader.FailDamaged();
  }
  point->num_visible = reader.Take<std::int32_t>();
  point->num_found = reader.Take<std::int32_t>();
  gray = reader.Take<std::uint8_t>();
  point->descriptor.resize(reader.TakeCount(1));
  if (!point->descriptor.empty() && point->descriptor.size() != features.BytesPerRow()) {
    reader.FailDamaged();
  }
  reader.TakeArray(std::span(point->descriptor));
  point->anchor = TakeAnchor(reader);
  TakeObservations(reader, *point);
  return point;
}

}  // namespace

RecordBytes PointsRecord(std::span<const MapPointId> ids, const MapToStore& stored) {
  RecordBytes record;
  record.Put(static_cast<std::uint64_t>(ids.size()));
  for (const MapPointId id : ids) {
    const auto& gray = stored.gray_of_point;
    PutPoint(stored.map.point(id), id.index() < gray.size() ? gray[id.index()] : kUnknownGray,
             record);
  }
  return record;
}

void TakePoints(MapRecordReader& reader, const DescriptorKind& features, std::size_t num_ids,
                std::vector<std::unique_ptr<MapPoint>>& points, std::vector<std::uint8_t>& gray) {
  const std::size_t count = reader.TakeCount(1);
  for (std::size_t i = 0; i < count; ++i) {
    std::uint8_t of_point = kUnknownGray;
    auto point = TakePoint(reader, features, of_point);
    if (!point->id.valid() || point->id.index() >= num_ids) reader.FailDamaged();
    const std::size_t at = point->id.index();
    if (at >= gray.size()) gray.resize(at + 1, kUnknownGray);
    if (at >= points.size()) points.resize(at + 1);
    if (points[at]) reader.FailDamaged();
    gray[at] = of_point;
    points[at] = std::move(point);
  }
}

}  // namespace lift_slam
