#include "lift_slam/datasets/video_sequence.h"

#include <fmt/format.h>

#include <chrono>
#include <limits>

#include "lift_slam/datasets/camera_file.h"
#include "lift_slam/datasets/sequence_setup.h"
#include "lift_slam/image/video_reader.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;

constexpr double kNominalRateHz = 30.0;
// A source that only hands out broken images would never end.
constexpr int kMaxUndecodableInARow = 100;

constexpr std::int64_t kNoTimeNs = std::numeric_limits<std::int64_t>::min();

enum class TimeSource { kNominalRate, kContainer, kArrival };

struct VideoClock {
  TimeSource source = TimeSource::kNominalRate;
  double rate_hz = kNominalRateHz;
};

std::int64_t NowNs(auto time_point) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(time_point.time_since_epoch())
      .count();
}

class VideoSequence : public Sequence {
 public:
  VideoSequence(SequenceInfo info, VideoReader reader, const VideoClock& clock,
                const ImageSize& size, const SequenceOptions& options)
      : info_(std::move(info)),
        reader_(std::move(reader)),
        clock_(clock),
        size_(size),
        options_(options),
        system_minus_steady_ns_(NowNs(std::chrono::system_clock::now()) -
                                NowNs(std::chrono::steady_clock::now())) {}

  std::optional<SequenceFrame> Next() override {
    for (; !IsSelected(next_index_, options_); ++next_index_) {
      const bool past_end = options_.last >= 0 && next_index_ > options_.last;
      if (ended_ || past_end || !reader_.Skip()) return std::nullopt;
    }
    if (ended_) return std::nullopt;
    SequenceFrame frame;
    frame.frame_index = next_index_++;
    GrayImage image;
    const VideoReader::ReadStatus status = reader_.Read(image);
    frame.timestamp_ns = TimeNs(frame.frame_index);
    num_undecodable_ = status == VideoReader::ReadStatus::kUndecodable ? num_undecodable_ + 1 : 0;
    ended_ = status == VideoReader::ReadStatus::kEnd || num_undecodable_ > kMaxUndecodableInARow;
    if (ended_) return std::nullopt;
    Judge(std::move(image), frame);
    return frame;
  }

  const SequenceInfo& info() const override { return info_; }

 private:
  std::int64_t TimeNs(std::int64_t frame_index) const {
    switch (clock_.source) {
      case TimeSource::kContainer:
        // A frame without time is refused as not increasing.
        return reader_.ContainerTimeNs().value_or(kNoTimeNs);
      case TimeSource::kArrival:
        return NowNs(std::chrono::steady_clock::now()) + system_minus_steady_ns_;
      case TimeSource::kNominalRate:
        break;
    }
    return NominalTimeNs(frame_index, clock_.rate_hz).value_or(kNoTimeNs);
  }

  void Judge(GrayImage image, SequenceFrame& frame) {
    const std::string what = fmt::format("{}: frame {}", info_.path.string(), frame.frame_index);
    if (image.empty()) {
      frame.problem = ImageProblem::kUnreadable;
      frame.problem_text = what + " cannot be decoded";
    } else if (frame.timestamp_ns <= last_time_ns_) {
      frame.problem = ImageProblem::kTimestampNotIncreasing;
      frame.problem_text =
          fmt::format("{}: its time {} ns does not increase", what, frame.timestamp_ns);
    } else if (image.width() != size_.width || image.height() != size_.height) {
      frame.problem = ImageProblem::kSizeDiffers;
      frame.problem_text = fmt::format("{} is {}x{} pixels, the sequence {}x{}", what,
                                       image.width(), image.height(), size_.width, size_.height);
    } else {
      last_time_ns_ = frame.timestamp_ns;
      frame.image = std::move(image);
    }
  }

  SequenceInfo info_;
  VideoReader reader_;
  VideoClock clock_;
  ImageSize size_;
  SequenceOptions options_;
  std::int64_t system_minus_steady_ns_;
  std::int64_t next_index_ = 0;
  std::int64_t last_time_ns_ = kNoTimeNs;
  int num_undecodable_ = 0;
  bool ended_ = false;
};

// Reads up to the first image that decodes; throws InputError when there is none.
ImageSize ReadFirstImage(VideoReader& reader, const std::string& source) {
  GrayImage image;
  for (int i = 0; i <= kMaxUndecodableInARow; ++i) {
    const VideoReader::ReadStatus status = reader.Read(image);
    if (status == VideoReader::ReadStatus::kEnd) break;
    if (status == VideoReader::ReadStatus::kImage) {
      return {image.width(), image.height(), "the first image of " + source};
    }
  }
  throw InputError(fmt::format("{}: no image can be read from it", source));
}

VideoReader OpenVideoFile(const std::string& file) {
  std::string why;
  std::optional<VideoReader> reader = VideoReader::OpenFile(file, &why);
  if (!reader) throw InputError(why);
  return std::move(*reader);
}

// `probe` has just read the first image.
VideoClock ChooseClock(VideoReader& probe, const std::string& file, const SequenceOptions& options,
                       std::vector<std::string>& warnings) {
  if (options.frame_rate_hz > 0.0) return {TimeSource::kNominalRate, options.frame_rate_hz};
  const auto first_ns = probe.ContainerTimeNs();
  const double rate_hz = probe.FrameRateHz();
  if (probe.Skip() && first_ns && probe.ContainerTimeNs() > first_ns) {
    return {TimeSource::kContainer, rate_hz};
  }
  if (rate_hz > 0.0) return {TimeSource::kNominalRate, rate_hz};
  warnings.push_back(
      fmt::format("{}: it has no frame rate; {} frames/s are assumed", file, kNominalRateHz));
  return {TimeSource::kNominalRate, kNominalRateHz};
}

std::int64_t CountSelected(std::int64_t num_frames, const SequenceOptions& options) {
  const std::int64_t last =
      options.last < 0 ? num_frames - 1 : std::min(options.last, num_frames - 1);
  return last < options.first ? 0 : (last - options.first) / options.step + 1;
}

// The frames at their nominal times, for pairing them with a truth. A container may claim any
// number of them, so they are not listed.
TruthFrames FramesOf(const VideoReader& reader, const VideoClock& clock) {
  const double rate_hz = clock.rate_hz > 0.0 ? clock.rate_hz : kNominalRateHz;
  TruthFrames frames;
  frames.count = reader.NumFrames();
  frames.time_ns = [rate_hz, count = frames.count](std::int64_t frame_index) {
    const bool past_end = count && frame_index >= *count;
    return past_end ? std::nullopt : NominalTimeNs(frame_index, rate_hz);
  };
  if (!frames.count) return frames;
  constexpr std::int64_t kLatestNs = std::numeric_limits<std::int64_t>::max();
  frames.range = TimeRange{0, NominalTimeNs(*frames.count - 1, rate_hz).value_or(kLatestNs)};
  return frames;
}

std::optional<Camera> ReadCameraBeside(const fs::path& video) {
  for (const char* extension : {".yaml", ".yml"}) {
    const fs::path file = fs::path(video).replace_extension(extension);
    if (fs::is_regular_file(file)) return ReadCameraFile(file);
  }
  const auto file = FindCameraFile(video.parent_path());
  return file ? std::optional<Camera>(ReadCameraFile(*file)) : std::nullopt;
}

}  // namespace

std::unique_ptr<Sequence> OpenVideoSequence(const std::string& file,
                                            const SequenceOptions& options) {
  if (!fs::is_regular_file(file)) throw InputError(fmt::format("{}: no such video file", file));
  SequenceInfo info;
  info.path = NormalPath(file);
  info.name = info.path.stem().string();
  info.format = SequenceFormat::kVideo;
  std::optional<Camera> camera = ReadGivenCamera(options);
  if (!camera) camera = ReadCameraBeside(info.path);

  VideoReader probe = OpenVideoFile(file);
  const ImageSize size = ReadFirstImage(probe, file);
  const VideoClock clock = ChooseClock(probe, file, options, info.warnings);
  info.camera = FinishCamera(
      camera, size, clock.rate_hz, file,
      fs::path(info.path).replace_extension(".yaml").string() + ", camera.yaml beside it", options);
  if (const auto num_frames = probe.NumFrames()) {
    info.num_frames = CountSelected(*num_frames, options);
    if (*info.num_frames == 0) {
      throw InputError(fmt::format("{}: the range {}:{}:{} selects none of its {} frames", file,
                                   options.first, options.last, options.step, *num_frames));
    }
  }
  if (options.ground_truth_file) {
    info.ground_truth = LoadGroundTruth({}, FramesOf(probe, clock), options, info.warnings);
  }
  // Opened anew, as not every container can be wound back.
  return std::make_unique<VideoSequence>(std::move(info), OpenVideoFile(file), clock, size,
                                         options);
}

std::unique_ptr<Sequence> OpenLiveSequence(const std::string& source,
                                           const SequenceOptions& options) {
  std::string why;
  std::optional<VideoReader> reader = VideoReader::OpenCamera(source, &why);
  if (!reader) throw InputError(why);
  const ImageSize size = ReadFirstImage(*reader, source);
  SequenceInfo info;
  info.path = source;
  info.name = "camera";
  info.format = SequenceFormat::kLiveCamera;
  info.camera = FinishCamera(ReadGivenCamera(options), size, reader->FrameRateHz(),
                             "the camera " + source, "nothing, for a live camera", options);
  return std::make_unique<VideoSequence>(std::move(info), std::move(*reader),
                                         VideoClock{TimeSource::kArrival, 0.0}, size, options);
}

}  // namespace lift_slam
