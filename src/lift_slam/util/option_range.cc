#include "lift_slam/util/option_range.h"

#include <fmt/format.h>

#include "lift_slam/util/input_error.h"

namespace lift_slam {

void CheckOptionRange(std::string_view name, double value, double low, double high) {
  if (value >= low && value <= high) return;  // false for NaN too
  throw InputError(
      fmt::format("option '{}' is {}, expected a number from {} to {}", name, value, low, high));
}

}  // namespace lift_slam
