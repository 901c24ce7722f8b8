// The meaning of each layer on values small enough to work out by hand.
#include "lift_slam/nn/reference_layers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lift_slam/nn/random_network_for_test.h"
#include "lift_slam/nn/soft_argmax.h"
#include "lift_slam/util/check.h"

namespace lift_slam::nn {
namespace {

using testing::ElementsAre;
using testing::FloatEq;
using testing::FloatNear;

Tensor Make(const Shape& shape, const std::vector<float>& values) { return {shape, values}; }

TEST(ReferenceLayers, ConvolutionDoesNotFlipItsKernel) {
  const Layer layer = Convolution{Make({1, 1, 1, 2}, {1, 10}), {0.5F}};
  EXPECT_THAT(ApplyLayer(layer, Make({1, 1, 1, 3}, {1, 2, 3})).values(), ElementsAre(21.5F, 32.5F));
}

TEST(ReferenceLayers, ConvolutionSumsOverInputChannels) {
  const Layer layer = Convolution{Make({2, 2, 1, 1}, {1, 10, 100, 1000}), {0, 1}};
  EXPECT_THAT(ApplyLayer(layer, Make({1, 2, 1, 2}, {1, 2, 3, 4})).values(),
              ElementsAre(31, 42, 3101, 4201));
}

TEST(ReferenceLayers, FullyConnectedFlattensChannelsRowsColumns) {
  const Layer layer = FullyConnected{Make({1, 4, 1, 1}, {1, 10, 100, 1000}), {5}};
  EXPECT_THAT(ApplyLayer(layer, Make({1, 2, 1, 2}, {1, 2, 3, 4})).values(), ElementsAre(4326));
}

TEST(ReferenceLayers, GhhAddsAndSubtractsMaxima) {
  const Layer layer = Ghh{.num_sums = 2, .num_maxima = 2};
  EXPECT_THAT(ApplyLayer(layer, Make({1, 8, 1, 1}, {1, 5, 3, 2, -1, -2, -3, -4})).values(),
              ElementsAre(5 - 3, -1 + 3));
}

TEST(ReferenceLayers, PoolingDropsIncompleteWindows) {
  const Tensor input = Make({1, 1, 2, 3}, {1, 2, 9, 3, -4, 9});
  EXPECT_THAT(ApplyLayer(Pooling{PoolingKind::kMax, 2}, input).values(), ElementsAre(3));
  EXPECT_THAT(ApplyLayer(Pooling{PoolingKind::kAverage, 2}, input).values(), ElementsAre(0.5F));
  EXPECT_THAT(ApplyLayer(Pooling{PoolingKind::kL2, 2}, input).values(),
              ElementsAre(FloatEq(std::sqrt(30.0F))));
}

TEST(ReferenceLayers, SubtractiveNormalizationRemovesAConstantAtTheBorderToo) {
  Tensor input({1, 3, 6, 7});
  for (float& v : input.values()) v = 4.0F;
  const Tensor output = ApplyLayer(GaussianNormalization(5), input);
  EXPECT_THAT(output.values(), testing::Each(FloatNear(0.0F, 1e-5F)));
}

TEST(ReferenceLayers, SubtractiveNormalizationHasOneMeanForAllChannels) {
  const Layer layer = SubtractiveNormalization{Make({1, 1, 1, 1}, {1})};
  EXPECT_THAT(ApplyLayer(layer, Make({1, 2, 1, 1}, {1, 5})).values(), ElementsAre(-2, 2));
}

TEST(ReferenceLayers, ActivationsAreReluAndTanh) {
  const Tensor input = Make({1, 1, 1, 2}, {-1, 0.5F});
  EXPECT_THAT(ApplyLayer(Activation{ActivationKind::kRelu}, input).values(), ElementsAre(0, 0.5F));
  EXPECT_THAT(ApplyLayer(Activation{ActivationKind::kTanh}, input).values(),
              ElementsAre(FloatEq(std::tanh(-1.0F)), FloatEq(std::tanh(0.5F))));
}

TEST(Layers, ShapesThatDoNotFitAreRefused) {
  Random random(1);
  const Layer convolution = RandomConvolution({4, 3, 5, 5}, random);
  EXPECT_EQ(OutputShape(convolution, {2, 3, 9, 8}), (Shape{2, 4, 5, 4}));
  EXPECT_THROW(OutputShape(convolution, {1, 2, 9, 8}), CheckError);
  EXPECT_THROW(OutputShape(convolution, {1, 3, 4, 8}), CheckError);
  EXPECT_THROW(OutputShape(Layer(Ghh{}), {1, 24, 1, 1}), CheckError);
  EXPECT_THROW(OutputShape(Layer(Pooling{PoolingKind::kMax, 5}), {1, 1, 4, 9}), CheckError);
  EXPECT_THROW(OutputShape(Layer(RandomFullyConnected(2, 7, random)), {1, 2, 2, 2}), CheckError);
  EXPECT_THROW(OutputShape(Layer(GaussianNormalization(4)), {1, 2, 8, 8}), CheckError);
  EXPECT_THROW(Tensor({1, 1, 2, 2}, std::vector<float>(3)), CheckError);
}

TEST(SoftArgmax, IsTheCentreOfMassOfTheExponential) {
  const std::vector<float> map = {0, 0, 0, 0, 0, 50};
  const SoftMaximum sharp = SoftArgmax(map, 3, 10.0);
  EXPECT_NEAR(sharp.x, 2.0, 1e-12);
  EXPECT_NEAR(sharp.y, 1.0, 1e-12);
  EXPECT_NEAR(sharp.score, 50.0 - std::log(6.0) / 10.0, 1e-12);
  const SoftMaximum flat = SoftArgmax(std::vector<float>(6, 7.0F), 3, 10.0);
  EXPECT_NEAR(flat.x, 1.0, 1e-12);
  EXPECT_NEAR(flat.y, 0.5, 1e-12);
  EXPECT_NEAR(flat.score, 7.0, 1e-12);
  EXPECT_THROW(SoftArgmax(map, 4, 10.0), CheckError);
}

}  // namespace
}  // namespace lift_slam::nn
