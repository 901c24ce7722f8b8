#include "lift_slam/geometry/sim3_ransac.h"

#include <algorithm>
#include <array>
#include <limits>

#include "lift_slam/geometry/ransac.h"
#include "lift_slam/geometry/sim3_refinement.h"
#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

constexpr int kRefineIterations = 5;
// Matches with errors up to twice the limit's pull.
constexpr double kRefineLimitFactor = 4.0;

struct ScoredSim3 {
  Sim3d cam1_from_cam2;
  double score = 0.0;
  int num_inliers = 0;
};

double SquaredError(const Eigen::Vector3d& in_cam, const Eigen::Vector2d& normalized,
                    double pixels_per_sigma) {
  if (!(in_cam.z() > 0.0)) return std::numeric_limits<double>::infinity();
  const Eigen::Vector2d error = in_cam.head<2>() / in_cam.z() - normalized;
  return pixels_per_sigma * pixels_per_sigma * error.squaredNorm();
}

class Sim3Ransac {
 public:
  Sim3Ransac(std::span<const Sim3Match> matches, double focal_length1_px, double focal_length2_px,
             ScaleFit scale_fit, const Sim3RansacOptions& options)
      : matches_(matches),
        focal_length1_px_(focal_length1_px),
        focal_length2_px_(focal_length2_px),
        scale_fit_(scale_fit),
        options_(options) {}

  ScoredSim3 FindBest(Random& random) const {
    const RansacLimits limits{10, options_.max_iterations, 0.999};
    ScoredSim3 best;
    int iterations = limits.max_iterations;
    for (int i = 0; i < iterations; ++i) {
      const auto sample = DrawSample<3>(random, matches_.size());
      const std::optional<Sim3d> similarity = Fit(sample);
      if (!similarity) continue;
      const ScoredSim3 scored = Score(*similarity);
      if (!(scored.score > best.score)) continue;
      best = Refine(scored);
      const auto count = static_cast<double>(matches_.size());
      iterations = RansacIterations(limits, best.num_inliers / count, 3);
    }
    return best;
  }

  Sim3Estimate Estimate(const ScoredSim3& scored) const {
    Sim3Estimate estimate{scored.cam1_from_cam2, {}, scored.num_inliers};
    const Sim3d inverse = Inverse(scored.cam1_from_cam2);
    for (const Sim3Match& match : matches_) {
      const auto [error1, error2] = SquaredErrors(scored.cam1_from_cam2, inverse, match);
      estimate.is_inlier.push_back(std::max(error1, error2) < options_.max_squared_error);
    }
    return estimate;
  }

 private:
  std::pair<double, double> SquaredErrors(const Sim3d& cam1_from_cam2, const Sim3d& cam2_from_cam1,
                                          const Sim3Match& match) const {
    return {SquaredError(cam1_from_cam2 * match.point_in_cam2, match.normalized1,
                         focal_length1_px_ / match.sigma1_px),
            SquaredError(cam2_from_cam1 * match.point_in_cam1, match.normalized2,
                         focal_length2_px_ / match.sigma2_px)};
  }

  ScoredSim3 Score(const Sim3d& cam1_from_cam2) const {
    ScoredSim3 scored{cam1_from_cam2};
    const Sim3d inverse = Inverse(cam1_from_cam2);
    for (const Sim3Match& match : matches_) {
      const auto [error1, error2] = SquaredErrors(cam1_from_cam2, inverse, match);
      if (!(std::max(error1, error2) < options_.max_squared_error)) continue;
      scored.score += 2.0 * options_.max_squared_error - error1 - error2;
      ++scored.num_inliers;
    }
    return scored;
  }

  std::optional<Sim3d> Fit(const std::array<std::size_t, 3>& indices) const {
    std::array<Eigen::Vector3d, 3> points1, points2;
    for (std::size_t i = 0; i < 3; ++i) {
      points1[i] = matches_[indices[i]].point_in_cam1;
      points2[i] = matches_[indices[i]].point_in_cam2;
    }
    const Alignment alignment = AlignPositions(points2, points1, scale_fit_);
    if (!alignment.reference_from_estimate || !(alignment.reference_from_estimate->scale > 0.0)) {
      return std::nullopt;
    }
    return alignment.reference_from_estimate;
  }

  // Three points with errors in depth give a rough similarity: pulled to all that nearly agree.
  ScoredSim3 Refine(const ScoredSim3& rough) const {
    const ScoredSim3 refined = Score(
        RefineSim3(matches_, focal_length1_px_, focal_length2_px_, rough.cam1_from_cam2, scale_fit_,
                   kRefineLimitFactor * options_.max_squared_error, kRefineIterations));
    return refined.score > rough.score ? refined : rough;
  }

  std::span<const Sim3Match> matches_;
  double focal_length1_px_, focal_length2_px_;
  ScaleFit scale_fit_;
  const Sim3RansacOptions& options_;
};

}  // namespace

std::optional<Sim3Estimate> EstimateSim3(std::span<const Sim3Match> matches,
                                         double focal_length1_px, double focal_length2_px,
                                         ScaleFit scale_fit, const Sim3RansacOptions& options,
                                         std::uint64_t seed) {
  LIFT_SLAM_CHECK(focal_length1_px > 0.0 && focal_length2_px > 0.0, "focal lengths {} and {} px",
                  focal_length1_px, focal_length2_px);
  const int needed = std::max(options.min_inliers, 3);
  if (matches.size() < static_cast<std::size_t>(needed)) return std::nullopt;
  Random random(seed);
  const Sim3Ransac ransac(matches, focal_length1_px, focal_length2_px, scale_fit, options);
  const ScoredSim3 best = ransac.FindBest(random);
  if (best.num_inliers < needed) return std::nullopt;
  return ransac.Estimate(best);
}

void Sim3RansacOptions::Visit(OptionVisitor& visitor) {
  visitor.Field("min_inliers", min_inliers, "matches that must agree on the similarity");
  visitor.Field("max_iterations", max_iterations, "samples of three matches");
  visitor.Field("max_squared_error", max_squared_error,
                "squared error over variance of an outlier; chi-square, 2 dof, 99 %");
}

}  // namespace lift_slam
