#include "lift_slam/util/provenance.h"

#include <fmt/chrono.h>

#include <chrono>

#include "lift_slam/util/option_writer.h"
#include "lift_slam/util/sha256.h"
#include "lift_slam/util/system_info.h"

namespace lift_slam {

Provenance CollectProvenance(const std::string& program_version, const std::string& git_revision,
                             const OptionRoot& effective_options) {
  Provenance provenance;
  provenance.program_version = program_version;
  provenance.git_revision = git_revision;
  provenance.config_sha256 = Sha256Hex(OptionsToYaml(effective_options));
  provenance.cpu_name = CpuName();
  provenance.threads = NumHardwareThreads();
  const auto now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  provenance.date_utc = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now));
  provenance.peak_memory_bytes = PeakMemoryBytes();
  return provenance;
}

}  // namespace lift_slam
