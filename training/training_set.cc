#include "training/training_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>

#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"
#include "training/folder_name.h"
#include "training/training_set_writer.h"

namespace lift_slam::training {
namespace {

// The records of a file, which must be a whole number of them.
template <class Record>
std::span<const Record> Records(const MappedFile& file, const std::filesystem::path& path) {
  const std::span<const std::byte> bytes = file.bytes();
  if (bytes.size() % sizeof(Record) != 0) {
    throw InputError(
        fmt::format("{}: {} bytes are no whole number of records of {} bytes; the "
                    "file is damaged, prepare the training set again",
                    path.string(), bytes.size(), sizeof(Record)));
  }
  return {reinterpret_cast<const Record*>(bytes.data()), bytes.size() / sizeof(Record)};
}

std::vector<ImageOrigin> ReadOrigins(const std::filesystem::path& path) {
  std::vector<ImageOrigin> origins;
  try {
    const nlohmann::json manifest = nlohmann::json::parse(ReadText(path));
    const nlohmann::json& format = manifest.at("format");
    if (format != kTrainingSetFormat) {
      throw InputError(fmt::format("{}: format is {}, expected '{}'", path.string(),
                                   format.is_primitive() ? format.dump() : format.type_name(),
                                   kTrainingSetFormat));
    }
    for (const nlohmann::json& image : manifest.at("images")) {
      origins.push_back({image.at("name"), image.at("scene"), image.at("source"),
                         image.at("licence"), image.at("author")});
    }
  } catch (const nlohmann::json::exception& error) {
    throw InputError(
        fmt::format("{}: is no manifest of a training set: {}", path.string(), error.what()));
  }
  return origins;
}

// Takes 32-bit numbers and pixels off the front of a file.
class ByteReader {
 public:
  ByteReader(std::span<const std::byte> bytes, const std::filesystem::path& path)
      : bytes_(bytes), path_(path) {}

  bool done() const { return bytes_.empty(); }

  const std::byte* Take(std::size_t size) {
    if (size > bytes_.size()) Refuse("ends in the middle of an image");
    const std::byte* taken = bytes_.data();
    bytes_ = bytes_.subspan(size);
    return taken;
  }

  int Number() {
    std::uint32_t number = 0;
    std::memcpy(&number, Take(sizeof number), sizeof number);
    return static_cast<int>(std::min(number, std::uint32_t{1} << 20));
  }

  [[noreturn]] void Refuse(const char* what) const {
    throw InputError(fmt::format("{}: {}; prepare the training set again", path_.string(), what));
  }

 private:
  std::span<const std::byte> bytes_;
  const std::filesystem::path& path_;
};

ImagePyramid TakePyramid(ByteReader& reader) {
  std::vector<cv::Size> sizes(static_cast<std::size_t>(reader.Number()));
  for (cv::Size& size : sizes) {
    size.width = reader.Number();
    size.height = reader.Number();
    if (size.empty()) reader.Refuse("has an image without width or height");
  }
  ImagePyramid pyramid;
  for (const cv::Size& size : sizes) {
    const std::byte* pixels =
        reader.Take(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height));
    // OpenCV has no read-only matrices; nobody writes to a GrayImage.
    cv::Mat mat(size, CV_8UC1, const_cast<std::byte*>(pixels));
    pyramid.push_back({GrayImage(mat), static_cast<double>(sizes[0].width) / size.width,
                       static_cast<double>(sizes[0].height) / size.height});
  }
  return pyramid;
}

// Up to the outer edges of its pixels, and a little for rounding.
bool LiesIn(const GrayImage& image, const View& view) {
  const auto within = [](float value, int size) {
    return value >= -1.0F && value <= static_cast<float>(size);  // false for no number
  };
  return within(view.x, image.width()) && within(view.y, image.height());
}

}  // namespace

TrainingSet::TrainingSet(const std::filesystem::path& folder)
    : folder_(folder), name_(FolderName(folder)) {
  if (!std::filesystem::is_directory(folder)) {
    throw InputError(
        fmt::format("{}: there is no such training set ('lift_slam_train prepare' "
                    "makes one)",
                    folder.string()));
  }
  origins_ = ReadOrigins(folder / "manifest.json");
  MapImages(folder / "images.bin");
  points_file_ = MappedFile(folder / "points.bin");
  views_file_ = MappedFile(folder / "views.bin");
  empty_file_ = MappedFile(folder / "empty.bin");
  first_views_ = Records<std::uint32_t>(points_file_, folder / "points.bin");
  views_ = Records<View>(views_file_, folder / "views.bin");
  empty_places_ = Records<View>(empty_file_, folder / "empty.bin");
  Check();
}

void TrainingSet::MapImages(const std::filesystem::path& path) {
  images_file_ = MappedFile(path);
  ByteReader reader(images_file_.bytes(), path);
  while (!reader.done()) {
    pyramids_.push_back(TakePyramid(reader));
    if (pyramids_.back().empty()) {
      throw InputError(fmt::format("{}: image {} is empty", path.string(), pyramids_.size() - 1));
    }
  }
}

void TrainingSet::Check() const {
  const auto refuse = [&](const std::string& what) {
    throw InputError(fmt::format("{}: {}; prepare the training set again", folder_.string(), what));
  };
  if (origins_.size() != pyramids_.size()) {
    refuse(fmt::format("{} images, but {} in the manifest", pyramids_.size(), origins_.size()));
  }
  if (first_views_.size() < 2) refuse("there are no points to train on");
  if (first_views_.front() != 0 || first_views_.back() != views_.size() ||
      std::adjacent_find(first_views_.begin(), first_views_.end(), std::greater_equal<>()) !=
          first_views_.end()) {
    refuse("points.bin and views.bin do not fit together");
  }
  const auto image_of = [&](std::uint32_t first_view) { return views_[first_view].image; };
  if (!std::ranges::is_sorted(first_views_.first(num_points()), {}, image_of)) {
    refuse("points are not sorted by the image of their first view");
  }
  for (const std::span<const View> views : {views_, empty_places_}) {
    for (const View& view : views) {
      if (view.image >= pyramids_.size() || !(view.sigma > 0.0F) || !(view.sigma < 1e4F)) {
        refuse("a view is of an image that is not there, or has no scale");
      }
      if (!LiesIn(pyramids_[view.image].front().image, view)) {
        refuse(fmt::format("a view lies outside its image, at {}, {}", view.x, view.y));
      }
    }
  }
}

std::span<const View> TrainingSet::views(std::size_t point) const {
  return views_.subspan(first_views_[point], first_views_[point + 1] - first_views_[point]);
}

std::pair<std::size_t, std::size_t> TrainingSet::NeighboursInImage(std::size_t point) const {
  const std::uint32_t image = views(point)[0].image;
  const auto image_of = [&](std::uint32_t first_view) { return views_[first_view].image; };
  const auto points = first_views_.first(num_points());
  const auto begin = std::partition_point(points.begin(), points.end(),
                                          [&](std::uint32_t v) { return image_of(v) < image; });
  const auto end = std::partition_point(begin, points.end(),
                                        [&](std::uint32_t v) { return image_of(v) <= image; });
  return {static_cast<std::size_t>(begin - points.begin()),
          static_cast<std::size_t>(end - points.begin())};
}

}  // namespace lift_slam::training
