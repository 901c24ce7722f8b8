#pragma once

#include <span>
#include <vector>

#include "lift_slam/features/lift/scale_pyramid.h"

namespace lift_slam {

// A pixel of a level whose score beats all around it.
struct ScorePeak {
  int level = 0;  // position in the list of levels
  int x = 0, y = 0;
};

inline constexpr int kMaximumRadius = 3;  // of the window that a maximum rules, pixels of the level

// Appends the pixels of rows [first_row, end_row) of a level whose score is larger than every other
// of the 7 x 7 around it, all of which must exist; in raster order.
void AppendSpaceMaxima(const ScoreLevel& level, int level_index, int first_row, int end_row,
                       std::vector<ScorePeak>& peaks);

// Whether the score is also larger than the largest of the 7 x 7 at the same place of each of the
// `num_neighbours` next levels above and below; false where there are not that many.
bool IsScaleMaximum(std::span<const ScoreLevel> levels, const ScorePeak& peak, int num_neighbours,
                    LevelCoordinates how);

}  // namespace lift_slam
