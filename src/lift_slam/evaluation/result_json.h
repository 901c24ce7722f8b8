#pragma once

#include <nlohmann/json_fwd.hpp>

namespace lift_slam {

struct ErrorStatistics;
struct EvaluationResult;

// result.json of one run (fields and units in docs/evaluation.md). The program that ran the system
// adds to the object: timing, provenance, counts of states. What was not measured is null.
nlohmann::ordered_json ToJson(const EvaluationResult& result);

// {rmse, mean, median, std, min, max, n}
nlohmann::ordered_json ToJson(const ErrorStatistics& statistics);

}  // namespace lift_slam
