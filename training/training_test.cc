#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <torch/torch.h>

#include <cmath>
#include <functional>

#include "lift_slam/features/lift/lift_networks.h"
#include "lift_slam/features/lift/lift_weights_topology.h"
#include "lift_slam/nn/soft_argmax.h"
#include "lift_slam/testing/temporary_folder.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"
#include "training/checkpoint.h"
#include "training/distance_statistics.h"
#include "training/lift_modules.h"
#include "training/losses.h"
#include "training/spatial_transformer.h"
#include "training/training_stage.h"

namespace lift_slam::training {
namespace {

using testing::HasSubstr;
using torch::Tensor;

std::vector<std::uint8_t> RandomGrey(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<std::uint8_t> values(count);
  for (std::uint8_t& value : values) value = static_cast<std::uint8_t>(random.UniformInt(0, 255));
  return values;
}

// Largest difference, relative to the largest value.
double Difference(const Tensor& a, std::span<const float> b) {
  const Tensor other = torch::from_blob(const_cast<float*>(b.data()),
                                        {static_cast<std::int64_t>(b.size())}, torch::kFloat32);
  const Tensor flat = a.detach().flatten();
  return ((flat - other).abs().max() / other.abs().max()).item<double>();
}

TEST(LiftModules, ComputeWhatTheRunTimeComputes) {
  LiftWeights weights = RandomLiftWeights(LiftTopology::kF, 5);
  LiftNetworks networks(weights, {});
  constexpr int kCount = 3;
  const auto patches = RandomGrey(kCount * kLiftPatchSize * kLiftPatchSize, 1);
  const torch::NoGradGuard no_gradients;
  const Tensor input = PatchTensor(patches, kCount, kLiftPatchSize);

  DescriptorModule descriptor;
  LoadParameters(weights, "descriptor", descriptor);
  EXPECT_LT(Difference(descriptor.forward(input), networks.DescribePatches(patches)), 1e-4);

  OrientationModule orientation;
  LoadParameters(weights, "orientation", orientation);
  const Tensor outputs = orientation.forward(input);
  const std::span<const float> angles = networks.OrientPatches(patches);
  for (int i = 0; i < kCount; ++i) {
    EXPECT_NEAR(LiftAngle(outputs[i][0].item<float>(), outputs[i][1].item<float>()),
                angles[static_cast<std::size_t>(i)], 1e-4);
  }

  DetectorModule detector;
  LoadParameters(weights, "detector", detector);
  const auto pixels = RandomGrey(48 * 48, 2);
  cv::Mat mat(48, 48, CV_8UC1, const_cast<std::uint8_t*>(pixels.data()));
  EXPECT_LT(Difference(detector.forward(PatchTensor(pixels, 1, 48)),
                       networks.DetectorScores(GrayImage(mat)).scores),
            1e-4);
}

TEST(LiftModules, StoreWhatTheyLoaded) {
  LiftWeights weights = RandomLiftWeights(LiftTopology::kF, 5);
  LiftWeights copy = ZeroLiftWeights(LiftTopology::kF, true);
  OrientationModule orientation;
  LoadParameters(weights, "orientation", orientation);
  StoreParameters(orientation, "orientation", copy);
  const auto expected = Parameters(weights), stored = Parameters(copy);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (!expected[i].name.starts_with("orientation.")) continue;
    EXPECT_TRUE(
        std::equal(expected[i].values.begin(), expected[i].values.end(), stored[i].values.begin()))
        << expected[i].name;
  }
}

// Compares the gradient of a scalar with central differences, in double precision.
void ExpectGradientRight(const std::function<Tensor(const Tensor&)>& function, Tensor input) {
  constexpr double kStep = 1e-5;
  input = input.detach().to(torch::kFloat64).clone().requires_grad_(true);  // own gradient
  function(input).backward();
  const Tensor gradient = input.grad().flatten();
  const Tensor values = input.detach().clone();
  for (std::int64_t i = 0; i < values.numel(); ++i) {
    Tensor plus = values.clone(), minus = values.clone();
    plus.view(-1)[i] += kStep;
    minus.view(-1)[i] -= kStep;
    const double numeric = (function(plus) - function(minus)).item<double>() / (2.0 * kStep);
    EXPECT_NEAR(gradient[i].item<double>(), numeric, 1e-5 * std::max(1.0, std::abs(numeric)))
        << "element " << i;
  }
}

TEST(Losses, GradientsAreRight) {
  torch::manual_seed(3);
  const Tensor other = torch::randn({4, 5}, torch::kFloat64);
  const Tensor different = torch::ones({4, 4}, torch::kBool).fill_diagonal_(false);
  const Tensor descriptions = torch::randn({4, 5}, torch::kFloat64);
  ExpectGradientRight(
      [&](const Tensor& x) { return HardestNegativeLoss(x, other, different, 2.0).sum(); },
      descriptions);
  ExpectGradientRight([&](const Tensor& x) { return PairLoss(x, other, different, 4.0).sum(); },
                      descriptions);
  ExpectGradientRight([&](const Tensor& x) { return TripletLoss(x, other, different, 4.0).sum(); },
                      descriptions);
  ExpectGradientRight(
      [&](const Tensor& x) {
        return ClassificationLoss(x.select(0, 0), x.select(0, 1), x.select(0, 2), x.select(0, 3));
      },
      descriptions);
  const Tensor places = torch::rand({6, 2}, torch::kFloat64) * 3.0;
  ExpectGradientRight(
      [&](const Tensor& x) { return OverlapLoss(x, torch::zeros_like(x), 0.5).sum(); }, places);
}

TEST(Losses, EqualDescriptionsHaveAGradient) {
  Tensor rows = torch::ones({2, 3}).requires_grad_(true);
  RowDistances(rows, torch::ones({2, 3})).sum().backward();
  EXPECT_TRUE(rows.grad().isfinite().all().item<bool>());
}

TEST(Losses, OverlapIsZeroForEqualPlacesAndGrowsWithTheGap) {
  const Tensor origin = torch::zeros({4, 2});
  const Tensor places = torch::tensor({{0.0F, 0.0F}, {0.25F, 0.0F}, {1.0F, 0.0F}, {2.0F, 0.0F}});
  const Tensor loss = OverlapLoss(places, origin, 0.5);
  EXPECT_NEAR(loss[0].item<double>(), 0.0, 1e-6);
  EXPECT_NEAR(loss[1].item<double>(), 1.0 - 0.75 / 1.25, 1e-6);
  EXPECT_NEAR(loss[2].item<double>(), 1.0, 1e-6);
  EXPECT_NEAR(loss[3].item<double>(), 1.0 + 1.0 / std::sqrt(2.0), 1e-6);
}

TEST(Losses, HardestNegativeIgnoresPointsThatMayBeTheSame) {
  const Tensor first = torch::tensor({{0.0F, 0.0F}, {0.1F, 0.0F}, {5.0F, 0.0F}});
  Tensor different = torch::ones({3, 3}, torch::kBool).fill_diagonal_(false);
  EXPECT_GT(HardestNegativeLoss(first, first, different, 2.0)[0].item<double>(), 1.8);
  different[0][1] = false;
  different[1][0] = false;
  EXPECT_NEAR(HardestNegativeLoss(first, first, different, 2.0)[0].item<double>(), 0.0, 1e-5);
}

TEST(SpatialTransformer, GradientsAreRight) {
  torch::manual_seed(4);
  const Tensor patches = torch::rand({2, 1, 9, 9}, torch::kFloat64);
  const Tensor centres = torch::tensor({{0.113, -0.207}, {0.031, 0.171}}, torch::kFloat64);
  const Tensor directions = torch::tensor({{0.8, 0.6}, {-0.28, 0.96}}, torch::kFloat64);
  const auto weigh = [](const Tensor& x) {
    return (x * torch::arange(x.numel(), x.options()).view_as(x).sin()).sum();
  };
  ExpectGradientRight(
      [&](const Tensor& x) { return weigh(CutRotated(patches, x, directions, 0.5, 4)); }, centres);
  ExpectGradientRight(
      [&](const Tensor& x) { return weigh(CutRotated(patches, centres, x, 0.5, 4)); }, directions);
  ExpectGradientRight(
      [&](const Tensor& x) { return weigh(CutRotated(x, centres, directions, 0.5, 4)); }, patches);
  const Tensor maps = torch::randn({2, 1, 4, 5}, torch::kFloat64);
  ExpectGradientRight([&](const Tensor& x) { return weigh(SoftArgmax(x, 10.0)); }, maps);
  ExpectGradientRight([&](const Tensor& x) { return weigh(SoftMaximum(x, 10.0)); }, maps);
}

TEST(SpatialTransformer, TurnsContentByTheAngle) {
  // A bright pixel to the right of the centre is below it where the +x axis points up.
  Tensor patch = torch::zeros({1, 1, 5, 5});
  patch[0][0][2][3] = 1.0F;
  const Tensor up = torch::tensor({{0.0F, -1.0F}});
  const Tensor turned = CutRotated(patch, torch::zeros({1, 2}), up, 1.0, 5);
  EXPECT_NEAR(turned[0][0][3][2].item<double>(), 1.0, 1e-5);
}

TEST(SpatialTransformer, SoftArgmaxAgreesWithTheRunTime) {
  torch::manual_seed(5);
  const Tensor map = torch::randn({1, 1, 6, 7});
  const nn::SoftMaximum expected =
      nn::SoftArgmax({map.data_ptr<float>(), static_cast<std::size_t>(map.numel())}, 7, 10.0);
  const Tensor place = SoftArgmax(map, 10.0);
  EXPECT_NEAR(place[0][0].item<double>(), expected.x, 1e-4);
  EXPECT_NEAR(place[0][1].item<double>(), expected.y, 1e-4);
  EXPECT_NEAR(SoftMaximum(map, 10.0)[0].item<double>(), expected.score, 1e-4);
}

TEST(DistanceStatistics, CountsWhatLiesBelowTheMatches) {
  DistanceStatistics statistics;
  const Tensor distances = torch::tensor({{0.1F, 3.0F}, {0.05F, 0.2F}});
  const Tensor different = torch::ones({2, 2}, torch::kBool).fill_diagonal_(false);
  statistics.Add(distances, different);
  EXPECT_DOUBLE_EQ(statistics.FalsePositiveRate95(), 0.5);
  EXPECT_DOUBLE_EQ(statistics.NearestCorrect(), 0.5);
}

TEST(DistanceStatistics, ANetworkThatSaysTheSameOfEverythingIsAlwaysWrong) {
  DistanceStatistics statistics;
  statistics.Add(torch::zeros({3, 3}), torch::ones({3, 3}, torch::kBool).fill_diagonal_(false));
  EXPECT_DOUBLE_EQ(statistics.FalsePositiveRate95(), 1.0);
  EXPECT_DOUBLE_EQ(statistics.NearestCorrect(), 0.0);
}

TEST(Checkpoint, ComesBackAndRefusesOthers) {
  const TemporaryFolder folder;
  DetectorModule written, read;
  torch::optim::Adam adam(written.parameters(), 0.01), other(read.parameters(), 0.01);
  written.forward(torch::rand({1, 1, 30, 30})).sum().backward();
  adam.step();
  WriteCheckpoint(folder / "c.pt", "detector", {.step = 7, .best = 0.5}, written, adam);
  const RunState state = ReadCheckpoint(folder / "c.pt", "detector", read, other);
  EXPECT_EQ(state.step, 7);
  EXPECT_EQ(state.best, 0.5);
  EXPECT_TRUE(torch::equal(written.conv1->weight, read.conv1->weight));
  const auto error_of = [&](const std::string& stage, torch::nn::Module& network) {
    torch::optim::Adam optimizer(network.parameters(), 0.01);
    try {
      ReadCheckpoint(folder / "c.pt", stage, network, optimizer);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(error_of("descriptor", read), HasSubstr("checkpoint of 'detector'"));
  DescriptorModule descriptor;
  EXPECT_THAT(error_of("detector", descriptor), HasSubstr("another topology"));
  std::filesystem::resize_file(folder / "c.pt", 1000);
  EXPECT_THAT(error_of("detector", read), HasSubstr("damaged"));
}

TEST(Checkpoint, RefusesDamagedValues) {
  const TemporaryFolder folder;
  DetectorModule network;
  torch::optim::Adam adam(network.parameters(), 0.01);
  const auto error_of = [&](const std::string& bytes) {
    folder.Write("c.pt", bytes);
    try {
      ReadCheckpoint(folder / "c.pt", "detector", network, adam);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const auto written = [&] {
    WriteCheckpoint(folder / "c.pt", "detector", {}, network, adam);
    return ReadText(folder / "c.pt");
  };
  std::string bytes = written();
  EXPECT_EQ(error_of(bytes), "");
  EXPECT_EQ(error_of(bytes.substr(0, bytes.rfind("\nSHA-256"))), "") << "as it was written before";
  const float first = network.conv1->weight.flatten()[0].item<float>();
  const std::size_t at = bytes.find(std::string(reinterpret_cast<const char*>(&first), 4));
  ASSERT_NE(at, std::string::npos);
  bytes[at] = static_cast<char>(bytes[at] ^ 1);
  EXPECT_THAT(error_of(bytes), HasSubstr("is damaged, its SHA-256"));
  const torch::NoGradGuard no_gradients;
  network.conv1->weight.fill_(std::nan(""));
  EXPECT_THAT(error_of(written()), HasSubstr("'conv1.weight' holds values that are not finite"));
}

}  // namespace
}  // namespace lift_slam::training
