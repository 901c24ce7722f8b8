#include "lift_slam/simulation/scene/texture_file.h"

#include <fmt/format.h>

#include <cstring>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "lift_slam/simulation/scene/sgi_image.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

cv::Mat ToRgba8(cv::Mat picture) {
  if (picture.depth() == CV_16U) picture.convertTo(picture, CV_8U, 1.0 / 257.0);
  if (picture.depth() != CV_8U) return {};
  cv::Mat rgba;
  if (picture.channels() == 1) cv::cvtColor(picture, rgba, cv::COLOR_GRAY2RGBA);
  if (picture.channels() == 3) cv::cvtColor(picture, rgba, cv::COLOR_BGR2RGBA);
  if (picture.channels() == 4) cv::cvtColor(picture, rgba, cv::COLOR_BGRA2RGBA);
  return rgba;
}

// A PNG without its colour profile, which is not used: libpng prints a warning for each old one.
std::string WithoutColourProfile(std::string_view png) {
  constexpr std::size_t kSignature = 8;
  std::string kept(png.substr(0, kSignature));
  for (std::size_t at = kSignature; at + 12 <= png.size();) {
    std::size_t size = 12;  // length, type and checksum around the chunk's content
    for (std::size_t i = 0; i < 4; ++i) {
      size += std::size_t{static_cast<unsigned char>(png[at + i])} << (24 - 8 * i);
    }
    const std::string_view chunk = png.substr(at, size);
    if (chunk.substr(4, 4) != "iCCP") kept += chunk;
    at += size;
  }
  return kept;
}

cv::Mat DecodeWithOpenCv(std::string_view bytes) {
  std::string content(bytes);
  if (bytes.starts_with("\x89PNG")) content = WithoutColourProfile(bytes);
  const cv::Mat raw(1, static_cast<int>(content.size()), CV_8U, content.data());
  try {
    return ToRgba8(cv::imdecode(raw, cv::IMREAD_UNCHANGED));
  } catch (const cv::Exception&) {
    return {};
  }
}

bool HasHoles(const std::vector<std::uint8_t>& rgba) {
  for (std::size_t i = 3; i < rgba.size(); i += 4) {
    if (rgba[i] < kAlphaCut) return true;
  }
  return false;
}

}  // namespace

SceneTexture DecodeTexture(std::string_view bytes, const std::filesystem::path& path) {
  SceneTexture texture;
  if (bytes.starts_with("\x01\xDA")) {
    texture = DecodeSgiImage(bytes, path);
  } else {
    const cv::Mat rgba = bytes.empty() ? cv::Mat() : DecodeWithOpenCv(bytes);
    if (rgba.empty()) {
      throw InputError(fmt::format("{}: expected a picture (PNG, JPEG, SGI .rgb)", path.string()));
    }
    texture.name = path.filename().string();
    texture.width = rgba.cols;
    texture.height = rgba.rows;
    texture.rgba.resize(rgba.total() * 4);
    std::memcpy(texture.rgba.data(), rgba.data, texture.rgba.size());
  }
  texture.has_alpha = HasHoles(texture.rgba);
  return texture;
}

SceneTexture ReadTextureFile(const std::filesystem::path& path) {
  return DecodeTexture(ReadText(path), path);
}

}  // namespace lift_slam
