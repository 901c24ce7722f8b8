#include "lift_slam/datasets/rig_transform.h"

#include <string>

#include "lift_slam/datasets/keyed_file.h"

namespace lift_slam {
namespace {

using RowMajor4d = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

Rigid3d ReadTransform(const KeyedFile& file, const std::string& key) {
  const std::vector<double> values = file.Numbers(key, 16);
  const Eigen::Matrix4d matrix = Eigen::Map<const RowMajor4d>(values.data());
  const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>();
  const double error = (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm();
  const bool last_row = matrix.row(3) == Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0);
  if (error > 1e-3 || rotation.determinant() < 0.0 || !last_row) {
    file.Fail(key, "a 4x4 rigid transform");
  }
  return {rotation, Eigen::Vector3d(matrix.topRightCorner<3, 1>())};
}

}  // namespace

std::optional<Rigid3d> ReadBodyFromCamera(const std::filesystem::path& path,
                                          std::string_view camera_name) {
  if (path.extension() != ".yaml" && path.extension() != ".yml") return std::nullopt;
  const KeyedFile file = KeyedFile::ReadYaml(path);
  for (const char* key : {"T_BS/data", "Tbc/data", "IMU.T_b_c1/data"}) {
    if (file.Has(key)) return ReadTransform(file, key);
  }
  const std::string kalibr = std::string(camera_name) + "/T_cam_imu";
  if (file.Has(kalibr)) return Inverse(ReadTransform(file, kalibr));
  return std::nullopt;
}

}  // namespace lift_slam
