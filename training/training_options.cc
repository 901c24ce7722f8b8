#include "training/training_options.h"

#include <fmt/format.h>

#include "lift_slam/util/input_error.h"
#include "lift_slam/util/option_range.h"

namespace lift_slam::training {

Stage StageNamed(const std::string& name) {
  for (std::size_t i = 0; i < std::size(kStageNames); ++i) {
    if (name == kStageNames[i]) return static_cast<Stage>(i);
  }
  throw InputError(fmt::format("stage '{}' is unknown, expected {}, {} or {}", name, kStageNames[0],
                               kStageNames[1], kStageNames[2]));
}

void ScheduleOptions::Visit(OptionVisitor& visitor) {
  visitor.Field("batch", batch, "points of a step");
  visitor.Field("steps", steps, "in all; the learning rate falls over them to a hundredth");
  visitor.Field("learning_rate", learning_rate, "of Adam, at the beginning");
  visitor.Field("warm_up_steps", warm_up_steps, "the first; the learning rate rises over them");
}

void ScheduleOptions::Check(std::string_view stage) const {
  CheckOptionRange(fmt::format("{}.schedule.batch", stage), batch, 2, 4096);
  CheckOptionRange(fmt::format("{}.schedule.steps", stage), steps, 1, 1e9);
  CheckOptionRange(fmt::format("{}.schedule.learning_rate", stage), learning_rate, 0.0, 1.0);
  CheckOptionRange(fmt::format("{}.schedule.warm_up_steps", stage), warm_up_steps, 0, 1e9);
}

void DescriptorOptions::Visit(OptionVisitor& visitor) {
  visitor.Group("schedule", schedule, "steps and learning rate");
  visitor.Field("loss", loss, kDescriptorLossNames,
                "hardest: nearest wrong one of the batch; pairs: Eq. 1; triplet");
  visitor.Field("margin", margin, "of the loss; fixes the scale of the distances");
  visitor.Field("easy_steps", easy_steps, "the first of hardest, with any wrong one instead");
  visitor.Field("mining", mining, "the worst of so many times as many (pairs and triplet)");
}

void DescriptorOptions::Check() const {
  schedule.Check("descriptor");
  CheckOptionRange("descriptor.margin", margin, 1e-3, 1e3);
  CheckOptionRange("descriptor.easy_steps", easy_steps, 0, 1e9);
  CheckOptionRange("descriptor.mining", mining, 1, 64);
}

void OrientationOptions::Visit(OptionVisitor& visitor) {
  visitor.Field("loss", loss, kOrientationLossNames,
                "angles: known turns between the patches; descriptor: Eq. 2");
  visitor.Group("schedule", schedule, "steps and learning rate");
  visitor.Field("max_shift_sigmas", max_shift_sigmas, "of the point from the patch's centre");
}

void OrientationOptions::Check() const {
  schedule.Check("orientation");
  CheckOptionRange("orientation.max_shift_sigmas", max_shift_sigmas, 0.0, 3.5);
}

void DetectorOptions::Visit(OptionVisitor& visitor) {
  visitor.Group("schedule", schedule, "steps and learning rate");
  visitor.Field("max_shift_sigmas", max_shift_sigmas, "of the point from the patch's centre");
  visitor.Field("min_sigma", min_sigma, "of the keypoints learnt from, pixels");
  visitor.Field("classification_weight", classification_weight, "of Eq. 4 beside Eq. 5");
  visitor.Field("softness", softness, "beta of the soft maximum over the scores");
  visitor.Field("pair_steps", pair_steps, "the last so many steps use the pair loss of Eq. 5");
}

void DetectorOptions::Check() const {
  schedule.Check("detector");
  CheckOptionRange("detector.max_shift_sigmas", max_shift_sigmas, 0.0, 3.5);
  CheckOptionRange("detector.min_sigma", min_sigma, 0.0, 100.0);
  CheckOptionRange("detector.classification_weight", classification_weight, 0.0, 1e6);
  CheckOptionRange("detector.softness", softness, 1e-3, 1e4);
  CheckOptionRange("detector.pair_steps", pair_steps, 0, 1e9);
}

void RunOptions::Visit(OptionVisitor& visitor) {
  visitor.Field("seed", seed, "of everything random");
  visitor.Field("threads", threads, "0: as many as the machine has");
  visitor.Field("designed_start", designed_start,
                "detector and orientation begin with blobs and gradients, not with noise");
  visitor.Field("bfloat16", bfloat16, "for convolutions, where the CPU has it");
  visitor.Field("checkpoint_minutes", checkpoint_minutes, "between checkpoints");
  visitor.Field("validation_every", validation_every, "steps");
  visitor.Field("validation_batches", validation_batches, "of a validation");
}

void RunOptions::Check() const {
  CheckOptionRange("run.threads", threads, 0, 256);
  CheckOptionRange("run.checkpoint_minutes", checkpoint_minutes, 0.01, 1e4);
  CheckOptionRange("run.validation_every", validation_every, 1, 1e9);
  CheckOptionRange("run.validation_batches", validation_batches, 1, 1e5);
}

void TrainingOptions::Visit(OptionVisitor& visitor) {
  visitor.Field("stage", stage, "descriptor, orientation or detector");
  visitor.Field("data", data,
                "training sets, PATH[=SHARE]..., separated by blanks; \\ before a blank in a path");
  visitor.Field("validation", validation, "sets of other images; empty: none");
  visitor.Field("from", from, "weights to begin with; empty: random ones");
  visitor.Group("run", run, "the run itself");
  visitor.Group("views", views, "how the two patches of a pair differ");
  visitor.Group("photometry", photometry, "changes of light, of each patch on its own");
  visitor.Group("descriptor", descriptor, "Eq. 1");
  visitor.Group("orientation", orientation, "Eq. 2");
  visitor.Group("detector", detector, "Eq. 3 to 5");
}

void TrainingOptions::Check() const {
  run.Check();
  views.Check();
  photometry.Check();
  descriptor.Check();
  orientation.Check();
  detector.Check();
}

}  // namespace lift_slam::training
