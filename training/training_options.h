#pragma once

#include <string>
#include <string_view>

#include "lift_slam/util/options.h"
#include "training/patch_view.h"
#include "training/photometry.h"

namespace lift_slam::training {

enum class Stage { kDescriptor, kOrientation, kDetector };
inline constexpr std::string_view kStageNames[] = {"descriptor", "orientation", "detector"};
Stage StageNamed(const std::string& name);  // throws InputError for another name

// What the three stages have in common.
struct ScheduleOptions {
  int batch = 128;    // points of a step
  int steps = 40000;  // in all; the learning rate falls to a hundredth over them (half a cosine)
  double learning_rate = 1e-3;
  int warm_up_steps = 300;  // the first, over which the learning rate rises from 0
  void Visit(OptionVisitor& visitor);
  void Check(std::string_view stage) const;  // throws InputError naming the field
};

enum class DescriptorLoss {
  // Of each pair the distance to the nearest other point of the batch must be larger by the margin
  // than that between its own two views (HardNet's choice of negatives, distances not normalised).
  kHardest,
  kPairs,    // Eq. 1 of the paper: |d1 - d2|, and max(0, C - |d1 - d3|) with C the margin
  kTriplet,  // max(0, margin + |d1 - d2| - min(|d1 - d3|, |d2 - d3|)): the authors' second code
};
inline constexpr std::string_view kDescriptorLossNames[] = {"hardest", "pairs", "triplet"};

struct DescriptorOptions {
  ScheduleOptions schedule{.learning_rate = 5e-4};
  DescriptorLoss loss = DescriptorLoss::kHardest;
  // Fixes the scale of the distances. 2: matches lie mostly below 1, others above 2.
  double margin = 2.0;
  // The first so many steps of `hardest` take the next point for the wrong one (triplet, margin
  // doubled): the nearest of random descriptions teaches nothing but to make all of them zero.
  int easy_steps = 1000;
  // Of so many times as many examples the worst ones are learnt from (pairs and triplet only).
  int mining = 2;
  void Visit(OptionVisitor& visitor);
  void Check() const;
};

enum class OrientationLoss {
  // 1 - cos of the error of the angle between the two patches, which is known for pairs that were
  // made (photographs, renderings); fast, needs no descriptor.
  kAngles,
  kDescriptor,  // Eq. 2 of the paper: |d1 - d2| of the patches turned upright
};
inline constexpr std::string_view kOrientationLossNames[] = {"angles", "descriptor"};

struct OrientationOptions {
  OrientationLoss loss = OrientationLoss::kAngles;
  ScheduleOptions schedule{.batch = 128, .steps = 30000, .learning_rate = 1e-3};
  double max_shift_sigmas = 1.0;  // of the point from the patch's centre, uniform
  void Visit(OptionVisitor& visitor);
  void Check() const;
};

struct DetectorOptions {
  ScheduleOptions schedule{.batch = 128, .steps = 20000, .learning_rate = 1e-3};
  double max_shift_sigmas = 2.4;       // 20 % of the half-width of 12 sigmas
  double min_sigma = 1.6;              // of the keypoints learnt from
  double classification_weight = 2.5;  // of Eq. 4 beside the overlap or pair loss
  double softness = 10.0;              // beta of the soft maximum over the scores
  int pair_steps = 0;                  // the last so many steps use the pair loss of Eq. 5
  void Visit(OptionVisitor& visitor);
  void Check() const;
};

struct RunOptions {
  int seed = 1;
  int threads = 0;             // 0: as many as the machine has
  bool designed_start = true;  // detector and orientation do not begin with noise alone
  bool bfloat16 = true;        // descriptor's convolutions in bfloat16 where the CPU has it
  double checkpoint_minutes = 3.0;
  int validation_every = 500;  // steps
  int validation_batches = 16;
  void Visit(OptionVisitor& visitor);
  void Check() const;
};

// Everything about one training run: what settings.yaml holds.
struct TrainingOptions {
  std::string stage = "descriptor";
  std::string data;        // training sets: PATH[=SHARE]... (word_list.h)
  std::string validation;  // of other images; empty: no validation, the last weights are the best
  std::string from;        // weights to begin with; empty: random ones
  RunOptions run;
  ViewOptions views;
  PhotometryOptions photometry;
  DescriptorOptions descriptor;
  OrientationOptions orientation;
  DetectorOptions detector;
  void Visit(OptionVisitor& visitor);
  void Check() const;
};

}  // namespace lift_slam::training
