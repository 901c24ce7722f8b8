// The camera files that are lines of numbers: COLMAP and TUM-mono.
#include <fmt/format.h>

#include "lift_slam/datasets/camera_formats.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/number_text.h"

namespace lift_slam {
namespace {

constexpr double kCornerToCentrePx = 0.5;

// How the parameters of a COLMAP model are laid out after the size.
struct ColmapModel {
  std::string_view name;
  int num_focal_lengths;  // f, or fx and fy
  enum class Kind { kNone, kRadialTangential, kKannalaBrandt, kFov } kind;
  int num_coefficients;
};
using Kind = ColmapModel::Kind;
constexpr ColmapModel kColmapModels[] = {
    {"SIMPLE_PINHOLE", 1, Kind::kNone, 0},
    {"PINHOLE", 2, Kind::kNone, 0},
    {"SIMPLE_RADIAL", 1, Kind::kRadialTangential, 1},       // k
    {"RADIAL", 1, Kind::kRadialTangential, 2},              // k1 k2
    {"OPENCV", 2, Kind::kRadialTangential, 4},              // k1 k2 p1 p2
    {"FULL_OPENCV", 2, Kind::kRadialTangential, 8},         // k1 k2 p1 p2 k3 k4 k5 k6
    {"SIMPLE_RADIAL_FISHEYE", 1, Kind::kKannalaBrandt, 1},  // k
    {"RADIAL_FISHEYE", 1, Kind::kKannalaBrandt, 2},         // k1 k2
    {"OPENCV_FISHEYE", 2, Kind::kKannalaBrandt, 4},         // k1 k2 k3 k4
    {"FOV", 2, Kind::kFov, 1},                              // omega
    {"THIN_PRISM_FISHEYE", 2, Kind::kNone, -1},             // known, not supported
};

const ColmapModel* FindColmapModel(std::string_view name) {
  for (const ColmapModel& model : kColmapModels) {
    if (model.name == name) return &model;
  }
  return nullptr;
}

Distortion MakeColmapDistortion(const TableRow& row, const ColmapModel& model,
                                std::vector<double> values) {
  if (model.kind == Kind::kNone) return NoDistortion{};
  if (model.kind == Kind::kFov) return FieldOfView{values.front()};
  for (std::size_t i = 5; i < values.size(); ++i) {
    if (values[i] != 0.0) row.Fail("FULL_OPENCV with k4, k5 and k6 zero (no other is supported)");
  }
  values.resize(model.kind == Kind::kKannalaBrandt ? 4 : 5, 0.0);
  return model.kind == Kind::kKannalaBrandt ? MakeKannalaBrandt(values)
                                            : MakeRadialTangential(values);
}

bool IsNumber(std::string_view text) { return ParseDouble(text).has_value(); }

struct TumMonoLine {
  std::string model;           // "FOV", "Pinhole", "RadTan", "EquiDistant", "KannalaBrandt"
  std::vector<double> values;  // fx fy cx cy and the coefficients
};

TumMonoLine ReadTumMonoLine(const TableRow& row) {
  const bool named = !IsNumber(row[0]);
  TumMonoLine line{named ? row[0] : "", row.Numbers(named ? 1 : 0, row.size() - (named ? 1 : 0))};
  const std::size_t count = line.values.size();
  if (!named) line.model = count == 8 ? "RadTan" : "FOV";
  const std::size_t expected = line.model == "FOV" || line.model == "Pinhole" ? 5 : 8;
  if (count != expected && !(line.model == "Pinhole" && count == 4)) {
    row.Fail(fmt::format("{} numbers for the model {}", expected, line.model));
  }
  return line;
}

Distortion MakeTumMonoDistortion(const TumMonoLine& line) {
  if (line.model == "Pinhole") return NoDistortion{};
  const std::span<const double> coefficients = std::span(line.values).subspan(4);
  if (line.model == "RadTan") return MakeRadialTangential(coefficients);
  if (line.model != "FOV") return MakeKannalaBrandt(coefficients);
  if (coefficients.front() == 0.0) return NoDistortion{};
  return FieldOfView{coefficients.front()};
}

}  // namespace

bool IsColmapCameraRow(const TableRow& row) {
  return row.size() >= 4 && ParseIndex(row[0]) && FindColmapModel(row[1]) != nullptr;
}

Camera ReadColmapCamera(const std::vector<TableRow>& rows, const std::filesystem::path& path) {
  if (rows.size() != 1) {
    throw InputError(fmt::format("{}: holds {} cameras; leave only the line of the one that runs",
                                 path.string(), rows.size()));
  }
  const TableRow& row = rows.front();
  const ColmapModel& model = *FindColmapModel(row[1]);
  if (model.num_coefficients < 0) row.Fail("a supported camera model");
  const std::size_t num_focal = static_cast<std::size_t>(model.num_focal_lengths);
  const std::size_t num_coefficients = static_cast<std::size_t>(model.num_coefficients);
  const std::size_t count = num_focal + 2 + num_coefficients;
  if (row.size() != 4 + count) {
    row.Fail(fmt::format("{} parameters for the model {}", count, model.name));
  }
  const std::vector<double> p = row.Numbers(4, count);
  Camera camera;
  camera.pinhole = {p[0],
                    p[num_focal - 1],
                    p[num_focal] - kCornerToCentrePx,
                    p[num_focal + 1] - kCornerToCentrePx,
                    row.SizePx(2),
                    row.SizePx(3)};
  camera.distortion =
      MakeColmapDistortion(row, model, row.Numbers(4 + num_focal + 2, num_coefficients));
  return camera;
}

bool IsTumMonoCameraRow(const TableRow& row) {
  const std::string& first = row[0];
  const bool named = first == "Pinhole" || first == "FOV" || first == "RadTan" ||
                     first == "EquiDistant" || first == "KannalaBrandt";
  if (row.size() < 5 || (!named && row.size() != 5 && row.size() != 8)) return false;
  return std::all_of(row.fields().begin() + (named ? 1 : 0), row.fields().end(), IsNumber);
}

Camera ReadTumMonoCamera(const std::vector<TableRow>& rows, const std::filesystem::path& path) {
  if (rows.size() < 2) {
    throw InputError(
        fmt::format("{}: expected a second line with width and height", path.string()));
  }
  TumMonoLine line = ReadTumMonoLine(rows[0]);
  if (rows[1].size() != 2) rows[1].Fail("width and height");
  const int width = rows[1].SizePx(0);
  const int height = rows[1].SizePx(1);
  std::vector<double>& p = line.values;
  const bool relative = p[2] < 1.0 && p[3] < 1.0;
  if (relative) {
    p[0] *= width;
    p[1] *= height;
    p[2] = p[2] * width - kCornerToCentrePx;
    p[3] = p[3] * height - kCornerToCentrePx;
  }
  Camera camera;
  camera.pinhole = {p[0], p[1], p[2], p[3], width, height};
  camera.distortion = MakeTumMonoDistortion(line);
  return camera;
}

}  // namespace lift_slam
