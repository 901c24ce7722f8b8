#pragma once

namespace lift_slam {

// Facts of the build, fixed when the program was compiled.
extern const char* const kGitRevision;     // full hash, "-dirty" appended; "unknown" outside git
extern const char* const kProgramVersion;  // "0.1.0"
extern const char* const kBuildType;       // "Release"
extern const char* const kCompiler;        // "GNU 12.2.0"
extern const char* const kOpenCvVersion;
extern const char* const kEigenVersion;
extern const char* const kCeresVersion;

}  // namespace lift_slam
