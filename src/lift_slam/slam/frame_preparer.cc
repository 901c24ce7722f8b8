#include "lift_slam/slam/frame_preparer.h"

#include <algorithm>

#include "lift_slam/util/timer.h"

namespace lift_slam {
namespace {

// Takes away the rows that have no undistorted pixel.
FeatureSet KeepRows(const FeatureSet& features, const std::vector<std::size_t>& rows) {
  FeatureSet kept;
  kept.descriptors = Descriptors(features.descriptors.kind(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    kept.keypoints.push_back(features.keypoints[rows[i]]);
    std::ranges::copy(features.descriptors.row(rows[i]), kept.descriptors.mutable_row(i).begin());
  }
  return kept;
}

std::shared_ptr<const ViewModel> MakeView(const Camera& camera, const FeatureExtractor& extractor) {
  const UndistortedBounds bounds = FindUndistortedBounds(camera);
  return std::make_shared<const ViewModel>(
      MakeViewModel(camera.pinhole, {bounds.min_x, bounds.max_x, bounds.min_y, bounds.max_y},
                    extractor.scale_levels(), extractor.thresholds()));
}

}  // namespace

FramePreparer::FramePreparer(const Camera& camera, std::unique_ptr<FeatureExtractor> extractor)
    : undistortion_(camera),
      extractor_(std::move(extractor)),
      view_(MakeView(camera, *extractor_)) {}

PreparedFrame FramePreparer::Prepare(InputFrame input) {
  PreparedFrame prepared;
  const Timer timer;
  if (input.refusal == FrameRefusal::kNone) {
    FeatureSet features = extractor_->Extract(input.image);
    std::vector<Eigen::Vector2f> undistorted;
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < features.keypoints.size(); ++i) {
      const Keypoint& keypoint = features.keypoints[i];
      const auto pixel =
          undistortion_.Undistort(Eigen::Vector2f(keypoint.x, keypoint.y).cast<double>());
      if (!pixel) continue;
      undistorted.push_back(pixel->cast<float>());
      rows.push_back(i);
    }
    if (rows.size() < features.keypoints.size()) features = KeepRows(features, rows);
    prepared.features =
        std::make_shared<const FrameFeatures>(std::move(features), std::move(undistorted), *view_);
  }
  prepared.input = std::move(input);
  prepared.extract_ms = timer.ElapsedMs();
  return prepared;
}

}  // namespace lift_slam
