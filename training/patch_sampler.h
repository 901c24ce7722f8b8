#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "training/patch_view.h"
#include "training/photometry.h"
#include "training/training_set.h"

namespace lift_slam::training {

// A training set and how much of each batch comes from it.
struct WeightedSet {
  std::shared_ptr<const TrainingSet> set;
  double share = 1.0;
};

// Opens each PATH[=SHARE]; shares are relative to one another and 1 when not given. In one text
// they are separated by blanks (word_list.h). Throws InputError.
std::vector<WeightedSet> OpenTrainingSets(const std::vector<std::string>& words);
std::vector<WeightedSet> OpenTrainingSets(const std::string& list);

// What patches a stage needs.
struct PatchRequest {
  int count = 128;           // points of a batch
  int size = 64;             // pixels
  double half_width = 6.0;   // sigmas
  double max_shift = 0.0;    // sigmas: the patch's centre lies beside the point, uniformly
  double min_sigma = 0.0;    // of keypoints; smaller ones are not taken
  bool each_turned = false;  // every patch by an angle of its own, uniform
  bool with_empty = false;   // patches of places without a keypoint too
  int points_per_image = 8;  // that the points of a batch are taken from the same image
};

// The patches of LIFT's quadruples: first and second show the same point (P1, P2), the next point
// of the batch is another one (P3), empty is P4.
struct PatchBatch {
  int count = 0, size = 0;
  std::vector<std::uint8_t> first{}, second{}, empty{};  // count x size x size
  // Of the true point in each patch, x and y, from -1 to 1 across the patch (centre 0).
  std::vector<float> first_position{}, second_position{};
  // By which the patch's axes are turned in the image, radians.
  std::vector<float> first_angle{}, second_angle{};
  // count x count: 1 where two points are surely different, so that one may serve as a negative
  // example of the other.
  std::vector<std::uint8_t> different{};
};

// Draws batches. Batch k depends on nothing but k, the seed and the sets.
class PatchSampler {
 public:
  // Throws InputError when no point is large enough, or empty places are asked for and there are
  // none.
  PatchSampler(std::vector<WeightedSet> sets, const PatchRequest& request, const ViewOptions& views,
               const PhotometryOptions& photometry, std::uint64_t seed);

  PatchBatch Draw(std::uint64_t index) const;

 private:
  struct Choice {
    std::size_t set = 0, point = 0;
  };
  // A patch's numbers, to be appended to a batch.
  struct Cut {
    std::uint8_t* pixels;
    std::array<float, 2> position{};
    float angle = 0.0F;
  };

  std::size_t ChooseSet(Random& random) const;
  std::size_t ChoosePoint(std::size_t set, Random& random) const;
  std::vector<Choice> ChoosePoints(Random& random) const;
  void AddGroup(Random& random, std::vector<std::string>& scenes,
                std::vector<Choice>& choices) const;
  void CutPair(const Choice& choice, std::size_t i, PatchBatch& batch, Random& random) const;
  void CutOne(const TrainingSet& set, const View& view, double angle, bool warp, Cut& cut,
              Random& random) const;
  void CutEmpty(std::size_t i, PatchBatch& batch, Random& random) const;
  bool AreDifferent(const Choice& a, const Choice& b) const;

  std::vector<WeightedSet> sets_;
  PatchRequest request_;
  ViewOptions views_;
  PhotometryOptions photometry_;
  std::uint64_t seed_;
};

}  // namespace lift_slam::training
