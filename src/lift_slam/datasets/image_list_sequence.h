#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "lift_slam/datasets/image_list.h"
#include "lift_slam/datasets/sequence.h"

namespace lift_slam {

struct PlannedFrame {
  ListedImage image;
  bool time_increases = true;
};

// The images of a list, decoded one a call.
class ImageListSequence : public Sequence {
 public:
  // All images must have `width` x `height`; others come without image.
  ImageListSequence(SequenceInfo info, std::vector<PlannedFrame> frames, int width, int height);

  std::optional<SequenceFrame> Next() override;
  const SequenceInfo& info() const override { return info_; }

 private:
  SequenceInfo info_;
  std::vector<PlannedFrame> frames_;
  int width_, height_;
  std::size_t next_ = 0;
};

// Opens one of the folder layouts. Throws InputError as OpenSequence does.
std::unique_ptr<Sequence> OpenImageListSequence(const std::string& source, SequenceFormat format,
                                                const SequenceOptions& options);

}  // namespace lift_slam
