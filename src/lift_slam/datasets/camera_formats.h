#pragma once

#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "lift_slam/camera/camera.h"
#include "lift_slam/datasets/keyed_file.h"
#include "lift_slam/datasets/text_table.h"

namespace lift_slam {

// One reader for each kind of camera file; ReadCameraFile chooses. All throw InputError.

// model, width, height, fx, fy, cx, cy; k1 k2 p1 p2 k3 (radial_tangential), k1 to k4
// (kannala_brandt), omega (fov); frame_rate_hz. Unknown keys are refused.
Camera ReadOwnCamera(const KeyedFile& file);
// camera_matrix, distortion_coefficients (4 or 5, up to 14 when the rest is zero; fisheye with
// `fisheye_model: 1` or a distortion_model of that name), image_width, image_height.
Camera ReadOpenCvCamera(const KeyedFile& file);
// camN: camera_model pinhole; distortion_model radtan, equidistant, fov or none.
Camera ReadKalibrCamera(const KeyedFile& file, std::string_view camera_name);
// intrinsics, distortion_model, distortion_coefficients, resolution, rate_hz.
Camera ReadEurocCamera(const KeyedFile& file);
// Camera.fx ... or Camera1.fx ...; Camera.type PinHole, Rectified or KannalaBrandt8.
Camera ReadOrbSlamCamera(const KeyedFile& file);

// One camera a row. COLMAP puts (0, 0) at the top-left CORNER: 0.5 is taken off cx and cy.
Camera ReadColmapCamera(const std::vector<TableRow>& rows, const std::filesystem::path& path);
bool IsColmapCameraRow(const TableRow& row);

// "fx fy cx cy omega", then "width height". Relative numbers (cx and cy below 1) are scaled by the
// size, 0.5 px taken off cx and cy (they count from the corner of the image); see docs/datasets.md.
// Also with a model name first (Pinhole, FOV, RadTan, EquiDistant, KannalaBrandt).
Camera ReadTumMonoCamera(const std::vector<TableRow>& rows, const std::filesystem::path& path);
bool IsTumMonoCameraRow(const TableRow& row);

// 4 or more of OpenCV's coefficients k1 k2 p1 p2 k3; all zero gives no distortion.
Distortion MakeRadialTangential(std::span<const double> coefficients);
// 4 coefficients of OpenCV's fisheye model.
Distortion MakeKannalaBrandt(std::span<const double> coefficients);

}  // namespace lift_slam
