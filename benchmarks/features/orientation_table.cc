#include "benchmarks/features/orientation_table.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "benchmarks/features/markdown_table.h"
#include "lift_slam/features/lift/measurement/descriptor_distances.h"
#include "lift_slam/features/lift/patch_cutter.h"
#include "lift_slam/features/lift/patch_sampling.h"

namespace lift_slam {
namespace {

constexpr double kTurnsDeg[] = {30.0, 60.0, 90.0};
constexpr std::size_t kKeypointsPerImage = 300;

Eigen::Matrix3d TurnAboutTheMiddle(const GrayImage& image, double angle_rad) {
  Eigen::Isometry2d turn = Eigen::Isometry2d::Identity();
  turn.translate(Eigen::Vector2d(0.5 * image.width(), 0.5 * image.height()));
  turn.rotate(angle_rad);
  turn.translate(-Eigen::Vector2d(0.5 * image.width(), 0.5 * image.height()));
  return turn.matrix();
}

std::vector<float> Angles(const GrayImage& image, std::span<const LiftKeypoint> keypoints,
                          LiftNetworks& networks) {
  PatchCutter cutter;
  cutter.SetImage(image);
  const std::span<const float> angles =
      networks.OrientPatches(cutter.Cut(keypoints, {}, networks.team()));
  return {angles.begin(), angles.end()};
}

// Appends the errors of the keypoints whose patches lie within the turned image.
void AppendErrors(const GrayImage& image, std::span<const LiftKeypoint> found, double turn_deg,
                  LiftNetworks& networks, std::vector<float>& errors_deg) {
  const double turn_rad = turn_deg * std::numbers::pi / 180.0;
  const Eigen::Matrix3d turn = TurnAboutTheMiddle(image, turn_rad);
  Random random(3);
  const GrayImage turned = WarpedCopy(image, turn, {.max_gamma = 1.0}, random);
  std::vector<LiftKeypoint> before, after;
  for (const LiftKeypoint& keypoint : found) {
    const LiftKeypoint place = Warped(keypoint, turn);
    if (!LiesWithin(turned, place.x, place.y, 1.5 * kLiftHalfWidthSigmas * place.sigma)) continue;
    before.push_back(keypoint);
    after.push_back(place);
  }
  const std::vector<float> first = Angles(image, before, networks);
  const std::vector<float> second = Angles(turned, after, networks);
  for (std::size_t i = 0; i < first.size(); ++i) {
    const double error = std::remainder(second[i] - first[i] - turn_rad, 2.0 * std::numbers::pi);
    errors_deg.push_back(static_cast<float>(std::abs(error) * 180.0 / std::numbers::pi));
  }
}

double PercentBelow(const std::vector<float>& errors, float limit) {
  const auto count = std::ranges::count_if(errors, [=](float error) { return error < limit; });
  return 100.0 * static_cast<double>(count) / static_cast<double>(errors.size());
}

std::string Cell(const ImageSet& set, double turn_deg, LiftNetworks& networks) {
  std::vector<float> errors;
  for (const auto& [image, unused] : set.pairs) {
    std::vector<LiftKeypoint> found = FindBlobs(image);
    found.resize(std::min(found.size(), kKeypointsPerImage));
    AppendErrors(image, found, turn_deg, networks, errors);
  }
  if (errors.empty()) return "-";
  return fmt::format("{:.1f} ({:.0f}, {:.0f})", Quantile(errors, 0.5), PercentBelow(errors, 10.0F),
                     PercentBelow(errors, 20.0F));
}

}  // namespace

std::string OrientationTable(std::span<const NamedWeights> all, std::span<const ImageSet> sets,
                             const QualityOptions& options) {
  std::vector<std::string> names{"median error, degrees (below 10, 20: %)"};
  for (const ImageSet& set : sets) {
    for (const double turn : kTurnsDeg) names.push_back(fmt::format("{}, {:g}°", set.name, turn));
  }
  std::string table = Header(names);
  for (const auto& [name, weights] : all) {
    if (!weights.orientation) continue;
    LiftNetworks networks(weights, {.num_threads = options.num_threads});
    std::vector<std::string> cells{name};
    for (const ImageSet& set : sets) {
      for (const double turn : kTurnsDeg) cells.push_back(Cell(set, turn, networks));
    }
    table += RowShown(cells);
  }
  return table;
}

}  // namespace lift_slam
