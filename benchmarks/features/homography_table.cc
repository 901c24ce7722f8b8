#include "benchmarks/features/homography_table.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "benchmarks/features/extractor_variants.h"
#include "benchmarks/features/markdown_table.h"
#include "lift_slam/features/brute_force_matcher.h"
#include "lift_slam/features/lift/measurement/keypoint_pairs.h"
#include "lift_slam/features/lift/patch_sampling.h"
#include "lift_slam/image/gamma.h"

namespace lift_slam {
namespace {

constexpr double kNearPx = 3.0;
constexpr std::array<double, 6> kThresholdsPx = {1, 2, 3, 5, 7, 10};

struct Change {
  const char* name;
  double turn_deg = 0.0, scale = 1.0;
  double slant = 0.0;  // change of scale from the image's middle to its right end
  double gamma = 1.0, blur_px = 0.0;
};

const Change kChanges[] = {
    {.name = "γ 0.25", .gamma = 0.25},        {.name = "γ 4", .gamma = 4.0},
    {.name = "blur 2 px", .blur_px = 2.0},    {.name = "turned 20°", .turn_deg = 20.0},
    {.name = "turned 90°", .turn_deg = 90.0}, {.name = "scale 0.67", .scale = 0.67},
    {.name = "slant 0.4", .slant = 0.4},
};

Eigen::Matrix3d HomographyOf(const Change& change, const GrayImage& image) {
  const double half_width = 0.5 * image.width(), half_height = 0.5 * image.height();
  const double angle = change.turn_deg * std::numbers::pi / 180.0;
  const double c = change.scale * std::cos(angle), s = change.scale * std::sin(angle);
  Eigen::Matrix3d to_middle, about_middle;
  to_middle << 1, 0, -half_width, 0, 1, -half_height, 0, 0, 1;
  about_middle << c, -s, 0, s, c, 0, change.slant / half_width, 0, 1;
  return to_middle.inverse() * about_middle * to_middle;
}

GrayImage Changed(const GrayImage& image, const Change& change, const Eigen::Matrix3d& homography) {
  Random random(9);
  GrayImage changed =
      ApplyGamma(WarpedCopy(image, homography, {.max_gamma = 1.0}, random), change.gamma);
  if (change.blur_px <= 0.0) return changed;
  cv::Mat blurred;
  cv::GaussianBlur(changed.mat(), blurred, {}, change.blur_px);
  return GrayImage(blurred);
}

struct Figures {
  double repeatability = 0.0, matching_score = 0.0, homographies = 0.0;
  std::array<double, kThresholdsPx.size()> accuracy{};
  int images = 0;

  void Add(const Figures& other) {
    repeatability += other.repeatability;
    matching_score += other.matching_score;
    homographies += other.homographies;
    for (std::size_t i = 0; i < accuracy.size(); ++i) accuracy[i] += other.accuracy[i];
    images += other.images;
  }
};

Eigen::Vector2d Mapped(const Eigen::Matrix3d& homography, double x, double y) {
  return (homography * Eigen::Vector3d(x, y, 1.0)).hnormalized();
}

// Whether the homography that the matches give moves the corners to where they belong.
bool FindsHomography(const std::vector<cv::Point2f>& a, const std::vector<cv::Point2f>& b,
                     const GrayImage& image, const Eigen::Matrix3d& truth) {
  if (a.size() < 4) return false;
  const cv::Mat found = cv::findHomography(a, b, cv::RANSAC, kNearPx);
  if (found.empty()) return false;
  const Eigen::Matrix3d homography =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(found.ptr<double>());
  double sum = 0.0;
  for (const double x : {0.0, image.width() - 1.0}) {
    for (const double y : {0.0, image.height() - 1.0}) {
      sum += (Mapped(homography, x, y) - Mapped(truth, x, y)).norm() / 4.0;
    }
  }
  return sum < kNearPx;
}

std::vector<Eigen::Vector2d> Places(const FeatureSet& features) {
  std::vector<Eigen::Vector2d> places;
  for (const Keypoint& k : features.keypoints) places.emplace_back(k.x, k.y);
  return places;
}

double Ratio(double part, double whole) { return whole > 0.0 ? part / whole : 0.0; }

Figures Compare(const GrayImage& image, const Change& change, const FeatureSet& a,
                FeatureExtractor& extractor) {
  const Eigen::Matrix3d truth = HomographyOf(change, image);
  const GrayImage changed = Changed(image, change, truth);
  const FeatureSet b = extractor.Extract(changed);
  const std::vector<Eigen::Vector2d> in_a = Places(a), in_b = Places(b);
  double visible = 0.0, found = 0.0;
  for (const Eigen::Vector2d& place : in_a) {
    const Eigen::Vector2d there = Mapped(truth, place.x(), place.y());
    if (!LiesWithin(changed, there.x(), there.y(), 0.0)) continue;
    ++visible;
    found += std::ranges::any_of(
        in_b, [&](const Eigen::Vector2d& other) { return (other - there).norm() < kNearPx; });
  }
  std::vector<cv::Point2f> matched_a, matched_b;
  std::array<double, kThresholdsPx.size()> near{};
  double right = 0.0;
  for (const DescriptorMatch& match : MatchMutualNearest(a.descriptors, b.descriptors, 1.0F)) {
    const Eigen::Vector2d& from = in_a[static_cast<std::size_t>(match.a)];
    const Eigen::Vector2d& to = in_b[static_cast<std::size_t>(match.b)];
    const double error = (Mapped(truth, from.x(), from.y()) - to).norm();
    for (std::size_t i = 0; i < near.size(); ++i) near[i] += error < kThresholdsPx[i] ? 1.0 : 0.0;
    right += error < kNearPx ? 1.0 : 0.0;
    matched_a.emplace_back(static_cast<float>(from.x()), static_cast<float>(from.y()));
    matched_b.emplace_back(static_cast<float>(to.x()), static_cast<float>(to.y()));
  }
  Figures figures{Ratio(found, visible), Ratio(right, visible), 0.0, {}, 1};
  figures.homographies = FindsHomography(matched_a, matched_b, image, truth) ? 1.0 : 0.0;
  for (std::size_t i = 0; i < near.size(); ++i) {
    figures.accuracy[i] = Ratio(near[i], static_cast<double>(matched_a.size()));
  }
  return figures;
}

// One sum for each change.
std::vector<Figures> Measure(std::span<const ImageSet> sets, FeatureExtractor& extractor) {
  std::vector<Figures> sums(std::size(kChanges));
  for (const ImageSet& set : sets) {
    for (const auto& [image, unused] : set.pairs) {
      const FeatureSet features = extractor.Extract(image);
      for (std::size_t i = 0; i < sums.size(); ++i) {
        sums[i].Add(Compare(image, kChanges[i], features, extractor));
      }
    }
  }
  return sums;
}

}  // namespace

std::string HomographyTables(std::span<const NamedWeights> all, std::span<const ImageSet> sets,
                             const QualityOptions& options, std::vector<AccuracyCurve>& curves) {
  std::vector<std::string> names{"repeatability / matching score / homography, %"};
  for (const Change& change : kChanges) names.emplace_back(change.name);
  std::string by_change = Header(names);
  names = {"matches within, %"};
  for (const double threshold : kThresholdsPx) names.push_back(fmt::format("{:g} px", threshold));
  std::string by_threshold = Header(names);
  for (const auto& [name, make] : Extractors(all, options)) {
    std::vector<std::string> cells{name}, accuracies{name};
    Figures total;
    for (const Figures& sum : Measure(sets, *make())) {
      const double share = 100.0 / std::max(1, sum.images);
      cells.push_back(fmt::format("{:.0f} / {:.0f} / {:.0f}", share * sum.repeatability,
                                  share * sum.matching_score, share * sum.homographies));
      total.Add(sum);
    }
    AccuracyCurve& curve = curves.emplace_back();
    curve = {name, {kThresholdsPx.begin(), kThresholdsPx.end()}, {}};
    for (const double accuracy : total.accuracy) {
      curve.percent.push_back(100.0 * accuracy / std::max(1, total.images));
      accuracies.push_back(fmt::format("{:.1f}", curve.percent.back()));
    }
    by_change += RowShown(cells);
    by_threshold += RowShown(accuracies);
  }
  return by_change + "\n" + by_threshold;
}

}  // namespace lift_slam
