#include "lift_slam/datasets/image_list_sequence.h"

#include <fmt/format.h>

#include "lift_slam/datasets/image_files.h"
#include "lift_slam/datasets/sequence_setup.h"
#include "lift_slam/datasets/time_order.h"
#include "lift_slam/util/check.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

ImageList ListImagesOf(SequenceFormat format, const LayoutRequest& request) {
  switch (format) {
    case SequenceFormat::kKittiOdometry:
      return ListKittiOdometry(request);
    case SequenceFormat::kKittiRaw:
      return ListKittiRaw(request);
    case SequenceFormat::kEuroc:
      return ListEuroc(request);
    case SequenceFormat::kTumRgbd:
      return ListTumRgbd(request);
    case SequenceFormat::kTumMono:
      return ListTumMono(request);
    case SequenceFormat::kImageFolder:
      return ListImageFolder(request);
    case SequenceFormat::kVideo:
    case SequenceFormat::kLiveCamera:
      break;
  }
  LIFT_SLAM_CHECK(false, "format {} is no image list", FormatName(format));
  return {};
}

// The size all images should have: that of the first one that can be read.
ImageSize FirstImageSize(const std::vector<ListedImage>& images) {
  std::string first_problem;
  for (const ListedImage& listed : images) {
    std::string why;
    if (const auto image = ReadWholeImage(listed.file, &why)) {
      return {image->width(), image->height(), listed.file.string()};
    }
    if (first_problem.empty()) first_problem = why;
  }
  throw InputError(
      fmt::format("none of the {} images can be read; {}", images.size(), first_problem));
}

struct TimeOrder {
  std::vector<PlannedFrame> frames;  // all
  std::vector<ListedImage> valid;    // those whose times increase
};

TimeOrder CheckTimes(const std::vector<ListedImage>& images, std::vector<std::string>& warnings) {
  std::vector<std::int64_t> times_ns;
  for (const ListedImage& image : images) times_ns.push_back(image.timestamp_ns);
  const std::vector<bool> keep = KeepIncreasing(times_ns);
  TimeOrder order;
  for (std::size_t i = 0; i < images.size(); ++i) {
    order.frames.push_back({images[i], keep[i]});
    if (keep[i]) order.valid.push_back(images[i]);
  }
  const std::size_t skipped = images.size() - order.valid.size();
  if (skipped > 0) {
    const auto first = std::find(keep.begin(), keep.end(), false) - keep.begin();
    warnings.push_back(
        fmt::format("{} of {} images are skipped because their times do not increase, the first "
                    "of them {}",
                    skipped, images.size(), images[static_cast<std::size_t>(first)].file.string()));
  }
  return order;
}

std::vector<PlannedFrame> Select(const std::vector<PlannedFrame>& frames,
                                 const SequenceOptions& options, const std::string& source) {
  std::vector<PlannedFrame> selected;
  for (const PlannedFrame& frame : frames) {
    if (IsSelected(frame.image.frame_index, options)) selected.push_back(frame);
  }
  if (selected.empty()) {
    throw InputError(fmt::format("{}: the range {}:{}:{} selects none of its frames {} to {}",
                                 source, options.first, options.last, options.step,
                                 frames.front().image.frame_index,
                                 frames.back().image.frame_index));
  }
  return selected;
}

double RateOf(const std::vector<ListedImage>& images) {
  std::vector<std::int64_t> times_ns;
  for (const ListedImage& image : images) times_ns.push_back(image.timestamp_ns);
  return MedianRateHz(times_ns);
}

// The name of a EuRoC sequence is the folder above mav0.
std::string SequenceName(const std::filesystem::path& folder) {
  const std::string name = folder.filename().string();
  return name == "mav0" ? folder.parent_path().filename().string() : name;
}

}  // namespace

ImageListSequence::ImageListSequence(SequenceInfo info, std::vector<PlannedFrame> frames, int width,
                                     int height)
    : info_(std::move(info)), frames_(std::move(frames)), width_(width), height_(height) {
  info_.num_frames = static_cast<std::int64_t>(frames_.size());
  info_.frames.reserve(frames_.size());
  for (const PlannedFrame& frame : frames_) {
    info_.frames.push_back({frame.image.frame_index, frame.image.timestamp_ns});
  }
}

std::optional<SequenceFrame> ImageListSequence::Next() {
  if (next_ == frames_.size()) return std::nullopt;
  const PlannedFrame& planned = frames_[next_++];
  const std::string file = planned.image.file.string();
  SequenceFrame frame;
  frame.frame_index = planned.image.frame_index;
  frame.timestamp_ns = planned.image.timestamp_ns;
  if (!planned.time_increases) {
    frame.problem = ImageProblem::kTimestampNotIncreasing;
    frame.problem_text = fmt::format(
        "{}: its time {} ns does not increase over the frames around it", file, frame.timestamp_ns);
    return frame;
  }
  std::optional<GrayImage> image = ReadWholeImage(planned.image.file, &frame.problem_text);
  if (!image) {
    frame.problem = ImageProblem::kUnreadable;
  } else if (image->width() != width_ || image->height() != height_) {
    frame.problem = ImageProblem::kSizeDiffers;
    frame.problem_text = fmt::format("{}: is {}x{} pixels, the sequence {}x{}", file,
                                     image->width(), image->height(), width_, height_);
  } else {
    frame.image = std::move(image);
  }
  return frame;
}

std::unique_ptr<Sequence> OpenImageListSequence(const std::string& source, SequenceFormat format,
                                                const SequenceOptions& options) {
  const std::filesystem::path folder = NormalPath(source);
  if (!std::filesystem::is_directory(folder)) {
    throw InputError(
        fmt::format("{}: is no folder, which the format {} needs", source, FormatName(format)));
  }
  const LayoutRequest request{folder, options, ReadGivenCamera(options)};
  ImageList list = ListImagesOf(format, request);
  SequenceInfo info;
  info.name = SequenceName(folder);
  info.format = format;
  info.path = folder;
  info.warnings = std::move(list.warnings);
  const TimeOrder order = CheckTimes(list.images, info.warnings);
  const ImageSize size = FirstImageSize(order.valid);
  info.camera = FinishCamera(request.given_camera ? request.given_camera : list.camera, size,
                             RateOf(order.valid), source, list.calibration_searched, options);
  info.ground_truth = LoadGroundTruth(list, FramesOf(order.valid), options, info.warnings);
  std::vector<PlannedFrame> frames = Select(order.frames, options, source);
  if (frames.size() == 1) {
    info.warnings.push_back(source + ": there is only one frame, so nothing can be tracked");
  }
  return std::make_unique<ImageListSequence>(std::move(info), std::move(frames), size.width,
                                             size.height);
}

}  // namespace lift_slam
