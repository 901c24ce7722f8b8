#include "lift_slam/map/map_file.h"

#include "lift_slam/map/map_file_info.h"
#include "lift_slam/map/map_file_keyframe.h"
#include "lift_slam/map/map_file_points.h"
#include "lift_slam/util/file.h"

namespace lift_slam {
namespace {

// Bounds the memory that writing and reading need besides the map.
constexpr std::size_t kPointsPerRecord = 256;
// Points made with a keyframe are of its features, of which options allow fewer.
constexpr std::uint64_t kMaxPointsPerKeyFrame = 1U << 17;

struct MapHead {
  std::size_t num_keyframes = 0, num_point_records = 0, num_point_ids = 0;
};

std::size_t NumRecords(std::size_t num_points) {
  return (num_points + kPointsPerRecord - 1) / kPointsPerRecord;
}

RecordBytes MapHeadRecord(const MapToStore& stored) {
  const Map& map = stored.map;
  RecordBytes record;
  record.Put(static_cast<std::uint64_t>(map.num_keyframe_ids()));
  record.Put(static_cast<std::uint64_t>(map.num_point_ids()));
  record.Put(static_cast<std::uint64_t>(map.num_keyframes()));
  record.Put(static_cast<std::uint64_t>(NumRecords(static_cast<std::size_t>(map.num_points()))));
  record.Put(map.newest_keyframe().value);
  for (std::size_t i = 0; i < map.num_keyframe_ids(); ++i) {
    const auto& reference = map.ReplacementOf(KeyFrameId(static_cast<std::int32_t>(i)));
    record.Put(reference ? reference->keyframe.value : -1);
    if (reference) PutPose(reference->cam_from_keyframe, record);
  }
  record.Put(static_cast<std::uint64_t>(stored.loops.size()));
  for (const auto& [query, candidate] : stored.loops) {
    record.Put(query.value);
    record.Put(candidate.value);
  }
  return record;
}

void TakeLoops(MapRecordReader& reader, std::size_t num_keyframe_ids, StoredMap& stored) {
  const std::size_t num_loops = reader.TakeCount(2 * sizeof(std::int32_t));
  for (std::size_t i = 0; i < num_loops; ++i) {
    const KeyFrameId query(reader.Take<std::int32_t>());
    const KeyFrameId candidate(reader.Take<std::int32_t>());
    for (const KeyFrameId id : {query, candidate}) {
      if (!id.valid() || id.index() >= num_keyframe_ids) reader.FailDamaged();
    }
    stored.loops.emplace_back(query, candidate);
  }
}

MapHead TakeMapHead(MapRecordReader& reader, Map::Contents& contents, StoredMap& stored) {
  MapHead head;
  const auto num_keyframe_ids = reader.Take<std::uint64_t>();
  head.num_point_ids = reader.Take<std::uint64_t>();
  head.num_keyframes = reader.Take<std::uint64_t>();
  head.num_point_records = reader.Take<std::uint64_t>();
  constexpr std::uint64_t kMaxIds = 1U << 31;
  if (num_keyframe_ids > kMaxIds || head.num_point_ids > kMaxIds ||
      head.num_point_ids > num_keyframe_ids * kMaxPointsPerKeyFrame) {
    reader.FailDamaged();
  }
  contents.newest_keyframe = KeyFrameId(reader.Take<std::int32_t>());
  for (std::size_t i = 0; i < num_keyframe_ids; ++i) {
    const KeyFrameId standing(reader.Take<std::int32_t>());
    contents.replaced_by.emplace_back();
    if (standing.valid()) contents.replaced_by.back() = {standing, TakePose(reader)};
  }
  contents.keyframes.resize(num_keyframe_ids);
  TakeLoops(reader, num_keyframe_ids, stored);
  return head;
}

void WriteMap(const MapToStore& stored, MapRecordWriter& writer) {
  writer.Write(MapRecord::kMap, MapHeadRecord(stored));
  for (const KeyFrameId id : stored.map.KeyFrameIds()) {
    writer.Write(MapRecord::kKeyFrame, KeyFrameRecordBytes(stored.map.keyframe(id)));
  }
  const std::vector<MapPointId> points = stored.map.PointIds();
  for (std::size_t i = 0; i < points.size(); i += kPointsPerRecord) {
    const std::size_t count = std::min(kPointsPerRecord, points.size() - i);
    writer.Write(MapRecord::kPoints, PointsRecord(std::span(points).subspan(i, count), stored));
  }
}

StoredMap ReadMap(MapRecordReader& reader, const std::shared_ptr<const ViewModel>& view,
                  const DescriptorKind& features) {
  StoredMap stored;
  Map::Contents contents;
  reader.Expect(MapRecord::kMap);
  const MapHead head = TakeMapHead(reader, contents, stored);
  for (std::size_t i = 0; i < head.num_keyframes; ++i) {
    reader.Expect(MapRecord::kKeyFrame);
    auto keyframe = TakeKeyFrame(reader, *view, features);
    if (keyframe->id.index() >= contents.keyframes.size()) reader.FailDamaged();
    auto& place = contents.keyframes[keyframe->id.index()];
    if (place) reader.FailDamaged();
    place = std::move(keyframe);
  }
  for (std::size_t i = 0; i < head.num_point_records; ++i) {
    reader.Expect(MapRecord::kPoints);
    TakePoints(reader, features, head.num_point_ids, contents.points, stored.gray_of_point);
  }
  contents.points.resize(head.num_point_ids);
  stored.map = Map::FromContents(view, std::move(contents));
  if (!stored.map || stored.map->FindKeyFrame(stored.map->newest_keyframe()) == nullptr) {
    reader.FailDamaged();
  }
  return stored;
}

}  // namespace

void WriteMapFile(const std::filesystem::path& path, const MapFileInfo& info,
                  const std::vector<MapToStore>& maps) {
  WriteFileAtomically(path, [&](std::ostream& stream) {
    MapRecordWriter writer(stream);
    writer.Write(MapRecord::kInfo, InfoRecord(info, maps.size()));
    for (const MapToStore& stored : maps) WriteMap(stored, writer);
    writer.Write(MapRecord::kEnd, RecordBytes());
  });
}

MapFile ReadMapFile(const std::filesystem::path& path, std::shared_ptr<const ViewModel> view,
                    const DescriptorKind& features) {
  MapRecordReader reader(path);
  reader.Expect(MapRecord::kInfo);
  const InfoContents contents = TakeInfo(reader);
  CheckInfo(contents.info, MakeMapFileInfo(*view, features, 0), reader);
  MapFile file;
  file.info = contents.info;
  for (std::size_t i = 0; i < contents.num_maps; ++i) {
    file.maps.push_back(ReadMap(reader, view, features));
  }
  reader.Expect(MapRecord::kEnd);
  reader.CheckEnd();
  return file;
}

}  // namespace lift_slam
