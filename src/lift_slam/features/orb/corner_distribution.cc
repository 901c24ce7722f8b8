#include "lift_slam/features/orb/corner_distribution.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <queue>

namespace lift_slam {
namespace {

// A cell of the quad-tree: corners [begin, end) of the list lie in it.
struct Cell {
  PixelRectangle area;
  int depth = 0;
  std::size_t begin = 0, end = 0;

  std::size_t size() const { return end - begin; }
};

// True when `a` is split after `b`. `begin` makes the order total.
struct SplitLater {
  bool operator()(const Cell& a, const Cell& b) const {
    if (a.depth != b.depth) return a.depth > b.depth;
    if (a.size() != b.size()) return a.size() < b.size();
    return a.begin > b.begin;
  }
};

bool RasterOrder(const Corner& a, const Corner& b) { return a.y != b.y ? a.y < b.y : a.x < b.x; }

bool Stronger(const Corner& a, const Corner& b) {
  return a.score != b.score ? a.score > b.score : RasterOrder(a, b);
}

class QuadTree {
 public:
  QuadTree(const PixelRectangle& area, std::size_t count, std::vector<Corner> corners)
      : count_(count), corners_(std::move(corners)) {
    AddRoots(area);
    while (!splittable_.empty() && splittable_.size() + singles_.size() < count_) {
      const Cell cell = splittable_.top();
      splittable_.pop();
      Split(cell);
    }
  }

  std::vector<Corner> StrongestOfLeaves() {
    std::vector<Corner> strongest = singles_;
    for (; !splittable_.empty(); splittable_.pop()) {
      const auto first = corners_.begin();
      const Cell& cell = splittable_.top();
      strongest.push_back(*std::min_element(first + static_cast<std::ptrdiff_t>(cell.begin),
                                            first + static_cast<std::ptrdiff_t>(cell.end),
                                            Stronger));
    }
    if (strongest.size() > count_) {  // the last split gave up to three leaves too many
      const auto keep = strongest.begin() + static_cast<std::ptrdiff_t>(count_);
      std::nth_element(strongest.begin(), keep, strongest.end(), Stronger);
      strongest.erase(keep, strongest.end());
    }
    std::sort(strongest.begin(), strongest.end(), RasterOrder);
    return strongest;
  }

 private:
  // Cells of about equal sides, side by side along the longer side of the area.
  void AddRoots(const PixelRectangle& area) {
    const double width = area.max_x - area.min_x, height = area.max_y - area.min_y;
    const int columns = std::max(1, static_cast<int>(std::lround(width / height)));
    const int rows = std::max(1, static_cast<int>(std::lround(height / width)));
    std::size_t begin = 0;
    for (int i = 0; i < columns * rows; ++i) {
      Cell root{area, 0, begin, corners_.size()};
      if (columns > 1) {
        root.area.min_x = area.min_x + static_cast<int>(width * i / columns);
        root.area.max_x = area.min_x + static_cast<int>(width * (i + 1) / columns);
        root.end = Partition(begin, corners_.size(),
                             [&](const Corner& c) { return c.x < root.area.max_x; });
      } else if (rows > 1) {
        root.area.min_y = area.min_y + static_cast<int>(height * i / rows);
        root.area.max_y = area.min_y + static_cast<int>(height * (i + 1) / rows);
        root.end = Partition(begin, corners_.size(),
                             [&](const Corner& c) { return c.y < root.area.max_y; });
      }
      begin = root.end;
      Add(root);
    }
  }

  void Split(const Cell& cell) {
    const int x = (cell.area.min_x + cell.area.max_x) / 2;
    const int y = (cell.area.min_y + cell.area.max_y) / 2;
    const auto is_left = [x](const Corner& c) { return c.x < x; };
    const PixelRectangle& a = cell.area;
    const std::size_t lower =
        Partition(cell.begin, cell.end, [y](const Corner& c) { return c.y < y; });
    const std::size_t upper_right = Partition(cell.begin, lower, is_left);
    const std::size_t lower_right = Partition(lower, cell.end, is_left);
    Add({{a.min_x, a.min_y, x, y}, cell.depth + 1, cell.begin, upper_right});
    Add({{x, a.min_y, a.max_x, y}, cell.depth + 1, upper_right, lower});
    Add({{a.min_x, y, x, a.max_y}, cell.depth + 1, lower, lower_right});
    Add({{x, y, a.max_x, a.max_y}, cell.depth + 1, lower_right, cell.end});
  }

  void Add(const Cell& cell) {
    if (cell.size() == 1) singles_.push_back(corners_[cell.begin]);
    if (cell.size() > 1) splittable_.push(cell);
  }

  template <class Predicate>
  std::size_t Partition(std::size_t begin, std::size_t end, Predicate predicate) {
    const auto first = corners_.begin();
    return static_cast<std::size_t>(std::partition(first + static_cast<std::ptrdiff_t>(begin),
                                                   first + static_cast<std::ptrdiff_t>(end),
                                                   predicate) -
                                    first);
  }

  std::size_t count_;
  std::vector<Corner> corners_;
  std::vector<Corner> singles_;
  std::priority_queue<Cell, std::vector<Cell>, SplitLater> splittable_;
};

}  // namespace

void DropWeakCorners(const PixelRectangle& area, int cell_size_px, int threshold,
                     std::vector<Corner>& corners) {
  const int columns = std::max(1, (area.max_x - area.min_x) / cell_size_px);
  const int rows = std::max(1, (area.max_y - area.min_y) / cell_size_px);
  const auto cell_of = [&](const Corner& corner) {
    const int column = (corner.x - area.min_x) * columns / (area.max_x - area.min_x);
    const int row = (corner.y - area.min_y) * rows / (area.max_y - area.min_y);
    return static_cast<std::size_t>(row * columns + column);
  };
  std::vector<std::uint8_t> has_strong(static_cast<std::size_t>(rows * columns), 0);
  for (const Corner& corner : corners) {
    if (corner.score > threshold) has_strong[cell_of(corner)] = 1;
  }
  std::erase_if(corners, [&](const Corner& corner) {
    return corner.score <= threshold && has_strong[cell_of(corner)] != 0;
  });
}

std::vector<Corner> SpreadCorners(const PixelRectangle& area, int count,
                                  std::vector<Corner> corners) {
  if (count <= 0 || corners.empty()) return {};
  const auto limit = static_cast<std::size_t>(count);
  if (corners.size() <= limit) return corners;
  return QuadTree(area, limit, std::move(corners)).StrongestOfLeaves();
}

}  // namespace lift_slam
