#include "benchmarks/place_recognition/precision_recall.h"

#include <algorithm>

namespace lift_slam {

std::vector<PrecisionRecall> PrecisionRecallCurve(std::vector<PlaceAnswer> answers) {
  std::stable_sort(answers.begin(), answers.end(),
                   [](const PlaceAnswer& a, const PlaceAnswer& b) { return a.score > b.score; });
  const auto matches = static_cast<double>(std::count_if(
      answers.begin(), answers.end(), [](const PlaceAnswer& a) { return a.has_match; }));
  std::vector<PrecisionRecall> curve;
  double given = 0.0, correct = 0.0;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    given += 1.0;
    correct += answers[i].is_correct ? 1.0 : 0.0;
    if (i + 1 < answers.size() && answers[i + 1].score == answers[i].score) continue;
    curve.push_back({answers[i].score, correct / given, matches > 0.0 ? correct / matches : 0.0});
  }
  return curve;
}

double RecallAtFullPrecision(const std::vector<PrecisionRecall>& curve) {
  double recall = 0.0;
  for (const PrecisionRecall& point : curve) {
    if (point.precision == 1.0) recall = std::max(recall, point.recall);
  }
  return recall;
}

double AveragePrecision(const std::vector<PrecisionRecall>& curve) {
  double area = 0.0, recall = 0.0;
  for (const PrecisionRecall& point : curve) {
    area += (point.recall - recall) * point.precision;
    recall = point.recall;
  }
  return area;
}

double FullRecall(const std::vector<PrecisionRecall>& curve) {
  return curve.empty() ? 0.0 : curve.back().recall;
}

}  // namespace lift_slam
