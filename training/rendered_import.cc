#include "training/rendered_import.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "lift_slam/datasets/sequence.h"
#include "lift_slam/geometry/trajectory_io.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/option_range.h"
#include "training/folder_name.h"
#include "training/sift_keypoints.h"

namespace lift_slam::training {
namespace {

struct RenderedFrame {
  GrayImage image;
  cv::Mat depth_m;  // CV_32FC1, 0: none
  Rigid3d world_from_cam;
  std::vector<View> keypoints;
  std::uint32_t number = 0;  // in the training set
};

cv::Mat ReadDepthM(const std::filesystem::path& folder, std::size_t frame) {
  constexpr double kUnitsPerM = 256.0;  // of 16-bit files (simulation/depth_file.h)
  const std::string stem = fmt::format("{:06}", frame);
  std::filesystem::path path = folder / (stem + ".png");
  if (!std::filesystem::exists(path)) path = folder / (stem + ".tiff");
  cv::Mat depth = cv::imread(path.string(), cv::IMREAD_UNCHANGED);
  if (depth.empty() || (depth.type() != CV_16UC1 && depth.type() != CV_32FC1)) {
    throw InputError(
        fmt::format("{}: is missing or no depth image ('lift_slam render --depth' "
                    "writes them)",
                    path.string()));
  }
  if (depth.type() == CV_16UC1) depth.convertTo(depth, CV_32FC1, 1.0 / kUnitsPerM);
  return depth;
}

// The partners of each frame, of pairs.txt in both directions.
std::vector<std::vector<std::size_t>> ReadPartners(const std::filesystem::path& path,
                                                   std::size_t num_frames) {
  std::vector<std::vector<std::size_t>> partners(num_frames);
  const std::vector<std::string> lines = ReadLines(path);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].empty() || lines[i][0] == '#') continue;
    std::istringstream line(lines[i]);
    std::size_t first = 0, second = 0;
    if (!(line >> first >> second) || first >= num_frames || second >= num_frames) {
      throw InputError(fmt::format("{}:{}: expected the numbers of two of the {} frames",
                                   path.string(), i + 1, num_frames));
    }
    partners[first].push_back(second);
    partners[second].push_back(first);
  }
  return partners;
}

template <class T>
void Shuffle(std::vector<T>& values, Random& random) {
  for (std::size_t i = values.size(); i > 1; --i) {
    std::swap(values[i - 1],
              values[static_cast<std::size_t>(random.UniformInt(0, static_cast<int>(i) - 1))]);
  }
}

// Depth at the pixel nearest to a place; 0 outside.
double DepthAt(const RenderedFrame& frame, double x, double y) {
  const auto column = static_cast<int>(std::lround(x)), row = static_cast<int>(std::lround(y));
  if (column < 0 || row < 0 || column >= frame.depth_m.cols || row >= frame.depth_m.rows) return 0;
  return frame.depth_m.at<float>(row, column);
}

class RenderedSequence {
 public:
  RenderedSequence(const std::filesystem::path& folder, const RenderedOptions& options);

  void AddTo(const ImageOrigin& origin, const ImportProgress& progress, TrainingSetWriter& writer);

 private:
  void AddPointsOf(std::size_t frame, TrainingSetWriter& writer);
  // The keypoint of another frame that shows the same point, if any.
  const View* Corresponding(const RenderedFrame& from, const View& view, const RenderedFrame& to,
                            const KeypointGrid& to_grid) const;

  std::filesystem::path folder_;
  RenderedOptions options_;
  Random random_;
  Camera camera_;
  std::vector<RenderedFrame> frames_;
  std::vector<KeypointGrid> grids_;
  std::vector<std::vector<std::size_t>> partners_;
};

RenderedSequence::RenderedSequence(const std::filesystem::path& folder,
                                   const RenderedOptions& options)
    : folder_(folder), options_(options), random_(static_cast<std::uint64_t>(options.seed)) {
  const std::filesystem::path sequence_folder = folder / "sequences" / "00";
  const auto sequence = OpenSequence(sequence_folder.string());
  camera_ = *sequence->info().camera;
  const Trajectory poses = ReadTrajectory(folder / "poses" / "00.txt").trajectory;
  while (auto frame = sequence->Next()) {
    const std::size_t i = frames_.size();
    if (!frame->image || i >= poses.size()) {
      throw InputError(fmt::format("{}: frame {} has no image or no pose", folder.string(), i));
    }
    RenderedFrame rendered{
        *frame->image, ReadDepthM(sequence_folder / "depth_0", i), poses[i].world_from_cam, {}, 0};
    rendered.keypoints = DetectSift(rendered.image, options.min_sigma, options.max_keypoints);
    frames_.push_back(std::move(rendered));
  }
  for (const RenderedFrame& frame : frames_) {
    grids_.emplace_back(frame.keypoints, frame.image.width(), frame.image.height());
  }
  partners_ = ReadPartners(folder / "pairs.txt", frames_.size());
}

const View* RenderedSequence::Corresponding(const RenderedFrame& from, const View& view,
                                            const RenderedFrame& to,
                                            const KeypointGrid& to_grid) const {
  const double depth = DepthAt(from, view.x, view.y);
  const auto ray = camera_.Unproject({view.x, view.y});
  if (depth <= 0.0 || !ray || ray->z() <= 0.0) return nullptr;
  const Eigen::Vector3d x_in_to =
      Inverse(to.world_from_cam) * (from.world_from_cam * (*ray * (depth / ray->z())));
  const auto pixel = camera_.Project(x_in_to);
  if (!pixel || x_in_to.z() <= 0.0) return nullptr;
  const double seen = DepthAt(to, pixel->x(), pixel->y());
  if (std::abs(seen - x_in_to.z()) > options_.max_depth_difference * x_in_to.z()) return nullptr;
  return to_grid.Find(pixel->x(), pixel->y(), view.sigma * depth / x_in_to.z());
}

void RenderedSequence::AddPointsOf(std::size_t frame, TrainingSetWriter& writer) {
  const RenderedFrame& reference = frames_[frame];
  std::vector<std::size_t> partners = partners_[frame];
  Shuffle(partners, random_);
  if (std::ssize(partners) > options_.max_partners) {
    partners.resize(static_cast<std::size_t>(options_.max_partners));
  }
  std::vector<View> keypoints = reference.keypoints;
  Shuffle(keypoints, random_);
  int added = 0;
  for (const View& keypoint : keypoints) {
    std::vector<View> views = {keypoint};
    views[0].image = reference.number;
    for (const std::size_t partner : partners) {
      const View* other = Corresponding(reference, keypoint, frames_[partner], grids_[partner]);
      if (other == nullptr) continue;
      views.push_back(*other);
      views.back().image = frames_[partner].number;
    }
    if (views.size() < 2) continue;
    writer.AddPoint(views);
    if (++added == options_.max_points) break;
  }
}

void RenderedSequence::AddTo(const ImageOrigin& origin, const ImportProgress& progress,
                             TrainingSetWriter& writer) {
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    ImageOrigin image_origin = origin;
    image_origin.name = fmt::format("{}/{:06}", FolderName(folder_), i);
    frames_[i].number = writer.AddImage(frames_[i].image, image_origin);
  }
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    AddPointsOf(i, writer);
    for (View& place :
         EmptyPlaces(frames_[i].image, frames_[i].keypoints, options_.max_empty_places, random_)) {
      place.image = frames_[i].number;
      writer.AddEmptyPlace(place);
    }
    progress(static_cast<int>(i) + 1, static_cast<int>(frames_.size()), writer.num_points());
  }
}

}  // namespace

void RenderedOptions::Visit(OptionVisitor& visitor) {
  visitor.Field("min_sigma", min_sigma, "of keypoints, pixels");
  visitor.Field("max_keypoints", max_keypoints, "of a frame, the strongest");
  visitor.Field("max_points", max_points, "of a reference frame");
  visitor.Field("max_partners", max_partners, "frames that a reference frame is related to");
  visitor.Field("max_depth_difference", max_depth_difference, "a share; more is an occlusion");
  visitor.Field("max_empty_places", max_empty_places, "of a frame");
  visitor.Field("seed", seed, "of the choices");
}

void RenderedOptions::Check() const {
  CheckOptionRange("rendered.min_sigma", min_sigma, 0.5, 50.0);
  CheckOptionRange("rendered.max_keypoints", max_keypoints, 1, 1000000);
  CheckOptionRange("rendered.max_points", max_points, 1, 1000000);
  CheckOptionRange("rendered.max_partners", max_partners, 1, 1000);
  CheckOptionRange("rendered.max_depth_difference", max_depth_difference, 0.0, 1.0);
  CheckOptionRange("rendered.max_empty_places", max_empty_places, 0, 1000000);
}

void ImportRendered(const std::filesystem::path& folder, const ImageOrigin& origin,
                    const RenderedOptions& options, const ImportProgress& progress,
                    TrainingSetWriter& writer) {
  options.Check();
  for (const char* part : {"poses/00.txt", "pairs.txt", "sequences/00/depth_0"}) {
    if (!std::filesystem::exists(folder / part)) {
      throw InputError(
          fmt::format("{}: is missing; expected what 'lift_slam render --depth "
                      "--pairs' writes",
                      (folder / part).string()));
    }
  }
  RenderedSequence(folder, options).AddTo(origin, progress, writer);
}

}  // namespace lift_slam::training
