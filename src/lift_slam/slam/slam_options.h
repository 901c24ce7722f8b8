#pragma once

#include <cstdint>

#include "lift_slam/image/impulse_noise.h"
#include "lift_slam/image/patch_alignment.h"
#include "lift_slam/local_mapping/local_mapper_options.h"
#include "lift_slam/loop_closing/loop_closing_options.h"
#include "lift_slam/matching/adaptive_thresholds.h"
#include "lift_slam/optimization/bundle_adjustment.h"
#include "lift_slam/slam/feature_options.h"
#include "lift_slam/tracking/map_initializer.h"
#include "lift_slam/tracking/tracker_options.h"

namespace lift_slam {

struct SlamOptions {
  int seed = 0;  // of everything random; set by the caller, not by Visit
  // Poses in loaded maps, which stay as they are, and no others; set by the caller, not by Visit.
  bool localization_only = false;
  double recovery_time_s = 1.0;   // a lost map is tried again so long, then a new one is begun
  int min_keyframes_to_keep = 5;  // a map lost with fewer is thrown away ("reset")
  bool final_bundle_adjustment = true;  // of every kept map, when the input has ended
  ImpulseNoiseOptions impulse_noise;
  FeatureOptions features;
  MatchingOptions matching;
  PatchAlignmentOptions alignment;
  MapInitializerOptions initializer;
  TrackerOptions tracker;
  LocalMapperOptions local_mapper;
  LoopClosingOptions loop_closing;
  BundleOptions local_bundle;  // also of the first map
  BundleOptions final_bundle = FinalBundleDefaults();
  SelfCalibrationOptions self_calibration;  // after the final bundle adjustment

  void Visit(OptionVisitor& visitor) {
    visitor.Field("recovery_time_s", recovery_time_s,
                  "a lost map is tried again for so long before a new one is begun");
    visitor.Field("min_keyframes_to_keep", min_keyframes_to_keep,
                  "a map lost with fewer keyframes is thrown away");
    visitor.Field("final_bundle_adjustment", final_bundle_adjustment,
                  "adjust whole maps when the input has ended");
    visitor.Group("impulse_noise", impulse_noise, "salt-and-pepper noise of the images");
    visitor.Field("features", features.type, kFeatureTypeNames, "kind of features");
    visitor.Field("lift_weights", features.lift_weights,
                  "file of LIFT's weights (.safetensors); empty: those that ship");
    visitor.Group("orb", features.orb, "ORB features");
    visitor.Group("lift", features.lift, "LIFT features");
    visitor.Group("matching", matching, "which descriptors match");
    visitor.Group("alignment", alignment, "sub-pixel alignment of matched features");
    visitor.Group("initializer", initializer, "how a map is begun");
    visitor.Group("tracker", tracker, "image to pose");
    visitor.Group("local_mapper", local_mapper, "keyframe to map");
    visitor.Group("loop_closing", loop_closing, "places seen before");
    visitor.Group("local_bundle", local_bundle, "local bundle adjustment");
    visitor.Group("final_bundle", final_bundle, "bundle adjustment of whole maps at the end");
    visitor.Group("self_calibration", self_calibration,
                  "correction of the given calibration, with the final bundle adjustment");
  }

  // Throws InputError naming the option that is out of range, or that another one makes void.
  void Check() const;

  static BundleOptions FinalBundleDefaults();
};

}  // namespace lift_slam
