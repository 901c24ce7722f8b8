#include "lift_slam/datasets/image_list.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "lift_slam/util/input_error.h"

namespace lift_slam {

std::optional<std::int64_t> NominalTimeNs(std::int64_t frame_index, double frame_rate_hz) {
  constexpr double kEndNs = 9223372036854775808.0;  // 2^63
  const double time_ns = static_cast<double>(frame_index) * 1e9 / frame_rate_hz;
  if (!(time_ns >= -kEndNs && time_ns < kEndNs)) return std::nullopt;
  return std::llround(time_ns);
}

void AssignNominalTimes(double frame_rate_hz, std::vector<ListedImage>& images) {
  for (ListedImage& image : images) {
    const auto time_ns = NominalTimeNs(image.frame_index, frame_rate_hz);
    if (!time_ns) {
      throw InputError(
          fmt::format("{}: frame {} at {} frames/s has a time beyond 292 years; "
                      "expected images numbered by frame, or a file with their times",
                      image.file.string(), image.frame_index, frame_rate_hz));
    }
    image.timestamp_ns = *time_ns;
  }
}

double NominalRate(const LayoutRequest& request, const std::optional<Camera>& camera,
                   double fallback_hz, const std::string& what_is_missing,
                   std::vector<std::string>& warnings) {
  if (request.options.frame_rate_hz > 0.0) return request.options.frame_rate_hz;
  if (camera && camera->frame_rate_hz > 0.0) return camera->frame_rate_hz;
  warnings.push_back(fmt::format("{}; {} frames/s are assumed, which only scales times",
                                 what_is_missing, fallback_hz));
  return fallback_hz;
}

std::string ChooseCameraFolder(const LayoutRequest& request, const std::vector<std::string>& names,
                               const std::string& subfolder) {
  const auto exists = [&](const std::string& name) {
    return std::filesystem::is_directory(request.folder / name / subfolder);
  };
  const std::string& wanted = request.options.camera_name;
  if (!wanted.empty()) {
    if (exists(wanted)) return wanted;
    throw InputError(
        fmt::format("{}: there is no camera '{}' in it", request.folder.string(), wanted));
  }
  for (const std::string& name : names) {
    if (exists(name)) return name;
  }
  throw InputError(fmt::format("{}: there is no image folder {} in it", request.folder.string(),
                               fmt::join(names, ", ")));
}

}  // namespace lift_slam
