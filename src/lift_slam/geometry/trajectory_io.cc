#include "lift_slam/geometry/trajectory_io.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "lift_slam/geometry/timestamp_text.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/number_text.h"

namespace lift_slam {
namespace {

constexpr std::int64_t kNominalFrameNs = 100'000'000;  // KITTI: 10 Hz
// A stamp above this is in nanoseconds: as seconds it would be 30,000 years.
constexpr double kLeastNanosecondStamp = 1e12;
constexpr double kMaxRotationNormError = 1e-3;
constexpr std::string_view kSeparators = " \t,";

// The columns of one line with what an error message needs.
struct Row {
  const std::filesystem::path& path;
  std::size_t line = 0;  // from 1
  std::vector<std::string_view> columns;
  bool has_comma = false;

  [[noreturn]] void Fail(const std::string& message) const {
    throw InputError(fmt::format("{}:{}: {}", path.string(), line, message));
  }
};

std::vector<std::string_view> SplitColumns(std::string_view text) {
  std::vector<std::string_view> columns;
  for (std::size_t end = 0;;) {
    const std::size_t begin = text.find_first_not_of(kSeparators, end);
    if (begin == std::string_view::npos) return columns;
    end = std::min(text.find_first_of(kSeparators, begin), text.size());
    columns.push_back(text.substr(begin, end - begin));
  }
}

// All lines with columns; comment lines and empty lines at the end are left out.
std::vector<Row> SplitRows(const std::filesystem::path& path,
                           const std::vector<std::string>& lines) {
  std::vector<Row> rows;
  std::size_t empty_line = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    Row row{path, i + 1, SplitColumns(lines[i]), lines[i].find(',') != std::string::npos};
    if (row.columns.empty()) {
      if (empty_line == 0) empty_line = i + 1;
      continue;
    }
    if (row.columns.front().starts_with('#')) continue;
    // In KITTI files of poses and of times a line is a frame: an empty line would shift all that
    // follow.
    const bool line_is_frame = row.columns.size() == 12 || row.columns.size() == 1;
    if (empty_line != 0 && line_is_frame && !row.has_comma) {
      row.line = empty_line;
      row.Fail("empty line between poses or times; each line of a KITTI file is one frame");
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

double ParseNumber(const Row& row, std::size_t column) {
  const std::optional<double> value = ParseDouble(row.columns[column]);
  if (!value) {
    row.Fail(fmt::format("column {} is '{}', expected a number", column + 1, row.columns[column]));
  }
  if (!std::isfinite(*value)) {
    row.Fail(
        fmt::format("column {} is {}, expected a finite number", column + 1, row.columns[column]));
  }
  return *value;
}

void CheckColumns(const Row& row, std::size_t expected, TrajectoryFormat format) {
  const bool more_allowed = format == TrajectoryFormat::kEurocCsv;
  if (row.columns.size() == expected || (more_allowed && row.columns.size() > expected)) return;
  row.Fail(fmt::format("{} columns, expected {}{} for format {}", row.columns.size(), expected,
                       more_allowed ? " or more" : "", Name(format)));
}

// Squares of what is larger lose all else.
constexpr double kMaxCoordinate = 1e12;

void CheckPosition(const Row& row, const Eigen::Vector3d& position) {
  if (position.cwiseAbs().maxCoeff() > kMaxCoordinate) {
    row.Fail(fmt::format("the position ({:g}, {:g}, {:g}) is out of range, expected metres",
                         position.x(), position.y(), position.z()));
  }
}

enum class QuaternionOrder { kXyzw, kWxyz };

// Columns 1 to 7: position and quaternion.
Rigid3d ParseQuaternionPose(const Row& row, QuaternionOrder order) {
  double v[7];
  for (std::size_t i = 0; i < 7; ++i) v[i] = ParseNumber(row, i + 1);
  const Eigen::Quaterniond rotation = order == QuaternionOrder::kXyzw
                                          ? Eigen::Quaterniond(v[6], v[3], v[4], v[5])
                                          : Eigen::Quaterniond(v[3], v[4], v[5], v[6]);
  if (std::abs(rotation.norm() - 1.0) > kMaxRotationNormError) {
    row.Fail(fmt::format("the quaternion has norm {:.6f}, expected 1", rotation.norm()));
  }
  const Eigen::Vector3d position(v[0], v[1], v[2]);
  CheckPosition(row, position);
  return {rotation, position};
}

// 12 columns from `first`: the rows of [R t].
Rigid3d ParseMatrixPose(const Row& row, std::size_t first) {
  Eigen::Matrix3d rotation;
  Eigen::Vector3d translation;
  for (std::size_t i = 0; i < 12; ++i) {
    const auto r = static_cast<Eigen::Index>(i / 4);
    const auto c = static_cast<Eigen::Index>(i % 4);
    (c < 3 ? rotation(r, c) : translation(r)) = ParseNumber(row, first + i);
  }
  CheckPosition(row, translation);
  const Eigen::Matrix3d excess = rotation * rotation.transpose() - Eigen::Matrix3d::Identity();
  if (excess.cwiseAbs().maxCoeff() > 2.0 * kMaxRotationNormError || rotation.determinant() < 0.0) {
    row.Fail("the 3x3 block is no rotation matrix (orthonormal, determinant 1)");
  }
  // The nearest rotation: files hold six or seven digits, which matters over
  // segments of hundreds of metres.
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(rotation, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {Eigen::Matrix3d(svd.matrixU() * svd.matrixV().transpose()), translation};
}

bool LooksLikeNanoseconds(const Row& row) { return ParseNumber(row, 0) > kLeastNanosecondStamp; }

bool HasNan(const Row& row) {
  return std::any_of(row.columns.begin(), row.columns.end(), [](std::string_view text) {
    const std::optional<double> value = ParseDouble(text);
    return value && std::isnan(*value);
  });
}

std::int64_t ParseStamp(const Row& row, bool nanoseconds) {
  const std::string_view text = row.columns[0];
  // Comma-separated files count nanoseconds, from 0 in some: any whole number will do there.
  const bool is_count = nanoseconds && row.has_comma && ParseIndex(text);
  if (!is_count && LooksLikeNanoseconds(row) != nanoseconds) {
    row.Fail(fmt::format(
        "timestamp {} looks like {}, expected {} as in the format or the line "
        "before",
        text, nanoseconds ? "seconds" : "nanoseconds", nanoseconds ? "nanoseconds" : "seconds"));
  }
  const auto stamp = nanoseconds ? ParseNanoseconds(text) : ParseSeconds(text);
  if (!stamp) row.Fail(fmt::format("timestamp {} does not fit into 64-bit nanoseconds", text));
  return *stamp;
}

Trajectory ParseStamped(const std::vector<Row>& rows, TrajectoryFormat format, bool nanoseconds,
                        NanRows nan_rows) {
  const auto order =
      format == TrajectoryFormat::kEurocCsv ? QuaternionOrder::kWxyz : QuaternionOrder::kXyzw;
  Trajectory trajectory;
  for (const Row& row : rows) {
    CheckColumns(row, 8, format);
    if (nan_rows == NanRows::kSkip && HasNan(row)) continue;
    TrajectoryPose& pose = trajectory.emplace_back();
    pose.timestamp_ns = ParseStamp(row, nanoseconds);
    pose.world_from_cam = ParseQuaternionPose(row, order);
  }
  return trajectory;
}

std::int64_t ParseFrameIndex(const Row& row, std::int64_t previous) {
  const std::optional<std::int64_t> index = ParseNanoseconds(row.columns[0]);
  if (!index || *index <= previous || *index > INT32_MAX ||
      ParseNumber(row, 0) != static_cast<double>(*index)) {
    row.Fail(fmt::format("frame index '{}', expected a whole number above {}", row.columns[0],
                         previous));
  }
  return *index;
}

Trajectory ParseKitti(const std::vector<Row>& rows, TrajectoryFormat format) {
  const bool indexed = format == TrajectoryFormat::kKittiIndexed;
  Trajectory trajectory;
  for (const Row& row : rows) {
    CheckColumns(row, indexed ? 13 : 12, format);
    const std::int64_t previous = trajectory.empty() ? -1 : trajectory.back().frame_index;
    TrajectoryPose pose;
    pose.frame_index = indexed ? ParseFrameIndex(row, previous) : previous + 1;
    pose.timestamp_ns = pose.frame_index * kNominalFrameNs;
    pose.world_from_cam = ParseMatrixPose(row, indexed ? 1 : 0);
    trajectory.push_back(pose);
  }
  return trajectory;
}

// Makes the stamps strictly increasing; real recordings and systems break this now and then.
void SortByTime(const std::filesystem::path& path, TrajectoryFile& file) {
  Trajectory& poses = file.trajectory;
  const auto earlier = [](const TrajectoryPose& a, const TrajectoryPose& b) {
    return a.timestamp_ns < b.timestamp_ns;
  };
  if (!std::is_sorted(poses.begin(), poses.end(), earlier)) {
    std::stable_sort(poses.begin(), poses.end(), earlier);
    file.warnings.push_back(fmt::format("{}: poses out of time order were sorted", path.string()));
  }
  const auto same = [](const TrajectoryPose& a, const TrajectoryPose& b) {
    return a.timestamp_ns == b.timestamp_ns;
  };
  const auto first_dropped = std::unique(poses.begin(), poses.end(), same);
  if (first_dropped == poses.end()) return;
  file.warnings.push_back(
      fmt::format("{}: {} pose(s) repeat a timestamp; the first of each was kept", path.string(),
                  poses.end() - first_dropped));
  poses.erase(first_dropped, poses.end());
}

TrajectoryFormat FormatOf(const Row& row) {
  if (row.has_comma) return TrajectoryFormat::kEurocCsv;
  switch (row.columns.size()) {
    case 8:
      return LooksLikeNanoseconds(row) ? TrajectoryFormat::kEurocResult : TrajectoryFormat::kTum;
    case 12:
      return TrajectoryFormat::kKitti;
    case 13:
      return TrajectoryFormat::kKittiIndexed;
    default:
      row.Fail(
          fmt::format("{} columns, expected 8 (TUM, EuRoC result), 12 (KITTI), 13 (KITTI with "
                      "frame index) or comma-separated EuRoC ground truth",
                      row.columns.size()));
  }
}

void WriteMatrix(const Rigid3d& pose, std::ostream& stream) {
  const Eigen::Matrix3d rotation = pose.RotationMatrix();
  for (Eigen::Index r = 0; r < 3; ++r) {
    stream << fmt::format("{}{:.12e} {:.12e} {:.12e} {:.12e}", r == 0 ? "" : " ", rotation(r, 0),
                          rotation(r, 1), rotation(r, 2), pose.translation(r));
  }
  stream << '\n';
}

bool HasEveryFrame(const Trajectory& trajectory) {
  std::int64_t expected = 0;
  return std::all_of(trajectory.begin(), trajectory.end(), [&](const TrajectoryPose& pose) {
    return pose.state == PoseState::kOk && pose.frame_index == expected++;
  });
}

void WriteKitti(const Trajectory& trajectory, bool indexed, std::ostream& stream) {
  for (const TrajectoryPose& pose : trajectory) {
    if (pose.state != PoseState::kOk) continue;
    if (pose.frame_index < 0) {
      throw InputError("KITTI trajectories need the frame index of each pose, which is unknown");
    }
    if (indexed) stream << pose.frame_index << ' ';
    WriteMatrix(pose.world_from_cam, stream);
  }
}

void WriteStamped(const Trajectory& trajectory, TrajectoryFormat format, std::ostream& stream) {
  const bool csv = format == TrajectoryFormat::kEurocCsv;
  if (csv) stream << "#timestamp [ns],p_x [m],p_y [m],p_z [m],q_w [],q_x [],q_y [],q_z []\n";
  if (format == TrajectoryFormat::kTum) stream << "# timestamp_s tx ty tz qx qy qz qw\n";
  for (const TrajectoryPose& pose : trajectory) {
    if (pose.state != PoseState::kOk) continue;
    const Eigen::Vector3d& p = pose.world_from_cam.translation;
    const Eigen::Quaterniond& q = pose.world_from_cam.rotation;
    const std::string stamp = format == TrajectoryFormat::kTum ? FormatSeconds(pose.timestamp_ns)
                                                               : std::to_string(pose.timestamp_ns);
    if (csv) {
      stream << fmt::format("{},{:.12f},{:.12f},{:.12f},{:.12f},{:.12f},{:.12f},{:.12f}\n", stamp,
                            p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z());
    } else {
      stream << fmt::format("{} {:.12f} {:.12f} {:.12f} {:.12f} {:.12f} {:.12f} {:.12f}\n", stamp,
                            p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w());
    }
  }
}

}  // namespace

std::string_view Name(TrajectoryFormat format) {
  switch (format) {
    case TrajectoryFormat::kTum:
      return "tum";
    case TrajectoryFormat::kKitti:
      return "kitti";
    case TrajectoryFormat::kKittiIndexed:
      return "kitti_indexed";
    case TrajectoryFormat::kEurocCsv:
      return "euroc_csv";
    case TrajectoryFormat::kEurocResult:
      return "euroc_result";
  }
  return "unknown";
}

std::optional<TrajectoryFormat> DetectTrajectoryFormat(const std::filesystem::path& path) {
  const std::vector<std::string> lines = ReadLines(path);
  const std::vector<Row> rows = SplitRows(path, lines);
  if (rows.empty()) return std::nullopt;
  return FormatOf(rows.front());
}

TrajectoryFile ReadTrajectory(const std::filesystem::path& path,
                              std::optional<TrajectoryFormat> format, NanRows nan_rows) {
  const std::vector<std::string> lines = ReadLines(path);
  const std::vector<Row> rows = SplitRows(path, lines);
  TrajectoryFile file;
  file.format = format.value_or(TrajectoryFormat::kTum);
  if (rows.empty()) {
    file.warnings.push_back(fmt::format("{}: the file holds no pose", path.string()));
    return file;
  }
  if (!format) file.format = FormatOf(rows.front());
  if (IsKitti(file.format)) {
    file.trajectory = ParseKitti(rows, file.format);
    file.nominal_timestamps = true;
    return file;
  }
  bool nanoseconds = file.format == TrajectoryFormat::kEurocCsv;
  if (file.format == TrajectoryFormat::kEurocResult) {
    nanoseconds = LooksLikeNanoseconds(rows.front());
    file.warnings.push_back(
        fmt::format("{}: timestamps were taken for {}, judging by the first ({})", path.string(),
                    nanoseconds ? "nanoseconds" : "seconds", rows.front().columns[0]));
  }
  file.trajectory = ParseStamped(rows, file.format, nanoseconds, nan_rows);
  SortByTime(path, file);
  return file;
}

std::vector<std::int64_t> ReadTimestamps(const std::filesystem::path& path) {
  const std::vector<std::string> lines = ReadLines(path);
  std::vector<std::int64_t> stamps;
  for (const Row& row : SplitRows(path, lines)) {
    if (row.columns.size() != 1) {
      row.Fail(fmt::format("{} columns, expected one timestamp in seconds", row.columns.size()));
    }
    const std::int64_t stamp = ParseStamp(row, /*nanoseconds=*/false);
    if (!stamps.empty() && stamp <= stamps.back()) {
      row.Fail(fmt::format("timestamp {} is not after the one before", row.columns[0]));
    }
    stamps.push_back(stamp);
  }
  return stamps;
}

void WriteTrajectory(const Trajectory& trajectory, TrajectoryFormat format, std::ostream& stream) {
  switch (format) {
    case TrajectoryFormat::kKitti:
      return WriteKitti(trajectory, /*indexed=*/!HasEveryFrame(trajectory), stream);
    case TrajectoryFormat::kKittiIndexed:
      return WriteKitti(trajectory, /*indexed=*/true, stream);
    default:
      return WriteStamped(trajectory, format, stream);
  }
}

void WriteTrajectory(const Trajectory& trajectory, TrajectoryFormat format,
                     const std::filesystem::path& path) {
  WriteFileAtomically(path, [&](std::ostream& s) { WriteTrajectory(trajectory, format, s); });
}

}  // namespace lift_slam
