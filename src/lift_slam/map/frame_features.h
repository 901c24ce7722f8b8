#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "lift_slam/features/feature_extractor.h"
#include "lift_slam/map/view_model.h"

namespace lift_slam {

// The features of one image with their undistorted pixels, sorted into a grid for look-up by place.
// Never changes after construction; frames and keyframes share it.
class FrameFeatures {
 public:
  // `undistorted[i]` is the ideal-pinhole pixel of features.keypoints[i].
  FrameFeatures(FeatureSet features, std::vector<Eigen::Vector2f> undistorted,
                const ViewModel& view);

  int size() const { return static_cast<int>(features_.keypoints.size()); }
  const Keypoint& keypoint(int i) const { return features_.keypoints[Index(i)]; }
  int level(int i) const { return features_.keypoints[Index(i)].level; }
  const Eigen::Vector2f& undistorted(int i) const { return undistorted_[Index(i)]; }
  Eigen::Vector2d pixel(int i) const { return undistorted_[Index(i)].cast<double>(); }
  DescriptorView descriptor(int i) const { return features_.descriptors.row(Index(i)); }
  const DescriptorKind& descriptor_kind() const { return features_.descriptors.kind(); }
  const Descriptors& descriptors() const { return features_.descriptors; }

  // Calls visit(i) for the features whose undistorted pixel lies in the square of half side
  // `radius_px` around (x, y); by grid cell, in order of index within a cell.
  template <class Visit>
  void ForEachInSquare(float x, float y, float radius_px, Visit visit) const {
    const int first_column = Column(x - radius_px), last_column = Column(x + radius_px);
    const int first_row = Row(y - radius_px), last_row = Row(y + radius_px);
    for (int row = first_row; row <= last_row; ++row) {
      for (int i : CellRange(row, first_column, last_column)) {
        const Eigen::Vector2f& p = undistorted_[Index(i)];
        if (std::abs(p.x() - x) <= radius_px && std::abs(p.y() - y) <= radius_px) visit(i);
      }
    }
  }

  // Calls visit(i) for all features in grid cells touched by the band of half width `margin_px`
  // around the segment a to b; a feature near the band's border may come along.
  template <class Visit>
  void ForEachNearSegment(const Eigen::Vector2f& a, const Eigen::Vector2f& b, float margin_px,
                          Visit visit) const {
    const int first_row = Row(std::min(a.y(), b.y()) - margin_px);
    const int last_row = Row(std::max(a.y(), b.y()) + margin_px);
    for (int row = first_row; row <= last_row; ++row) {
      const auto [x0, x1] = SegmentSpanInRow(a, b, margin_px, row);
      if (x0 > x1) continue;
      for (int i : CellRange(row, Column(x0), Column(x1))) visit(i);
    }
  }

 private:
  static std::size_t Index(int i) { return static_cast<std::size_t>(i); }
  int Column(float x) const;
  int Row(float y) const;
  std::span<const int> CellRange(int row, int first_column, int last_column) const;
  // Range of x that the band around the segment covers within a row of cells.
  std::pair<float, float> SegmentSpanInRow(const Eigen::Vector2f& a, const Eigen::Vector2f& b,
                                           float margin_px, int row) const;

  FeatureSet features_;
  std::vector<Eigen::Vector2f> undistorted_;
  float min_x_, min_y_;
  int columns_, rows_;
  std::vector<int> cell_begin_;  // rows_ * columns_ + 1 offsets into cell_items_
  std::vector<int> cell_items_;
};

}  // namespace lift_slam
