#include "training/first_weights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lift_slam/features/lift/lift_networks.h"
#include "lift_slam/util/random.h"

namespace lift_slam::training {
namespace {

// 61 x 61 grey values of a function of the distance from the middle.
template <class Function>
GrayImage Picture(const Function& grey) {
  cv::Mat pixels(61, 61, CV_8UC1);
  for (int y = 0; y < 61; ++y) {
    for (int x = 0; x < 61; ++x) {
      pixels.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(grey(x - 30.0, y - 30.0));
    }
  }
  return GrayImage(pixels);
}

struct Peak {
  int x, y;
  float score;
};

Peak HighestScore(LiftNetworks& networks, const GrayImage& image) {
  const ScoreMap map = networks.DetectorScores(image);
  const auto best = std::ranges::max_element(map.scores) - map.scores.begin();
  return {static_cast<int>(best) % map.width + 12, static_cast<int>(best) / map.width + 12,
          map.scores[static_cast<std::size_t>(best)]};
}

TEST(FirstWeights, BlobsScoreHighAndEdgesLow) {
  LiftWeights weights = RandomLiftWeights(LiftTopology::kF, 1);
  BeginWithBlobs(weights);
  LiftNetworks networks(weights, {});
  for (const double sign : {1.0, -1.0}) {
    const Peak blob =
        HighestScore(networks, Picture([=](double x, double y) {
                       return 128.0 + sign * 60.0 * std::exp(-0.5 * (x * x + y * y) / 3.8);
                     }));
    EXPECT_NEAR(blob.x, 30, 1);
    EXPECT_NEAR(blob.y, 30, 1);
    EXPECT_GT(blob.score, 0.5F);
  }
  const GrayImage edge = Picture([](double x, double) { return x < 0 ? 60.0 : 200.0; });
  EXPECT_LT(HighestScore(networks, edge).score, 0.0F);
}

// Waves that fade away from a point beside the middle, the whole turned by an angle.
std::vector<std::uint8_t> TurnedPatch(double angle, double phase, double gamma = 1.0) {
  std::vector<std::uint8_t> patch;
  const double c = std::cos(angle), s = std::sin(angle);
  for (int row = 0; row < 64; ++row) {
    for (int column = 0; column < 64; ++column) {
      const double x = column - 31.5, y = row - 31.5;
      const double u = c * x + s * y, v = c * y - s * x;
      const double wave = std::sin(0.22 * u + phase) + 0.5 * std::sin(0.3 * v + 2.0 * phase);
      const double grey = std::clamp(128.0 + 2.0 * u + 35.0 * wave, 0.0, 255.0);
      patch.push_back(static_cast<std::uint8_t>(255.0 * std::pow(grey / 255.0, gamma)));
    }
  }
  return patch;
}

TEST(FirstWeights, GammaHardlyTurnsTheAngle) {
  LiftWeights weights = RandomLiftWeights(LiftTopology::kF, 3);
  BeginWithGradients(weights);
  LiftNetworks networks(weights, {});
  const float plain = networks.OrientPatches(TurnedPatch(1.0, 0.3))[0];
  for (const double gamma : {0.25, 4.0}) {
    EXPECT_NEAR(networks.OrientPatches(TurnedPatch(1.0, 0.3, gamma))[0], plain, 0.35) << gamma;
  }
}

TEST(FirstWeights, AnglesTurnWithThePatch) {
  LiftWeights weights = RandomLiftWeights(LiftTopology::kF, 2);
  BeginWithGradients(weights);
  LiftNetworks networks(weights, {});
  for (const double phase : {0.3, 1.4, 2.2}) {
    const float start = networks.OrientPatches(TurnedPatch(0.0, phase))[0];
    for (const double turn : {0.5, 1.6, 3.0}) {
      const float turned = networks.OrientPatches(TurnedPatch(turn, phase))[0];
      EXPECT_NEAR(std::remainder(turned - start - turn, 2.0 * std::numbers::pi), 0.0, 0.35)
          << turn << " at phase " << phase;
    }
  }
}

}  // namespace
}  // namespace lift_slam::training
