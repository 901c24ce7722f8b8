#pragma once

#include <string_view>

namespace lift_slam {

// For the Check() of option structs: throws InputError naming the option ("drive.laps"), its value
// and the range when the value lies outside [low, high] or is not a number.
void CheckOptionRange(std::string_view name, double value, double low, double high);

}  // namespace lift_slam
