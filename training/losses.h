#pragma once

#include <torch/torch.h>

namespace lift_slam::training {

// Euclidean distances of rows, with a tiny number under the root: the gradient at equal rows is 0.
torch::Tensor RowDistances(const torch::Tensor& a, const torch::Tensor& b);
// Of all rows of `a` to all rows of `b`.
torch::Tensor AllDistances(const torch::Tensor& a, const torch::Tensor& b);

// Each of these gives one loss per row. `first` and `second` (N, 128) describe two views of N
// points; `different` (N, N, bool) says which may be told apart.

// max(0, margin + |d1 - d2| - distance to the nearest other description, of either view).
torch::Tensor HardestNegativeLoss(const torch::Tensor& first, const torch::Tensor& second,
                                  const torch::Tensor& different, double margin);
// Eq. 1 of the paper: |d1 - d2| and max(0, C - |d1 - d3|), one after the other (2 N rows), with d3
// the next point's second view. Where that is not surely another point the loss is 0.
torch::Tensor PairLoss(const torch::Tensor& first, const torch::Tensor& second,
                       const torch::Tensor& different, double margin);
// max(0, margin + |d1 - d2| - min(|d1 - d3|, |d2 - d3|)).
torch::Tensor TripletLoss(const torch::Tensor& first, const torch::Tensor& second,
                          const torch::Tensor& different, double margin);

// Eq. 4 with squared hinges: scores of P1, P2, P3 (each (N)) should exceed 1, those of P4 fall
// below -1; weights 1/6, 1/6, 1/6, 3/6. One loss.
torch::Tensor ClassificationLoss(const torch::Tensor& s1, const torch::Tensor& s2,
                                 const torch::Tensor& s3, const torch::Tensor& s4);

// 1 - intersection / union of the squares of half-width `radius` about two places (N, 2), plus
// their gap in units of the root of the union where they do not meet (the authors' second code).
torch::Tensor OverlapLoss(const torch::Tensor& a, const torch::Tensor& b, double radius);

}  // namespace lift_slam::training
