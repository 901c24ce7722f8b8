#pragma once

#include <string>

namespace lift_slam {

struct EvaluationResult;

// The numbers of one evaluation for people: several small tables, a unit in every header.
std::string FormatResult(const EvaluationResult& result);

}  // namespace lift_slam
