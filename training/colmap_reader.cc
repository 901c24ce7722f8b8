#include "training/colmap_reader.h"

#include <fmt/format.h>

#include <cstring>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>

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

  void CheckEnd() const {
    if (at_ == bytes_.size()) return;
    throw InputError(
        fmt::format("{}: has {} bytes after its last image; copy or reconstruct it again",
                    path_.string(), bytes_.size() - at_));
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
  reader.CheckEnd();
  return images;
}

// Two lines an image: id, pose, camera and name; then x, y and the point's id of each keypoint.
class TextReader {
 public:
  explicit TextReader(const std::filesystem::path& path) : path_(path), lines_(ReadLines(path)) {}

  std::vector<ColmapImage> Read() {
    CheckLastLineEnds();
    std::vector<ColmapImage> images;
    for (; at_ < lines_.size(); ++at_) {
      if (lines_[at_].starts_with('#')) TakeNumberOfImages();
      if (lines_[at_].empty() || lines_[at_][0] == '#') continue;
      images.push_back(TakeHeading());
      if (++at_ == lines_.size()) Refuse(at_ - 1, "a line of keypoints after this one");
      images.back().observations = TakeObservations();
    }
    if (expected_ && *expected_ != images.size()) {
      throw InputError(
          fmt::format("{}: has {} images, but {} by its head; copy or reconstruct it again",
                      path_.string(), images.size(), *expected_));
    }
    return images;
  }

 private:
  [[noreturn]] void Refuse(std::size_t line, const char* expected) const {
    throw InputError(fmt::format("{}:{}: expected {}", path_.string(), line + 1, expected));
  }

  // A number cut short is one all the same.
  void CheckLastLineEnds() const {
    std::ifstream stream(path_, std::ios::binary);
    stream.seekg(-1, std::ios::end);
    if (!lines_.empty() && stream.get() != '\n') {
      Refuse(lines_.size() - 1, "an end of this line (truncated? copy or reconstruct it again)");
    }
  }

  void TakeNumberOfImages() {
    constexpr std::string_view kKey = "Number of images:";
    const std::size_t found = lines_[at_].find(kKey);
    if (found == std::string::npos) return;
    std::istringstream number(lines_[at_].substr(found + kKey.size()));
    if (std::size_t count = 0; number >> count) expected_ = count;
  }

  ColmapImage TakeHeading() const {
    ColmapImage image;
    std::istringstream heading(lines_[at_]);
    double number = 0.0;
    heading >> image.id;
    for (int k = 0; k < 8; ++k) heading >> number;
    if (!(heading >> std::ws) || !std::getline(heading, image.name)) {
      Refuse(at_, "image id, 7 numbers of the pose, camera id and file name");
    }
    return image;
  }

  std::vector<ColmapObservation> TakeObservations() const {
    std::vector<ColmapObservation> observations;
    std::istringstream keypoints(lines_[at_]);
    for (std::size_t k = 0; !(keypoints >> std::ws).eof(); ++k) {
      double x = 0.0, y = 0.0;
      std::int64_t point = 0;
      if (!(keypoints >> x >> y >> point)) Refuse(at_, "x, y and point id of each keypoint");
      if (point >= 0) observations.push_back({k, static_cast<std::uint64_t>(point)});
    }
    return observations;
  }

  std::filesystem::path path_;
  std::vector<std::string> lines_;
  std::size_t at_ = 0;
  std::optional<std::size_t> expected_;  // images, by the comments at the begin
};

}  // namespace

std::vector<ColmapImage> ReadColmapImages(const std::filesystem::path& model) {
  std::vector<ColmapImage> images;
  if (std::filesystem::exists(model / "images.bin")) {
    images = ReadBinary(model / "images.bin");
  } else if (std::filesystem::exists(model / "images.txt")) {
    images = TextReader(model / "images.txt").Read();
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
