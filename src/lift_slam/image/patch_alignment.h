#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "lift_slam/image/pyramid.h"
#include "lift_slam/util/options.h"

namespace lift_slam {

// The grey values around a feature on the grid of its own scale, with a border of one pixel for
// the derivatives. Later images of the feature are aligned to it.
struct ReferencePatch {
  static constexpr int kSide = 12;
  static constexpr int kStoredSide = kSide + 2;

  std::array<std::uint8_t, std::size_t{kStoredSide} * kStoredSide> gray{};
};

// Cuts the patch around `center` (pixels of the full-size image), one pixel of the patch being
// `scale` pixels of the full-size image. Nothing when it reaches beyond the image.
std::optional<ReferencePatch> CutReferencePatch(const ImagePyramid& image,
                                                const Eigen::Vector2d& center, double scale);

struct PatchAlignmentOptions {
  bool enabled = true;
  double max_shift_px = 2.0;  // from the detected place, in pixels of the patch
  double max_residual = 0.5;  // RMS of the difference over the patch's contrast (RMS)
  // The same for features that are found to a fraction of a pixel already (LIFT: 0.15 of a blob's
  // sigma): only a close fit improves on that.
  double max_residual_of_fine = 0.2;
  double min_contrast = 3.0;           // RMS of the patch, grey levels
  double max_position_sigma_px = 0.2;  // predicted from residual and texture, pixels of the patch
  int max_iterations = 12;
  // Sigma of an aligned position over that of a detected one. Measured: a third; the rest is for
  // what alignment cannot mend, such as an imperfect calibration.
  double sigma_factor = 0.5;

  void Visit(OptionVisitor& visitor) {
    visitor.Field("enabled", enabled, "align matched features to their point's first image");
    visitor.Field("max_shift_px", max_shift_px,
                  "farthest from the detected place, in pixels of the feature's scale");
    visitor.Field("max_residual", max_residual,
                  "largest difference after alignment, as a share of the contrast");
    visitor.Field("max_residual_of_fine", max_residual_of_fine,
                  "the same for features with fine positions of their own (LIFT)");
    visitor.Field("min_contrast", min_contrast, "least RMS contrast of a patch, grey levels");
    visitor.Field("max_position_sigma_px", max_position_sigma_px,
                  "largest standard deviation of the position that the texture allows");
    visitor.Field("max_iterations", max_iterations, "steps after which alignment is given up");
    visitor.Field("sigma_factor", sigma_factor,
                  "standard deviation of an aligned position over that of a detected one");
  }
};

// How a patch is expected to look in another image.
struct PatchView {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();                // pixels, full-size image
  Eigen::Matrix2d image_from_patch = Eigen::Matrix2d::Identity();  // pixels per pixel of the patch
  // Where depth moves a pixel: the shift in the image between the point at its depth and at
  // infinity. A slanted surface shears the patch along it.
  Eigen::Vector2d parallax = Eigen::Vector2d::Zero();
};

struct PatchAlignment {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();  // pixels, full-size image
  double residual = 0.0;                             // share of the contrast
  double shift_px = 0.0;                             // from the expected centre, patch pixels
};

// Finds where the patch's centre lies in the image to a fraction of a pixel: Lucas-Kanade,
// inverse compositional (Baker and Matthews, IJCV 2004), for a shift, a shear along the parallax
// (rank one, as the relative depth of a plane makes it; under a prior), gain and offset. Nothing
// when it does not converge or a limit of the options is exceeded.
std::optional<PatchAlignment> AlignPatch(const ReferencePatch& patch, const ImagePyramid& image,
                                         const PatchView& expected,
                                         const PatchAlignmentOptions& options);

}  // namespace lift_slam
