#pragma once

#include "lift_slam/matching/epipolar_matcher.h"
#include "lift_slam/util/options.h"

namespace lift_slam {

struct LocalMapperOptions {
  int triangulation_neighbors = 10;  // covisible keyframes matched for new points
  double min_parallax_deg = 1.5;     // of a new point
  // Correlation of a new point's patch with others along its epipolar line; above: repetitive.
  double max_self_similarity = 0.85;
  int min_unique_points = 200;  // of a keyframe; with fewer, more repetitive ones are made as well,
  double max_self_similarity_of_few = 0.95;  // up to this correlation
  double min_baseline_ratio = 0.01;          // baseline over median scene depth of a keyframe pair
  int fusion_neighbors = 10;                 // covisible keyframes whose points are fused, and
  int fusion_second_neighbors = 5;           // of each of those as many again
  double fusion_radius_px = 3.0;             // on level 0
  int bundle_free_keyframes = 20;            // poses optimised, the new keyframe included
  int bundle_fixed_keyframes = 20;           // further observers, held fixed
  int bundle_min_shared_points = 15;         // of a covisible keyframe to take part
  double redundant_share = 0.9;              // of a keyframe's points seen by three others: culled
  double min_found_ratio = 0.25;             // of a new point's sightings over expected ones
  EpipolarMatchOptions epipolar;

  void Visit(OptionVisitor& visitor) {
    visitor.Field("triangulation_neighbors", triangulation_neighbors,
                  "covisible keyframes matched for new points");
    visitor.Field("min_parallax_deg", min_parallax_deg, "least parallax of a new point");
    visitor.Field("max_self_similarity", max_self_similarity,
                  "correlation of a new point's patch with others along its epipolar line");
    visitor.Field("min_unique_points", min_unique_points,
                  "points of a keyframe below which repetitive ones are made as well");
    visitor.Field("max_self_similarity_of_few", max_self_similarity_of_few,
                  "the correlation that these may have");
    visitor.Field("min_baseline_ratio", min_baseline_ratio,
                  "least baseline over median scene depth of a keyframe pair");
    visitor.Field("fusion_neighbors", fusion_neighbors, "covisible keyframes for fusion");
    visitor.Field("fusion_second_neighbors", fusion_second_neighbors,
                  "covisible keyframes of each of those");
    visitor.Field("fusion_radius_px", fusion_radius_px, "search window of fusion, full-size level");
    visitor.Field("bundle_free_keyframes", bundle_free_keyframes,
                  "poses optimised by local bundle adjustment");
    visitor.Field("bundle_fixed_keyframes", bundle_fixed_keyframes,
                  "further observers held fixed in local bundle adjustment");
    visitor.Field("bundle_min_shared_points", bundle_min_shared_points,
                  "map points a keyframe shares with the new one to be optimised");
    visitor.Field("redundant_share", redundant_share,
                  "share of points seen by three others that makes a keyframe redundant");
    visitor.Field("min_found_ratio", min_found_ratio,
                  "sightings over expected sightings below which a new point is culled");
    visitor.Field("max_epipolar_error_px", epipolar.max_epipolar_error_px,
                  "distance of a match from the epipolar line, full-size level");
    visitor.Field(
        "max_descriptor_ratio", epipolar.max_descriptor_ratio,
        "nearest over second nearest distance of a new point's match, descriptors of bits");
    visitor.Field("max_descriptor_ratio_of_floats", epipolar.max_descriptor_ratio_of_floats,
                  "the same for descriptors of floats (LIFT)");
  }
};

}  // namespace lift_slam
