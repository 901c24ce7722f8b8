#include "lift_slam/evaluation/scale_drift.h"

#include <algorithm>
#include <cmath>

namespace lift_slam {
namespace {

constexpr int kChordsOfPiece = 50;

Eigen::Vector3d ReferencePosition(const PosePair& pair) { return pair.reference.translation; }
Eigen::Vector3d EstimatePosition(const PosePair& pair) { return pair.estimate.translation; }

double ReferenceLength(std::span<const PosePair> pairs) {
  double length = 0.0;
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    length += (ReferencePosition(pairs[i]) - ReferencePosition(pairs[i - 1])).norm();
  }
  return length;
}

struct Chords {
  double reference = 0.0, estimate = 0.0;
  int count = 0;
};

// Each chord counts to the piece its end lies in.
std::vector<Chords> ChordsOfPieces(std::span<const PosePair> pairs, double length) {
  std::vector<Chords> pieces(kScaleDriftPieces);
  const double least = length / (kScaleDriftPieces * kChordsOfPiece);
  double way = 0.0;
  std::size_t start = 0;
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    way += (ReferencePosition(pairs[i]) - ReferencePosition(pairs[i - 1])).norm();
    const double reference = (ReferencePosition(pairs[i]) - ReferencePosition(pairs[start])).norm();
    if (reference < least) continue;
    const auto piece =
        std::min(static_cast<std::size_t>(way / length * kScaleDriftPieces), pieces.size() - 1);
    pieces[piece].reference += reference;
    pieces[piece].estimate += (EstimatePosition(pairs[i]) - EstimatePosition(pairs[start])).norm();
    ++pieces[piece].count;
    start = i;
  }
  return pieces;
}

}  // namespace

std::optional<ScaleDrift> ComputeScaleDrift(std::span<const PosePair> pairs) {
  const double length = ReferenceLength(pairs);
  if (!(length > 0.0)) return std::nullopt;
  ScaleDrift drift;
  for (const Chords& piece : ChordsOfPieces(pairs, length)) {
    if (piece.count < 2 || !(piece.estimate > 0.0)) return std::nullopt;
    drift.scale_of_piece.push_back(piece.reference / piece.estimate);
  }
  std::vector<double> sorted = drift.scale_of_piece;
  std::sort(sorted.begin(), sorted.end());
  const double median = 0.5 * (sorted[sorted.size() / 2 - 1] + sorted[sorted.size() / 2]);
  for (double& scale : drift.scale_of_piece) scale /= median;
  drift.last_over_first = drift.scale_of_piece.back() / drift.scale_of_piece.front();
  drift.largest_over_smallest = sorted.back() / sorted.front();
  return drift;
}

}  // namespace lift_slam
