#include "lift_slam/slam/frame_preparer.h"

#include "lift_slam/util/timer.h"

namespace lift_slam {
