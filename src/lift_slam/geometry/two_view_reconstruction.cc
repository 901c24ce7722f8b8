#include "lift_slam/geometry/two_view_reconstruction.h"

#include <cmath>
#include <numbers>

#include "lift_slam/geometry/chi_square.h"
#include "lift_slam/geometry/epipolar.h"
#include "lift_slam/geometry/homography.h"
#include "lift_slam/geometry/triangulation.h"
#include "lift_slam/geometry/two_view_models.h"
#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

// Essential matrices taken from the sampling, and poses refined afterwards.
constexpr int kMaxEssentials = 5;
constexpr std::size_t kMaxSampledPoses = 5;
constexpr std::size_t kMaxAxisPoses = 3;
constexpr int kRefineIterations = 10;
// While refining, errors up to 3 sigma pull; only smaller ones count as inliers.
constexpr double kMaxRefineSquaredError = 9.0;
// Median of the chi-square distribution with 1 degree of freedom.
constexpr double kChiSquareMedianWith1Dof = 0.4549;
// The real noise is taken to be at least this share of the given one (sub-pixel limit).
constexpr double kMinNoiseScale = 0.25;
// Angle between rays, in sigmas of that angle, from which on a depth sign means something.
constexpr double kSignificantParallax = 3.0;
// Poses that differ less in both are the same solution.
constexpr double kSamePoseRotationDeg = 1.0;
constexpr double kSamePoseTranslationDeg = 15.0;
// When more matches than this share of the inliers stay where they were, the camera stands still
// and what moves is an object; background far away would show at least a slight rotation.
constexpr double kMaxStillRatio = 0.5;
// With parallax in more than this share of the inliers it is the points that are lacking.
constexpr double kGoodParallaxRatio = 0.5;
// Turning by less than this is standing still.
constexpr double kStillRotationDeg = 1.0;

double Median(std::vector<float> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

struct Hypothesis {
  Rigid3d cam2_from_cam1;
  TwoViewModelKind model = TwoViewModelKind::kEssential;
  double score = 0.0;
  int inliers = 0;
};

// How one match agrees with a pose.
struct MatchCheck {
  bool is_inlier = false;
  double squared_error = 0.0;  // in sigmas
  double parallax_rad = 0.0;
  bool significant = false;  // the parallax is above the noise
};

MatchCheck CheckMatch(const Eigen::Matrix3d& essential, const Eigen::Matrix3d& rotation,
                      const Eigen::Vector3d& translation, const NormalizedMatch& match) {
  MatchCheck check;
  check.squared_error = SquaredSampsonError(essential, match.in_image1, match.in_image2) /
                        (match.sigma * match.sigma);
  if (!(check.squared_error < kChiSquare95With1Dof)) return check;
  // depth1 * ray1 + t = depth2 * ray2, solved by cross products with either ray.
  const Eigen::Vector3d ray1 = (rotation * match.in_image1.homogeneous()).normalized();
  const Eigen::Vector3d ray2 = match.in_image2.homogeneous().normalized();
  const Eigen::Vector3d normal = ray1.cross(ray2);
  check.parallax_rad = std::atan2(normal.norm(), ray1.dot(ray2));
  check.significant = check.parallax_rad > kSignificantParallax * std::numbers::sqrt2 * match.sigma;
  const bool in_front =
      ray2.cross(translation).dot(normal) > 0.0 && ray1.cross(translation).dot(normal) > 0.0;
  check.is_inlier = in_front || !check.significant;
  return check;
}

void ScoreHypothesis(std::span<const NormalizedMatch> matches, Hypothesis& hypothesis) {
  const Eigen::Matrix3d essential = EssentialMatrix(hypothesis.cam2_from_cam1);
  const Eigen::Matrix3d rotation = hypothesis.cam2_from_cam1.RotationMatrix();
  hypothesis.score = 0.0;
  hypothesis.inliers = 0;
  for (const NormalizedMatch& match : matches) {
    const MatchCheck check =
        CheckMatch(essential, rotation, hypothesis.cam2_from_cam1.translation, match);
    if (!check.is_inlier) continue;
    hypothesis.score += kChiSquare95With1Dof - check.squared_error;
    ++hypothesis.inliers;
  }
}

void SortByScore(std::vector<Hypothesis>& hypotheses) {
  std::stable_sort(hypotheses.begin(), hypotheses.end(),
                   [](const Hypothesis& a, const Hypothesis& b) { return a.score > b.score; });
}

bool SamePose(const Rigid3d& a, const Rigid3d& b) {
  const double rotation = RotationAngle(a.rotation * b.rotation.conjugate());
  return rotation * kDegrees < kSamePoseRotationDeg &&
         AngleBetween(a.translation, b.translation) * kDegrees < kSamePoseTranslationDeg;
}

// Both signs of the translation.
void AddBothSigns(const Rigid3d& pose, TwoViewModelKind model, std::vector<Hypothesis>& poses) {
  poses.push_back({pose, model});
  poses.push_back({Rigid3d(pose.rotation, -pose.translation), model});
}

// The best `max_count` of different poses, scored, best first.
std::vector<Hypothesis> KeepBestDifferent(std::span<const NormalizedMatch> matches,
                                          std::vector<Hypothesis> hypotheses,
                                          std::size_t max_count) {
  for (Hypothesis& hypothesis : hypotheses) ScoreHypothesis(matches, hypothesis);
  SortByScore(hypotheses);
  std::vector<Hypothesis> kept;
  for (const Hypothesis& hypothesis : hypotheses) {
    if (kept.size() == max_count) break;
    const bool known = std::any_of(kept.begin(), kept.end(), [&](const Hypothesis& other) {
      return SamePose(other.cam2_from_cam1, hypothesis.cam2_from_cam1);
    });
    if (!known) kept.push_back(hypothesis);
  }
  return kept;
}

// The poses of the models found by sampling.
std::vector<Hypothesis> SampledPoses(const std::vector<TwoViewModel>& essentials,
                                     const std::optional<TwoViewModel>& homography) {
  std::vector<Hypothesis> hypotheses;
  for (const TwoViewModel& essential : essentials) {
    for (const Rigid3d& pose : DecomposeEssential(essential.matrix)) {
      hypotheses.push_back({pose, TwoViewModelKind::kEssential});
    }
  }
  if (homography) {
    for (const Rigid3d& pose : DecomposeHomography(homography->matrix)) {
      hypotheses.push_back({pose, TwoViewModelKind::kHomography});
    }
  }
  return hypotheses;
}

// Further starts: the best rotation with motion along each axis. With little parallax the samples
// may miss the right one of several valleys; what ends up in a known valley costs only time.
std::vector<Hypothesis> AxisPoses(const Eigen::Matrix3d& rotation) {
  std::vector<Hypothesis> hypotheses;
  for (int axis = 0; axis < 3; ++axis) {
    AddBothSigns(Rigid3d(rotation, Eigen::Vector3d::Unit(axis)), TwoViewModelKind::kEssential,
                 hypotheses);
  }
  return hypotheses;
}

void Refine(std::span<const NormalizedMatch> matches, std::vector<Hypothesis>& hypotheses) {
  for (Hypothesis& hypothesis : hypotheses) {
    hypothesis.cam2_from_cam1 = RefineRelativePose(matches, hypothesis.cam2_from_cam1,
                                                   kMaxRefineSquaredError, kRefineIterations);
    ScoreHypothesis(matches, hypothesis);
  }
  SortByScore(hypotheses);
}

// The sigmas given are those of a detector in general; on one pair of images the noise is often
// far smaller, and with it wrong poses stand out more. Ratio of real to given sigma, by the median
// of the best pose's squared errors.
double NoiseScale(std::span<const NormalizedMatch> matches, const Rigid3d& cam2_from_cam1) {
  const Eigen::Matrix3d essential = EssentialMatrix(cam2_from_cam1);
  std::vector<float> errors;
  for (const NormalizedMatch& match : matches) {
    const double error = SquaredSampsonError(essential, match.in_image1, match.in_image2) /
                         (match.sigma * match.sigma);
    if (error < kChiSquare95With1Dof) errors.push_back(static_cast<float>(error));
  }
  const double variance = Median(std::move(errors)) / kChiSquareMedianWith1Dof;
  return std::clamp(std::sqrt(variance), kMinNoiseScale, 1.0);
}

double RunnerUpScore(const std::vector<Hypothesis>& hypotheses) {
  for (const Hypothesis& other : hypotheses) {
    if (!SamePose(other.cam2_from_cam1, hypotheses.front().cam2_from_cam1)) return other.score;
  }
  return 0.0;
}

// The point of an inlier when both reprojection errors are small.
std::optional<Eigen::Vector3d> PointOf(const Rigid3d& cam2_from_cam1,
                                       const NormalizedMatch& match) {
  const auto point = TriangulatePoint(cam2_from_cam1, match.in_image1, match.in_image2);
  if (!point) return std::nullopt;
  const double limit = kChiSquare95With2Dof * match.sigma * match.sigma;
  if (!(SquaredReprojectionError(Rigid3d(), *point, match.in_image1) < limit) ||
      !(SquaredReprojectionError(cam2_from_cam1, *point, match.in_image2) < limit)) {
    return std::nullopt;
  }
  return point;
}

int CountStill(std::span<const NormalizedMatch> matches) {
  return static_cast<int>(std::count_if(matches.begin(), matches.end(), [](const auto& match) {
    return SquaredRotationError(Eigen::Matrix3d::Identity(), match) < kChiSquare95With2Dof;
  }));
}

void FillMatches(std::span<const NormalizedMatch> matches, const TwoViewOptions& options,
                 TwoViewReconstruction& result) {
  const Rigid3d& pose = result.cam2_from_cam1;
  const Eigen::Matrix3d essential = EssentialMatrix(pose);
  const Eigen::Matrix3d rotation = pose.RotationMatrix();
  std::vector<float> inlier_parallax;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const MatchCheck check = CheckMatch(essential, rotation, pose.translation, matches[i]);
    if (!check.is_inlier) continue;
    const double parallax_deg = check.parallax_rad * kDegrees;
    result.is_inlier[i] = 1;
    ++result.num_inliers;
    result.parallax_deg[i] = static_cast<float>(parallax_deg);
    inlier_parallax.push_back(result.parallax_deg[i]);
    if (!check.significant) continue;
    result.points[i] = PointOf(pose, matches[i]);
    if (result.points[i] && parallax_deg >= options.min_parallax_deg) {
      ++result.num_points_with_parallax;
    }
  }
  result.median_parallax_deg = Median(std::move(inlier_parallax));
}

TwoViewStatus Judge(const TwoViewReconstruction& result, std::size_t num_matches,
                    const TwoViewOptions& options) {
  const double inliers = result.num_inliers;
  if (inliers < options.min_inlier_ratio * static_cast<double>(num_matches)) {
    return TwoViewStatus::kTooFewPoints;
  }
  const TwoViewStatus no_parallax = result.rotation_deg > kStillRotationDeg
                                        ? TwoViewStatus::kPureRotation
                                        : TwoViewStatus::kLowParallax;
  if (result.num_still_matches > kMaxStillRatio * inliers) return TwoViewStatus::kLowParallax;
  if (result.num_rotation_inliers > options.max_rotation_ratio * inliers) return no_parallax;
  const double with_parallax = result.num_points_with_parallax;
  if (with_parallax < options.min_point_ratio * inliers) return TwoViewStatus::kLowParallax;
  if (with_parallax < options.min_points) {
    return with_parallax > kGoodParallaxRatio * inliers ? TwoViewStatus::kTooFewPoints
                                                        : TwoViewStatus::kLowParallax;
  }
  if (result.runner_up_score > options.max_runner_up_ratio * result.score) {
    return TwoViewStatus::kAmbiguousPlanar;
  }
  return TwoViewStatus::kSuccess;
}

std::vector<NormalizedMatch> Normalize(std::span<const TwoViewMatch> matches,
                                       double focal_length_px) {
  std::vector<NormalizedMatch> normalized;
  normalized.reserve(matches.size());
  for (const TwoViewMatch& match : matches) {
    normalized.push_back({match.normalized1, match.normalized2, match.sigma_px / focal_length_px});
  }
  return normalized;
}

}  // namespace

TwoViewReconstruction ReconstructTwoViews(std::span<const TwoViewMatch> matches,
                                          double focal_length_px, const TwoViewOptions& options,
                                          std::uint64_t seed) {
  LIFT_SLAM_CHECK(focal_length_px > 0.0, "focal length {} px", focal_length_px);
  TwoViewReconstruction result;
  result.is_inlier.resize(matches.size());
  result.points.resize(matches.size());
  result.parallax_deg.resize(matches.size());
  if (matches.size() < static_cast<std::size_t>(std::max(options.min_matches, 8))) return result;

  std::vector<NormalizedMatch> normalized = Normalize(matches, focal_length_px);
  Random random(seed);
  const auto homography = FindHomography(normalized, {20, 100, 0.999}, random);
  const auto essentials = FindEssentialMatrices(normalized, {30, options.max_iterations, 0.999},
                                                kMaxEssentials, random);
  if (homography) result.num_homography_inliers = homography->inliers;
  auto hypotheses =
      KeepBestDifferent(normalized, SampledPoses(essentials, homography), kMaxSampledPoses);
  result.status = TwoViewStatus::kTooFewPoints;
  if (hypotheses.empty()) return result;
  Refine(normalized, hypotheses);

  result.noise_scale = NoiseScale(normalized, hypotheses.front().cam2_from_cam1);
  for (NormalizedMatch& match : normalized) match.sigma *= result.noise_scale;
  const TwoViewModel rotation = FindRotation(normalized, {10, 50, 0.999}, random);
  result.num_rotation_inliers = rotation.inliers;
  result.num_still_matches = CountStill(normalized);
  result.rotation_deg = RotationAngle(Eigen::Quaterniond(rotation.matrix)) * kDegrees;
  for (const Hypothesis& start :
       KeepBestDifferent(normalized, AxisPoses(rotation.matrix), kMaxAxisPoses)) {
    hypotheses.push_back(start);
  }
  Refine(normalized, hypotheses);
  result.cam2_from_cam1 = hypotheses.front().cam2_from_cam1;
  result.model = hypotheses.front().model;
  result.score = hypotheses.front().score;
  result.runner_up_score = RunnerUpScore(hypotheses);
  FillMatches(normalized, options, result);
  result.status = Judge(result, matches.size(), options);
  return result;
}

std::string_view Name(TwoViewStatus status) {
  switch (status) {
    case TwoViewStatus::kSuccess:
      return "success";
    case TwoViewStatus::kTooFewMatches:
      return "too_few_matches";
    case TwoViewStatus::kLowParallax:
      return "low_parallax";
    case TwoViewStatus::kPureRotation:
      return "pure_rotation";
    case TwoViewStatus::kAmbiguousPlanar:
      return "ambiguous_planar";
    case TwoViewStatus::kTooFewPoints:
      return "too_few_points";
  }
  return "unknown";
}

void TwoViewOptions::Visit(OptionVisitor& visitor) {
  visitor.Field("min_matches", min_matches, "matches below which no model is tried");
  visitor.Field("min_inlier_ratio", min_inlier_ratio, "share of the matches the pose explains");
  visitor.Field("min_points", min_points, "points with min_parallax_deg to start a map with");
  visitor.Field("min_point_ratio", min_point_ratio, "such points as a share of the inliers");
  visitor.Field("min_parallax_deg", min_parallax_deg, "angle between the rays of such a point");
  visitor.Field("max_rotation_ratio", max_rotation_ratio,
                "matches a pure rotation may explain, as a share of the inliers");
  visitor.Field("max_runner_up_ratio", max_runner_up_ratio,
                "score of a different pose against the best; above: ambiguous");
  visitor.Field("max_iterations", max_iterations, "samples for the essential matrix");
}

}  // namespace lift_slam
