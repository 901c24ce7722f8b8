#pragma once

#include <memory>
#include <optional>

#include "lift_slam/camera/camera.h"
#include "lift_slam/camera/undistortion.h"
#include "lift_slam/features/feature_extractor.h"
#include "lift_slam/image/image.h"
#include "lift_slam/image/impulse_noise.h"
#include "lift_slam/map/frame.h"
#include "lift_slam/tracking/tracking_state.h"

namespace lift_slam {

// One image of the input, or the reason why there is none.
struct InputFrame {
  std::int64_t frame_index = -1;  // in the source sequence
  std::int64_t timestamp_ns = 0;
  GrayImage image;  // empty when refused
  FrameRefusal refusal = FrameRefusal::kNone;
};

// An input frame with its features, ready for tracking.
struct PreparedFrame {
  InputFrame input;
  std::shared_ptr<const FrameFeatures> features;  // null when refused
  std::shared_ptr<const ImagePyramid> pyramid;    // null when refused or not needed
  int num_impulses = 0;                           // pixels of noise taken out of the image
  double extract_ms = 0.0;

  Frame MakeFrame() const;
};

// Image to features: takes salt-and-pepper noise out, extracts and undistorts. Knows nothing of the
// map, so it may run ahead in a thread of its own; one object serves one thread.
class FramePreparer {
 public:
  FramePreparer(const Camera& camera, std::unique_ptr<FeatureExtractor> extractor,
                const PatchAlignmentOptions& alignment = {},
                const ImpulseNoiseOptions& impulse_noise = {});

  PreparedFrame Prepare(InputFrame input);
  const std::shared_ptr<const ViewModel>& view() const { return view_; }

 private:
  std::unique_ptr<FeatureExtractor> extractor_;
  std::shared_ptr<const ViewModel> view_;
  ImpulseNoiseOptions impulse_noise_;
  PyramidShape pyramid_shape_;
};

}  // namespace lift_slam
