#include "lift_slam/datasets/ground_truth.h"

#include <fmt/format.h>

#include <cmath>

#include "lift_slam/datasets/decimal.h"
#include "lift_slam/datasets/text_table.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

constexpr double kMaxNormError = 1e-3;
constexpr std::int64_t kNsPerSecond = 1'000'000'000;
// Seconds beyond this would be the year 33658: the file counts nanoseconds.
constexpr std::int64_t kMaxPlausibleSeconds = 1'000'000'000'000;

Rigid3d MakePose(const TableRow& row, const Eigen::Vector3d& position,
                 const Eigen::Quaterniond& rotation) {
  if (std::abs(rotation.norm() - 1.0) > kMaxNormError) {
    row.Fail(fmt::format("a unit quaternion (norm {:.6g})", rotation.norm()));
  }
  return {rotation, position};
}

Rigid3d MakePose(const TableRow& row, std::span<const double> m) {
  const Eigen::Matrix<double, 3, 4, Eigen::RowMajor> matrix =
      Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(m.data());
  const Eigen::Matrix3d rotation = matrix.leftCols<3>();
  const double error = (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm();
  if (error > 1e-2 || rotation.determinant() < 0.0) row.Fail("a 3x4 matrix with a rotation in it");
  return {rotation, Eigen::Vector3d(matrix.col(3))};
}

void SortByTime(Trajectory& poses) {
  std::stable_sort(poses.begin(), poses.end(),
                   [](const auto& a, const auto& b) { return a.timestamp_ns < b.timestamp_ns; });
}

void RequirePoses(const Trajectory& poses, const std::filesystem::path& path) {
  if (poses.empty()) throw InputError(fmt::format("{}: holds no pose", path.string()));
}

bool HasNan(const TableRow& row) {
  return std::any_of(row.fields().begin(), row.fields().end(), [](const std::string& text) {
    const auto value = ParseDouble(text);
    return value && std::isnan(*value);
  });
}

bool CountsNanoseconds(const TableRow& row) {
  const auto whole = ParseScaledDecimal(row[0], 0);
  return whole && *whole > kMaxPlausibleSeconds;
}

}  // namespace

Trajectory ReadTumPoses(const std::filesystem::path& path, InvalidRows invalid_rows,
                        std::vector<std::string>* warnings) {
  const std::vector<TableRow> rows = ReadTable(path);
  const bool in_ns = !rows.empty() && CountsNanoseconds(rows.front());
  if (in_ns && warnings != nullptr) {
    warnings->push_back(fmt::format(
        "{}: its times are too large for seconds and were read as nanoseconds", path.string()));
  }
  Trajectory poses;
  for (const TableRow& row : rows) {
    if (row.size() != 8) row.Fail("8 numbers: t tx ty tz qx qy qz qw");
    if (invalid_rows == InvalidRows::kSkip && HasNan(row)) continue;
    const std::vector<double> v = row.Numbers(1, 7);
    TrajectoryPose pose;
    pose.timestamp_ns = in_ns ? row.Index(0) : row.SecondsAsNs(0);
    pose.world_from_cam = MakePose(row, Eigen::Vector3d(v[0], v[1], v[2]),
                                   Eigen::Quaterniond(v[6], v[3], v[4], v[5]));
    poses.push_back(pose);
  }
  RequirePoses(poses, path);
  SortByTime(poses);
  return poses;
}

Trajectory ReadKittiPoses(const std::filesystem::path& path) {
  Trajectory poses;
  for (const TableRow& row : ReadTable(path)) {
    if (row.size() != 12 && row.size() != 13) row.Fail("12 numbers (3x4 matrix), or 13 with index");
    TrajectoryPose pose;
    const bool indexed = row.size() == 13;
    pose.frame_index = indexed ? row.Index(0) : static_cast<std::int64_t>(poses.size());
    if (!poses.empty() && pose.frame_index <= poses.back().frame_index) {
      row.Fail("frame indices that increase");
    }
    pose.world_from_cam = MakePose(row, row.Numbers(indexed ? 1 : 0, 12));
    poses.push_back(pose);
  }
  RequirePoses(poses, path);
  return poses;
}

Trajectory ReadEurocPoses(const std::filesystem::path& path) {
  Trajectory poses;
  for (const TableRow& row : ReadTable(path)) {
    if (row.size() < 8) row.Fail("at least 8 numbers: t[ns], px, py, pz, qw, qx, qy, qz");
    const std::vector<double> v = row.Numbers(1, 7);
    TrajectoryPose pose;
    pose.timestamp_ns = row.Index(0);
    pose.world_from_cam = MakePose(row, Eigen::Vector3d(v[0], v[1], v[2]),
                                   Eigen::Quaterniond(v[3], v[4], v[5], v[6]));
    poses.push_back(pose);
  }
  RequirePoses(poses, path);
  SortByTime(poses);
  return poses;
}

PoseFileKind DetectPoseFile(const std::filesystem::path& path) {
  const std::vector<TableRow> rows = ReadTable(path);
  if (rows.empty()) throw InputError(fmt::format("{}: holds no pose", path.string()));
  const TableRow& row = rows.front();
  if (path.extension() == ".csv" && row.size() >= 8) return PoseFileKind::kEuroc;
  if (row.size() == 8) return PoseFileKind::kTum;
  if (row.size() == 12 || row.size() == 13) return PoseFileKind::kKitti;
  row.Fail("8 numbers (TUM), 12 or 13 (KITTI) or a csv file (EuRoC)");
}

Trajectory TransformBody(const Trajectory& poses, const Rigid3d& body_from_cam) {
  Trajectory result = poses;
  for (TrajectoryPose& pose : result) pose.world_from_cam = pose.world_from_cam * body_from_cam;
  return result;
}

std::optional<std::string> DescribeMissingOverlap(const Trajectory& truth,
                                                  std::int64_t first_frame_ns,
                                                  std::int64_t last_frame_ns) {
  const std::int64_t begin = truth.front().timestamp_ns, end = truth.back().timestamp_ns;
  if (begin <= last_frame_ns && end >= first_frame_ns) return std::nullopt;
  const auto seconds = [](std::int64_t ns) {
    return fmt::format("{}.{:09}", ns / kNsPerSecond, std::abs(ns % kNsPerSecond));
  };
  std::string text =
      fmt::format("the poses cover {} s to {} s and the images {} s to {} s", seconds(begin),
                  seconds(end), seconds(first_frame_ns), seconds(last_frame_ns));
  const double ratio = (std::abs(static_cast<double>(end)) + 1.0) /
                       (std::abs(static_cast<double>(last_frame_ns)) + 1.0);
  if (ratio > 1e6 || ratio < 1e-6) text += "; are seconds and nanoseconds mixed up?";
  return text;
}

}  // namespace lift_slam
