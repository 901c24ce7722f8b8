#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "lift_slam/camera/camera.h"
#include "lift_slam/geometry/rigid3.h"
#include "lift_slam/simulation/depth_file.h"
#include "lift_slam/util/options.h"

namespace lift_slam {

// Which pairs of frames are worth training on.
struct PairOptions {
  double max_distance_m = 15.0;
  double max_angle_deg = 45.0;
  double min_overlap = 0.25;
  int max_pairs_per_frame = 20;  // a seeded choice among those near enough
  void Visit(OptionVisitor& visitor);
  void Check() const;  // throws InputError naming the field
};

// Two frames and how they lie; first < second.
struct FramePair {
  int first = 0, second = 0;
  double distance_m = 0.0;  // between the camera centres
  double angle_deg = 0.0;   // of the relative rotation
  double overlap = 0.0;  // lesser of both directions: share of the pixels seen in the other frame
};

// Share of the pixels of one frame, on a grid, whose points the other frame sees unoccluded: they
// project into its image, and its depth there agrees within 3 %. Pixels without depth count as not
// seen.
double Overlap(const Camera& camera, const DepthImage& depth, const Rigid3d& cam_from_world,
               const DepthImage& other_depth, const Rigid3d& other_from_world);

// All pairs wanted, by first and second frame. `read_depth` gives the depth of a frame.
std::vector<FramePair> ListPairs(const Camera& camera, const std::vector<Rigid3d>& world_from_cam,
                                 const std::function<DepthImage(int)>& read_depth,
                                 const PairOptions& options, std::uint64_t seed);

// "first second distance_m angle_deg overlap" a line, below a comment that says so.
std::string PairsText(const std::vector<FramePair>& pairs);

}  // namespace lift_slam
