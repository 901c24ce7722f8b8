#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "lift_slam/map/map.h"
#include "lift_slam/testing/synthetic_scene.h"

namespace lift_slam {

struct SyntheticMapOptions {
  int num_keyframes = 15;
  int num_points = 3300;      // of the scene; the last view holds about 2000 of them
  double mapped_share = 0.6;  // of the points that the map holds; the others are to be found
  double step_m = 0.15;       // between cameras; the scene is 4 to 20 m ahead
  int flipped_bits = 20;      // of 256, between two descriptors of one point
  std::uint64_t seed = 1;
};

// A map with known truth in the size of a real one, to time the stages that work on a map. The
// camera goes forward and a little aside; each view has a feature for each scene point in it, with
// a random 256-bit descriptor of the point's own, some bits flipped from view to view.
class SyntheticMap {
 public:
  explicit SyntheticMap(const SyntheticMapOptions& options);

  const std::shared_ptr<const ViewModel>& view() const { return view_; }
  // Camera `i`, counted on beyond the keyframes: true pose, no matches.
  Frame MakeFrame(int i) const;
  // The same with its matches to the points of MakeMap.
  Frame MakeTrackedFrame(int i) const;
  // Keyframes 0 to num_keyframes - 1 and the mapped points they see. The same each time.
  std::unique_ptr<Map> MakeMap() const;

 private:
  FrameFeatures MakeFeatures(int camera) const;
  bool IsMapped(int point) const { return point < num_mapped_; }

  SyntheticMapOptions options_;
  SyntheticScene scene_;
  std::shared_ptr<const ViewModel> view_;
  std::vector<std::array<std::uint64_t, 4>> descriptors_;       // by scene point
  std::vector<std::shared_ptr<const FrameFeatures>> features_;  // by camera
  int num_mapped_ = 0;  // the first scene points; map point ids are their indices
};

}  // namespace lift_slam
