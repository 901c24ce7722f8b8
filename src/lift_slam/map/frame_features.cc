#include "lift_slam/map/frame_features.h"

#include <cmath>

#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

constexpr float kCellSizePx = 20.0F;

}  // namespace

FrameFeatures::FrameFeatures(FeatureSet features, std::vector<Eigen::Vector2f> undistorted,
                             const ViewModel& view)
    : features_(std::move(features)),
      undistorted_(std::move(undistorted)),
      min_x_(static_cast<float>(view.min_x)),
      min_y_(static_cast<float>(view.min_y)),
      columns_(std::max(1, static_cast<int>(std::ceil((view.max_x - view.min_x) / kCellSizePx)))),
      rows_(std::max(1, static_cast<int>(std::ceil((view.max_y - view.min_y) / kCellSizePx)))) {
  LIFT_SLAM_CHECK(undistorted_.size() == features_.keypoints.size() &&
                      features_.descriptors.size() == features_.keypoints.size(),
                  "{} keypoints, {} undistorted, {} descriptors", features_.keypoints.size(),
                  undistorted_.size(), features_.descriptors.size());
  const std::size_t cells = Index(columns_) * Index(rows_);
  cell_begin_.assign(cells + 1, 0);
  const auto cell_of = [&](const Eigen::Vector2f& p) {
    return Index(Row(p.y())) * Index(columns_) + Index(Column(p.x()));
  };
  for (const auto& p : undistorted_) ++cell_begin_[cell_of(p) + 1];
  for (std::size_t c = 0; c < cells; ++c) cell_begin_[c + 1] += cell_begin_[c];
  std::vector<int> next(cell_begin_.begin(), cell_begin_.end() - 1);
  cell_items_.resize(undistorted_.size());
  for (int i = 0; i < size(); ++i) {
    cell_items_[Index(next[cell_of(undistorted_[Index(i)])]++)] = i;
  }
}

int FrameFeatures::Column(float x) const {
  return std::clamp(static_cast<int>(std::floor((x - min_x_) / kCellSizePx)), 0, columns_ - 1);
}

int FrameFeatures::Row(float y) const {
  return std::clamp(static_cast<int>(std::floor((y - min_y_) / kCellSizePx)), 0, rows_ - 1);
}

std::span<const int> FrameFeatures::CellRange(int row, int first_column, int last_column) const {
  const std::size_t begin = Index(row) * Index(columns_);
  const auto first = Index(cell_begin_[begin + Index(first_column)]);
  const auto last = Index(cell_begin_[begin + Index(last_column) + 1]);
  return {cell_items_.data() + first, last - first};
}

std::pair<float, float> FrameFeatures::SegmentSpanInRow(const Eigen::Vector2f& a,
                                                        const Eigen::Vector2f& b, float margin_px,
                                                        int row) const {
  const float top = min_y_ + kCellSizePx * static_cast<float>(row) - margin_px;
  const float bottom = top + kCellSizePx + 2.0F * margin_px;
  const Eigen::Vector2f d = b - a;
  float t0 = 0.0F, t1 = 1.0F;
  if (std::abs(d.y()) > 1e-6F) {
    const float u = (top - a.y()) / d.y(), v = (bottom - a.y()) / d.y();
    t0 = std::max(t0, std::min(u, v));
    t1 = std::min(t1, std::max(u, v));
  }
  if (t0 > t1) return {1.0F, 0.0F};
  const float x0 = a.x() + t0 * d.x(), x1 = a.x() + t1 * d.x();
  return {std::min(x0, x1) - margin_px, std::max(x0, x1) + margin_px};
}

}  // namespace lift_slam
