#include "lift_slam/slam/frame_preparer.h"

#include <algorithm>
#include <cmath>

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

std::shared_ptr<const ViewModel> MakeView(const Camera& camera, const FeatureExtractor& extractor,
                                          const PatchAlignmentOptions& alignment) {
  const UndistortedBounds bounds = FindUndistortedBounds(camera);
  ViewModel view =
      MakeViewModel(camera.pinhole, {bounds.min_x, bounds.max_x, bounds.min_y, bounds.max_y},
                    extractor.scale_levels(), extractor.thresholds());
  view.alignment = alignment;
  if (extractor.has_fine_positions()) {
    view.alignment.max_residual = alignment.max_residual_of_fine;
  }
  view.undistortion = std::make_shared<const UndistortionMap>(camera);
  return std::make_shared<const ViewModel>(std::move(view));
}

// For patches of every scale of the features.
PyramidShape ShapeForPatches(const ViewModel& view) {
  PyramidShape shape;
  shape.min_size_px = 2 * ReferencePatch::kStoredSide;
  shape.num_levels =
      1 + static_cast<int>(std::ceil(std::log(view.scale.back()) / std::log(shape.scale_factor)));
  return shape;
}

}  // namespace

FramePreparer::FramePreparer(const Camera& camera, std::unique_ptr<FeatureExtractor> extractor,
                             const PatchAlignmentOptions& alignment,
                             const ImpulseNoiseOptions& impulse_noise)
    : extractor_(std::move(extractor)),
      view_(MakeView(camera, *extractor_, alignment)),
      impulse_noise_(impulse_noise),
      pyramid_shape_(ShapeForPatches(*view_)) {}

Frame PreparedFrame::MakeFrame() const {
  Frame frame(input.frame_index, input.timestamp_ns, features);
  frame.pyramid = pyramid;
  return frame;
}

PreparedFrame FramePreparer::Prepare(InputFrame input) {
  PreparedFrame prepared;
  const Timer timer;
  if (input.refusal == FrameRefusal::kNone) {
    if (impulse_noise_.remove) {
      const ImpulseNoiseResult clean = RemoveImpulseNoise(input.image, impulse_noise_);
      input.image = clean.image;
      prepared.num_impulses = clean.num_replaced;
    }
    FeatureSet features = extractor_->Extract(input.image);
    std::vector<Eigen::Vector2f> undistorted;
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < features.keypoints.size(); ++i) {
      const Keypoint& keypoint = features.keypoints[i];
      const auto pixel =
          view_->undistortion->Undistort(Eigen::Vector2f(keypoint.x, keypoint.y).cast<double>());
      if (!pixel) continue;
      undistorted.push_back(pixel->cast<float>());
      rows.push_back(i);
    }
    if (rows.size() < features.keypoints.size()) features = KeepRows(features, rows);
    prepared.features =
        std::make_shared<const FrameFeatures>(std::move(features), std::move(undistorted), *view_);
  }
  if (prepared.features && view_->alignment.enabled) {
    prepared.pyramid =
        std::make_shared<const ImagePyramid>(BuildPyramid(input.image, pyramid_shape_));
  }
  prepared.input = std::move(input);
  prepared.extract_ms = timer.ElapsedMs();
  return prepared;
}

}  // namespace lift_slam
