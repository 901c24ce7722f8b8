#include "apps/benchmark_document.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "apps/benchmark_jobs.h"
#include "apps/benchmark_outcome.h"
#include "apps/benchmark_plan.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr std::size_t kMaxFigureBytes = 60000;  // a document is kept with the source

// Where the results of a benchmark come from.
struct Origin {
  int finished = 0;
  std::set<std::string> processors, revisions, dates;
  std::map<std::string, std::string> settings;  // SHA-256 by title, of the first run
  std::map<std::string, int> frames;            // by sequence, of the first run
};

std::string TextAt(const Json& json, const char* pointer) {
  const Json::json_pointer p(pointer);
  return json.contains(p) && json.at(p).is_string() ? json.at(p).get<std::string>() : "";
}

Origin FindOrigin(const BenchmarkPlan& plan, const fs::path& folder) {
  Origin origin;
  for (const BenchmarkJob& job : plan.jobs) {
    if (!IsFinished(folder, job)) continue;
    const fs::path file = ResultFolder(folder, job) / "result.json";
    const Json json = Json::parse(ReadText(file), nullptr, /*allow_exceptions=*/false);
    if (!json.is_object()) throw InputError(file.string() + ": is no result");
    ++origin.finished;
    const int threads = json.value(Json::json_pointer("/provenance/threads"), 0);
    origin.processors.insert(
        fmt::format("{}, {} threads", TextAt(json, "/provenance/cpu_name"), threads));
    origin.revisions.insert(TextAt(json, "/provenance/git_revision"));
    origin.dates.insert(TextAt(json, "/provenance/date_utc").substr(0, 10));
    const std::string settings = TextAt(json, "/provenance/config_sha256");
    if (!settings.empty()) origin.settings.try_emplace(job.title, settings);
    const int frames = json.value(Json::json_pointer("/coverage/frames_total"), 0);
    if (frames > 0) origin.frames.try_emplace(job.sequence, frames);
  }
  return origin;
}

std::string Row(const std::string& title, const std::string& value) {
  return fmt::format("| {} | {} |\n", title, value);
}

// Of the options that were changed on the command line, those of all systems.
std::vector<std::string> CommonOverrides(const BenchmarkPlan& plan) {
  if (plan.jobs.empty()) return {};
  std::vector<std::string> common = plan.jobs.front().overrides;
  for (const BenchmarkJob& job : plan.jobs) {
    std::erase_if(common, [&](const std::string& option) {
      return std::ranges::find(job.overrides, option) == job.overrides.end();
    });
  }
  return common;
}

std::string OriginTable(const BenchmarkPlan& plan, const Origin& origin) {
  std::string text = "| from | |\n| --- | --- |\n";
  text += Row("processor", fmt::format("{}", fmt::join(origin.processors, "; ")));
  text += Row("revision", fmt::format("{}", fmt::join(origin.revisions, ", ")));
  const std::vector<std::string> overrides = CommonOverrides(plan);
  if (!overrides.empty()) {
    text += Row("set for every system", fmt::format("`{}`", fmt::join(overrides, " ")));
  }
  if (!plan.frames.empty()) text += Row("frames", plan.frames);
  for (const auto& [sequence, frames] : origin.frames) {
    text += Row(fmt::format("images, sequence {}", sequence), std::to_string(frames));
  }
  text += Row("finished", fmt::format("{} of {} jobs", origin.finished, plan.jobs.size()));
  text += Row("date (UTC)", fmt::format("{}", fmt::join(origin.dates, ", ")));
  for (const auto& [name, hash] : plan.hashes) {
    text += Row(fmt::format("SHA-256, {}", name), fmt::format("`{}`", hash));
  }
  for (const auto& [title, hash] : origin.settings) {
    text += Row(fmt::format("SHA-256, settings of {}, seed 0", title), fmt::format("`{}`", hash));
  }
  text += "\n";
  return text;
}

struct Chapter {
  std::string text;
  std::map<std::string, std::string> figures;  // file by name
};

// Under its section's heading; the document names the folder of the files `link`.
void AddFigures(const std::vector<BenchmarkPicture>& pictures, const std::string& prefix,
                const std::string& link, Chapter& chapter) {
  std::string& text = chapter.text;
  std::string section;
  for (const BenchmarkPicture& picture : pictures) {
    if (picture.section != section) text += fmt::format("### {}\n\n", picture.section);
    section = picture.section;
    const std::string name = fmt::format("{}_{}", prefix, picture.file_name);
    if (picture.svg_file.size() > kMaxFigureBytes) {
      text += fmt::format("{}: left out, larger than {} kB.\n\n", picture.title,
                          kMaxFigureBytes / 1000);
      continue;
    }
    chapter.figures[name] = picture.svg_file;
    text += fmt::format("![{}]({}/{})\n\n", picture.title, link, name);
    text +=
        fmt::format("{}{}{}\n\n", picture.title, picture.note.empty() ? "" : ": ", picture.note);
  }
}

BenchmarkOutcome OutcomeOf(const BenchmarkPlan& plan, const fs::path& folder,
                           const fs::path& publications) {
  if (plan.suite == "matching") return MatchingOutcome(plan, folder);
  return RunsOutcome(plan, ReadBenchmarkRuns(plan, folder), publications);
}

// Figures are named after their chapter, which begins with its suite.
bool IsFigure(const fs::path& file) {
  return file.extension() == ".svg" &&
         std::ranges::any_of(kBenchmarkSuites, [&](const std::string& suite) {
           return file.filename().string().starts_with(suite + "_");
         });
}

// Instead of those of an earlier document.
void WriteFigures(const std::map<std::string, std::string>& figures, const fs::path& folder) {
  CreateFolder(folder);
  std::vector<fs::path> old;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const bool is_old =
        IsFigure(entry.path()) && !figures.contains(entry.path().filename().string());
    if (is_old) old.push_back(entry.path());
  }
  for (const auto& [name, svg] : figures) WriteTextAtomically(folder / name, svg);
  for (const fs::path& path : old) fs::remove(path);
}

// Each is its suite's; where several benchmarks are of one suite, with their folders, and numbers
// if need be.
std::vector<std::string> ChapterNames(const std::vector<BenchmarkPlan>& plans,
                                      const std::vector<fs::path>& folders) {
  std::map<std::string, int> counts;
  for (const BenchmarkPlan& plan : plans) ++counts[plan.suite];
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (std::size_t k = 0; k < plans.size(); ++k) {
    const std::string& suite = plans[k].suite;
    const std::string first =
        counts[suite] == 1
            ? suite
            : fmt::format("{}_{}", suite, fs::canonical(folders[k]).filename().string());
    std::string name = first;
    for (int i = 2; !taken.insert(name).second; ++i) name = fmt::format("{}_{}", first, i);
    names.push_back(name);
  }
  return names;
}

Chapter MakeChapter(const std::string& name, const BenchmarkPlan& plan, const fs::path& folder,
                    const fs::path& publications, const std::string& link) {
  const Origin origin = FindOrigin(plan, folder);
  if (origin.finished == 0) throw InputError(folder.string() + ": has no finished run");
  const BenchmarkOutcome outcome = OutcomeOf(plan, folder, publications);
  Chapter chapter;
  chapter.text =
      fmt::format("## {}\n\n{}{}", name, outcome.tables.markdown, OriginTable(plan, origin));
  AddFigures(outcome.pictures, name, link, chapter);
  return chapter;
}

}  // namespace

void WriteBenchmarkDocument(const std::vector<fs::path>& folders, const fs::path& publications,
                            const fs::path& file) {
  const fs::path figures_folder = fs::path(file).replace_extension();
  std::string text =
      "# Results\n\nWritten by `lift_slam benchmark results` from stored results; not to be "
      "edited. "
      "[benchmark.md](benchmark.md) says how they are made and read.\n\n";
  std::map<std::string, std::string> figures;
  std::vector<BenchmarkPlan> plans;
  for (const fs::path& folder : folders) plans.push_back(ReadBenchmarkPlan(folder));
  const std::vector<std::string> names = ChapterNames(plans, folders);
  for (std::size_t i = 0; i < folders.size(); ++i) {
    Chapter chapter = MakeChapter(names[i], plans[i], folders[i], publications,
                                  figures_folder.filename().string());
    text += chapter.text;
    figures.merge(chapter.figures);
  }
  WriteFigures(figures, figures_folder);
  text.pop_back();  // one line end is enough
  WriteTextAtomically(file, text);
}

}  // namespace lift_slam
