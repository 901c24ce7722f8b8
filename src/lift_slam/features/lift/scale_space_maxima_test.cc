#include "lift_slam/features/lift/scale_space_maxima.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lift_slam/util/random.h"

namespace lift_slam {

bool operator==(const ScorePeak& a, const ScorePeak& b) {
  return a.level == b.level && a.x == b.x && a.y == b.y;
}

namespace {

// Scores of few values, so that some are equal.
ScoreLevel RandomLevel(const ScaleLevel& shape, int num_values, Random& random) {
  ScoreLevel level{.shape = shape,
                   .border = 12,
                   .width = shape.width - 24,
                   .height = shape.height - 24,
                   .scores = {}};
  for (int i = 0; i < level.width * level.height; ++i) {
    level.scores.push_back(static_cast<float>(random.UniformInt(0, num_values)));
  }
  return level;
}

// Whether the pixel's score is above all others of the window, none of which is missing.
bool IsSpaceMaximum(const ScoreLevel& level, int x, int y) {
  for (int v = y - 3; v <= y + 3; ++v) {
    for (int u = x - 3; u <= x + 3; ++u) {
      if (!std::isfinite(level.At(u, v))) return false;
      if ((u != x || v != y) && level.At(u, v) >= level.At(x, y)) return false;
    }
  }
  return true;
}

std::vector<ScorePeak> BruteForce(const ScoreLevel& level, int index) {
  std::vector<ScorePeak> peaks;
  for (int y = 0; y < level.shape.height; ++y) {
    for (int x = 0; x < level.shape.width; ++x) {
      if (IsSpaceMaximum(level, x, y)) peaks.push_back({index, x, y});
    }
  }
  return peaks;
}

TEST(SpaceMaxima, AreThoseOfBruteForceInAnyStrips) {
  Random random(5);
  for (const int num_values : {30, 100, 1000000}) {
    const ScoreLevel level = RandomLevel({.width = 121, .height = 75}, num_values, random);
    const std::vector<ScorePeak> expected = BruteForce(level, 4);
    EXPECT_GT(expected.size(), 20U);
    for (const int rows : {1, 5, 64, 1000}) {
      std::vector<ScorePeak> found;
      for (int y = 0; y < 75; y += rows) AppendSpaceMaxima(level, 4, y, y + rows, found);
      EXPECT_EQ(found, expected) << rows;
    }
  }
}

TEST(SpaceMaxima, MapsSmallerThanTheWindowHaveNone) {
  Random random(5);
  for (const int size : {25, 30, 31}) {
    std::vector<ScorePeak> found;
    AppendSpaceMaxima(RandomLevel({.width = size, .height = size}, 1000000, random), 0, 0, size,
                      found);
    EXPECT_LE(found.size(), size == 31 ? 1U : 0U);
  }
}

TEST(ScaleMaxima, AreThoseOfBruteForce) {
  Random random(6);
  std::vector<ScoreLevel> levels;
  for (const ScaleLevel& shape : MakeScaleLevels(90, 70, 3)) {
    levels.push_back(RandomLevel(shape, 1000, random));
  }
  ASSERT_GE(levels.size(), 6U);
  int num_maxima = 0;
  for (const int neighbours : {1, 2}) {
    for (const auto how : {LevelCoordinates::kExact, LevelCoordinates::kOriginal}) {
      for (int index = 0; index < static_cast<int>(levels.size()); ++index) {
        const ScoreLevel& own = levels[static_cast<std::size_t>(index)];
        for (const ScorePeak& peak : BruteForce(own, index)) {
          bool expected = true;
          for (int d = -neighbours; d <= neighbours; ++d) {
            const int other = index + d;
            if (other < 0 || other >= static_cast<int>(levels.size())) expected = false;
            if (d == 0 || !expected) continue;
            const ScoreLevel& level = levels[static_cast<std::size_t>(other)];
            // In the order of operations of the code, since halves are rounded.
            const auto there = [&](int at, int from, int to) {
              const double position = how == LevelCoordinates::kExact
                                          ? (at + 0.5) * to / from - 0.5
                                          : static_cast<double>(at) * (to - 1) / (from - 1);
              return static_cast<int>(std::lround(position));
            };
            const int x = there(peak.x, own.shape.width, level.shape.width);
            const int y = there(peak.y, own.shape.height, level.shape.height);
            for (int v = y - 3; v <= y + 3; ++v) {
              for (int u = x - 3; u <= x + 3; ++u) {
                expected = expected && level.At(u, v) < own.At(peak.x, peak.y);
              }
            }
          }
          EXPECT_EQ(IsScaleMaximum(levels, peak, neighbours, how), expected);
          num_maxima += expected;
        }
      }
    }
  }
  EXPECT_GT(num_maxima, 10);
}

}  // namespace
}  // namespace lift_slam
