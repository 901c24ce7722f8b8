#include "lift_slam/features/spread_selection.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>

namespace lift_slam {
namespace {

// A cell of the quad-tree: points [begin, end) of the list lie in it.
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

struct Point {
  float x, y, score;
  std::size_t index;  // makes the orders total
};

bool RasterOrder(const Point& a, const Point& b) {
  if (a.y != b.y) return a.y < b.y;
  return a.x != b.x ? a.x < b.x : a.index < b.index;
}

bool Stronger(const Point& a, const Point& b) {
  return a.score != b.score ? a.score > b.score : RasterOrder(a, b);
}

class QuadTree {
 public:
  QuadTree(const PixelRectangle& area, std::size_t count, std::vector<Point> points)
      : count_(count), points_(std::move(points)) {
    AddRoots(area);
    while (!splittable_.empty() && splittable_.size() + singles_.size() < count_) {
      const Cell cell = splittable_.top();
      splittable_.pop();
      Split(cell);
    }
  }

  std::vector<Point> StrongestOfLeaves() {
    std::vector<Point> strongest = singles_;
    for (; !splittable_.empty(); splittable_.pop()) {
      strongest.push_back(Strongest(splittable_.top()));
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
      Cell root{area, 0, begin, points_.size()};
      if (columns > 1) {
        root.area.min_x = area.min_x + static_cast<int>(width * i / columns);
        root.area.max_x = area.min_x + static_cast<int>(width * (i + 1) / columns);
        root.end = Partition(
            begin, points_.size(),
            [x = static_cast<float>(root.area.max_x)](const Point& c) { return c.x < x; });
      } else if (rows > 1) {
        root.area.min_y = area.min_y + static_cast<int>(height * i / rows);
        root.area.max_y = area.min_y + static_cast<int>(height * (i + 1) / rows);
        root.end = Partition(
            begin, points_.size(),
            [y = static_cast<float>(root.area.max_y)](const Point& c) { return c.y < y; });
      }
      if (i + 1 == columns * rows) root.end = points_.size();
      begin = root.end;
      Add(root);
    }
  }

  void Split(const Cell& cell) {
    const int x = (cell.area.min_x + cell.area.max_x) / 2;
    const int y = (cell.area.min_y + cell.area.max_y) / 2;
    const auto is_left = [x = static_cast<float>(x)](const Point& c) { return c.x < x; };
    const PixelRectangle& a = cell.area;
    const std::size_t lower = Partition(
        cell.begin, cell.end, [y = static_cast<float>(y)](const Point& c) { return c.y < y; });
    const std::size_t upper_right = Partition(cell.begin, lower, is_left);
    const std::size_t lower_right = Partition(lower, cell.end, is_left);
    Add({{a.min_x, a.min_y, x, y}, cell.depth + 1, cell.begin, upper_right});
    Add({{x, a.min_y, a.max_x, y}, cell.depth + 1, upper_right, lower});
    Add({{a.min_x, y, x, a.max_y}, cell.depth + 1, lower, lower_right});
    Add({{x, y, a.max_x, a.max_y}, cell.depth + 1, lower_right, cell.end});
  }

  void Add(const Cell& cell) {
    if (cell.size() == 0) return;
    const bool is_one_pixel = cell.area.max_x - cell.area.min_x <= 1 &&  //
                              cell.area.max_y - cell.area.min_y <= 1;
    if (cell.size() == 1 || is_one_pixel) {
      singles_.push_back(Strongest(cell));
    } else {
      splittable_.push(cell);
    }
  }

  const Point& Strongest(const Cell& cell) const {
    const auto first = points_.begin();
    return *std::min_element(first + static_cast<std::ptrdiff_t>(cell.begin),
                             first + static_cast<std::ptrdiff_t>(cell.end), Stronger);
  }

  template <class Predicate>
  std::size_t Partition(std::size_t begin, std::size_t end, Predicate predicate) {
    const auto first = points_.begin();
    return static_cast<std::size_t>(std::partition(first + static_cast<std::ptrdiff_t>(begin),
                                                   first + static_cast<std::ptrdiff_t>(end),
                                                   predicate) -
                                    first);
  }

  std::size_t count_;
  std::vector<Point> points_;
  std::vector<Point> singles_;  // of cells that cannot be split
  std::priority_queue<Cell, std::vector<Cell>, SplitLater> splittable_;
};

}  // namespace

std::vector<std::size_t> SelectSpread(const PixelRectangle& area, int count,
                                      std::span<const ScoredPoint> points) {
  if (count <= 0) return {};
  std::vector<std::size_t> selected(points.size());
  std::iota(selected.begin(), selected.end(), std::size_t{0});
  const auto limit = static_cast<std::size_t>(count);
  if (points.size() <= limit) return selected;
  std::vector<Point> numbered;
  numbered.reserve(points.size());
  for (const ScoredPoint& p : points) numbered.push_back({p.x, p.y, p.score, numbered.size()});
  selected.clear();
  for (const Point& p : QuadTree(area, limit, std::move(numbered)).StrongestOfLeaves()) {
    selected.push_back(p.index);
  }
  return selected;
}

}  // namespace lift_slam
