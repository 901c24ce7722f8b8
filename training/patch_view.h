#pragma once

#include <cstdint>
#include <span>

#include "lift_slam/image/pyramid.h"
#include "lift_slam/util/options.h"
#include "lift_slam/util/random.h"
#include "training/training_set.h"

namespace lift_slam::training {

// A patch's plane laid over an image. (u, v) are sigmas of the keypoint from the patch's centre:
//   X = x + (xu u + xv v) / w,  Y = y + (yu u + yv v) / w,  w = 1 + wu u + wv v.
struct PatchView {
  double x = 0.0, y = 0.0;                        // pixels
  double xu = 1.0, xv = 0.0, yu = 0.0, yv = 1.0;  // pixels per sigma
  double wu = 0.0, wv = 0.0;                      // per sigma; 0: no perspective
};

// size x size samples of [-half_width, half_width]^2 sigmas, row by row, bilinear, rounded, the
// image continued by its outermost pixels: what features/lift/patch_cutter.h cuts, for any view.
// The level of the pyramid is the first whose pixels are at least 2/3 of the largest step.
void SamplePatchView(const ImagePyramid& pyramid, const PatchView& view, double half_width,
                     int size, std::span<std::uint8_t> patch);

// Moves the centre by (u, v) sigmas within the patch's plane.
PatchView Shifted(const PatchView& view, double u, double v);

// How the two patches of a pair come to differ beyond what their images show.
struct ViewOptions {
  // Of points with one view: largest ratio of a slanted surface's axes; log-uniform.
  double max_tilt = 2.0;
  double max_perspective = 0.02;  // per sigma: 12 % larger at the far edge of +-6 sigmas
  // Noise of the keypoint, standard deviations.
  double position_noise_sigmas = 0.2;
  double scale_noise_octaves = 0.12;
  double rotation_noise_deg = 6.0;
  // Share of pairs of which both patches are turned by the same random angle.
  double turned_share = 0.5;
  void Visit(OptionVisitor& visitor);
  void Check() const;  // throws InputError naming the field
};

// A random view of a keypoint, its content turned by `angle_rad`. With `warp` the surface is
// slanted at random, for points of which there is one image only.
PatchView RandomPatchView(const View& view, double angle_rad, bool warp, const ViewOptions& options,
                          Random& random);

}  // namespace lift_slam::training
