#include "lift_slam/map/map_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <limits>
#include <sstream>

#include "lift_slam/map/map_consistency_for_test.h"
#include "lift_slam/map/map_file_records.h"
#include "lift_slam/testing/synthetic_frames.h"
#include "lift_slam/testing/temporary_folder.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

constexpr int kPoints = 600;  // more than one record of points
constexpr std::uint64_t kWords = 77;

// Two maps in one file; the first with erased keyframes and points, aligned pixels and patches.
class MapFileTest : public testing::Test {
 protected:
  MapFileTest() : first_(scene_.view()), second_(scene_.view()) {
    std::vector<Rigid3d> poses;
    for (int i = 0; i < 6; ++i) {
      const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.013 * i, Eigen::Vector3d::UnitY()));
      poses.emplace_back(turn, Eigen::Vector3d(0.1 * i, 0.01 * i, 0.0));
    }
    const auto points = scene_.FillMap(poses, first_);
    scene_.FillMap({poses[0], poses[1]}, second_);
    first_.EraseKeyFrame(KeyFrameId(2));
    first_.EraseKeyFrame(KeyFrameId(3));
    first_.ErasePoint(points[5]);
    first_.MergePoints(points[6], points[7]);
    for (int i = 10; i < 30; ++i) AlignPoint(points[static_cast<std::size_t>(i)], i);
    gray_.assign(kPoints, 9);
    gray_[20] = 200;
  }

  void AlignPoint(MapPointId id, int i) {
    MapPoint& point = first_.point(id);
    point.num_visible = 10 + i;
    point.num_found = i;
    MapPoint::Anchor anchor;
    anchor.keyframe = point.observations.front().keyframe;
    anchor.pixel = {1.5F, static_cast<float>(i)};
    anchor.patch.gray.fill(static_cast<std::uint8_t>(i));
    point.anchor = anchor;
    first_.SetAlignedPixel(id, KeyFrameId(4), Eigen::Vector2f(3.25F, static_cast<float>(i)));
  }

  DescriptorKind kind() const { return first_.keyframe(KeyFrameId(0)).features->descriptor_kind(); }
  MapFileInfo Info() const { return MakeMapFileInfo(*scene_.view(), kind(), kWords); }
  fs::path Write(const std::string& name = "a.liftmap") const {
    const std::vector<std::uint8_t> no_gray;
    WriteMapFile(folder_ / name, Info(),
                 {{first_, gray_, {{KeyFrameId(5), KeyFrameId(0)}}}, {second_, no_gray, {}}});
    return folder_ / name;
  }
  MapFile Read(const fs::path& path) const { return ReadMapFile(path, scene_.view(), kind()); }

  // What reading the file says; empty: it was read.
  template <class Reading>
  static std::string Complaint(Reading reading) {
    try {
      reading();
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }
  std::string ComplaintAbout(const std::string& contents) const {
    const fs::path path = folder_.Write("changed.liftmap", contents);
    const std::string complaint = Complaint([&] { Read(path); });
    EXPECT_TRUE(complaint.empty() || complaint.find(path.string()) != std::string::npos);
    return complaint;
  }

  using Record = std::pair<MapRecord, std::vector<std::byte>>;
  // The bytes of a file whose records were changed, with the checksums that belong to them.
  std::string Forged(const std::function<void(std::vector<Record>&)>& change) const {
    std::vector<Record> records = Records(ReadText(Write()));
    change(records);
    std::ostringstream stream;
    MapRecordWriter writer(stream);
    for (const auto& [kind, bytes] : records) {
      RecordBytes record;
      record.PutArray(std::span<const std::byte>(bytes));
      writer.Write(kind, record);
    }
    return std::move(stream).str();
  }
  static std::vector<Record> Records(const std::string& file) {
    constexpr std::size_t kHead = 16, kRecordHead = 24, kSizeAt = 8;
    std::vector<Record> records;
    for (std::size_t at = kHead; at < file.size();) {
      std::uint64_t size = 0;
      std::memcpy(&size, &file[at + kSizeAt], sizeof size);
      const auto bytes = std::as_bytes(std::span(file)).subspan(at + kRecordHead, size);
      records.emplace_back(static_cast<MapRecord>(file[at]),
                           std::vector<std::byte>(bytes.begin(), bytes.end()));
      at += kRecordHead + size;
    }
    return records;
  }

  const TemporaryFolder folder_;
  SyntheticFrames scene_{kPoints, 4.0, 8.0, 3};
  Map first_, second_;
  std::vector<std::uint8_t> gray_;
};

TEST_F(MapFileTest, SavedLoadedAndSavedAgainHasTheSameBytes) {
  const fs::path path = Write();
  const MapFile file = Read(path);
  std::vector<MapToStore> again;
  for (const StoredMap& stored : file.maps) {
    again.push_back({*stored.map, stored.gray_of_point, stored.loops});
  }
  WriteMapFile(folder_ / "b.liftmap", file.info, again);
  EXPECT_EQ(ReadText(path), ReadText(folder_ / "b.liftmap"));
}

TEST_F(MapFileTest, LoadedMapIsTheOneThatWasSaved) {
  const MapFile file = Read(Write());
  ASSERT_EQ(file.maps.size(), 2U);
  EXPECT_EQ(file.info.vocabulary_checksum, kWords);
  const Map& map = *file.maps[0].map;
  ExpectConsistent(map);
  ExpectConsistent(*file.maps[1].map);
  EXPECT_EQ(map.KeyFrameIds(), first_.KeyFrameIds());
  EXPECT_EQ(map.PointIds(), first_.PointIds());
  EXPECT_EQ(map.newest_keyframe(), first_.newest_keyframe());
  for (const KeyFrameId id : map.KeyFrameIds()) {
    const KeyFrame &loaded = map.keyframe(id), &saved = first_.keyframe(id);
    EXPECT_TRUE(loaded.is_loaded);
    EXPECT_EQ(loaded.frame_index, saved.frame_index);
    EXPECT_EQ(loaded.timestamp_ns, saved.timestamp_ns);
    EXPECT_EQ(loaded.cam_from_world.rotation.coeffs(), saved.cam_from_world.rotation.coeffs());
    EXPECT_EQ(loaded.cam_from_world.translation, saved.cam_from_world.translation);
    EXPECT_EQ(loaded.map_points, saved.map_points);
    EXPECT_EQ(loaded.features->undistorted(50), saved.features->undistorted(50));
    EXPECT_TRUE(
        std::ranges::equal(loaded.features->descriptor(50), saved.features->descriptor(50)));
  }
  EXPECT_EQ(file.maps[0].gray_of_point[20], 200);
  EXPECT_EQ(file.maps[0].loops, (std::vector<KeyFramePair>{{KeyFrameId(5), KeyFrameId(0)}}));
}

TEST_F(MapFileTest, LoadedPointsKeepWhatIsKnownOfThem) {
  const MapFile file = Read(Write());
  const MapPoint &loaded = file.maps[0].map->point(MapPointId(20)),
                 &saved = first_.point(MapPointId(20));
  EXPECT_EQ(loaded.position, saved.position);
  EXPECT_EQ(loaded.normal, saved.normal);
  EXPECT_EQ(loaded.max_distance, saved.max_distance);
  EXPECT_EQ(loaded.descriptor, saved.descriptor);
  EXPECT_EQ(loaded.num_visible, saved.num_visible);
  EXPECT_EQ(loaded.num_found, saved.num_found);
  ASSERT_TRUE(loaded.anchor.has_value());
  EXPECT_EQ(loaded.anchor->patch.gray, saved.anchor->patch.gray);
  ASSERT_EQ(loaded.num_observations(), saved.num_observations());
  for (std::size_t i = 0; i < saved.observations.size(); ++i) {
    EXPECT_EQ(loaded.observations[i].pixel, saved.observations[i].pixel);
    EXPECT_EQ(loaded.observations[i].is_aligned, saved.observations[i].is_aligned);
  }
}

TEST_F(MapFileTest, ErasedKeyFramesResolveAsBeforeAndTheirIdsStayTaken) {
  MapFile file = Read(Write());
  Map& map = *file.maps[0].map;
  for (const KeyFrameId erased : {KeyFrameId(2), KeyFrameId(3)}) {
    EXPECT_EQ(map.FindKeyFrame(erased), nullptr);
    const auto loaded = map.ResolveReference(erased), saved = first_.ResolveReference(erased);
    ASSERT_TRUE(loaded && saved);
    EXPECT_EQ(loaded->keyframe, saved->keyframe);
    EXPECT_EQ(loaded->cam_from_keyframe.translation, saved->cam_from_keyframe.translation);
  }
  EXPECT_EQ(map.AddPoint({0, 0, 1}, KeyFrameId(5)), MapPointId(kPoints));
  EXPECT_EQ(map.AddKeyFrame(scene_.MakeFrame(9, Rigid3d())), KeyFrameId(6));
}

TEST_F(MapFileTest, EveryTruncationIsRefused) {
  const std::string whole = ReadText(Write());
  for (std::size_t size = 0; size < whole.size(); size += 1 + size / 7) {
    const std::string complaint = ComplaintAbout(whole.substr(0, size));
    EXPECT_THAT(complaint, HasSubstr(size < 8 ? "no map file" : "truncated")) << size;
  }
  EXPECT_THAT(ComplaintAbout(whole.substr(0, whole.size() - 1)), HasSubstr("truncated"));
  EXPECT_THAT(ComplaintAbout(whole + "x"), HasSubstr("1 bytes after its end"));
}

TEST_F(MapFileTest, EveryChangedByteIsFound) {
  const std::string whole = ReadText(Write());
  for (std::size_t at = 0; at < whole.size(); at += 1 + at / 9) {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ 4);
    EXPECT_NE(ComplaintAbout(changed), "") << at;
  }
  std::string changed = whole;
  changed[whole.size() / 2] ^= 1;
  EXPECT_THAT(ComplaintAbout(changed), HasSubstr("damaged"));
}

TEST_F(MapFileTest, ForeignFileAndOtherVersionAreNamedAsSuch) {
  EXPECT_THAT(ComplaintAbout("ply\nformat ascii 1.0\n"), HasSubstr("no map file of lift_slam"));
  std::string other = ReadText(Write());
  other[8] = 9;
  EXPECT_THAT(ComplaintAbout(other), HasSubstr("version 9, this program reads version 1"));
  EXPECT_THAT(Complaint([&] { Read(folder_ / "none"); }), HasSubstr("no such file"));
  EXPECT_THAT(Complaint([&] { Read(folder_.path()); }), HasSubstr("is no file"));
}

TEST_F(MapFileTest, OtherFeaturesAndOtherCameraAreRefused) {
  const fs::path path = Write();
  DescriptorKind lift = kind();
  lift.name = "lift:0123";
  EXPECT_THAT(Complaint([&] { ReadMapFile(path, scene_.view(), lift); }),
              HasSubstr("expected those of this run, 'lift:0123'"));
  auto view = std::make_shared<ViewModel>(*scene_.view());
  view->pinhole.fx += 1.0;
  EXPECT_THAT(Complaint([&] { ReadMapFile(path, view, kind()); }), HasSubstr("another camera"));
  view = std::make_shared<ViewModel>(*scene_.view());
  view->levels.num_levels += 1;
  EXPECT_THAT(Complaint([&] { ReadMapFile(path, view, kind()); }), HasSubstr("levels"));
}

TEST_F(MapFileTest, ValuesThatAreNotFiniteAreRefused) {
  constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
  const auto complaint = [&] { return Complaint([&] { Read(Write()); }); };
  MapPoint& point = first_.point(MapPointId(30));
  const MapPoint before = point;
  point.position.y() = kNoNumber;
  EXPECT_THAT(complaint(), HasSubstr("contradict"));
  point = before;
  point.max_distance = std::numeric_limits<double>::infinity();
  EXPECT_THAT(complaint(), HasSubstr("contradict"));
  point = before;
  EXPECT_EQ(complaint(), "");
  first_.SetPose(KeyFrameId(1), Rigid3d(Eigen::Quaterniond::Identity(), {0.0, kNoNumber, 0.0}));
  EXPECT_THAT(complaint(), HasSubstr("contradict"));
}

TEST_F(MapFileTest, DoubledKeyFramesAndPointsAreRefused) {
  EXPECT_EQ(ComplaintAbout(Forged([](std::vector<Record>&) {})), "");
  // The head of the first map: ids of keyframes and points, keyframes, records of points.
  EXPECT_THAT(ComplaintAbout(Forged([](std::vector<Record>& records) {
                records[1].second[16] = std::byte{5};  // instead of 4
                records.insert(records.begin() + 3, records[2]);
              })),
              HasSubstr("contradict"));
  EXPECT_THAT(ComplaintAbout(Forged([](std::vector<Record>& records) {
                records[1].second[24] = std::byte{4};  // instead of 3
                const auto points = std::ranges::find(records, MapRecord::kPoints, &Record::first);
                records.insert(points, Record(*points));
              })),
              HasSubstr("contradict"));
}

TEST_F(MapFileTest, MorePointIdsThanKeyFramesCanHaveMadeAreRefused) {
  EXPECT_THAT(ComplaintAbout(Forged([](std::vector<Record>& records) {
                records[1].second[11] = std::byte{0x7F};  // times 2^24
              })),
              HasSubstr("contradict"));
}

TEST_F(MapFileTest, UnwritablePlaceIsRefused) {
  EXPECT_NE(Complaint([&] { WriteMapFile(folder_ / "none" / "a.liftmap", Info(), {}); }), "");
}

}  // namespace
}  // namespace lift_slam
