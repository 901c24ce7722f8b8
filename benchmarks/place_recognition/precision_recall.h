#pragma once

#include <vector>

namespace lift_slam {

// What a place recogniser says of one image: its best match among the earlier ones.
struct PlaceAnswer {
  bool has_match = false;   // an earlier image shows the place
  bool is_correct = false;  // and the best match is such an image
  double score = 0.0;       // of the best match
};

struct PrecisionRecall {
  double threshold = 0.0;  // answers with this score and above are given
  double precision = 1.0;  // of the answers given, correct
  double recall = 0.0;     // of the images with a match, answered correctly
};

// One entry a threshold, from the highest score to the lowest.
std::vector<PrecisionRecall> PrecisionRecallCurve(std::vector<PlaceAnswer> answers);

// The largest recall without a wrong answer.
double RecallAtFullPrecision(const std::vector<PrecisionRecall>& curve);
// Area under the curve, by steps: mean precision over recall (average precision).
double AveragePrecision(const std::vector<PrecisionRecall>& curve);
// Recall when every answer is given.
double FullRecall(const std::vector<PrecisionRecall>& curve);

}  // namespace lift_slam
