#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "lift_slam/geometry/two_view_reconstruction.h"
#include "lift_slam/map/map.h"
#include "lift_slam/matching/feature_matcher.h"
#include "lift_slam/optimization/map_bundle.h"
#include "lift_slam/tracking/tracking_state.h"
#include "lift_slam/util/options.h"

namespace lift_slam {

struct MapInitializerOptions {
  double search_window_ratio = 0.09;  // half side of the match window, of the image's width
  int min_features = 100;             // an image with fewer cannot begin a map
  int max_poor_frames = 3;            // frames with too few matches before the reference moves on
  int max_waiting_frames = 150;       // frames kept to be tracked once the map exists
  int min_points = 50;                // of the first map after bundle adjustment
  TwoViewOptions two_view;

  void Visit(OptionVisitor& visitor) {
    visitor.Field("search_window_ratio", search_window_ratio,
                  "half side of the match window as a share of the image's width");
    visitor.Field("min_features", min_features, "features an image needs to begin a map");
    visitor.Field("max_poor_frames", max_poor_frames,
                  "frames with too few matches before the reference frame moves on");
    visitor.Field("max_waiting_frames", max_waiting_frames,
                  "frames before the first map that are tracked afterwards");
    visitor.Field("min_points", min_points, "points of the first map after bundle adjustment");
    visitor.Group("two_view", two_view, "relative pose of the first two keyframes");
  }
};

// A map just begun from two views.
struct InitialMap {
  std::unique_ptr<Map> map;    // two keyframes: 0 is the reference, 1 the current frame
  Frame current;               // pose and matches valid
  std::vector<Frame> waiting;  // earlier frames without pose, in order, the reference included
  TwoViewReconstruction two_view;
};

// Two views to a first map (paper sec. 3.2; ORB-SLAM sec. IV). Keeps a reference frame and tries
// each new frame against it. The reference is kept while frames match it, whatever else they are
// refused for; after `max_poor_frames` it moves to the middle of the frames since.
class MapInitializer {
 public:
  MapInitializer(std::shared_ptr<const ViewModel> view, const MapInitializerOptions& options,
                 const BundleOptions& bundle, std::uint64_t seed)
      : view_(std::move(view)), options_(options), bundle_options_(bundle), seed_(seed) {}

  struct Result {
    FrameRefusal refusal = FrameRefusal::kNone;
    int num_matches = 0;
    std::optional<InitialMap> initial;  // when nothing was refused
  };
  Result Process(const Frame& frame);

 private:
  void SetReference(std::size_t waiting_index);
  void MoveReference();
  void LetGoOfOldImage();
  TwoViewReconstruction Reconstruct(const Frame& frame,
                                    const std::vector<FeatureMatch>& matches) const;
  std::optional<InitialMap> BuildMap(const Frame& frame, const std::vector<FeatureMatch>& matches,
                                     TwoViewReconstruction two_view) const;
  const Frame& reference() const { return waiting_[reference_]; }

  std::shared_ptr<const ViewModel> view_;
  MapInitializerOptions options_;
  BundleOptions bundle_options_;
  std::uint64_t seed_;
  std::vector<Frame> waiting_;             // frames without pose, in order
  std::size_t reference_ = 0;              // index into waiting_
  std::vector<Eigen::Vector2f> expected_;  // where the reference's features were seen last
  int poor_frames_ = 0;
};

}  // namespace lift_slam
