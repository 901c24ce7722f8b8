#include "lift_slam/slam/slam_options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

using testing::HasSubstr;

void ExpectRefused(const SlamOptions& options, const std::string& name) {
  try {
    options.Check();
    ADD_FAILURE() << name << " was accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr(name));
  }
}

TEST(SlamOptions, DefaultsAreInRange) { EXPECT_NO_THROW(SlamOptions().Check()); }

TEST(SlamOptions, WhatWouldDoNothingIsRefused) {
  SlamOptions options;
  options.final_bundle.num_threads = 0;
  ExpectRefused(options, "'slam.final_bundle.num_threads' is 0, expected a number from 1 to 256");
  options = {};
  options.loop_closing.bundle.bundle.plain_iterations = 0;
  ExpectRefused(options, "slam.loop_closing.bundle.bundle.plain_iterations");
  options = {};
  options.tracker.pose.rounds = 0;
  ExpectRefused(options, "slam.tracker.pose.rounds");
  options = {};
  options.alignment.sigma_factor = 0.0;
  ExpectRefused(options, "slam.alignment.sigma_factor");
}

TEST(SlamOptions, NothingIsNegative) {
  SlamOptions options;
  options.local_mapper.fusion_radius_px = -1.0;
  ExpectRefused(options, "'slam.local_mapper.fusion_radius_px' is -1");
}

TEST(SlamOptions, FixedThresholdsAreNotForAdaptiveOnes) {
  SlamOptions options;
  options.features.type = FeatureType::kLift;
  options.features.lift.high_threshold = 2.5;
  ExpectRefused(options, "slam.matching.thresholds=fixed");
  options.matching.thresholds = ThresholdMode::kFixed;
  EXPECT_NO_THROW(options.Check());
}

}  // namespace
}  // namespace lift_slam
