#include "lift_slam/geometry/two_view_models.h"

#include <Eigen/LU>

#include "lift_slam/geometry/chi_square.h"
#include "lift_slam/geometry/epipolar.h"
#include "lift_slam/geometry/homography.h"

namespace lift_slam {
namespace {

// Essential matrices (norm 1) closer than this in Frobenius norm are variants of one solution.
constexpr double kDistinctEssential = 0.1;
// Rounds of fitting to the inliers of the round before.
constexpr int kPolishRounds = 3;

TwoViewModel ScoreEssential(const Eigen::Matrix3d& essential,
                            std::span<const NormalizedMatch> matches) {
  TwoViewModel model{essential};
  for (const NormalizedMatch& match : matches) {
    const double error = SquaredSampsonError(essential, match.in_image1, match.in_image2) /
                         (match.sigma * match.sigma);
    if (!(error < kChiSquare95With1Dof)) continue;
    model.score += kChiSquare95With1Dof - error;
    ++model.inliers;
  }
  return model;
}

// Scores a model whose squared error is error(match); appends the inliers when asked.
template <class Error>
TwoViewModel ScorePointModel(const Eigen::Matrix3d& matrix,
                             std::span<const NormalizedMatch> matches, const Error& error_of,
                             std::vector<NormalizedMatch>* inliers = nullptr) {
  TwoViewModel model{matrix};
  for (const NormalizedMatch& match : matches) {
    const double error = error_of(match);
    if (!(error < kChiSquare95With2Dof)) continue;
    model.score += kChiSquare95With2Dof - error;
    ++model.inliers;
    if (inliers != nullptr) inliers->push_back(match);
  }
  return model;
}

TwoViewModel ScoreHomography(const Eigen::Matrix3d& homography,
                             std::span<const NormalizedMatch> matches,
                             std::vector<NormalizedMatch>* inliers = nullptr) {
  const Eigen::Matrix3d inverse = homography.inverse();
  const auto error = [&](const NormalizedMatch& match) {
    return SquaredHomographyError(homography, inverse, match);
  };
  return ScorePointModel(homography, matches, error, inliers);
}

TwoViewModel ScoreRotation(const Eigen::Matrix3d& rotation,
                           std::span<const NormalizedMatch> matches,
                           std::vector<NormalizedMatch>* inliers = nullptr) {
  const auto error = [&](const NormalizedMatch& match) {
    return SquaredRotationError(rotation, match);
  };
  return ScorePointModel(rotation, matches, error, inliers);
}

bool SameEssential(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return std::min((a - b).norm(), (a + b).norm()) < kDistinctEssential;
}

// Keeps `candidates` distinct, sorted and short.
void AddCandidate(const TwoViewModel& model, int max_candidates,
                  std::vector<TwoViewModel>& candidates) {
  for (const TwoViewModel& other : candidates) {
    if (other.score >= model.score && SameEssential(other.matrix, model.matrix)) return;
  }
  std::erase_if(candidates, [&](const TwoViewModel& other) {
    return other.score < model.score && SameEssential(other.matrix, model.matrix);
  });
  const auto place = std::find_if(candidates.begin(), candidates.end(),
                                  [&](const auto& other) { return other.score < model.score; });
  candidates.insert(place, model);
  if (candidates.size() > static_cast<std::size_t>(max_candidates)) candidates.pop_back();
}

double InlierRatio(const TwoViewModel& model, std::span<const NormalizedMatch> matches) {
  return static_cast<double>(model.inliers) / static_cast<double>(matches.size());
}

template <std::size_t kSize>
std::array<NormalizedMatch, kSize> DrawMatches(std::span<const NormalizedMatch> matches,
                                               Random& random) {
  std::array<NormalizedMatch, kSize> sample;
  const auto indices = DrawSample<kSize>(random, matches.size());
  for (std::size_t i = 0; i < kSize; ++i) sample[i] = matches[indices[i]];
  return sample;
}

// Refits to the inliers while that helps.
template <class Score, class Fit>
TwoViewModel Polish(TwoViewModel best, const Score& score, const Fit& fit) {
  for (int round = 0; round < kPolishRounds; ++round) {
    std::vector<NormalizedMatch> inliers;
    score(best.matrix, &inliers);
    const std::optional<Eigen::Matrix3d> refitted = fit(inliers);
    if (!refitted) break;
    const TwoViewModel model = score(*refitted, nullptr);
    if (!(model.score > best.score)) break;
    best = model;
  }
  return best;
}

}  // namespace

std::vector<TwoViewModel> FindEssentialMatrices(std::span<const NormalizedMatch> matches,
                                                const RansacLimits& limits, int max_candidates,
                                                Random& random) {
  std::vector<TwoViewModel> candidates;
  if (matches.size() < 5) return candidates;
  int iterations = limits.max_iterations;
  for (int i = 0; i < iterations; ++i) {
    const auto indices = DrawSample<5>(random, matches.size());
    std::array<const NormalizedMatch*, 5> sample{};
    for (std::size_t k = 0; k < 5; ++k) sample[k] = &matches[indices[k]];
    for (const Eigen::Matrix3d& essential : SolveFivePoint(sample)) {
      const TwoViewModel model = ScoreEssential(essential, matches);
      if (candidates.empty() || model.score > candidates.front().score) {
        iterations = RansacIterations(limits, InlierRatio(model, matches), 5);
      }
      AddCandidate(model, max_candidates, candidates);
    }
  }
  return candidates;
}

std::optional<TwoViewModel> FindHomography(std::span<const NormalizedMatch> matches,
                                           const RansacLimits& limits, Random& random) {
  if (matches.size() < 4) return std::nullopt;
  std::optional<TwoViewModel> best;
  int iterations = limits.max_iterations;
  for (int i = 0; i < iterations; ++i) {
    const auto homography = FitHomography(DrawMatches<4>(matches, random));
    if (!homography) continue;
    const TwoViewModel model = ScoreHomography(*homography, matches);
    if (best && !(model.score > best->score)) continue;
    best = model;
    iterations = RansacIterations(limits, InlierRatio(model, matches), 4);
  }
  if (!best) return std::nullopt;
  const auto score = [&](const Eigen::Matrix3d& homography, std::vector<NormalizedMatch>* inliers) {
    return ScoreHomography(homography, matches, inliers);
  };
  return Polish(*best, score, [](const auto& inliers) { return FitHomography(inliers); });
}

TwoViewModel FindRotation(std::span<const NormalizedMatch> matches, const RansacLimits& limits,
                          Random& random) {
  TwoViewModel best;
  if (matches.size() < 2) return best;
  int iterations = limits.max_iterations;
  for (int i = 0; i < iterations; ++i) {
    const Eigen::Matrix3d rotation = FitRotation(DrawMatches<2>(matches, random));
    const TwoViewModel model = ScoreRotation(rotation, matches);
    if (!(model.score > best.score)) continue;
    best = model;
    iterations = RansacIterations(limits, InlierRatio(model, matches), 2);
  }
  const auto score = [&](const Eigen::Matrix3d& rotation, std::vector<NormalizedMatch>* inliers) {
    return ScoreRotation(rotation, matches, inliers);
  };
  const auto fit = [](const auto& inliers) {
    return inliers.size() < 2 ? std::nullopt : std::make_optional(FitRotation(inliers));
  };
  return Polish(best, score, fit);
}

}  // namespace lift_slam
