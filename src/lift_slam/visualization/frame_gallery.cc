#include "lift_slam/visualization/frame_gallery.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "lift_slam/visualization/annotate.h"
#include "lift_slam/visualization/xml_text.h"

namespace lift_slam {
namespace {

constexpr std::size_t kMaxFrames = 9;
constexpr int kMaxWidthPx = 640;

std::ptrdiff_t CountTracked(const AnnotatedFrame& frame) {
  return std::count_if(frame.marks.begin(), frame.marks.end(),
                       [](const AnnotatedFrame::Mark& mark) { return mark.tracked; });
}

// Index of the run's first tracked frame; -1: none.
std::int64_t FirstWithMap(const RunRecord& run) {
  for (const FrameRecord& frame : run.frames) {
    if (frame.state == TrackingState::kTracking) return frame.frame_index;
  }
  return -1;
}

// The frames of special interest, by their place in RunRecord::annotated_frames.
struct Special {
  std::optional<std::size_t> first_with_map, worst;
};

Special FindSpecial(const RunRecord& run) {
  const std::vector<AnnotatedFrame>& frames = run.annotated_frames;
  Special special;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (frames[i].state != TrackingState::kTracking) continue;
    if (frames[i].frame_index == FirstWithMap(run)) special.first_with_map = i;
    if (!special.worst || CountTracked(frames[i]) < CountTracked(frames[*special.worst])) {
      special.worst = i;
    }
  }
  return special;
}

std::set<std::size_t> Chosen(const std::vector<AnnotatedFrame>& frames, const Special& special) {
  std::set<std::size_t> chosen;
  if (special.first_with_map) chosen.insert(*special.first_with_map);
  if (special.worst) chosen.insert(*special.worst);
  const std::size_t wanted = std::min(kMaxFrames, frames.size());
  // Evenly spaced: the first, then ever finer, until enough are chosen.
  for (std::size_t parts = 1; chosen.size() < wanted; ++parts) {
    for (std::size_t k = 0; k <= parts && chosen.size() < wanted; ++k) {
      chosen.insert(k * (frames.size() - 1) / parts);
    }
  }
  return chosen;
}

std::string FrameHtml(const AnnotatedFrame& frame, const char* remark) {
  const cv::Mat picture = DrawTrackedPoints(frame, kMaxWidthPx);
  if (picture.empty()) return {};
  return fmt::format(
      "<figure><img alt=\"frame {0}\" width=\"{1}\" height=\"{2}\" "
      "src=\"{3}\"><figcaption><b>Frame "
      "{0}</b>{4} &middot; {5} &middot; {6} tracked, {7} unmatched</figcaption></figure>\n",
      frame.frame_index, picture.cols, picture.rows, JpegDataUri(picture, 78), remark,
      EscapeXml(Name(frame.state)), CountTracked(frame),
      static_cast<std::ptrdiff_t>(frame.marks.size()) - CountTracked(frame));
}

}  // namespace

std::string FrameGalleryHtml(const RunRecord& run) {
  const std::vector<AnnotatedFrame>& frames = run.annotated_frames;
  if (frames.empty()) return {};
  const Special special = FindSpecial(run);
  const bool wide = frames.front().image.width() > 2 * frames.front().image.height();
  std::string html =
      "<p class=\"note\"><i class=\"dot\" style=\"margin-left:0\"></i>tracked map point <i "
      "class=\"dot "
      "u\"></i>feature without a map point</p><br>\n";
  html += wide ? "<div class=\"frames wide-frames\">\n" : "<div class=\"frames\">\n";
  for (const std::size_t i : Chosen(frames, special)) {
    const char* remark = special.first_with_map == i ? ", first with the map"
                         : special.worst == i        ? ", fewest tracked points"
                                                     : "";
    html += FrameHtml(frames[i], remark);
  }
  return html + "</div>\n";
}

}  // namespace lift_slam
