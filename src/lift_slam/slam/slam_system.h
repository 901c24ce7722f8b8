#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "lift_slam/slam/annotated_frame_album.h"
#include "lift_slam/slam/frame_preparer.h"
#include "lift_slam/slam/map_collection.h"
#include "lift_slam/slam/run_record.h"
#include "lift_slam/slam/slam_options.h"

namespace lift_slam {

// The whole of SLAM over one input: begins maps, tracks and maps frame by frame, and goes on with a
// fresh map when the old one is lost for good. Runs everything in the calling thread.
class SlamSystem {
 public:
  // Without a vocabulary (of the features' kind) neither loops nor lost frames are recognised.
  // Throws InputError as SlamOptions::Check.
  SlamSystem(const Camera& camera, std::shared_ptr<const ViewModel> view,
             const SlamOptions& options, std::shared_ptr<const Vocabulary> vocabulary = nullptr);

  // Takes up the maps of a file; see ReadMapFile. Before the first frame, which no map is then
  // active for: frames are looked for in the loaded maps first. Needs a vocabulary.
  void LoadMaps(MapFile file);
  // Frames must come in order of time.
  const FrameRecord& Process(const PreparedFrame& prepared);

  // Ends the run: final bundle adjustment, then everything there is to know about it.
  RunRecord Finish();
  // After Finish: writes all maps into a file. Throws InputError when it cannot be written.
  void SaveMaps(const std::filesystem::path& path, const MapFileInfo& info) {
    maps_.Store(path, info);
  }

  TrackingState state() const { return state_; }
  int num_keyframes() const {
    return maps_.active() != nullptr ? maps_.active()->map().num_keyframes() : 0;
  }
  int num_points() const {
    return maps_.active() != nullptr ? maps_.active()->map().num_points() : 0;
  }
  // So far.
  const std::vector<PlaceEvent>& place_events() const { return record_.place_events; }

 private:
  void ProcessInitializing(const PreparedFrame& prepared, FrameRecord& record);
  void ProcessWithoutMap(const PreparedFrame& prepared, FrameRecord& record);
  void ProcessTracking(const PreparedFrame& prepared, FrameRecord& record);
  // Whether so much time has passed since the last tracked frame that it predicts nothing.
  bool IsAfterGap(std::int64_t timestamp_ns) const;
  // Looks for the frame by its words; false when no map shows it.
  bool Relocalize(const PreparedFrame& prepared, FrameRecord& record);
  void RecordTracked(const MapSession::Step& step, const PreparedFrame& prepared,
                     FrameRecord& record);
  void HandleLost(const PreparedFrame& prepared, FrameRecord& record);
  void BeginInitializing();
  void CountMapping(const MappingReport& report);

  Camera camera_;
  std::shared_ptr<const ViewModel> view_;
  SlamOptions options_;
  TrackingState state_ = TrackingState::kInitializing;
  std::unique_ptr<MapInitializer> initializer_;
  std::int64_t last_tracked_ns_ = 0;
  std::int64_t last_frame_ns_ = 0, frame_interval_ns_ = 0;  // of the frames before; 0: none yet
  AnnotatedFrameAlbum album_;
  RunRecord record_;
  MapCollection maps_;  // writes into record_
};

}  // namespace lift_slam
