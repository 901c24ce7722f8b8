#include "training/trainer.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "lift_slam/util/config_file.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/option_root.h"
#include "lift_slam/util/system_info.h"
#include "training/batch_producer.h"
#include "training/first_weights.h"
#include "training/lift_modules.h"
#include "training/stage_network.h"
#include "training/training_log.h"

namespace lift_slam::training {
namespace {

constexpr int kMaxFailures = 50;
constexpr double kMaxGradientNorm = 20.0;
constexpr std::uint64_t kValidationSeed = 90001;

LiftWeights BeginningWeights(const TrainingOptions& options) {
  LiftWeights random =
      RandomLiftWeights(LiftTopology::kF, static_cast<std::uint64_t>(options.run.seed));
  if (options.run.designed_start) {
    BeginWithBlobs(random);
    BeginWithGradients(random);
    random.provenance += ", the detector with blobs, the orientation with gradients";
  }
  if (options.from.empty()) return random;
  LiftWeights weights = ReadLiftWeights(options.from);
  const InputNormalization expected;
  if (weights.topology != LiftTopology::kF || weights.descriptor_input != expected ||
      weights.detector_input != expected) {
    throw InputError(fmt::format("{}: only topology F with input (grey - 128) / 128 can be trained",
                                 options.from));
  }
  if (!weights.orientation) weights.orientation = random.orientation;
  return weights;
}

// "gcompris-qt-data 3.1-2 (CC-BY-2.0: 18 images; ...); ..."
std::string DescribeSources(const std::vector<WeightedSet>& sets) {
  std::map<std::string, std::map<std::string, int>> images;
  for (const WeightedSet& weighted : sets) {
    for (std::size_t i = 0; i < weighted.set->num_images(); ++i) {
      const ImageOrigin& origin = weighted.set->origin(i);
      ++images[origin.source][origin.licence];
    }
  }
  std::string text;
  for (const auto& [source, licences] : images) {
    text += (text.empty() ? "" : "; ") + source + " (";
    const char* separator = "";
    for (const auto& [licence, count] : licences) {
      text += fmt::format("{}{}: {} images", separator, licence, count);
      separator = ", ";
    }
    text += ")";
  }
  return text;
}

double Seconds(std::chrono::steady_clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

}  // namespace

Trainer::Trainer(const TrainingOptions& options, const std::filesystem::path& output, bool resume,
                 const std::string& revision)
    : options_(options),
      stage_(StageNamed(options.stage)),
      output_(output),
      revision_(revision),
      weights_(BeginningWeights(options)) {
  options_.Check();
  const std::filesystem::path checkpoint = output / "checkpoint.pt";
  if (resume != std::filesystem::exists(checkpoint)) {
    throw InputError(
        resume ? fmt::format("{}: is missing, there is nothing to resume", checkpoint.string())
               : fmt::format("{}: holds a run; go on with it by --resume, or choose "
                             "another folder",
                             output.string()));
  }
  at::set_num_threads(options.run.threads > 0 ? options.run.threads : NumHardwareThreads());
  torch::manual_seed(static_cast<std::uint64_t>(options.run.seed));
  network_ = MakeStage(stage_, options_, weights_);
  const auto sets = OpenTrainingSets(options.data);
  sources_ = DescribeSources(sets);
  sampler_ =
      std::make_unique<PatchSampler>(sets, network_->request(), options.views, options.photometry,
                                     static_cast<std::uint64_t>(options.run.seed));
  if (!options.validation.empty()) {
    const PatchSampler sampler(OpenTrainingSets(options.validation), network_->request(),
                               options.views, options.photometry, kValidationSeed);
    for (int i = 0; i < options.run.validation_batches; ++i) {
      validation_.push_back(sampler.Draw(static_cast<std::uint64_t>(i)));
    }
  }
  optimizer_ = std::make_unique<torch::optim::Adam>(network_->network().parameters(),
                                                    schedule().learning_rate);
  if (resume) {
    state_ = ReadCheckpoint(checkpoint, options.stage, network_->network(), *optimizer_);
    if (!validation_.empty()) state_.best = FigureOfBest();
  }
  CreateFolder(output);
  WriteConfigFile(output / "settings.yaml", "lift_slam_train: settings of this run",
                  MakeOptionRoot(options_));
  log_ = std::make_unique<TrainingLog>(output, resume, state_.step);
}

Trainer::~Trainer() = default;

const ScheduleOptions& Trainer::schedule() const {
  switch (stage_) {
    case Stage::kDescriptor:
      return options_.descriptor.schedule;
    case Stage::kOrientation:
      return options_.orientation.schedule;
    case Stage::kDetector:
      break;
  }
  return options_.detector.schedule;
}

void Trainer::Run(const std::function<bool(const TrainingProgress&)>& go_on) {
  using Clock = std::chrono::steady_clock;
  BatchProducer producer(*sampler_, static_cast<std::uint64_t>(state_.step));
  const double checkpoint_s = 60.0 * options_.run.checkpoint_minutes;
  Clock::time_point saved = Clock::now(), before = Clock::now();
  bool wanted = true;
  // Weights that were given may be better than all that comes of them.
  if (state_.step == 0 && !options_.from.empty() && !validation_.empty()) Validate();
  while (wanted && state_.step < schedule().steps) {
    Step(producer.Next());
    const Clock::time_point now = Clock::now();
    const double elapsed = Seconds(now - before);
    before = now;
    state_.seconds += elapsed;
    steps_per_s_ = steps_per_s_ > 0.0 ? 0.95 * steps_per_s_ + 0.05 / elapsed : 1.0 / elapsed;
    if (state_.step % options_.run.validation_every == 0) Validate();
    if (Seconds(now - saved) > checkpoint_s) {
      Save();
      saved = Clock::now();
    }
    wanted = go_on(Progress());
  }
  if (state_.step % options_.run.validation_every != 0) Validate();
  Save();
}

void Trainer::SetLearningRate() {
  constexpr double kLast = 0.01;
  const double part =
      std::min(1.0, static_cast<double>(state_.step) / static_cast<double>(schedule().steps));
  const double rise = static_cast<double>(state_.step + 1) / (schedule().warm_up_steps + 1.0);
  const double factor = std::min(1.0, rise) *
                        (kLast + (1.0 - kLast) * 0.5 * (1.0 + std::cos(std::numbers::pi * part)));
  for (torch::optim::OptimizerParamGroup& group : optimizer_->param_groups()) {
    static_cast<torch::optim::AdamOptions&>(group.options()).lr(schedule().learning_rate * factor);
  }
}

void Trainer::Step(const PatchBatch& batch) {
  SetLearningRate();
  optimizer_->zero_grad();
  const torch::Tensor loss = network_->Loss(batch, state_.step);
  loss.backward();
  const double norm =
      torch::nn::utils::clip_grad_norm_(network_->network().parameters(), kMaxGradientNorm);
  const auto value = loss.item<double>();
  ++state_.step;
  if (!std::isfinite(value) || !std::isfinite(norm)) {
    ++state_.skipped;
    if (++failures_in_a_row_ >= kMaxFailures) {
      throw InputError(fmt::format(
          "the loss was not finite in {} steps in a row, up to step {}: go on from {} with a "
          "smaller {}.schedule.learning_rate (now {})",
          kMaxFailures, state_.step, (output_ / "checkpoint.pt").string(), options_.stage,
          schedule().learning_rate));
    }
    return;
  }
  failures_in_a_row_ = 0;
  optimizer_->step();
  loss_sum_ += value;
  ++loss_count_;
  running_loss_ = running_loss_ == 0.0 ? value : 0.98 * running_loss_ + 0.02 * value;
}

void Trainer::Validate() {
  LogEntry entry{
      .step = state_.step, .hours = state_.seconds / 3600.0, .steps_per_s = steps_per_s_};
  if (loss_count_ > 0) entry.loss = loss_sum_ / loss_count_;
  loss_sum_ = 0.0;
  loss_count_ = 0;
  double figure = -static_cast<double>(state_.step);  // without validation the latest is the best
  if (!validation_.empty()) {
    const Validation result = network_->Validate(validation_);
    figure = result.figure;
    entry.validation = result.details;
    last_validation_.clear();
    for (const auto& [name, value] : result.details) {
      last_validation_ +=
          fmt::format("{}{} {:.4g}", last_validation_.empty() ? "" : ", ", name, value);
    }
  }
  log_->Add(entry);
  if (figure < state_.best) {
    state_.best = figure;
    WriteWeights("best.safetensors");
  }
}

double Trainer::FigureOfBest() {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const std::filesystem::path file = output_ / "best.safetensors";
  if (!std::filesystem::exists(file)) return kNone;
  LiftWeights best = weights_;
  TakeNetwork(stage_, ReadLiftWeights(file), best);
  const double figure = MakeStage(stage_, options_, best)->Validate(validation_).figure;
  return std::isfinite(figure) ? figure : kNone;
}

void Trainer::Save() {
  WriteCheckpoint(output_ / "checkpoint.pt", options_.stage, state_, network_->network(),
                  *optimizer_);
  WriteWeights("latest.safetensors");
}

void Trainer::WriteWeights(const std::string& file) {
  StoreParameters(network_->network(), options_.stage, weights_);
  LiftWeights written = weights_;
  written.name = fmt::format("{} after {} steps", options_.stage, state_.step);
  written.distances.reset();
  written.descriptor_ranges.clear();
  written.provenance = fmt::format(
      "{}{}: {} steps of {} points by lift_slam_train {}, validation {}; images: {}",
      weights_.provenance.empty() ? "" : weights_.provenance + "\n", options_.stage, state_.step,
      schedule().batch, revision_, last_validation_.empty() ? "none" : last_validation_, sources_);
  WriteLiftWeights(written, output_ / file);
}

TrainingProgress Trainer::Progress() const {
  const auto left = static_cast<double>(schedule().steps - state_.step);
  return {state_.step,
          schedule().steps,
          running_loss_,
          steps_per_s_,
          left / std::max(steps_per_s_, 1e-9) / 60.0,
          last_validation_};
}

}  // namespace lift_slam::training
