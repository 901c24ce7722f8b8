#include "training/losses.h"

namespace lift_slam::training {

using torch::Tensor;

namespace {

constexpr double kTiny = 1e-12;

// Which point comes next, and whether it is surely another one (N).
Tensor NextIsDifferent(const Tensor& different) {
  return different.roll(-1, 1).diagonal().to(torch::kFloat32);
}

Tensor Next(const Tensor& rows) { return rows.roll(-1, 0); }

}  // namespace

Tensor RowDistances(const Tensor& a, const Tensor& b) {
  return ((a - b).pow(2).sum(1) + kTiny).sqrt();
}

Tensor AllDistances(const Tensor& a, const Tensor& b) {
  // |a - b|^2 = a^2 + b^2 - 2 a b loses digits: keep away from the root's infinite slope.
  constexpr double kRounding = 1e-6;
  const Tensor squares =
      a.pow(2).sum(1).unsqueeze(1) + b.pow(2).sum(1).unsqueeze(0) - 2.0 * a.mm(b.t());
  return (squares.clamp_min(0.0) + kRounding).sqrt();
}

Tensor HardestNegativeLoss(const Tensor& first, const Tensor& second, const Tensor& different,
                           double margin) {
  constexpr double kFar = 1e6;
  const Tensor distances = AllDistances(first, second).masked_fill(different.logical_not(), kFar);
  const Tensor nearest = torch::min(distances.amin(1), distances.amin(0));
  return torch::relu(margin + RowDistances(first, second) - nearest);
}

Tensor PairLoss(const Tensor& first, const Tensor& second, const Tensor& different, double margin) {
  const Tensor wrong = torch::relu(margin - RowDistances(first, Next(second)));
  return torch::cat({RowDistances(first, second), wrong * NextIsDifferent(different)});
}

Tensor TripletLoss(const Tensor& first, const Tensor& second, const Tensor& different,
                   double margin) {
  const Tensor third = Next(second);
  const Tensor wrong = torch::min(RowDistances(first, third), RowDistances(second, third));
  return torch::relu(margin + RowDistances(first, second) - wrong) * NextIsDifferent(different);
}

Tensor ClassificationLoss(const Tensor& s1, const Tensor& s2, const Tensor& s3, const Tensor& s4) {
  const auto hinge = [](const Tensor& x) { return torch::relu(1.0 - x).pow(2).mean(); };
  return (hinge(s1) + hinge(s2) + hinge(s3)) / 6.0 + hinge(-s4) / 2.0;
}

Tensor OverlapLoss(const Tensor& a, const Tensor& b, double radius) {
  const Tensor gap = (a - b).abs();                               // (N, 2)
  const Tensor shared = torch::relu(2.0 * radius - gap).prod(1);  // area
  const Tensor joined = 8.0 * radius * radius - shared;
  const Tensor apart = torch::relu(gap - 2.0 * radius).sum(1);
  return 1.0 - shared / joined + apart / joined.sqrt();
}

}  // namespace lift_slam::training
