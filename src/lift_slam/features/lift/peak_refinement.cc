#include "lift_slam/features/lift/peak_refinement.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>

namespace lift_slam {
namespace {

double Interpolate(const ScoreLevel& level, const LevelPosition& at) {
  const double left = std::floor(at.x), top = std::floor(at.y);
  const double fx = at.x - left, fy = at.y - top;
  const auto x = static_cast<int>(left), y = static_cast<int>(top);
  return (1 - fy) * ((1 - fx) * level.At(x, y) + fx * level.At(x + 1, y)) +
         fy * ((1 - fx) * level.At(x, y + 1) + fx * level.At(x + 1, y + 1));
}

// The scores around a peak, in pixels of its level.
class Neighbourhood {
 public:
  Neighbourhood(std::span<const ScoreLevel> levels, const ScorePeak& peak, LevelCoordinates how)
      : levels_(levels), peak_(peak), how_(how) {}

  // Not finite where there is no score.
  double operator()(int dx, int dy, int d_level) const {
    const int index = peak_.level + d_level;
    if (index < 0 || index >= static_cast<int>(levels_.size())) return ScoreLevel::kNoScore;
    const ScoreLevel& level = levels_[static_cast<std::size_t>(index)];
    const int x = peak_.x + dx, y = peak_.y + dy;
    if (d_level == 0) return level.At(x, y);
    const LevelPosition there =
        ToLevel(levels_[static_cast<std::size_t>(peak_.level)].shape, level.shape,
                {static_cast<double>(x), static_cast<double>(y)}, how_);
    if (how_ == LevelCoordinates::kExact) return Interpolate(level, there);
    return level.At(static_cast<int>(std::lround(there.x)), static_cast<int>(std::lround(there.y)));
  }

  Eigen::Vector3d Gradient() const {
    const Neighbourhood& s = *this;
    return {(s(1, 0, 0) - s(-1, 0, 0)) / 2, (s(0, 1, 0) - s(0, -1, 0)) / 2,
            (s(0, 0, 1) - s(0, 0, -1)) / 2};
  }

  Eigen::Matrix3d Hessian() const {
    const Neighbourhood& s = *this;
    const double center = 2 * s(0, 0, 0);
    const double xy = (s(1, 1, 0) - s(1, -1, 0) - s(-1, 1, 0) + s(-1, -1, 0)) / 4;
    const double xl = (s(1, 0, 1) - s(1, 0, -1) - s(-1, 0, 1) + s(-1, 0, -1)) / 4;
    const double yl = (s(0, 1, 1) - s(0, 1, -1) - s(0, -1, 1) + s(0, -1, -1)) / 4;
    Eigen::Matrix3d hessian;
    hessian << s(1, 0, 0) + s(-1, 0, 0) - center, xy, xl,  //
        xy, s(0, 1, 0) + s(0, -1, 0) - center, yl,         //
        xl, yl, s(0, 0, 1) + s(0, 0, -1) - center;
    return hessian;
  }

 private:
  std::span<const ScoreLevel> levels_;
  const ScorePeak& peak_;
  LevelCoordinates how_;
};

bool IsEdge(const Eigen::Matrix3d& hessian, double max_ratio) {
  const double trace = hessian(0, 0) + hessian(1, 1);
  const double determinant = hessian(0, 0) * hessian(1, 1) - hessian(0, 1) * hessian(0, 1);
  const double largest = (max_ratio + 1) * (max_ratio + 1) / max_ratio;
  const double roundness = trace * trace / determinant;
  return !(roundness >= 0.0 && roundness < largest);  // true for NaN too
}

// A flat area has maxima too, of rounding: its scores, near -1, differ by some 1e-6.
bool IsRounding(const Eigen::Matrix3d& hessian, double score) {
  constexpr double kLeastCurvature = 1e-4;
  return !(-(hessian(0, 0) + hessian(1, 1)) > kLeastCurvature * (1.0 + std::abs(score)));
}

// From the peak to the extremum of the quadratic function; nothing when it is out of reach.
std::optional<Eigen::Vector3d> OffsetOfExtremum(const Eigen::Vector3d& gradient,
                                                const Eigen::Matrix3d& hessian) {
  constexpr double kMaxOffset = 1.5;
  Eigen::Matrix3d inverse;
  bool invertible = false;
  hessian.computeInverseWithCheck(inverse, invertible, 1e-30);
  if (!invertible) return std::nullopt;
  const Eigen::Vector3d offset = -(inverse * gradient);
  if (!(offset.cwiseAbs().maxCoeff() < kMaxOffset)) return std::nullopt;
  return offset;
}

}  // namespace

std::optional<LiftKeypoint> RefinePeak(std::span<const ScoreLevel> levels, const ScorePeak& peak,
                                       double max_edge_ratio, LevelCoordinates how) {
  const Neighbourhood scores(levels, peak, how);
  const Eigen::Vector3d gradient = scores.Gradient();
  const Eigen::Matrix3d hessian = scores.Hessian();
  if (!gradient.allFinite() || !hessian.allFinite()) return std::nullopt;
  if (IsRounding(hessian, scores(0, 0, 0)) || IsEdge(hessian, max_edge_ratio)) return std::nullopt;
  const std::optional<Eigen::Vector3d> offset = OffsetOfExtremum(gradient, hessian);
  if (!offset) return std::nullopt;
  const ScaleLevel& level = levels[static_cast<std::size_t>(peak.level)].shape;
  const LevelPosition position =
      ToFullSize(level, {peak.x + offset->x(), peak.y + offset->y()}, how);
  const double there =
      scores(static_cast<int>(std::lround(offset->x())), static_cast<int>(std::lround(offset->y())),
             static_cast<int>(std::lround(offset->z())));
  return LiftKeypoint{.x = position.x,
                      .y = position.y,
                      .sigma = level.sigma * std::exp2(offset->z() / kLiftLevelsPerOctave),
                      .score = static_cast<float>(std::isfinite(there) ? there : scores(0, 0, 0))};
}

}  // namespace lift_slam
