#include "training/spatial_transformer.h"

#include <cmath>

namespace lift_slam::training {

using torch::Tensor;

Tensor CutRotated(const Tensor& patches, const Tensor& centres, const Tensor& directions,
                  double ratio, std::int64_t size) {
  const Tensor c = ratio * directions.select(1, 0), s = ratio * directions.select(1, 1);
  const Tensor x_row = torch::stack({c, -s, centres.select(1, 0)}, 1);
  const Tensor y_row = torch::stack({s, c, centres.select(1, 1)}, 1);
  const Tensor grid = torch::nn::functional::affine_grid(
      torch::stack({x_row, y_row}, 1), {patches.size(0), 1, size, size}, /*align_corners=*/true);
  return torch::nn::functional::grid_sample(patches, grid,
                                            torch::nn::functional::GridSampleFuncOptions()
                                                .mode(torch::kBilinear)
                                                .padding_mode(torch::kBorder)
                                                .align_corners(true));
}

Tensor SoftArgmax(const Tensor& maps, double softness) {
  const std::int64_t height = maps.size(2), width = maps.size(3);
  const Tensor weights = torch::softmax(softness * maps.flatten(1), 1).view({-1, height, width});
  const Tensor columns = torch::arange(width, maps.options());
  const Tensor rows = torch::arange(height, maps.options());
  return torch::stack({(weights.sum(1) * columns).sum(1), (weights.sum(2) * rows).sum(1)}, 1);
}

Tensor SoftMaximum(const Tensor& maps, double softness) {
  const auto places = static_cast<double>(maps.size(2) * maps.size(3));
  return (torch::logsumexp(softness * maps.flatten(1), 1) - std::log(places)) / softness;
}

}  // namespace lift_slam::training
