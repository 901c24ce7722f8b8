#include "lift_slam/nn/fft_filter_bank.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "lift_slam/nn/random_network_for_test.h"
#include "lift_slam/nn/reference_layers.h"
#include "lift_slam/util/check.h"

namespace lift_slam::nn {
namespace {

std::vector<std::uint8_t> RandomPixels(std::size_t count, Random& random) {
  std::vector<std::uint8_t> pixels(count);
  for (std::uint8_t& v : pixels) v = static_cast<std::uint8_t>(random.UniformInt(0, 255));
  return pixels;
}

TEST(FftFilterBank, AgreesWithConvolutionAndGhh) {
  Random random(2);
  for (const auto& [size, width, height] : {std::tuple{25, 25, 25},
                                            {25, 64, 64},
                                            {25, 65, 103},
                                            {25, 131, 40},
                                            {7, 70, 61},
                                            {33, 50, 90}}) {
    const Convolution filters = RandomConvolution({16, 1, size, size}, random);
    const int stride = width + 3;
    const auto pixels = RandomPixels(static_cast<std::size_t>(stride * height), random);
    Tensor input({1, 1, height, width});
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        input.at(0, 0, y, x) = (pixels[static_cast<std::size_t>(y * stride + x)] - 128.0F) / 128.0F;
      }
    }
    const Tensor expected = ApplyNetwork({filters, Ghh{}}, input);
    std::vector<float> scores(expected.size());
    FftFilterBank bank(filters, 128.0F, 128.0F, std::make_shared<WorkerTeam>(2));
    bank.Run({pixels.data(), width, height, stride}, scores.data());
    double largest = 0.0;
    for (std::size_t i = 0; i < scores.size(); ++i) {
      largest = std::max(largest, static_cast<double>(std::abs(scores[i] - expected.data()[i])));
    }
    EXPECT_LT(largest, 1e-5) << size << " on " << width << " x " << height;
  }
}

TEST(FftFilterBank, GivesTheSameBytesForAnyNumberOfThreads) {
  Random random(3);
  const Convolution filters = RandomConvolution({16, 1, 25, 25}, random);
  const auto pixels = RandomPixels(200 * 150, random);
  std::vector<float> first(176 * 126), again(first.size());
  FftFilterBank(filters, 0, 1, nullptr).Run({pixels.data(), 200, 150, 200}, first.data());
  FftFilterBank(filters, 0, 1, std::make_shared<WorkerTeam>(3))
      .Run({pixels.data(), 200, 150, 200}, again.data());
  EXPECT_EQ(std::memcmp(first.data(), again.data(), first.size() * sizeof(float)), 0);
}

TEST(FftFilterBank, RefusesOtherBanks) {
  Random random(4);
  EXPECT_THROW(FftFilterBank(RandomConvolution({16, 1, 34, 34}, random), 0, 1, nullptr),
               CheckError);
  EXPECT_THROW(FftFilterBank(RandomConvolution({8, 1, 5, 5}, random), 0, 1, nullptr), CheckError);
  FftFilterBank bank(RandomConvolution({16, 1, 5, 5}, random), 0, 1, nullptr);
  float score = 0;
  const std::uint8_t pixels[16] = {};
  EXPECT_THROW(bank.Run({pixels, 4, 4, 4}, &score), CheckError);
}

}  // namespace
}  // namespace lift_slam::nn
