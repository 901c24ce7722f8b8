#include "training/colmap_reader.h"

#include <fmt/format.h>

#include <cstring>
#include <sstream>

#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam::training {
namespace {

constexpr std::uint64_t kNoPoint = ~std::uint64_t{0};

// Takes values off the front of images.bin.
class BinaryReader {
 public:
  BinaryReader(std::string bytes, const std::filesystem::path& path)
      : bytes_(std::move(bytes)), path_(path) {}

  template <class T>
  T Take() {
    T value;
    std::memcpy(&value, Bytes(sizeof value), sizeof value);
    return value;
  }

  const char* Bytes(std::size_t size) {
    if (size > bytes_.size() - at_) {
      throw InputError(fmt::format(
          "{}: ends in the middle of an image; copy or reconstruct it again", path_.string()));
    }
    at_ += size;
    return bytes_.data() + at_ - size;
  }

  std::string Text() {
    std::string text;
    for (char c = *Bytes(1); c != '\0'; c = *Bytes(1)) text += c;
    return text;
  }

 private:
  std::string bytes_;
  std::filesystem::path path_;
  std::size_t at_ = 0;
};

std::vector<ColmapImage> ReadBinary(const std::filesystem::path& path) {
  BinaryReader reader(ReadText(path), path);
  const auto count = reader.Take<std::uint64_t>();
  std::vector<ColmapImage> images;
  for (std::uint64_t i = 0; i < count; ++i) {
    ColmapImage image;
    image.id = reader.Take<std::uint32_t>();
    reader.Bytes(7 * sizeof(double) + sizeof(std::uint32_t));  // pose and camera
    image.name = reader.Text();
    const auto keypoints = reader.Take<std::uint64_t>();
    for (std::uint64_t k = 0; k < keypoints; ++k) {
      reader.Bytes(2 * sizeof(double));  // the database has the place as well
      const auto point = reader.Take<std::uint64_t>();
      if (point != kNoPoint) image.observations.push_back({k, point});
    }
    images.push_back(std::move(image));
  }
  return images;
}

// Two lines an image: id, pose, camera and name; then x, y and the point's id of each keypoint.
std::vector<ColmapImage> ReadTextual(const std::filesystem::path& path) {
  std::vector<ColmapImage> images;
  const std::vector<std::string> lines = ReadLines(path);
  const auto refuse = [&](std::size_t line, const char* expected) {
    throw InputError(fmt::format("{}:{}: expected {}", path.string(), line + 1, expected));
  };
  std::size_t i = 0;
  while (i < lines.size()) {
    if (lines[i].empty() || lines[i][0] == '#') {
      ++i;
      continue;
    }
    ColmapImage image;
    std::istringstream heading(lines[i]);
    double number = 0.0;
    heading >> image.id;
    for (int k = 0; k < 8; ++k) heading >> number;
    if (!(heading >> std::ws) || !std::getline(heading, image.name)) {
      refuse(i, "image id, 7 numbers of the pose, camera id and file name");
    }
    if (++i == lines.size()) refuse(i - 1, "a line of keypoints after this one");
    std::istringstream keypoints(lines[i]);
    double x = 0.0, y = 0.0;
    std::int64_t point = 0;
    std::size_t k = 0;
    for (; keypoints >> x >> y >> point; ++k) {
      if (point >= 0) image.observations.push_back({k, static_cast<std::uint64_t>(point)});
    }
    if (!keypoints.eof()) refuse(i, "x, y and point id of each keypoint");
    ++i;
    images.push_back(std::move(image));
  }
  return images;
}

}  // namespace

std::vector<ColmapImage> ReadColmapImages(const std::filesystem::path& model) {
  std::vector<ColmapImage> images;
  if (std::filesystem::exists(model / "images.bin")) {
    images = ReadBinary(model / "images.bin");
  } else if (std::filesystem::exists(model / "images.txt")) {
    images = ReadTextual(model / "images.txt");
  } else {
    throw InputError(
        fmt::format("{}: holds neither images.bin nor images.txt; expected the folder "
                    "of a sparse COLMAP model (such as sparse/0)",
                    model.string()));
  }
  if (images.empty()) throw InputError(fmt::format("{}: has no images", model.string()));
  return images;
}

}  // namespace lift_slam::training
