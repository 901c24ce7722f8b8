#include "apps/benchmark_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include "apps/build_info.h"
#include "lift_slam/util/environment.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/nearest_name.h"
#include "lift_slam/util/sha256.h"
#include "lift_slam/util/shipped_file.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;

constexpr const char* kKitti[] = {"00", "01", "02", "03", "04", "05", "06", "07", "08", "09", "10"};
constexpr const char* kEuroc[] = {"MH_01", "MH_02", "MH_03", "MH_04", "MH_05", "V1_01",
                                  "V1_02", "V1_03", "V2_01", "V2_02", "V2_03"};
constexpr const char* kRobustnessKitti[] = {"03", "06", "07", "10"};
constexpr const char* kRobustnessEuroc[] = {"MH_02"};
// The two sequences of the paper's Table 1.
constexpr const char* kThresholdsKitti[] = {"05"};
constexpr const char* kThresholdsEuroc[] = {"MH_01"};
// Images of each sequence, in the order of kKitti and kEuroc.
constexpr int kKittiFrames[] = {4541, 1101, 4661, 801, 271, 2761, 1101, 1101, 4071, 1591, 1201};
constexpr int kEurocFrames[] = {3682, 3040, 2700, 2033, 2273, 2912, 1710, 2149, 2280, 2348, 1922};
constexpr int kSearchDepth = 6;
constexpr std::uintmax_t kMaxTextBytes = 64U << 20U;

// "kitti", "euroc" or nothing, by what lies in the folder.
std::string DatasetOf(const fs::path& folder) {
  if (fs::is_directory(folder / "mav0" / "cam0")) return "euroc";
  for (const char* images : {"image_0", "image_2", "image_00"}) {
    if (fs::is_directory(folder / images)) return "kitti";
  }
  return fs::is_regular_file(folder / "rgb.txt") ? "euroc" : "";  // a hand-held camera, indoors
}

// Sequences in a folder and below, by path.
std::vector<BenchmarkSequence> SearchSequences(const fs::path& folder, int depth) {
  std::vector<BenchmarkSequence> found;
  if (const std::string dataset = DatasetOf(folder); !dataset.empty()) {
    return {{folder.filename().string(), dataset, folder, {}}};
  }
  if (depth == 0) return found;
  std::set<fs::path> below;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_directory()) below.insert(entry.path());
  }
  for (const fs::path& path : below) {
    const auto more = SearchSequences(path, depth - 1);
    found.insert(found.end(), more.begin(), more.end());
  }
  return found;
}

// "track/sequences/00" is called "track": every rendered track is a KITTI tree of its own.
std::string RenderedName(const fs::path& folder) {
  return folder.parent_path().filename() == "sequences"
             ? folder.parent_path().parent_path().filename().string()
             : folder.filename().string();
}

// Names that several sequences share become those of RenderedName, and where these are shared too
// the way from `data`.
void MakeNamesDifferent(const fs::path& data, std::vector<BenchmarkSequence>& sequences) {
  const auto rename_shared = [&](const auto& name_of) {
    std::map<std::string, int> counts;
    for (const BenchmarkSequence& sequence : sequences) ++counts[sequence.name];
    for (BenchmarkSequence& sequence : sequences) {
      if (counts[sequence.name] > 1) sequence.name = name_of(sequence.folder);
    }
  };
  rename_shared(RenderedName);
  rename_shared([&](const fs::path& folder) { return folder.lexically_relative(data).string(); });
}

template <class Names>
void Choose(const Names& names, const std::string& dataset,
            const std::vector<BenchmarkSequence>& found, std::vector<BenchmarkSequence>& chosen) {
  for (const std::string name : names) {
    BenchmarkSequence sequence{name, dataset, {}, {}};
    for (const BenchmarkSequence& candidate : found) {
      // EuRoC's folders go on after the number: MH_01_easy.
      const bool fits =
          dataset == "euroc" ? candidate.name.starts_with(name) : candidate.name == name;
      if (!fits || candidate.dataset != dataset) continue;
      if (sequence.folder.empty()) {
        sequence.folder = candidate.folder;
      } else if (!fs::equivalent(candidate.folder, sequence.folder)) {
        sequence.rival = candidate.folder;
      }
    }
    chosen.push_back(sequence);
  }
}

bool IsSmallText(const fs::path& file) {
  const std::string extension = file.extension().string();
  const bool is_text = extension == ".txt" || extension == ".csv" || extension == ".yaml" ||
                       extension == ".yml" || extension == ".xml";
  return is_text && fs::file_size(file) <= kMaxTextBytes;
}

fs::path PresetFolder() {
  return EnvironmentPath("LIFT_SLAM_SYSTEMS_DIR").value_or(ShippedFile("configs/systems"));
}

std::vector<std::string> PresetNames(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".yaml") continue;
    names.insert(
        entry.path().filename().string().substr(0, entry.path().filename().string().find('.')));
  }
  return {names.begin(), names.end()};
}

}  // namespace

std::vector<BenchmarkSequence> FindBenchmarkSequences(const std::string& suite,
                                                      const fs::path& data) {
  if (!fs::is_directory(data)) {
    throw InputError(fmt::format("--data '{}': no such folder", data.string()));
  }
  std::vector<BenchmarkSequence> found = SearchSequences(fs::canonical(data), kSearchDepth);
  std::vector<BenchmarkSequence> chosen;
  if (suite == "kitti") Choose(kKitti, "kitti", found, chosen);
  if (suite == "euroc") Choose(kEuroc, "euroc", found, chosen);
  if (suite == "robustness") {
    Choose(kRobustnessKitti, "kitti", found, chosen);
    Choose(kRobustnessEuroc, "euroc", found, chosen);
  }
  if (suite == "thresholds") {
    Choose(kThresholdsEuroc, "euroc", found, chosen);
    Choose(kThresholdsKitti, "kitti", found, chosen);
  }
  if (suite == "rendered" || suite == "shared" || suite == "ablation" || suite == "matching") {
    for (BenchmarkSequence& sequence : found) {
      if (suite == "rendered") sequence.name = RenderedName(sequence.folder);
      chosen.push_back(sequence);
    }
    MakeNamesDifferent(fs::canonical(data), chosen);
  }
  return chosen;
}

int PublishedFrames(const std::string& sequence) {
  const auto frames_in = [&](const auto& names, const auto& frames) {
    const auto found = std::ranges::find(names, sequence);
    return found == std::end(names) ? 0 : frames[found - std::begin(names)];
  };
  return std::max(frames_in(kKitti, kKittiFrames), frames_in(kEuroc, kEurocFrames));
}

std::string SequenceIdentity(const fs::path& folder) {
  std::set<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files.insert(entry.path());
  }
  std::string text;
  for (const fs::path& file : files) {
    text += fmt::format("{} {}\n", file.lexically_relative(folder).string(), fs::file_size(file));
    if (IsSmallText(file)) text += ReadText(file);
  }
  const fs::path truth =
      folder.parent_path().parent_path() / "poses" / (folder.filename().string() + ".txt");
  if (fs::is_regular_file(truth)) text += ReadText(truth);
  return Sha256Hex(text);
}

std::string ProgramIdentity() {
  const std::string revision = kGitRevision;
  if (!revision.ends_with("-dirty") && revision != "unknown") return revision;
  return revision + " " + Sha256Hex(ReadText("/proc/self/exe"));
}

BenchmarkSystem FindBenchmarkSystem(const std::string& name, const std::string& dataset) {
  const fs::path folder = PresetFolder();
  BenchmarkSystem system{name, name, {}, {}, {}, {}};
  for (const fs::path& path :
       {fs::path(name), folder / (name + "." + dataset + ".yaml"), folder / (name + ".yaml")}) {
    if (system.config.empty() && path.extension() == ".yaml" && fs::is_regular_file(path)) {
      system.config = fs::canonical(path);
    }
  }
  if (system.config.empty()) {
    const auto names = PresetNames(folder);
    throw InputError(
        fmt::format("system '{}' is neither a preset nor a .yaml file; the nearest "
                    "preset is '{}'",
                    name, NearestName(name, names)));
  }
  for (const std::string& line : ReadLines(system.config)) {
    if (line.starts_with("# title: ")) system.title = line.substr(9);
    if (line.starts_with("# make: ")) system.making = line.substr(8);
    if (!line.starts_with("# skip: ")) continue;
    std::istringstream words(line.substr(8));
    for (std::string word; words >> word;) system.skipped_sequences.push_back(word);
  }
  return system;
}

}  // namespace lift_slam
