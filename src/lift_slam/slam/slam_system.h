#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "lift_slam/slam/annotated_frame_album.h"
#include "lift_slam/slam/frame_preparer.h"
#include "lift_slam/slam/map_session.h"
#include "lift_slam/slam/run_record.h"
#include "lift_slam/slam/slam_options.h"

namespace lift_slam {

// The whole of SLAM over one input: begins maps, tracks and maps frame by frame, and goes on with a
// fresh map when the old one is lost for good. Runs everything in the calling thread.
class SlamSystem {
 public:
  SlamSystem(const Camera& camera, std::shared_ptr<const ViewModel> view,
             const SlamOptions& options);

  // Frames must come in order of time.
  const FrameRecord& Process(const PreparedFrame& prepared);

  // Ends the run: final bundle adjustment, then everything there is to know about it.
  RunRecord Finish();

  TrackingState state() const { return state_; }
  int num_keyframes() const { return session_ ? session_->map().num_keyframes() : 0; }
  int num_points() const { return session_ ? session_->map().num_points() : 0; }

 private:
  void ProcessInitializing(const PreparedFrame& prepared, FrameRecord& record);
  void ProcessTracking(const PreparedFrame& prepared, FrameRecord& record);
  void HandleLost(const PreparedFrame& prepared, FrameRecord& record);
  // The map with this number was thrown away: another will have the number.
  void ForgetMapOfFrames(int map_index);
  void BeginInitializing();
  void CountMapping(const MappingReport& report);
  void AdjustFinalMaps();

  Camera camera_;
  std::shared_ptr<const ViewModel> view_;
  SlamOptions options_;
  TrackingState state_ = TrackingState::kInitializing;
  std::unique_ptr<MapInitializer> initializer_;
  std::unique_ptr<MapSession> session_;                // the map tracked now; null: none
  std::vector<std::unique_ptr<MapSession>> finished_;  // maps kept, by age
  std::int64_t last_tracked_ns_ = 0;
  AnnotatedFrameAlbum album_;
  RunRecord record_;
};

}  // namespace lift_slam
