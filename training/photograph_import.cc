#include "training/photograph_import.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <sstream>

#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/option_range.h"
#include "lift_slam/util/sha256.h"
#include "training/folder_name.h"
#include "training/sift_keypoints.h"

namespace lift_slam::training {
namespace {

std::vector<std::string> Columns(const std::string& line) {
  std::vector<std::string> columns(1);
  for (const char c : line) {
    if (c == '\t') {
      columns.emplace_back();
    } else {
      columns.back() += c;
    }
  }
  return columns;
}

std::vector<ImageOrigin> ReadManifest(const std::filesystem::path& path) {
  std::vector<ImageOrigin> origins;
  const std::vector<std::string> lines = ReadLines(path);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::vector<std::string> columns = Columns(lines[i]);
    if (columns.size() < 4) {
      throw InputError(
          fmt::format("{}:{}: expected file, licence, author and package, separated by tabs",
                      path.string(), i + 1));
    }
    origins.push_back({.name = columns[0],
                       .scene = columns[0],
                       .source = columns[3],
                       .licence = columns[1],
                       .author = columns[2]});
  }
  return origins;
}

std::vector<ImageOrigin> ListImages(const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder)) {
    throw InputError(fmt::format("{}: there is no such folder of photographs", folder.string()));
  }
  if (std::filesystem::exists(folder / "manifest.tsv"))
    return ReadManifest(folder / "manifest.tsv");
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) names.push_back(entry.path().lexically_relative(folder).string());
  }
  std::sort(names.begin(), names.end());
  std::vector<ImageOrigin> origins;
  for (const std::string& name : names) {
    origins.push_back({name, name, FolderName(folder), "unknown", "unknown"});
  }
  return origins;
}

bool HasWord(const std::string& text, const std::string& words) {
  std::istringstream stream(words);
  bool any = false;
  for (std::string word; stream >> word; any = true) {
    if (text.find(word) != std::string::npos) return true;
  }
  return !any;
}

GrayImage Limited(const GrayImage& image, int max_side_px) {
  const int side = std::max(image.width(), image.height());
  if (side <= max_side_px) return image;
  const double scale = static_cast<double>(max_side_px) / side;
  cv::Mat small;
  cv::resize(image.mat(), small, {}, scale, scale, cv::INTER_AREA);
  return GrayImage(small);
}

// A view of the picture turned, slanted and resized, in another light.
struct Warp {
  cv::Matx33d warped_from_image;
  double scale = 1.0;
  GrayImage image;
};

Warp RandomWarp(const GrayImage& image, Random& random) {
  constexpr double kMaxTurn = std::numbers::pi / 6, kMaxStretch = 1.4, kMaxScale = 1.4;
  const double turn = random.Uniform(-kMaxTurn, kMaxTurn);
  const double scale = std::pow(kMaxScale, random.Uniform(-1.0, 1.0));
  const double stretch = std::pow(kMaxStretch, random.Uniform(-0.5, 0.5));
  const double cx = 0.5 * image.width(), cy = 0.5 * image.height();
  const double c = scale * std::cos(turn), s = scale * std::sin(turn);
  const cv::Matx33d to_centre(1, 0, -cx, 0, 1, -cy, 0, 0, 1), back(1, 0, cx, 0, 1, cy, 0, 0, 1);
  const cv::Matx33d linear(c * stretch, -s / stretch, 0, s * stretch, c / stretch, 0,
                           random.Uniform(-1e-4, 1e-4), random.Uniform(-1e-4, 1e-4), 1);
  Warp warp{back * linear * to_centre, scale, {}};
  cv::Mat warped;
  cv::warpPerspective(image.mat(), warped, warp.warped_from_image, image.mat().size(),
                      cv::INTER_LINEAR, cv::BORDER_REFLECT_101);
  warped.convertTo(warped, -1, random.Uniform(0.6, 1.4), random.Uniform(-20.0, 20.0));
  warp.image = GrayImage(warped);
  return warp;
}

// Keypoints found again in at least one of several warped views: what would survive matching.
std::vector<View> RepeatedKeypoints(const GrayImage& image, const std::vector<View>& keypoints,
                                    const PhotographOptions& options, Random& random) {
  std::vector<char> repeated(keypoints.size(), options.num_warps == 0);
  for (int i = 0; i < options.num_warps; ++i) {
    const Warp warp = RandomWarp(image, random);
    const std::vector<View> found = DetectSift(warp.image, 0.5 * options.min_sigma, 0);
    const KeypointGrid grid(found, image.width(), image.height());
    for (std::size_t k = 0; k < keypoints.size(); ++k) {
      const cv::Vec3d p = warp.warped_from_image * cv::Vec3d(keypoints[k].x, keypoints[k].y, 1.0);
      if (grid.Find(p[0] / p[2], p[1] / p[2], keypoints[k].sigma * warp.scale) != nullptr) {
        repeated[k] = 1;
      }
    }
  }
  std::vector<View> kept;
  for (std::size_t k = 0; k < keypoints.size(); ++k) {
    if (repeated[k] != 0) kept.push_back(keypoints[k]);
  }
  return kept;
}

bool HasRoom(const GrayImage& image, const View& view) {
  constexpr double kHalfWidthSigmas = 6.0;
  const double half_width = kHalfWidthSigmas * view.sigma;
  return view.x >= half_width && view.y >= half_width && view.x <= image.width() - 1 - half_width &&
         view.y <= image.height() - 1 - half_width;
}

void AddPhotograph(const GrayImage& image, const ImageOrigin& origin,
                   const PhotographOptions& options, TrainingSetWriter& writer) {
  Random random(static_cast<std::uint64_t>(options.seed) * 1000003 + writer.num_images());
  std::vector<View> keypoints = DetectSift(image, options.min_sigma, 0);
  std::vector<View> points = RepeatedKeypoints(image, keypoints, options, random);
  std::erase_if(points, [&](const View& view) { return !HasRoom(image, view); });
  if (std::ssize(points) > options.max_points) {
    points.resize(static_cast<std::size_t>(options.max_points));
  }
  if (points.empty()) return;
  const std::uint32_t number = writer.AddImage(image, origin);
  for (View& view : points) {
    view.image = number;
    writer.AddPoint({&view, 1});
  }
  for (View& place : EmptyPlaces(image, keypoints, options.max_empty_places, random)) {
    place.image = number;
    writer.AddEmptyPlace(place);
  }
}

}  // namespace

bool IsWanted(const std::string& name, Part part) {
  if (part == Part::kAll) return true;
  const int digit = std::stoi(Sha256Hex(name).substr(0, 4), nullptr, 16) % 10;
  return (digit == 0) == (part == Part::kValidation);
}

void PhotographOptions::Visit(OptionVisitor& visitor) {
  visitor.Field("part", part, kPartNames, "every tenth image is for validation");
  visitor.Field("sources", sources, "words of which an image's source has one; empty: all");
  visitor.Field("max_side_px", max_side_px, "larger images are made smaller");
  visitor.Field("min_sigma", min_sigma, "of keypoints, pixels");
  visitor.Field("max_points", max_points, "of an image, the strongest");
  visitor.Field("num_warps", num_warps, "views of which one must show a keypoint again");
  visitor.Field("max_empty_places", max_empty_places, "of an image");
  visitor.Field("seed", seed, "of the views and the empty places");
}

void PhotographOptions::Check() const {
  CheckOptionRange("photographs.max_side_px", max_side_px, 64, 10000);
  CheckOptionRange("photographs.min_sigma", min_sigma, 0.5, 50.0);
  CheckOptionRange("photographs.max_points", max_points, 1, 1000000);
  CheckOptionRange("photographs.num_warps", num_warps, 0, 100);
  CheckOptionRange("photographs.max_empty_places", max_empty_places, 0, 1000000);
}

void ImportPhotographs(const std::filesystem::path& folder, const PhotographOptions& options,
                       const ImportProgress& progress, TrainingSetWriter& writer) {
  options.Check();
  const std::vector<ImageOrigin> origins = ListImages(folder);
  const std::size_t before = writer.num_images();
  int done = 0;
  for (const ImageOrigin& origin : origins) {
    if (IsWanted(origin.name, options.part) && HasWord(origin.source, options.sources)) {
      if (const auto image = ReadGrayImage(folder / origin.name)) {
        AddPhotograph(Limited(*image, options.max_side_px), origin, options, writer);
      }
    }
    progress(++done, static_cast<int>(origins.size()), writer.num_points());
  }
  if (writer.num_images() == before) {
    throw InputError(
        fmt::format("{}: no usable photograph among {} files", folder.string(), origins.size()));
  }
}

}  // namespace lift_slam::training
