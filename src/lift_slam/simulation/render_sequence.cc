#include "lift_slam/simulation/render_sequence.h"

#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "lift_slam/simulation/frame_capture.h"
#include "lift_slam/simulation/frame_workers.h"
#include "lift_slam/simulation/scene_watch.h"
#include "lift_slam/simulation/sequence_folder.h"
#include "lift_slam/util/check.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

constexpr std::string_view kDepthFormatNames[] = {"png16", "tiff32"};

std::vector<std::uint8_t> EncodePng(const ByteImage& image) {
  const int type = image.channels == 1 ? CV_8UC1 : CV_8UC3;
  // OpenCV does not write to what it encodes.
  cv::Mat mat(image.height, image.width, type, const_cast<std::uint8_t*>(image.values.data()));
  if (image.channels == 3) cv::cvtColor(mat, mat, cv::COLOR_RGB2BGR);
  std::vector<std::uint8_t> bytes;
  LIFT_SLAM_CHECK(cv::imencode(".png", mat, bytes, {cv::IMWRITE_PNG_COMPRESSION, 3}),
                  "an image of {}x{} cannot be encoded", image.width, image.height);
  return bytes;
}

class Rendering {
 public:
  Rendering(const std::filesystem::path& root, const SequenceRequest& request)
      : folder_(root), request_(request), watch_(world_from_cam_) {}

  RenderSummary Run(const RenderWork& work) {
    folder_.WriteMotion(request_.camera, TimesFromZero(), world_from_cam_);
    const int done = RunFrameWorkers({static_cast<int>(world_from_cam_.size()), work.num_threads,
                                      [&] { return MakeTask(work); }, work.progress, work.stop});
    const bool stopped = done < static_cast<int>(world_from_cam_.size());
    if (!stopped && request_.outputs.pairs) WritePairs();
    return {done, num_rendered_.load(), stopped};
  }

 private:
  std::vector<std::int64_t> TimesFromZero() const {
    std::vector<std::int64_t> times = request_.times_ns;
    for (std::int64_t& time_ns : times) time_ns -= request_.times_ns.front();
    return times;
  }

  FrameTask MakeTask(const RenderWork& work) {
    // Made at the first frame that is needed: a finished sequence costs no renderer.
    auto source = std::make_shared<ViewSource>();
    return [this, &work, source](int frame) {
      if (IsThere(frame)) {
        watch_.Tell(frame, false);
        return;
      }
      if (!*source) *source = work.make_view_source();
      Render(frame, *source);
    };
  }

  bool IsThere(int frame) const {
    const SequenceOutputOptions& outputs = request_.outputs;
    return IsWholeImage(folder_.Gray(frame)) &&
           (!outputs.color || IsWholeImage(folder_.Color(frame))) &&
           (!outputs.depth || IsWholeImage(folder_.Depth(frame, outputs.depth_format)));
  }

  void Render(int frame, const ViewSource& source) {
    const SequenceOutputOptions& outputs = request_.outputs;
    const double time_s =
        static_cast<double>(request_.times_ns[static_cast<std::size_t>(frame)]) * 1e-9;
    CapturedFrame captured = CaptureFrame(source, request_.motion, request_.sensor,
                                          outputs.color ? ImageColor::kRgb : ImageColor::kGray,
                                          request_.seed, frame, time_s);
    watch_.Tell(frame, std::all_of(captured.depth_m.begin(), captured.depth_m.end(),
                                   [](float depth) { return depth <= 0.0F; }));
    if (captured.color) WriteBytesAtomically(folder_.Color(frame), EncodePng(*captured.color));
    if (outputs.depth) {
      const DepthImage depth{captured.gray.width, captured.gray.height,
                             std::move(captured.depth_m)};
      WriteBytesAtomically(folder_.Depth(frame, outputs.depth_format),
                           EncodeDepth(depth, outputs.depth_format));
    }
    WriteBytesAtomically(folder_.Gray(frame), EncodePng(captured.gray));
    ++num_rendered_;
  }

  void WritePairs() const {
    const auto read = [this](int frame) {
      return ReadDepth(folder_.Depth(frame, request_.outputs.depth_format));
    };
    WriteTextAtomically(folder_.Pairs(), PairsText(ListPairs(request_.camera, world_from_cam_, read,
                                                             request_.pairs, request_.seed)));
  }

  SequenceFolder folder_;
  const SequenceRequest& request_;
  const std::vector<Rigid3d> world_from_cam_ = FramePoses(request_);
  EmptyFrameWatch watch_;
  std::atomic<int> num_rendered_ = 0;
};

}  // namespace

void SequenceOutputOptions::Visit(OptionVisitor& visitor) {
  visitor.Field("color", color, "colour images (image_2) as well");
  visitor.Field("depth", depth, "exact depth (depth_0)");
  visitor.Field("depth_format", depth_format, kDepthFormatNames,
                "png16: 256 a metre, none beyond 255.99 m; tiff32: metres");
  visitor.Field("pairs", pairs, "list of pairs for training (pairs.txt); needs depth");
}

void SequenceOutputOptions::Check() const {
  if (pairs && !depth) {
    throw InputError("outputs.pairs needs outputs.depth: the overlap is found from the depth");
  }
}

std::vector<Rigid3d> FramePoses(const SequenceRequest& request) {
  std::vector<Rigid3d> poses;
  for (const std::int64_t time_ns : request.times_ns) {
    poses.push_back(request.motion.WorldFromCam(static_cast<double>(time_ns) * 1e-9));
  }
  CheckInsideScene(poses, request.scene_box);
  return poses;
}

std::vector<std::int64_t> FrameTimesNs(double duration_s, double rate_hz) {
  std::vector<std::int64_t> times;
  const auto count = static_cast<std::int64_t>(std::floor(duration_s * rate_hz + 1e-9)) + 1;
  for (std::int64_t i = 0; i < count; ++i) {
    times.push_back(std::llround(static_cast<double>(i) * 1e9 / rate_hz));
  }
  return times;
}

RenderSummary RenderSequence(const std::filesystem::path& root, const SequenceRequest& request,
                             const RenderWork& work) {
  LIFT_SLAM_CHECK(!request.times_ns.empty() && request.motion.DurationS() >= 0.0, "no frames");
  Rendering rendering(root, request);
  SequenceFolder(root).Create(request.outputs.color, request.outputs.depth);
  return rendering.Run(work);
}

}  // namespace lift_slam
