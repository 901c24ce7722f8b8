#include "lift_slam/datasets/kitti_calibration.h"

#include <fmt/format.h>

#include <cctype>

#include "lift_slam/datasets/camera_formats.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

const TableRow* FindRow(const std::vector<TableRow>& rows, std::string_view name) {
  for (const TableRow& row : rows) {
    if (row[0] == name) return &row;
  }
  return nullptr;
}

std::vector<double> RowNumbers(const TableRow& row, std::size_t count) {
  if (row.size() != count + 1) row.Fail(fmt::format("{} numbers after '{}'", count, row[0]));
  return row.Numbers(1, count);
}

char CameraDigit(std::string_view camera_name) {
  const bool has =
      !camera_name.empty() && std::isdigit(static_cast<unsigned char>(camera_name.back()));
  return has ? camera_name.back() : '0';
}

void ReadSize(const std::vector<TableRow>& rows, const std::string& name, Camera& camera) {
  const TableRow* row = FindRow(rows, name);
  if (row == nullptr) return;
  camera.pinhole.width = row->SizePx(1);
  camera.pinhole.height = row->SizePx(2);
}

const TableRow& RequireRow(const std::vector<TableRow>& rows, const std::string& name,
                           const std::filesystem::path& path) {
  const TableRow* row = FindRow(rows, name);
  if (row == nullptr) {
    throw InputError(fmt::format("{}: there is no line '{}'", path.string(), name));
  }
  return *row;
}

}  // namespace

std::optional<std::string> FindKittiProjectionRow(const std::vector<TableRow>& rows,
                                                  std::string_view camera_name) {
  const char digit = CameraDigit(camera_name);
  for (const std::string& name : {fmt::format("P{}:", digit), fmt::format("P_rect_0{}:", digit)}) {
    if (FindRow(rows, name) != nullptr) return name;
  }
  return std::nullopt;
}

KittiProjection ReadKittiProjection(const std::filesystem::path& path,
                                    const std::string& row_name) {
  const std::vector<TableRow> rows = ReadTable(path);
  const TableRow& row = RequireRow(rows, row_name, path);
  const std::vector<double> p = RowNumbers(row, 12);
  if (!(p[0] > 0.0 && p[5] > 0.0) || p[10] != 1.0 || p[1] != 0.0) {
    row.Fail("a projection matrix fx 0 cx . 0 fy cy . 0 0 1 .");
  }
  KittiProjection projection;
  projection.camera.pinhole = {p[0], p[5], p[2], p[6], 0, 0};
  projection.camera.source = path.string();
  const double z = p[11];
  projection.offset = {(p[3] - p[2] * z) / p[0], (p[7] - p[6] * z) / p[5], z};
  if (row_name.starts_with("P_rect_")) {
    ReadSize(rows, "S_rect_" + row_name.substr(7), projection.camera);
  }
  return projection;
}

Camera ReadKittiUnrectified(const std::filesystem::path& path, std::string_view camera_name) {
  const std::vector<TableRow> rows = ReadTable(path);
  const std::string suffix = fmt::format("_0{}:", CameraDigit(camera_name));
  const std::vector<double> k = RowNumbers(RequireRow(rows, "K" + suffix, path), 9);
  Camera camera;
  camera.pinhole = {k[0], k[4], k[2], k[5], 0, 0};
  camera.distortion = MakeRadialTangential(RowNumbers(RequireRow(rows, "D" + suffix, path), 5));
  camera.source = path.string();
  ReadSize(rows, "S" + suffix, camera);
  return camera;
}

}  // namespace lift_slam
