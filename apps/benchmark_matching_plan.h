#pragma once

#include "apps/benchmark_plan.h"

namespace lift_slam {

// The suite "matching": each of the features (request.systems: orb, lift, sift; LIFT again with
// each of request.weights) on each sequence found, one job each. Throws InputError for others and
// for options that are for runs.
BenchmarkPlan MakeMatchingPlan(const BenchmarkRequest& request);

}  // namespace lift_slam
