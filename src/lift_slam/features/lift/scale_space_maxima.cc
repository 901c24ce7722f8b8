#include "lift_slam/features/lift/scale_space_maxima.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lift_slam {
namespace {

constexpr int kWindow = 2 * kMaximumRadius + 1;

// Rows of the largest of 7 scores side by side, as many as a window is high; the compiler takes
// several columns at once.
class RowMaxima {
 public:
  // For windows whose first columns are `count` columns of the level.
  explicit RowMaxima(int count) : count_(static_cast<std::size_t>(count)) {
    for (std::vector<float>& row : rows_) row.resize(count_);
    pairs_.resize(count_ + kWindow - 1);
    fours_.resize(count_ + kWindow - 1);
    window_.resize(count_);
  }

  // scores[0] is the first column; there are count + 6.
  void SetRow(int y, const float* scores) {
    const auto larger = [](float a, float b) { return a > b ? a : b; };
    float* pairs = pairs_.data();
    float* fours = fours_.data();
    float* target = rows_[static_cast<std::size_t>(y % kWindow)].data();
    for (std::size_t i = 0; i < count_ + 5; ++i) pairs[i] = larger(scores[i], scores[i + 1]);
    for (std::size_t i = 0; i < count_ + 3; ++i) fours[i] = larger(pairs[i], pairs[i + 2]);
    for (std::size_t i = 0; i < count_; ++i) target[i] = larger(fours[i], fours[i + 3]);
  }

  // The largest score of each window over the last 7 rows set.
  const float* WindowMaxima() {
    float* window = window_.data();
    std::copy(rows_[0].begin(), rows_[0].end(), window);
    for (std::size_t r = 1; r < rows_.size(); ++r) {
      const float* row = rows_[r].data();
      for (std::size_t i = 0; i < count_; ++i) window[i] = window[i] > row[i] ? window[i] : row[i];
    }
    return window;
  }

 private:
  std::size_t count_;
  std::array<std::vector<float>, kWindow> rows_;
  std::vector<float> pairs_, fours_, window_;
};

bool IsOnlyMaximum(const ScoreLevel& level, int x, int y) {
  const float score = level.row(y)[x];
  int as_large = 0;
  for (int v = y - kMaximumRadius; v <= y + kMaximumRadius; ++v) {
    const float* row = level.row(v);
    for (int u = x - kMaximumRadius; u <= x + kMaximumRadius; ++u) as_large += row[u] >= score;
  }
  return as_large == 1;
}

// Whether some score within the window is as large; what lies outside the map is not.
bool HasAsLarge(const ScoreLevel& level, int x, int y, float score) {
  const int begin_x = std::max(x - kMaximumRadius, level.border);
  const int begin_y = std::max(y - kMaximumRadius, level.border);
  const int end_x = std::min(x + kMaximumRadius + 1, level.border + level.width);
  const int end_y = std::min(y + kMaximumRadius + 1, level.border + level.height);
  for (int v = begin_y; v < end_y; ++v) {
    const float* row = level.row(v);
    for (int u = begin_x; u < end_x; ++u) {
      if (row[u] >= score) return true;
    }
  }
  return false;
}

}  // namespace

void AppendSpaceMaxima(const ScoreLevel& level, int level_index, int first_row, int end_row,
                       std::vector<ScorePeak>& peaks) {
  const int count = level.width - 2 * kMaximumRadius;
  const int begin = std::max(first_row, level.border + kMaximumRadius);
  const int end = std::min(end_row, level.border + level.height - kMaximumRadius);
  if (count <= 0 || begin >= end) return;
  RowMaxima maxima(count);
  const auto set_row = [&](int y) { maxima.SetRow(y, level.row(y) + level.border); };
  for (int y = begin - kMaximumRadius; y < begin + kMaximumRadius; ++y) set_row(y);
  for (int y = begin; y < end; ++y) {
    set_row(y + kMaximumRadius);
    const float* window = maxima.WindowMaxima();
    const int first_x = level.border + kMaximumRadius;
    const float* scores = level.row(y) + first_x;
    for (int i = 0; i < count; ++i) {
      if (scores[i] == window[i] && IsOnlyMaximum(level, first_x + i, y)) {
        peaks.push_back({level_index, first_x + i, y});
      }
    }
  }
}

bool IsScaleMaximum(std::span<const ScoreLevel> levels, const ScorePeak& peak, int num_neighbours,
                    LevelCoordinates how) {
  const auto count = static_cast<int>(levels.size());
  if (peak.level < num_neighbours || peak.level + num_neighbours >= count) return false;
  const ScoreLevel& own = levels[static_cast<std::size_t>(peak.level)];
  const float score = own.At(peak.x, peak.y);
  for (int i = peak.level - num_neighbours; i <= peak.level + num_neighbours; ++i) {
    if (i == peak.level) continue;
    const ScoreLevel& other = levels[static_cast<std::size_t>(i)];
    const LevelPosition there = ToLevel(
        own.shape, other.shape, {static_cast<double>(peak.x), static_cast<double>(peak.y)}, how);
    if (HasAsLarge(other, static_cast<int>(std::lround(there.x)),
                   static_cast<int>(std::lround(there.y)), score)) {
      return false;
    }
  }
  return true;
}

}  // namespace lift_slam
