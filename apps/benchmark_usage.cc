#include "apps/benchmark_usage.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string_view>

#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

enum Step : unsigned { kPlan = 1, kRun = 2, kMerge = 4, kResults = 8, kBatch = 16 };

// What an option is of. A suite by itself plans, runs all of it and merges.
struct OptionUse {
  std::string_view name;
  unsigned steps;
  std::string_view suite = {};  // empty: of all
  bool not_of_matching = false;
};

constexpr OptionUse kUses[] = {
    {"--data", kPlan},
    {"--systems", kPlan},
    {"--sequences", kPlan},
    {"--frames", kPlan},
    {"--variants", kPlan, "ablation"},
    {"--weights", kPlan, "matching"},
    {"--pairs", kPlan, "matching"},
    {"--conditions", kPlan},
    {"--set", kPlan},
    {"--runs", kPlan, {}, true},
    {"--jobs", kBatch},
    {"--feature-cache", kRun, {}, true},
    {"--external", kMerge, {}, true},
    {"--publications", kMerge | kResults, {}, true},
    {"--from", kResults},
};

unsigned StepsOf(const std::string& verb) {
  if (verb == "plan") return kPlan;
  if (verb == "run-job") return kRun;
  if (verb == "merge") return kMerge;
  if (verb == "results") return kResults;
  return kPlan | kRun | kMerge | kBatch;
}

// Who reads it, for the sentence.
std::string ReadersOf(const OptionUse& use) {
  if (!use.suite.empty()) return fmt::format("the suite '{}'", use.suite);
  const char* verb = use.steps & kPlan    ? " and 'plan'"
                     : use.steps & kRun   ? " and 'run-job'"
                     : use.steps & kMerge ? " and 'merge'"
                                          : "";
  if (use.steps == kResults) return "'results'";
  return fmt::format("a suite{}{}", use.not_of_matching ? " other than 'matching'" : "", verb);
}

void CheckWords(const std::vector<std::string>& words) {
  const std::string& verb = words.front();
  const bool wants_two = verb == "plan" || verb == "run-job";
  if (words.size() == (wants_two ? 2U : 1U)) return;
  if (wants_two) {
    throw InputError(fmt::format("benchmark {}: expected {} after it", verb,
                                 verb == "plan" ? "a suite" : "the number of a run"));
  }
  throw InputError(
      fmt::format("benchmark {}: expected nothing after it, found '{}'", verb, words.back()));
}

}  // namespace

void CheckBenchmarkUsage(const CLI::App& command, const std::vector<std::string>& words) {
  CheckWords(words);
  const unsigned steps = StepsOf(words.front());
  // That of a plan that is there already is not known here.
  const std::string suite = steps & kPlan ? words.back() : std::string();
  for (const OptionUse& use : kUses) {
    if (command.count(std::string(use.name)) == 0) continue;
    const bool is_read = (use.steps & steps) != 0 && (use.suite.empty() || use.suite == suite) &&
                         !(use.not_of_matching && suite == "matching");
    if (is_read) continue;
    throw InputError(fmt::format("{} says nothing to 'benchmark {}': it is for {}", use.name,
                                 fmt::join(words, " "), ReadersOf(use)));
  }
}

}  // namespace lift_slam
