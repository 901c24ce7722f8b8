#pragma once

#include <torch/torch.h>

namespace lift_slam::training {

// Differentiable in all arguments. Patches are (N, 1, S, S); places in them are x, y from -1 to 1
// between the centres of the outermost pixels; the image continues by its border.

// size x size samples of the square of half-width `ratio` (of the patch's) about `centres` (N, 2),
// its +x axis along `directions` (N, 2), (cos, sin): LIFT's crop and rotation in one.
torch::Tensor CutRotated(const torch::Tensor& patches, const torch::Tensor& centres,
                         const torch::Tensor& directions, double ratio, std::int64_t size);

// Centre of mass of exp(softness (S - max S)) over maps (N, 1, H, W): column and row (N, 2), from
// 0.
torch::Tensor SoftArgmax(const torch::Tensor& maps, double softness);
// Log-mean-exp: max S + log(mean exp(softness (S - max S))) / softness (N).
torch::Tensor SoftMaximum(const torch::Tensor& maps, double softness);

}  // namespace lift_slam::training
