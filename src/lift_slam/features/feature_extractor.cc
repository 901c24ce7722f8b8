#include "lift_slam/features/feature_extractor.h"

#include <cmath>

namespace lift_slam {

double ScaleLevels::Scale(int level) const { return std::pow(scale_factor, level); }

}  // namespace lift_slam
