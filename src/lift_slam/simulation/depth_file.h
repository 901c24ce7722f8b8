#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace lift_slam {

enum class DepthFormat {
  kPng16,   // whole numbers, KITTI's way: 256 a metre, none beyond 255.99 m
  kTiff32,  // metres as floating point: every depth, exactly
};

// In a 16-bit file, of one metre. 0 stands for no depth.
inline constexpr double kDepthUnitsPerM = 256.0;

// A depth image, row 0 at the top; 0: no depth (sky, or too far for the format).
struct DepthImage {
  int width = 0, height = 0;
  std::vector<float> depth_m;
};

// ".png" or ".tiff".
std::string DepthExtension(DepthFormat format);

// The file's bytes.
std::vector<std::uint8_t> EncodeDepth(const DepthImage& image, DepthFormat format);

// Throws InputError when the file is missing or no depth image of ours.
DepthImage ReadDepth(const std::filesystem::path& path);

}  // namespace lift_slam
