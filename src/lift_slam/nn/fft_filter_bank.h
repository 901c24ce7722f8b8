#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "lift_slam/nn/aligned_vector.h"
#include "lift_slam/nn/layers.h"
#include "lift_slam/nn/worker_team.h"

namespace lift_slam::nn {

// Eight floats that are computed together.
using EightFloats = float __attribute__((vector_size(32)));

// A grey image; `stride` is the number of pixels from one row to the next.
struct GreyPixels {
  const std::uint8_t* pixels = nullptr;
  int width = 0, height = 0;
  std::ptrdiff_t stride = 0;
};

// Sixteen large filters on one channel, then GHH with four sums of four maxima, by Fourier
// transforms: the same as Convolution and Ghh up to rounding (about 1e-6 of the largest score), in
// about a fifteenth of the multiplications for filters of 25 x 25, and for any size of image.
// The image is cut into tiles of 64 x 64 that overlap by the filter size. Two filters share one
// complex transform (real and imaginary part), eight of which run side by side.
class FftFilterBank {
 public:
  // CheckError unless the weights are (16, 1, k, k) with 2 <= k <= 33.
  // Pixel value v enters as (v - input_mean) / input_scale.
  FftFilterBank(const Convolution& filters, float input_mean, float input_scale,
                std::shared_ptr<WorkerTeam> team);
  ~FftFilterBank();

  // (width - k + 1) x (height - k + 1) scores, row by row; the image is at least k x k. The same
  // bytes for any number of threads. One caller at a time.
  void Run(const GreyPixels& image, float* scores);

 private:
  struct Workspace;

  void TransformFilters(const Convolution& filters);
  void LoadTile(const GreyPixels& image, int left, int top, float* tile) const;
  void FilterTile(const GreyPixels& image, int left, int top, Workspace& space,
                  float* scores) const;
  void MultiplyAndInvertColumn(int column, Workspace& space) const;
  void WriteRow(const EightFloats* real, const EightFloats* imaginary, int count,
                float* scores) const;

  int size_;   // of the filters
  int valid_;  // rows and columns of scores that a tile gives
  float input_mean_, input_scale_;
  std::shared_ptr<WorkerTeam> team_;
  AlignedVector<EightFloats> real_, imaginary_;  // spectra of the filters, [column][row]
  EightFloats real_bias_{}, imaginary_bias_{};
  std::vector<std::unique_ptr<Workspace>> workspaces_;  // one a thread
};

}  // namespace lift_slam::nn
