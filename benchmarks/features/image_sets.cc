#include "benchmarks/features/image_sets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "lift_slam/datasets/camera_file.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/number_text.h"

namespace lift_slam {
namespace {

GrayImage Read(const std::filesystem::path& path) {
  std::string why;
  std::optional<GrayImage> image = ReadGrayImage(path, &why);
  if (!image) throw InputError(fmt::format("{}: {}", path.string(), why));
  return *image;
}

std::vector<std::filesystem::path> FilesIn(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  if (!std::filesystem::is_directory(folder)) return files;
  // By number: "10.5.jpg" comes after "9.5.jpg". Other files (.DS_Store) are no images.
  std::vector<std::pair<double, std::filesystem::path>> numbered;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const auto number = ParseDouble(entry.path().stem().string());
    if (number && std::isfinite(*number)) numbered.emplace_back(*number, entry.path());
  }
  std::ranges::sort(numbered);
  for (const auto& [number, path] : numbered) files.push_back(path);
  return files;
}

using ImageCache = std::map<std::filesystem::path, GrayImage>;

// Images that several sets have in common are read once.
const GrayImage& ReadOnce(const std::filesystem::path& path, ImageCache& images) {
  const auto [entry, is_new] = images.try_emplace(path);
  if (is_new) entry->second = Read(path);
  return entry->second;
}

// Pairs with the same first images for all skips up to 10.
ImageSet Pairs(const std::string& name, const std::filesystem::path& images,
               const std::filesystem::path& camera, int count, int skip, double gamma,
               ImageCache& cache) {
  Camera calibration = ReadCameraFile(camera);
  ImageSet set{name, {}, gamma, {}};
  const std::vector<std::filesystem::path> files = FilesIn(images);
  const int last = static_cast<int>(files.size()) - 1 - std::max(skip, 10);
  if (last < count) throw InputError(fmt::format("{}: too few images", images.string()));
  for (int i = 0; i < count; ++i) {
    const auto at = static_cast<std::size_t>(i * last / count);
    set.pairs.emplace_back(ReadOnce(files[at], cache),
                           ReadOnce(files[at + static_cast<std::size_t>(skip)], cache));
  }
  calibration.pinhole.width = set.pairs.front().first.width();
  calibration.pinhole.height = set.pairs.front().first.height();
  set.camera = calibration;
  return set;
}

// `count` pairs spread over KITTI 00, `skip` frames apart.
ImageSet KittiPairs(const std::filesystem::path& data, int count, int skip, double gamma,
                    ImageCache& cache) {
  const std::filesystem::path folder = data / "kitti/sequences/00";
  std::string name = fmt::format("KITTI t+{}", skip);
  if (gamma != 1.0) name += fmt::format(", γ {:g}", gamma);
  return Pairs(name, folder / "image_0", folder / "calib.txt", count, skip, gamma, cache);
}

// The same of 7-Scenes RedKitchen.
ImageSet KitchenPairs(const std::filesystem::path& data, int count, int skip, ImageCache& cache) {
  const std::filesystem::path folder = data / "7scenes_redkitchen";
  return Pairs(fmt::format("RedKitchen t+{}", skip), folder / "rgb", folder / "camera.yaml", count,
               skip, 1.0, cache);
}

const std::uint8_t* FirstPixel(const ImageSet& set) { return set.pairs.front().first.row(0); }

}  // namespace

std::vector<ImageSet> OneOfEachKind(const std::vector<ImageSet>& sets) {
  if (sets.size() < 2) return sets;
  if (FirstPixel(sets.front()) == FirstPixel(sets.back())) return {sets.front()};
  return {sets.front(), sets.back()};
}

ImageSet SinglePair(const std::filesystem::path& a, const std::filesystem::path& b) {
  return {
      fmt::format("{}, {}", a.stem().string(), b.stem().string()), {}, 1.0, {{Read(a), Read(b)}}};
}

std::vector<ImageSet> RealImageSets(const std::filesystem::path& data, int count) {
  ImageCache cache;
  std::vector<ImageSet> sets;
  const auto add = [&](auto&& make) {
    try {
      sets.push_back(make());
    } catch (const InputError& error) {
      std::fprintf(stderr, "left out: %s\n", error.what());
    }
  };
  add([&] { return KittiPairs(data, count, 1, 1.0, cache); });
  for (const double gamma : {1.0, 0.25, 0.5, 2.0, 4.0}) {
    add([&] { return KittiPairs(data, count, 5, gamma, cache); });
  }
  add([&] { return KitchenPairs(data, count, 10, cache); });
  return sets;
}

}  // namespace lift_slam
