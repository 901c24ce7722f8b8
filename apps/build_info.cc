#include "apps/build_info.h"

namespace lift_slam {

// The macros come from apps/CMakeLists.txt.
const char* const kProgramVersion = LIFT_SLAM_VERSION;
const char* const kBuildType = LIFT_SLAM_BUILD_TYPE;
const char* const kCompiler = LIFT_SLAM_COMPILER;
const char* const kOpenCvVersion = LIFT_SLAM_OPENCV_VERSION;
const char* const kEigenVersion = LIFT_SLAM_EIGEN_VERSION;
const char* const kCeresVersion = LIFT_SLAM_CERES_VERSION;

}  // namespace lift_slam
