#include <fmt/format.h>

#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "lift_slam/testing/synthetic_sequence.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;

// EuRoC stamps are 19 digits long: a constant beyond double precision, as in the real data.
constexpr std::int64_t kEurocStartNs = 1403636579763555584;

// Body from camera: 90 degrees about z and a lever arm of about 7 cm.
Rigid3d BodyFromCam() {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ())),
          {-0.0216, -0.0647, 0.0098}};
}

using ImageWritten = std::function<void(int)>;

void WriteImage(const fs::path& path, const GrayImage& image) {
  bool written = false;
  try {
    written = cv::imwrite(path.string(), image.mat(), {cv::IMWRITE_PNG_COMPRESSION, 1});
  } catch (const cv::Exception&) {
    written = false;
  }
  if (!written) throw InputError(fmt::format("{}: cannot write image", path.string()));
}

// Row-major 3x4 matrix [R | t] in one line.
std::string MatrixLine(const Rigid3d& pose) {
  const Eigen::Matrix3d rotation = pose.RotationMatrix();
  std::string line;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      const double value = column < 3 ? rotation(row, column) : pose.translation[row];
      line += fmt::format("{}{:.12e}", row + column > 0 ? " " : "", value);
    }
  }
  return line;
}

WrittenSequence WriteKitti(const fs::path& root, const SyntheticSequence& sequence,
                           const ImageWritten& image_written) {
  const WrittenSequence written{root / "sequences" / "00", root / "poses" / "00.txt"};
  CreateFolder(written.folder / "image_0");
  CreateFolder(written.ground_truth.parent_path());
  const Rigid3d first_from_world = Inverse(sequence.WorldFromCam(0));
  std::string times, poses;
  for (int i = 0; i < sequence.size(); ++i) {
    WriteImage(written.folder / "image_0" / fmt::format("{:06d}.png", i), sequence.Render(i));
    image_written(i + 1);
    times += fmt::format("{:.6e}\n", static_cast<double>(sequence.TimestampNs(i)) * 1e-9);
    poses += MatrixLine(first_from_world * sequence.WorldFromCam(i)) + "\n";
  }
  const PinholeIntrinsics& camera = sequence.camera().pinhole;
  WriteTextAtomically(written.folder / "calib.txt",
                      fmt::format("P0: {:.12e} 0 {:.12e} 0 0 {:.12e} {:.12e} 0 0 0 1 0\n",
                                  camera.fx, camera.cx, camera.fy, camera.cy));
  WriteTextAtomically(written.folder / "times.txt", times);
  WriteTextAtomically(written.ground_truth, poses);
  return written;
}

// The distortion in OpenCV's order k1 k2 p1 p2 k3; InputError for other models.
RadialTangential DistortionOf(const Camera& camera, const char* layout) {
  if (std::holds_alternative<NoDistortion>(camera.distortion)) return {};
  if (const auto* model = std::get_if<RadialTangential>(&camera.distortion)) return *model;
  throw InputError(fmt::format("{}: the {} layout cannot hold the camera model {}", camera.source,
                               layout, camera.ModelName()));
}

std::string TumCameraYaml(const Camera& camera) {
  const RadialTangential d = DistortionOf(camera, "TUM");
  const PinholeIntrinsics& p = camera.pinhole;
  return fmt::format(
      "%YAML:1.0\nCamera.width: {}\nCamera.height: {}\nCamera.fx: {}\nCamera.fy: {}\n"
      "Camera.cx: {}\nCamera.cy: {}\nCamera.k1: {}\nCamera.k2: {}\nCamera.p1: {}\nCamera.p2: {}\n"
      "Camera.k3: {}\nCamera.fps: {}\n",
      p.width, p.height, p.fx, p.fy, p.cx, p.cy, d.k1, d.k2, d.p1, d.p2, d.k3,
      camera.frame_rate_hz);
}

WrittenSequence WriteTum(const fs::path& root, const SyntheticSequence& sequence,
                         const ImageWritten& image_written) {
  CreateFolder(root / "rgb");
  std::string images = "# color images\n# timestamp filename\n";
  std::string poses = "# ground truth trajectory\n# timestamp tx ty tz qx qy qz qw\n";
  const std::string camera = TumCameraYaml(sequence.camera());
  for (int i = 0; i < sequence.size(); ++i) {
    const std::int64_t ns = sequence.TimestampNs(i);
    const std::string time = fmt::format("{}.{:09d}", ns / 1000000000, ns % 1000000000);
    WriteImage(root / "rgb" / (time + ".png"), sequence.Render(i));
    image_written(i + 1);
    images += fmt::format("{0} rgb/{0}.png\n", time);
    const Rigid3d pose = sequence.WorldFromCam(i);
    const Eigen::Vector3d& t = pose.translation;
    const Eigen::Quaterniond& q = pose.rotation;
    poses += fmt::format("{} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f}\n", time, t.x(),
                         t.y(), t.z(), q.x(), q.y(), q.z(), q.w());
  }
  WriteTextAtomically(root / "rgb.txt", images);
  WriteTextAtomically(root / "groundtruth.txt", poses);
  WriteTextAtomically(root / "camera.yaml", camera);
  return {root, root / "groundtruth.txt"};
}

std::string EurocSensorYaml(const Camera& camera) {
  const RadialTangential d = DistortionOf(camera, "EuRoC");
  if (d.k3 != 0.0) {
    throw InputError(
        fmt::format("{}: the EuRoC layout has no k3, but it is {}", camera.source, d.k3));
  }
  Eigen::Matrix4d body_from_cam = Eigen::Matrix4d::Identity();
  body_from_cam.topLeftCorner<3, 3>() = BodyFromCam().RotationMatrix();
  body_from_cam.topRightCorner<3, 1>() = BodyFromCam().translation;
  std::string entries;
  for (int i = 0; i < 16; ++i) {
    entries += fmt::format("{}{:.12f}", i > 0 ? ", " : "", body_from_cam(i / 4, i % 4));
  }
  const PinholeIntrinsics& p = camera.pinhole;
  return fmt::format(
      "sensor_type: camera\ncomment: synthetic\nT_BS:\n  cols: 4\n  rows: 4\n  data: [{}]\n"
      "rate_hz: {}\nresolution: [{}, {}]\ncamera_model: pinhole\n"
      "intrinsics: [{}, {}, {}, {}] #fu, fv, cu, cv\ndistortion_model: radial-tangential\n"
      "distortion_coefficients: [{}, {}, {}, {}]\n",
      entries, camera.frame_rate_hz, p.width, p.height, p.fx, p.fy, p.cx, p.cy, d.k1, d.k2, d.p1,
      d.p2);
}

WrittenSequence WriteEuroc(const fs::path& root, const SyntheticSequence& sequence,
                           const ImageWritten& image_written) {
  const fs::path cam0 = root / "mav0" / "cam0";
  const fs::path truth = root / "mav0" / "state_groundtruth_estimate0";
  const std::string sensor = EurocSensorYaml(sequence.camera());
  CreateFolder(cam0 / "data");
  CreateFolder(truth);
  std::string images = "#timestamp [ns],filename\n";
  std::string poses =
      "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], "
      "q_RS_z []\n";
  for (int i = 0; i < sequence.size(); ++i) {
    const std::int64_t ns = kEurocStartNs + sequence.TimestampNs(i);
    WriteImage(cam0 / "data" / fmt::format("{}.png", ns), sequence.Render(i));
    image_written(i + 1);
    images += fmt::format("{0},{0}.png\n", ns);
    const Rigid3d body = sequence.WorldFromCam(i) * Inverse(BodyFromCam());
    const Eigen::Vector3d& t = body.translation;
    const Eigen::Quaterniond& q = body.rotation;
    poses += fmt::format("{},{:.9f},{:.9f},{:.9f},{:.9f},{:.9f},{:.9f},{:.9f}\n", ns, t.x(), t.y(),
                         t.z(), q.w(), q.x(), q.y(), q.z());
  }
  WriteTextAtomically(cam0 / "data.csv", images);
  WriteTextAtomically(cam0 / "sensor.yaml", sensor);
  WriteTextAtomically(truth / "data.csv", poses);
  return {root, truth / "data.csv"};
}

}  // namespace

WrittenSequence WriteSyntheticSequence(const fs::path& root, SequenceLayout layout,
                                       const SyntheticSequenceOptions& options,
                                       const ImageWritten& image_written) {
  const ImageWritten told = image_written ? image_written : ImageWritten([](int) {});
  const SyntheticSequence sequence(options);
  switch (layout) {
    case SequenceLayout::kKittiOdometry:
      if (sequence.camera().HasDistortion()) {
        throw InputError(fmt::format("{}: the KITTI layout cannot hold the camera model {}",
                                     sequence.camera().source, sequence.camera().ModelName()));
      }
      return WriteKitti(root, sequence, told);
    case SequenceLayout::kTumRgbd:
      return WriteTum(root, sequence, told);
    case SequenceLayout::kEuroc:
      return WriteEuroc(root, sequence, told);
  }
  throw InputError("unknown sequence layout");
}

}  // namespace lift_slam
