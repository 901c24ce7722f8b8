#include "lift_slam/simulation/scene/torcs_road.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cctype>
#include <limits>
#include <tuple>

#include "lift_slam/simulation/scene/road_piece.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

constexpr double kMaxGapM = 1.0;      // between joined rungs
constexpr double kSamePointM = 0.05;  // two corners nearer than this are one
constexpr double kMaxSpanM = 30.0;    // between rungs joined by another mesh

// The number after TKMN; -1 when the mesh is no road. Long numbers keep their first nine digits.
int RoadNumber(const std::string& name) {
  std::string prefix = name.substr(0, 4);
  for (char& c : prefix) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  if (prefix != "TKMN" || name.size() < 5 ||
      std::isdigit(static_cast<unsigned char>(name[4])) == 0) {
    return -1;
  }
  int number = 0;
  for (std::size_t i = 4; i < std::min<std::size_t>(name.size(), 13); ++i) {
    if (std::isdigit(static_cast<unsigned char>(name[i])) == 0) break;
    number = 10 * number + (name[i] - '0');
  }
  return number;
}

Eigen::Vector3d CenterOf(const RoadRung& rung) { return 0.5 * (rung[0] + rung[1]); }

// Largest distance between corners, whichever way round fits.
double RungDistance(const RoadRung& a, const RoadRung& b) {
  const double straight = std::max((a[0] - b[0]).norm(), (a[1] - b[1]).norm());
  const double crossed = std::max((a[0] - b[1]).norm(), (a[1] - b[0]).norm());
  return std::min(straight, crossed);
}

double Gap(const RoadRung& a, const RoadRung& b) { return (CenterOf(a) - CenterOf(b)).norm(); }

// One end of a piece.
struct PieceEnd {
  int piece = 0;
  int end = 0;  // 0: first rung, 1: last rung
};

// A chain of pieces in walking order; `enter` is the end at which a piece is entered.
struct Chain {
  std::vector<PieceEnd> enter;
  bool closed = false;
  double length_m = 0.0;
};

class RoadJoiner {
 public:
  explicit RoadJoiner(const Scene& scene) : scene_(scene) {
    for (const SceneMesh& mesh : scene.meshes) {
      const int number = RoadNumber(mesh.name);
      if (number < 0) continue;
      for (RoadPiece& piece : FindRoadPieces(mesh, number)) pieces_.push_back(std::move(piece));
    }
    if (pieces_.empty()) {
      throw InputError(
          fmt::format("{}: no road in this scene (no mesh named TKMN<number>)", scene.name));
    }
    joined_.assign(2 * pieces_.size(), -1);
  }

  Road Join() {
    JoinNear();
    JoinSpanned();
    Chain chain = LongestChain();
    if (!chain.closed) RefuseGap(chain);
    return Sections(chain);
  }

 private:
  int EndCount() const { return static_cast<int>(joined_.size()); }
  const RoadPiece& PieceOf(int end) const { return pieces_[static_cast<std::size_t>(end / 2)]; }
  const RoadRung& RungOf(int end) const { return PieceOf(end).End(end % 2); }
  bool IsFree(int end) const { return joined_[static_cast<std::size_t>(end)] < 0; }

  void Connect(int a, int b) {
    if (!IsFree(a) || !IsFree(b)) return;
    joined_[static_cast<std::size_t>(a)] = b;
    joined_[static_cast<std::size_t>(b)] = a;
  }

  // The nearest pairs of ends first.
  void JoinNear() {
    std::vector<std::tuple<double, int, int>> pairs;
    for (int a = 0; a < EndCount(); ++a) {
      for (int b = a + 1; b < EndCount(); ++b) {
        if (a / 2 == b / 2 && PieceOf(a).rungs.size() < 3) continue;
        const double distance = RungDistance(RungOf(a), RungOf(b));
        if (distance <= kMaxGapM) pairs.emplace_back(distance, a, b);
      }
    }
    std::sort(pairs.begin(), pairs.end());
    for (const auto& [distance, a, b] : pairs) Connect(a, b);
  }

  static bool Touches(const SceneMesh& mesh, const RoadRung& rung) {
    return std::all_of(rung.begin(), rung.end(), [&](const Eigen::Vector3d& corner) {
      return std::any_of(mesh.vertices.begin(), mesh.vertices.end(), [&](const SceneVertex& v) {
        return (v.position.cast<double>() - corner).squaredNorm() < kSamePointM * kSamePointM;
      });
    });
  }

  void JoinSpanned() {
    std::vector<int> free;
    for (int end = 0; end < EndCount(); ++end) {
      if (IsFree(end)) free.push_back(end);
    }
    for (const SceneMesh& mesh : scene_.meshes) {
      if (RoadNumber(mesh.name) >= 0) continue;
      std::vector<int> touched;
      for (const int end : free) {
        if (Touches(mesh, RungOf(end))) touched.push_back(end);
      }
      if (touched.size() != 2 || touched[0] / 2 == touched[1] / 2) continue;
      if (RungDistance(RungOf(touched[0]), RungOf(touched[1])) > kMaxSpanM) continue;
      Connect(touched[0], touched[1]);
    }
  }

  // Walks on from the end at which the piece is entered until the road ends or closes.
  Chain Walk(int enter) const {
    Chain chain;
    const int first = enter;
    while (enter >= 0) {
      chain.enter.push_back({enter / 2, enter % 2});
      chain.length_m += Length(PieceOf(enter));
      enter = joined_[static_cast<std::size_t>(enter ^ 1)];
      chain.closed = enter == first;
      if (chain.closed) break;
    }
    return chain;
  }

  static double Length(const RoadPiece& piece) {
    double length = 0.0;
    for (std::size_t i = 1; i < piece.rungs.size(); ++i) {
      length += Gap(piece.rungs[i], piece.rungs[i - 1]);
    }
    return length;
  }

  Chain LongestChain() const {
    Chain longest;
    for (int end = 0; end < EndCount(); ++end) {
      // Open chains from their ends, loops from anywhere.
      Chain chain = Walk(StartOfChain(end));
      if (chain.length_m > longest.length_m + kSamePointM) longest = std::move(chain);
    }
    return longest;
  }

  // Backwards from that end to the start of its chain; the end itself in a loop.
  int StartOfChain(int end) const {
    int at = end;
    while (!IsFree(at)) {
      at = joined_[static_cast<std::size_t>(at)] ^ 1;
      if (at == end) break;
    }
    return at;
  }

  [[noreturn]] void RefuseGap(const Chain& chain) const {
    const int last = 2 * chain.enter.back().piece + (chain.enter.back().end ^ 1);
    double gap = std::numeric_limits<double>::infinity();
    for (int other = 0; other < EndCount(); ++other) {
      if (other == last || !IsFree(other)) continue;
      gap = std::min(gap, Gap(RungOf(last), RungOf(other)));
    }
    const Eigen::Vector3d place = CenterOf(RungOf(last));
    throw InputError(fmt::format(
        "{}: the road's centre line does not close: after {:.0f} m a gap of {:.1f} m at "
        "({:.1f}, {:.1f}, {:.1f}), expected at most {:.0f} m",
        scene_.name, chain.length_m, gap, place.x(), place.y(), place.z(), kMaxGapM));
  }

  static void Reverse(Chain& chain) {
    std::reverse(chain.enter.begin(), chain.enter.end());
    for (PieceEnd& enter : chain.enter) enter.end ^= 1;
  }

  int NumberAt(const Chain& chain, std::size_t i) const {
    return pieces_[static_cast<std::size_t>(chain.enter[i % chain.enter.size()].piece)].number;
  }

  // Starts at the smallest number and walks the way in which most numbers grow.
  void Orient(Chain& chain) const {
    const std::size_t size = chain.enter.size();
    int growing = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const int here = NumberAt(chain, i);
      const int next = NumberAt(chain, i + 1);
      growing += (next > here) - (next < here);
    }
    if (growing < 0) Reverse(chain);
    std::size_t start = 0;
    for (std::size_t i = 1; i < size; ++i) {
      if (NumberAt(chain, i) < NumberAt(chain, start)) start = i;
    }
    std::rotate(chain.enter.begin(), chain.enter.begin() + static_cast<std::ptrdiff_t>(start),
                chain.enter.end());
  }

  std::vector<RoadRung> RungsOf(const Chain& chain) const {
    std::vector<RoadRung> rungs;
    for (const PieceEnd& enter : chain.enter) {
      std::vector<RoadRung> piece = pieces_[static_cast<std::size_t>(enter.piece)].rungs;
      if (enter.end == 1) std::reverse(piece.begin(), piece.end());
      // Where two pieces meet, both have the same rung, or nearly.
      const bool is_doubled = !rungs.empty() && Gap(rungs.back(), piece.front()) <= kMaxGapM;
      rungs.insert(rungs.end(), piece.begin() + (is_doubled ? 1 : 0), piece.end());
    }
    if (Gap(rungs.back(), rungs.front()) <= kMaxGapM) rungs.pop_back();
    return rungs;
  }

  Road Sections(Chain chain) const {
    Orient(chain);
    const std::vector<RoadRung> rungs = RungsOf(chain);
    Road road;
    for (std::size_t i = 0; i < rungs.size(); ++i) {
      const std::size_t size = rungs.size();
      const Eigen::Vector3d forward =
          CenterOf(rungs[(i + 1) % size]) - CenterOf(rungs[(i + size - 1) % size]);
      const Eigen::Vector3d across = rungs[i][0] - rungs[i][1];
      const bool first_is_left = forward.x() * across.y() - forward.y() * across.x() > 0.0;
      road.sections.push_back({rungs[i][first_is_left ? 0 : 1], rungs[i][first_is_left ? 1 : 0]});
    }
    return road;
  }

  const Scene& scene_;
  std::vector<RoadPiece> pieces_;
  std::vector<int> joined_;  // for each end (2 * piece + end), the end joined to it, or -1
};

}  // namespace

Road FindTorcsRoad(const Scene& scene) { return RoadJoiner(scene).Join(); }

}  // namespace lift_slam
