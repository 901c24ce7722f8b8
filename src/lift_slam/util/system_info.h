#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace lift_slam {

// "AMD EPYC 9555 64-Core Processor", or "unknown CPU".
std::string CpuName();
// Instruction sets that matter here and that this CPU has, of: sse4.2, avx2, fma, avx512f,
// avx512_vnni, avx512_bf16. Empty on other architectures.
std::vector<std::string> CpuFeatures();
// Threads that can run at once for this process; at least 1.
int NumHardwareThreads();
// Of the running program's file; nothing when the system does not say.
std::optional<std::filesystem::path> ProgramPath();
// Main memory of the machine; 0 when unknown.
std::int64_t TotalMemoryBytes();
// The most memory this process has held so far (resident set).
std::int64_t PeakMemoryBytes();

}  // namespace lift_slam
