#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "lift_slam/loop_closing/loop_confirmation.h"
#include "lift_slam/slam/map_session.h"
#include "lift_slam/slam/run_record.h"
#include "lift_slam/slam/slam_options.h"

namespace lift_slam {

// All maps of a run, by age, at most one of which is tracked (active). Relocalises in any of them
// and merges two that show the same place. Writes what happens into the run's record.
class MapCollection {
 public:
  // Without a vocabulary no place is recognised. `record` must outlive this.
  MapCollection(const SlamOptions& options, std::shared_ptr<const Vocabulary> vocabulary,
                RunRecord& record);

  MapSession* active() { return active_; }
  const MapSession* active() const { return active_; }
  int active_index() const;

  // Takes up maps of an earlier run, before the first frame; none is active.
  void Load(std::vector<StoredMap> stored);
  // Writes all maps, as they are after the run, into a file. Call after all else.
  void Store(const std::filesystem::path& path, const MapFileInfo& info);

  // Begins a map, which becomes active.
  void Begin(InitialMap initial, const GrayImage& image);
  // The active map is kept, but not tracked any more.
  void Leave() { active_ = nullptr; }
  // The active map, which must be the youngest, is forgotten, and the frames' records of it too.
  void ThrowAwayActive();

  // Looks for a lost frame by its words: in the active map, or without one in all. The map that
  // shows the frame becomes active. Nothing when none does.
  std::optional<MapSession::Step> Relocalize(const PreparedFrame& prepared);
  // Records what loop closing found in the step of the active map; with its new keyframe looks for
  // other maps that show the same place and joins the first: nothing is thrown away.
  void RecognizePlaces(const MapSession::Step& step);

  const std::vector<std::unique_ptr<MapSession>>& maps() const { return maps_; }
  // Of all maps, when the input has ended.
  void AdjustAll();

 private:
  // What two maps' keyframes have said of where the one lies in the other.
  struct MergeClaims {
    const MapSession* active;
    const MapSession* other;
    LoopConfirmation confirmation;
  };

  // Whether another keyframe has said the same of the active map and another one.
  bool IsConfirmed(const PlaceAttempt& attempt, const MapSession& other);
  void RecordReport(const LoopReport& report, const MapSession& other, PlaceEventKind kind);
  void MergeWith(std::size_t other, const PlaceAttempt& attempt);
  // The younger map's frames now belong to the older one.
  void RenumberFrames(int younger, int older);

  SlamOptions options_;
  std::shared_ptr<const Vocabulary> vocabulary_;
  RunRecord& record_;
  std::vector<std::unique_ptr<MapSession>> maps_;
  MapSession* active_ = nullptr;
  std::vector<MergeClaims> merge_claims_;  // of maps that are there
};

}  // namespace lift_slam
