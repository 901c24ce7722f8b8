#include "training/patch_sampler.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "lift_slam/util/input_error.h"
#include "training/word_list.h"

namespace lift_slam::training {
namespace {

constexpr int kTries = 200;  // for a point that is large enough, or a scene that is new
constexpr double kFullTurn = 2.0 * std::numbers::pi;

std::uint64_t Mixed(std::uint64_t seed, std::uint64_t index) {
  std::uint64_t x = seed * 0x9E3779B97F4A7C15ULL + index + 0x632BE59BD9B4E019ULL;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ULL;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBULL;
  return x ^ (x >> 31);
}

std::size_t Index(int last, Random& random) {
  return static_cast<std::size_t>(random.UniformInt(0, last));
}

bool HasPoint(const TrainingSet& set, double min_sigma) {
  for (std::size_t i = 0; i < set.num_points(); ++i) {
    if (set.views(i)[0].sigma >= min_sigma) return true;
  }
  return false;
}

}  // namespace

std::vector<WeightedSet> OpenTrainingSets(const std::string& list) {
  return OpenTrainingSets(SplitWords(list));
}

std::vector<WeightedSet> OpenTrainingSets(const std::vector<std::string>& words) {
  std::vector<WeightedSet> sets;
  for (const std::string& word : words) {
    const std::size_t equals = word.rfind('=');
    double share = 1.0;
    if (equals != std::string::npos) {
      std::istringstream number(word.substr(equals + 1));
      if (!(number >> share) || !number.eof() || !(share > 0.0)) {
        throw InputError(fmt::format(
            "training set '{}': expected PATH or PATH=SHARE with a share above 0", word));
      }
    }
    sets.push_back({std::make_shared<TrainingSet>(word.substr(0, equals)), share});
  }
  if (sets.empty()) throw InputError("no training set was named: expected PATH[=SHARE]...");
  return sets;
}

PatchSampler::PatchSampler(std::vector<WeightedSet> sets, const PatchRequest& request,
                           const ViewOptions& views, const PhotometryOptions& photometry,
                           std::uint64_t seed)
    : sets_(std::move(sets)),
      request_(request),
      views_(views),
      photometry_(photometry),
      seed_(seed) {
  views_.Check();
  photometry_.Check();
  for (const WeightedSet& weighted : sets_) {
    if (!HasPoint(*weighted.set, request.min_sigma)) {
      throw InputError(fmt::format("training set '{}' has no point of sigma {} or more",
                                   weighted.set->name(), request.min_sigma));
    }
    if (request.with_empty && weighted.set->empty_places().empty()) {
      throw InputError(
          fmt::format("training set '{}' has no places without a keypoint, which "
                      "the detector needs",
                      weighted.set->name()));
    }
  }
}

std::size_t PatchSampler::ChooseSet(Random& random) const {
  double total = 0.0;
  for (const WeightedSet& weighted : sets_) total += weighted.share;
  double chosen = total * random.Uniform();
  for (std::size_t i = 0; i + 1 < sets_.size(); ++i) {
    chosen -= sets_[i].share;
    if (chosen < 0.0) return i;
  }
  return sets_.size() - 1;
}

std::size_t PatchSampler::ChoosePoint(std::size_t set, Random& random) const {
  const TrainingSet& points = *sets_[set].set;
  const int last = static_cast<int>(points.num_points()) - 1;
  std::size_t point = Index(last, random);
  for (int i = 0; i < kTries && points.views(point)[0].sigma < request_.min_sigma; ++i) {
    point = Index(last, random);
  }
  return point;
}

// Points of one image, hard to tell apart; one image of a scene in a batch, where there are
// scenes enough, because another image of it may show the same points.
void PatchSampler::AddGroup(Random& random, std::vector<std::string>& scenes,
                            std::vector<Choice>& choices) const {
  Choice seed;
  for (int i = 0; i < kTries / 10; ++i) {
    seed.set = ChooseSet(random);
    seed.point = ChoosePoint(seed.set, random);
    const TrainingSet& set = *sets_[seed.set].set;
    const std::string& scene = set.origin(set.views(seed.point)[0].image).scene;
    if (std::find(scenes.begin(), scenes.end(), scene) == scenes.end()) {
      scenes.push_back(scene);
      break;
    }
  }
  const TrainingSet& set = *sets_[seed.set].set;
  const auto [begin, end] = set.NeighboursInImage(seed.point);
  choices.push_back(seed);
  for (int i = 1; i < request_.points_per_image && std::ssize(choices) < request_.count; ++i) {
    Choice other{seed.set, begin + Index(static_cast<int>(end - begin) - 1, random)};
    if (set.views(other.point)[0].sigma < request_.min_sigma) other = seed;
    choices.push_back(other);
  }
}

std::vector<PatchSampler::Choice> PatchSampler::ChoosePoints(Random& random) const {
  std::vector<Choice> choices;
  std::vector<std::string> scenes;
  while (std::ssize(choices) < request_.count) AddGroup(random, scenes, choices);
  return choices;
}

bool PatchSampler::AreDifferent(const Choice& a, const Choice& b) const {
  const View& va = sets_[a.set].set->views(a.point)[0];
  const View& vb = sets_[b.set].set->views(b.point)[0];
  if (a.set != b.set) return true;
  if (va.image != vb.image) {
    const TrainingSet& set = *sets_[a.set].set;
    return set.origin(va.image).scene != set.origin(vb.image).scene;
  }
  constexpr double kMinDistanceSigmas = 2.5;
  return std::hypot(va.x - vb.x, va.y - vb.y) > kMinDistanceSigmas * std::max(va.sigma, vb.sigma);
}

void PatchSampler::CutOne(const TrainingSet& set, const View& view, double angle, bool warp,
                          Cut& cut, Random& random) const {
  const PatchView exact = RandomPatchView(view, angle, warp, views_, random);
  const double u = random.Uniform(-request_.max_shift, request_.max_shift);
  const double v = random.Uniform(-request_.max_shift, request_.max_shift);
  const std::span patch(cut.pixels, static_cast<std::size_t>(request_.size * request_.size));
  SamplePatchView(set.pyramid(view.image), Shifted(exact, u, v), request_.half_width, request_.size,
                  patch);
  ChangeLight(patch, request_.size, photometry_, random);
  cut.position = {static_cast<float>(-u / request_.half_width),
                  static_cast<float>(-v / request_.half_width)};
  cut.angle = static_cast<float>(angle);
}

void PatchSampler::CutPair(const Choice& choice, std::size_t i, PatchBatch& batch,
                           Random& random) const {
  const TrainingSet& set = *sets_[choice.set].set;
  const std::span<const View> views = set.views(choice.point);
  const int last = static_cast<int>(views.size()) - 1;
  const std::size_t a = Index(last, random);
  std::size_t b = a;
  while (last > 0 && b == a) b = Index(last, random);
  const bool turned = request_.each_turned || random.Uniform() < views_.turned_share;
  const double angle = turned ? kFullTurn * random.Uniform() : 0.0;
  const double other_angle = request_.each_turned ? kFullTurn * random.Uniform() : angle;
  const std::size_t pixels = static_cast<std::size_t>(request_.size * request_.size);
  Cut first{&batch.first[i * pixels]}, second{&batch.second[i * pixels]};
  CutOne(set, views[a], angle, last == 0, first, random);
  CutOne(set, views[b], other_angle, last == 0, second, random);
  std::copy(first.position.begin(), first.position.end(), &batch.first_position[2 * i]);
  std::copy(second.position.begin(), second.position.end(), &batch.second_position[2 * i]);
  batch.first_angle[i] = first.angle;
  batch.second_angle[i] = second.angle;
}

void PatchSampler::CutEmpty(std::size_t i, PatchBatch& batch, Random& random) const {
  const TrainingSet& set = *sets_[ChooseSet(random)].set;
  const std::span<const View> places = set.empty_places();
  View place = places[Index(static_cast<int>(places.size()) - 1, random)];
  place.sigma = std::max(place.sigma, static_cast<float>(request_.min_sigma));
  const std::size_t pixels = static_cast<std::size_t>(request_.size * request_.size);
  Cut cut{&batch.empty[i * pixels]};
  CutOne(set, place, kFullTurn * random.Uniform(), false, cut, random);
}

PatchBatch PatchSampler::Draw(std::uint64_t index) const {
  Random random(Mixed(seed_, index));
  const std::vector<Choice> choices = ChoosePoints(random);
  const std::size_t count = choices.size();
  const std::size_t pixels = static_cast<std::size_t>(request_.size * request_.size);
  PatchBatch batch{.count = request_.count, .size = request_.size};
  batch.first.resize(count * pixels);
  batch.second.resize(count * pixels);
  batch.empty.resize(request_.with_empty ? count * pixels : 0);
  batch.first_position.resize(2 * count);
  batch.second_position.resize(2 * count);
  batch.first_angle.resize(count);
  batch.second_angle.resize(count);
  batch.different.resize(count * count);
  for (std::size_t i = 0; i < count; ++i) {
    CutPair(choices[i], i, batch, random);
    if (request_.with_empty) CutEmpty(i, batch, random);
    for (std::size_t j = 0; j < count; ++j) {
      batch.different[i * count + j] = AreDifferent(choices[i], choices[j]) ? 1 : 0;
    }
  }
  return batch;
}

}  // namespace lift_slam::training
