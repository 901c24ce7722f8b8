#pragma once

#include <string>

#include "apps/finished_run.h"

namespace lift_slam {

// Text of result.json: the evaluation's object (ToJson in evaluation/result_json.h) and
//   configuration, ate_online, ate_keyframes (as ate, or null), map {maps, keyframes, points},
//   states {initializing, tracking, lost: frames}, refusals {reason: frames}, counters
//   {"stage.reason": n}, places {notice, loops_closed, maps_merged, relocalisations, events},
//   timing {wall_time_s, frames_per_s, frames_from_cache, frame_ms, stages {name: ...}},
//   memory {peak_bytes}, interrupted, warnings, provenance.
std::string RunResultJson(const FinishedRun& finished);

}  // namespace lift_slam
