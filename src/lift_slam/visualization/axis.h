#pragma once

#include <string>
#include <vector>

namespace lift_slam {

// A closed range of numbers on an axis; empty until the first Add.
struct AxisRange {
  double min = 0.0, max = 0.0;
  bool empty = true;

  // Values that are not finite are left out.
  void Add(double value);
  void Add(const std::vector<double>& values);
  double length() const { return max - min; }
};

// Ticks at 1, 2 or 5 times a power of ten.
struct AxisTicks {
  double step = 1.0;
  std::vector<double> values;       // inside the range, ascending
  std::vector<std::string> labels;  // one for each value, all with the same decimals
};

// At most `max_count` (>= 2) ticks within a range of positive length. With `integers` no step is
// below one.
AxisTicks MakeTicks(const AxisRange& range, int max_count, bool integers = false);

// A range of positive length around a possibly empty or single-valued one.
AxisRange WithLength(const AxisRange& range);
// The range grown to the next ticks on both sides.
AxisRange GrownToTicks(const AxisRange& range, int max_count);

}  // namespace lift_slam
