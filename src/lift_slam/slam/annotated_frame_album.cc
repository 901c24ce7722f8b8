#include "lift_slam/slam/annotated_frame_album.h"

#include <algorithm>

namespace lift_slam {
namespace {

constexpr std::size_t kMaxSpaced = 12, kMaxSpecial = 4;

AnnotatedFrame Annotate(const PreparedFrame& prepared, const FrameRecord& record,
                        const std::vector<int>& tracked_features) {
  AnnotatedFrame frame;
  frame.frame_index = record.frame_index;
  frame.image = prepared.input.image;
  frame.state = record.state;
  for (int i = 0; i < prepared.features->size(); ++i) {
    const Keypoint& keypoint = prepared.features->keypoint(i);
    frame.marks.push_back({keypoint.x, keypoint.y, false});
  }
  for (const int i : tracked_features) frame.marks[static_cast<std::size_t>(i)].tracked = true;
  return frame;
}

}  // namespace

void AnnotatedFrameAlbum::Offer(const PreparedFrame& prepared, const FrameRecord& record,
                                const std::vector<int>& tracked_features) {
  const bool changed = record.state != previous_state_;
  previous_state_ = record.state;
  if (!prepared.features) return;
  if (changed && special_.size() < kMaxSpecial) {
    special_.push_back(Annotate(prepared, record, tracked_features));
    return;
  }
  if (offered_++ % stride_ != 0) return;
  spaced_.push_back(Annotate(prepared, record, tracked_features));
  if (spaced_.size() <= kMaxSpaced) return;
  for (std::size_t i = 1; 2 * i < spaced_.size(); ++i) spaced_[i] = std::move(spaced_[2 * i]);
  spaced_.resize((spaced_.size() + 1) / 2);
  stride_ *= 2;
}

std::vector<AnnotatedFrame> AnnotatedFrameAlbum::Take() {
  std::vector<AnnotatedFrame> all = std::move(spaced_);
  std::move(special_.begin(), special_.end(), std::back_inserter(all));
  std::sort(all.begin(), all.end(), [](const AnnotatedFrame& a, const AnnotatedFrame& b) {
    return a.frame_index < b.frame_index;
  });
  return all;
}

}  // namespace lift_slam
