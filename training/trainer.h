#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "lift_slam/features/lift/lift_weights.h"
#include "training/checkpoint.h"
#include "training/training_options.h"
#include "training/training_stage.h"

namespace lift_slam::training {

class TrainingLog;

// What a run shows while it goes on.
struct TrainingProgress {
  std::int64_t step = 0, steps = 0;
  double loss = 0.0;  // running mean
  double steps_per_s = 0.0;
  double minutes_left = 0.0;
  std::string validation;  // the last one; empty before
};

// Trains one network. The run's folder holds:
//   settings.yaml        all options
//   checkpoint.pt        network, optimizer and step, to go on from
//   latest.safetensors   the weights of the checkpoint, with the other two networks as given
//   best.safetensors     those of the best validation, that of the weights given included (the
//                        latest without validation sets); a run that goes on validates it anew
//   log.csv, curves.html the course of the training
class Trainer {
 public:
  // Goes on from the folder's checkpoint with `resume`, which must be there then; else the folder
  // must not hold one. Throws InputError.
  Trainer(const TrainingOptions& options, const std::filesystem::path& output, bool resume,
          const std::string& revision);
  ~Trainer();

  // Until the last step, or until `go_on` says false; it is asked after every step. A checkpoint is
  // written in the end. Throws InputError when the loss was not finite many times in a row.
  void Run(const std::function<bool(const TrainingProgress&)>& go_on);

  const RunState& state() const { return state_; }

 private:
  void Step(const PatchBatch& batch);
  void SetLearningRate();
  void Validate();
  // By the validation of this run, which may be another than it was chosen by.
  double FigureOfBest();
  void Save();
  void WriteWeights(const std::string& file);
  const ScheduleOptions& schedule() const;
  TrainingProgress Progress() const;

  TrainingOptions options_;
  Stage stage_;
  std::filesystem::path output_;
  std::string revision_;
  LiftWeights weights_;
  std::unique_ptr<TrainingStage> network_;
  std::unique_ptr<PatchSampler> sampler_;
  std::vector<PatchBatch> validation_;
  std::unique_ptr<torch::optim::Adam> optimizer_;
  std::unique_ptr<TrainingLog> log_;
  RunState state_;
  std::string sources_, last_validation_;
  double loss_sum_ = 0.0;
  int loss_count_ = 0, failures_in_a_row_ = 0;
  double running_loss_ = 0.0, steps_per_s_ = 0.0;
};

}  // namespace lift_slam::training
