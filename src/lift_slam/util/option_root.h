#pragma once

#include <functional>

#include "lift_slam/util/options.h"

namespace lift_slam {

// Shows all options of a program to a visitor. Refers to the struct it was made from, which must
// outlive it.
using OptionRoot = std::function<void(OptionVisitor&)>;

template <class Options>
OptionRoot MakeOptionRoot(Options& options) {
  return [&options](OptionVisitor& visitor) { options.Visit(visitor); };
}

}  // namespace lift_slam
