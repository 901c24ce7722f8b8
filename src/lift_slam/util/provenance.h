#pragma once

#include <cstdint>
#include <string>

#include "lift_slam/util/option_root.h"

namespace lift_slam {

// Where a result came from: enough to make it again.
struct Provenance {
  std::string program_version;  // "0.1.0"
  std::string git_revision;     // full hash, "-dirty" appended when files differ from it
  std::string config_sha256;    // SHA-256 of the effective options as YAML (OptionsToYaml)
  std::string cpu_name;
  int threads = 0;                     // that the machine offers this process
  std::string date_utc;                // "2024-05-01T12:00:00Z", when this was filled in
  std::int64_t peak_memory_bytes = 0;  // of the process up to then
};

// Fills in everything. The program hands over its own version and revision, which the library does
// not know: it would have to be rebuilt at every commit.
Provenance CollectProvenance(const std::string& program_version, const std::string& git_revision,
                             const OptionRoot& effective_options);

}  // namespace lift_slam
