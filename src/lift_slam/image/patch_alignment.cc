#include "lift_slam/image/patch_alignment.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace lift_slam {
namespace {

constexpr int kSide = ReferencePatch::kSide;
constexpr int kPixels = kSide * kSide;
// Parameters: shift x, y; shear along the parallax, per pixel x, y; gain; offset.
constexpr int kParameters = 6;
using Gray = Eigen::Matrix<float, kPixels, 1>;
using Jacobian = Eigen::Matrix<float, kPixels, kParameters>;
using Vector6 = Eigen::Matrix<float, kParameters, 1>;
using Matrix6 = Eigen::Matrix<float, kParameters, kParameters>;

constexpr float kConvergedShiftPx = 0.01F;
constexpr float kMinGain = 0.5F, kMaxGain = 2.0F;
// Prior of the shear: grey levels by which a pixel differs for other reasons, and the shear's
// standard deviation for a parallax of one pixel and at most.
constexpr float kGraySigma = 4.0F;
constexpr float kShearPerParallax = 0.02F, kMaxShearSigma = 0.2F, kMinShearSigma = 1e-3F;
constexpr float kMaxShear = 0.6F;

const PyramidLevel& LevelOfScale(const ImagePyramid& image, double scale) {
  std::size_t best = 0;
  double best_ratio = 0.0;
  for (std::size_t i = 0; i < image.size(); ++i) {
    const double ratio = std::min(image[i].scale_x / scale, scale / image[i].scale_x);
    if (ratio > best_ratio) {
      best_ratio = ratio;
      best = i;
    }
  }
  return image[best];
}

// Samples side x side values bilinearly; false when the square reaches beyond the image.
template <class Store>
bool SampleSquare(const PyramidLevel& level, const Eigen::Vector2d& center,
                  const Eigen::Matrix2d& step, int side, Store store) {
  const Eigen::Vector2d inverse_scale(1.0 / level.scale_x, 1.0 / level.scale_y);
  const Eigen::Matrix2d a = inverse_scale.asDiagonal() * step;
  const double half = 0.5 * (side - 1);
  const Eigen::Vector2d middle = (center.array() + 0.5) * inverse_scale.array() - 0.5;
  const Eigen::Vector2d extent = half * a.cwiseAbs().rowwise().sum();
  // One pixel is left at the far borders, for the bilinear neighbours; NaN fails as well.
  if (!((middle - extent).minCoeff() >= 0.0 &&
        middle.x() + extent.x() < level.image.width() - 1.001 &&
        middle.y() + extent.y() < level.image.height() - 1.001)) {
    return false;
  }
  const std::uint8_t* pixels = level.image.row(0);
  const std::ptrdiff_t stride = level.image.row(1) - pixels;
  const Eigen::Vector2f first = (middle - a * Eigen::Vector2d(half, half)).cast<float>();
  const Eigen::Matrix2f step_f = a.cast<float>();
  for (int v = 0, k = 0; v < side; ++v) {
    const Eigen::Vector2f begin = first + static_cast<float>(v) * step_f.col(1);
    for (int u = 0; u < side; ++u, ++k) {
      const float x = std::max(begin.x() + static_cast<float>(u) * step_f(0, 0), 0.0F);
      const float y = std::max(begin.y() + static_cast<float>(u) * step_f(1, 0), 0.0F);
      const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
      const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
      const std::uint8_t* p = pixels + y0 * stride + x0;
      const auto p00 = static_cast<float>(p[0]), p01 = static_cast<float>(p[1]);
      const auto p10 = static_cast<float>(p[stride]), p11 = static_cast<float>(p[stride + 1]);
      const float top = p00 + fx * (p01 - p00), bottom = p10 + fx * (p11 - p10);
      store(k, top + fy * (bottom - top));
    }
  }
  return true;
}

// What does not change from step to step.
struct Template {
  Jacobian jacobian;  // the gain's column is the patch itself, less its mean
  float mean = 0.0F, contrast = 0.0F;
};

Template MakeTemplate(const ReferencePatch& patch, const Eigen::Vector2f& shear_direction) {
  constexpr int kStride = ReferencePatch::kStoredSide;
  Template result;
  for (int v = 0, k = 0; v < kSide; ++v) {
    for (int u = 0; u < kSide; ++u, ++k) {
      const std::uint8_t* p = patch.gray.data() + (v + 1) * kStride + u + 1;
      const float dx = 0.5F * static_cast<float>(p[1] - p[-1]);
      const float dy = 0.5F * static_cast<float>(p[kStride] - p[-kStride]);
      const float along = dx * shear_direction.x() + dy * shear_direction.y();
      const float x = static_cast<float>(u) - 0.5F * (kSide - 1);
      const float y = static_cast<float>(v) - 0.5F * (kSide - 1);
      result.jacobian.row(k) << dx, dy, along * x, along * y, static_cast<float>(p[0]), 1.0F;
    }
  }
  auto gray = result.jacobian.col(4);
  result.mean = gray.mean();
  gray.array() -= result.mean;
  result.contrast = gray.norm() / static_cast<float>(kSide);
  return result;
}

// The state of one alignment.
class Aligner {
 public:
  Aligner(const ReferencePatch& patch, const ImagePyramid& image, const PatchView& expected)
      : expected_(expected),
        level_(LevelOfScale(image, std::sqrt(std::abs(expected.image_from_patch.determinant())))),
        center_(expected.center) {
    const Eigen::Vector2d parallax = expected.image_from_patch.inverse() * expected.parallax;
    if (parallax.norm() > 1e-6) shear_direction_ = parallax.normalized().cast<float>();
    template_ = MakeTemplate(patch, shear_direction_);
    offset_ = template_.mean;
    const float shear_sigma =
        std::clamp(kShearPerParallax * static_cast<float>(expected.parallax.norm()), kMinShearSigma,
                   kMaxShearSigma);
    shear_weight_ = kGraySigma * kGraySigma / (shear_sigma * shear_sigma);
    Matrix6 hessian = template_.jacobian.transpose() * template_.jacobian;
    hessian(2, 2) += shear_weight_;
    hessian(3, 3) += shear_weight_;
    hessian.diagonal().array() += 1e-3F;
    inverse_ = hessian.ldlt().solve(Matrix6::Identity());
  }

  // One step; false when the patch has left the image. `shift` is how far it moved.
  bool Step(float& shift) {
    Gray difference;
    const Eigen::Matrix2d step = expected_.image_from_patch * Warp().cast<double>();
    if (!SampleSquare(level_, center_, step, kSide,
                      [&](int k, float value) { difference[k] = value; })) {
      return false;
    }
    difference -= gain_ * template_.jacobian.col(4);
    difference.array() -= offset_;
    rms_ = difference.norm() / static_cast<float>(kSide);
    Vector6 gradient = template_.jacobian.transpose() * difference;
    gradient.segment<2>(2) += shear_weight_ * shear_;
    const Vector6 update = inverse_ * gradient;
    const float inverse_gain = 1.0F / std::max(gain_, kMinGain);
    gain_ += update[4];
    offset_ += update[5];
    Compose(update.head<2>() * inverse_gain, update.segment<2>(2) * inverse_gain);
    shift = update.head<2>().norm() * inverse_gain;
    return true;
  }

  float contrast() const { return template_.contrast; }
  float gain() const { return gain_; }
  bool ShearIsPlausible() const { return shear_.norm() < kMaxShear; }
  const Eigen::Vector2d& center() const { return center_; }
  double ShiftPx() const {
    return (expected_.image_from_patch.inverse() * (center_ - expected_.center)).norm();
  }
  double Residual() const { return rms_ / (gain_ * template_.contrast); }
  double PositionSigmaPx() const {
    return rms_ / gain_ * std::sqrt(inverse_(0, 0) + inverse_(1, 1));
  }

 private:
  Eigen::Matrix2f Warp() const {
    return Eigen::Matrix2f::Identity() + shear_direction_ * shear_.transpose();
  }

  // The warp followed backwards by the update: W <- W o inverse(dW).
  void Compose(const Eigen::Vector2f& shift, const Eigen::Vector2f& shear) {
    const Eigen::Matrix2f inverse =
        (Eigen::Matrix2f::Identity() + shear_direction_ * shear.transpose()).inverse();
    const Eigen::Matrix2f warp = Warp();
    center_ -= expected_.image_from_patch * (warp * inverse * shift).cast<double>();
    // The product is again the identity plus direction times a row.
    shear_ = (warp * inverse - Eigen::Matrix2f::Identity()).transpose() * shear_direction_;
  }

  const PatchView& expected_;
  const PyramidLevel& level_;
  Template template_;
  Matrix6 inverse_;
  Eigen::Vector2f shear_direction_ = Eigen::Vector2f::UnitX();  // in the patch, unit
  float shear_weight_ = 0.0F;
  Eigen::Vector2d center_;
  Eigen::Vector2f shear_ = Eigen::Vector2f::Zero();  // patch pixels along, per patch pixel
  float gain_ = 1.0F, offset_ = 0.0F, rms_ = 0.0F;
};

}  // namespace

std::optional<ReferencePatch> CutReferencePatch(const ImagePyramid& image,
                                                const Eigen::Vector2d& center, double scale) {
  if (image.empty()) return std::nullopt;
  ReferencePatch patch;
  const auto store = [&](int k, float value) {
    patch.gray[static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(value + 0.5F);
  };
  if (!SampleSquare(LevelOfScale(image, scale), center, scale * Eigen::Matrix2d::Identity(),
                    ReferencePatch::kStoredSide, store)) {
    return std::nullopt;
  }
  return patch;
}

std::optional<PatchAlignment> AlignPatch(const ReferencePatch& patch, const ImagePyramid& image,
                                         const PatchView& expected,
                                         const PatchAlignmentOptions& options) {
  if (image.empty() || !(std::abs(expected.image_from_patch.determinant()) > 1e-6)) {
    return std::nullopt;
  }
  Aligner aligner(patch, image, expected);
  if (aligner.contrast() < options.min_contrast) return std::nullopt;
  float shift = 0.0F;
  for (int i = 0; i < options.max_iterations; ++i) {
    if (!aligner.Step(shift)) return std::nullopt;
    // Also refuses what is not a number.
    if (!(aligner.ShiftPx() <= options.max_shift_px) || !aligner.ShearIsPlausible()) {
      return std::nullopt;
    }
    if (shift < kConvergedShiftPx) break;
  }
  if (shift >= kConvergedShiftPx || aligner.gain() < kMinGain || aligner.gain() > kMaxGain ||
      aligner.Residual() > options.max_residual ||
      aligner.PositionSigmaPx() > options.max_position_sigma_px) {
    return std::nullopt;
  }
  return PatchAlignment{aligner.center(), aligner.Residual(), aligner.ShiftPx()};
}

}  // namespace lift_slam
