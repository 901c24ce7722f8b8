// Checks the ground truth of a rendered sequence by its pixels alone: relative poses from SIFT
// matches and the essential matrix against the poses written, and depth by warping each frame into
// the next; also how many corners there are. Usage: verify_ground_truth FOLDER [PAIRS]; FOLDER as
// `lift_slam render --depth` made it.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lift_slam/datasets/sequence.h"
#include "lift_slam/evaluation/error_statistics.h"
#include "lift_slam/geometry/trajectory_io.h"
#include "lift_slam/simulation/depth_file.h"
#include "lift_slam/simulation/sequence_folder.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/random.h"

namespace lift_slam {
namespace {

constexpr double kPairDistanceM = 1.0;

struct RenderedSequence {
  SequenceFolder folder;
  Camera camera;
  std::vector<GrayImage> images;
  std::vector<Rigid3d> world_from_cam;
};

RenderedSequence Load(const std::string& root) {
  RenderedSequence loaded{SequenceFolder(root), {}, {}, {}};
  const auto sequence = OpenSequence(loaded.folder.Sequence().string());
  loaded.camera = *sequence->info().camera;
  if (loaded.camera.HasDistortion())
    throw InputError(root + ": only for cameras without distortion");
  while (auto frame = sequence->Next()) {
    if (!frame->image) throw InputError(frame->problem_text);
    loaded.images.push_back(*frame->image);
  }
  for (const auto& pose : ReadTrajectory(loaded.folder.GroundTruth()).trajectory) {
    loaded.world_from_cam.push_back(pose.world_from_cam);
  }
  if (loaded.images.size() > loaded.world_from_cam.size()) {
    throw InputError(root + ": fewer poses than images");
  }
  return loaded;
}

// How much there is to see: FAST corners and the share of 64-pixel cells that hold one.
void CountCorners(const RenderedSequence& rendered) {
  constexpr int kCell = 64;
  std::vector<double> counts, shares;
  for (const GrayImage& image : rendered.images) {
    std::vector<cv::KeyPoint> corners;
    cv::FAST(image.mat(), corners, 20);
    const int columns = (image.width() + kCell - 1) / kCell;
    const int rows = (image.height() + kCell - 1) / kCell;
    std::vector<char> seen(static_cast<std::size_t>(columns * rows), 0);
    for (const cv::KeyPoint& corner : corners) {
      const int cell =
          static_cast<int>(corner.pt.y) / kCell * columns + static_cast<int>(corner.pt.x) / kCell;
      seen[static_cast<std::size_t>(cell)] = 1;
    }
    counts.push_back(static_cast<double>(corners.size()));
    shares.push_back(static_cast<double>(std::count(seen.begin(), seen.end(), 1)) /
                     static_cast<double>(seen.size()));
  }
  std::printf("corners: %zu frames, median %.0f FAST(20) corners, %.2f of the cells of 64 pixels\n",
              rendered.images.size(), Median(counts), Median(shares));
}

struct PoseError {
  double rotation_deg = 0.0;
  double direction_deg = 0.0;
  int inliers = 0;
};

double Degrees(double radians) { return radians * 180.0 / std::numbers::pi; }

double AngleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return Degrees(std::atan2(a.cross(b).norm(), a.dot(b)));
}

// Matches by SIFT with the ratio test.
void Match(const cv::Mat& a, const cv::Mat& b, std::vector<cv::Point2d>& in_a,
           std::vector<cv::Point2d>& in_b) {
  const auto sift = cv::SIFT::create(0, 3, 0.02);
  std::vector<cv::KeyPoint> keypoints_a, keypoints_b;
  cv::Mat descriptors_a, descriptors_b;
  sift->detectAndCompute(a, cv::noArray(), keypoints_a, descriptors_a);
  sift->detectAndCompute(b, cv::noArray(), keypoints_b, descriptors_b);
  if (keypoints_a.empty() || keypoints_b.size() < 2) return;
  std::vector<std::vector<cv::DMatch>> nearest;
  cv::FlannBasedMatcher().knnMatch(descriptors_a, descriptors_b, nearest, 2);
  for (const auto& two : nearest) {
    if (two.size() < 2 || two[0].distance > 0.75F * two[1].distance) continue;
    in_a.emplace_back(keypoints_a[static_cast<std::size_t>(two[0].queryIdx)].pt);
    in_b.emplace_back(keypoints_b[static_cast<std::size_t>(two[0].trainIdx)].pt);
  }
}

std::optional<PoseError> ErrorOfPair(const RenderedSequence& rendered, std::size_t i,
                                     std::size_t j) {
  std::vector<cv::Point2d> in_i, in_j;
  Match(rendered.images[i].mat(), rendered.images[j].mat(), in_i, in_j);
  if (in_i.size() < 20) return std::nullopt;
  const PinholeIntrinsics& pinhole = rendered.camera.pinhole;
  const cv::Matx33d k(pinhole.fx, 0, pinhole.cx, 0, pinhole.fy, pinhole.cy, 0, 0, 1);
  cv::setRNGSeed(1);
  cv::Mat inliers, rotation, translation;
  const cv::Mat essential =
      cv::findEssentialMat(in_i, in_j, k, cv::USAC_MAGSAC, 0.9999, 0.5, 5000, inliers);
  if (essential.rows != 3) return std::nullopt;
  PoseError error;
  error.inliers = cv::recoverPose(essential, in_i, in_j, k, rotation, translation, inliers);
  Eigen::Matrix3d measured_rotation;
  Eigen::Vector3d measured_direction;
  cv::cv2eigen(rotation, measured_rotation);
  cv::cv2eigen(translation, measured_direction);
  const Rigid3d truth = Inverse(rendered.world_from_cam[j]) * rendered.world_from_cam[i];
  const Eigen::AngleAxisd left(measured_rotation * truth.RotationMatrix().transpose());
  error.rotation_deg = Degrees(std::abs(left.angle()));
  error.direction_deg = AngleBetween(measured_direction, truth.translation);
  return error;
}

// The first frame at least the distance away from frame i; nothing when there is none.
std::optional<std::size_t> FrameAhead(const RenderedSequence& rendered, std::size_t i) {
  for (std::size_t j = i + 1; j < rendered.images.size(); ++j) {
    const double distance =
        (rendered.world_from_cam[j].translation - rendered.world_from_cam[i].translation).norm();
    if (distance >= kPairDistanceM - 0.05) return j;
  }
  return std::nullopt;
}

void CheckPoses(const RenderedSequence& rendered, int num_pairs) {
  Random random(1);
  std::vector<double> rotations, directions, inliers;
  int failed = 0;
  for (int pair = 0; pair < num_pairs; ++pair) {
    const std::size_t i = static_cast<std::size_t>(
        random.UniformInt(0, static_cast<int>(rendered.images.size()) - 1));
    const auto j = FrameAhead(rendered, i);
    if (!j) continue;
    const auto error = ErrorOfPair(rendered, i, *j);
    if (!error) {
      ++failed;
      continue;
    }
    rotations.push_back(error->rotation_deg);
    directions.push_back(error->direction_deg);
    inliers.push_back(error->inliers);
  }
  if (rotations.empty()) {
    std::printf("poses: no pair with enough matches\n");
    return;
  }
  std::printf(
      "poses: %zu pairs, %d without enough matches; median rotation error %.4f deg, "
      "direction error %.3f deg, %.0f inliers\n",
      rotations.size(), failed, Median(rotations), Median(directions), Median(inliers));
}

std::optional<DepthImage> DepthOf(const RenderedSequence& rendered, std::size_t frame) {
  for (const DepthFormat format : {DepthFormat::kTiff32, DepthFormat::kPng16}) {
    const auto path = rendered.folder.Depth(static_cast<int>(frame), format);
    if (std::filesystem::exists(path)) return ReadDepth(path);
  }
  return std::nullopt;
}

struct DepthErrors {
  std::vector<double> gray;      // absolute difference of the grey values
  std::vector<double> relative;  // |depth there - depth expected| / depth expected
};

// Every third pixel of frame i, moved by its depth into frame i + 1.
void CompareWarped(const RenderedSequence& rendered, std::size_t i, const DepthImage& here,
                   const DepthImage& there, DepthErrors& errors) {
  const PinholeIntrinsics& pinhole = rendered.camera.pinhole;
  const Rigid3d next_from_this =
      Inverse(rendered.world_from_cam[i + 1]) * rendered.world_from_cam[i];
  const GrayImage &image = rendered.images[i], &next = rendered.images[i + 1];
  for (int y = 1; y < here.height; y += 3) {
    for (int x = 1; x < here.width; x += 3) {
      const float depth = here.depth_m[static_cast<std::size_t>(y * here.width + x)];
      if (depth <= 0.0F) continue;
      const Eigen::Vector3d point((x - pinhole.cx) / pinhole.fx * depth,
                                  (y - pinhole.cy) / pinhole.fy * depth, depth);
      const Eigen::Vector3d moved = next_from_this * point;
      if (moved.z() < 0.5) continue;
      const Eigen::Vector2d pixel = pinhole.Project(moved);
      const int u = static_cast<int>(std::floor(pixel.x())),
                v = static_cast<int>(std::floor(pixel.y()));
      if (u < 0 || v < 0 || u + 1 >= there.width || v + 1 >= there.height) continue;
      const auto nearest =
          static_cast<std::size_t>(std::lround(pixel.y()) * there.width + std::lround(pixel.x()));
      if (there.depth_m[nearest] > 0.0F) {
        errors.relative.push_back(std::abs(there.depth_m[nearest] - moved.z()) / moved.z());
      }
      const double a = pixel.x() - u, b = pixel.y() - v;
      const double gray = (1 - b) * ((1 - a) * next.row(v)[u] + a * next.row(v)[u + 1]) +
                          b * ((1 - a) * next.row(v + 1)[u] + a * next.row(v + 1)[u + 1]);
      errors.gray.push_back(std::abs(gray - image.row(y)[x]));
    }
  }
}

void CheckDepth(const RenderedSequence& rendered) {
  DepthErrors errors;
  int pairs = 0;
  const std::size_t step = std::max<std::size_t>(1, rendered.images.size() / 40);
  for (std::size_t i = 0; i + 1 < rendered.images.size(); i += step) {
    const auto here = DepthOf(rendered, i), there = DepthOf(rendered, i + 1);
    if (!here || !there) continue;
    CompareWarped(rendered, i, *here, *there, errors);
    ++pairs;
  }
  if (errors.gray.empty() || errors.relative.empty()) {
    std::printf("depth: none stored\n");
    return;
  }
  std::printf(
      "depth: %d frames warped into the next; median difference %.2f grey levels, "
      "%.4f %% of the depth\n",
      pairs, Median(errors.gray), 100.0 * Median(errors.relative));
}

}  // namespace
}  // namespace lift_slam

int main(int argc, char** argv) {
  if (argc < 2 || argc > 3) {
    std::fprintf(stderr, "usage: verify_ground_truth FOLDER [PAIRS]\n");
    return 1;
  }
  try {
    const auto rendered = lift_slam::Load(argv[1]);
    lift_slam::CountCorners(rendered);
    lift_slam::CheckPoses(rendered, argc > 2 ? std::atoi(argv[2]) : 100);
    lift_slam::CheckDepth(rendered);
  } catch (const lift_slam::InputError& error) {
    std::fprintf(stderr, "verify_ground_truth: %s\n", error.what());
    return 1;
  }
  return 0;
}
