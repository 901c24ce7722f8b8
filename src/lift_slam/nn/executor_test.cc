// The oneDNN back-end against the plain reference, on shapes that no blocking likes.
#include "lift_slam/nn/executor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "lift_slam/nn/random_network_for_test.h"
#include "lift_slam/util/check.h"
#include "lift_slam/util/system_info.h"

namespace lift_slam::nn {
namespace {

double LargestDifference(std::span<const float> a, std::span<const float> b) {
  EXPECT_EQ(a.size(), b.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, std::abs(static_cast<double>(a[i]) - b[i]));
    if (std::isnan(a[i]) || std::isnan(b[i])) return 1e9;
  }
  return largest;
}

struct Case {
  const char* name;
  Shape input;
  std::function<Network(Random&)> make;
};

void PrintTo(const Case& which, std::ostream* stream) { *stream << which.name; }

Layer Relu() { return Activation{ActivationKind::kRelu}; }
Layer Tanh() { return Activation{ActivationKind::kTanh}; }

const Case kCases[] = {
    {"OneChannelConvolution",
     {1, 1, 13, 17},
     [](Random& r) {
       return Network{RandomConvolution({5, 1, 4, 3}, r)};
     }},
    {"OddConvolutions",
     {1, 3, 19, 11},
     [](Random& r) {
       return Network{RandomConvolution({10, 3, 5, 5}, r), Relu(),
                      RandomConvolution({7, 10, 3, 3}, r)};
     }},
    {"WideConvolution",
     {1, 32, 9, 9},
     [](Random& r) {
       return Network{RandomConvolution({64, 32, 6, 6}, r), Tanh()};
     }},
    {"BareActivation",
     {1, 3, 5, 7},
     [](Random&) {
       return Network{Tanh(), Relu()};
     }},
    {"MaxPooling",
     {1, 10, 13, 11},
     [](Random& r) {
       return Network{RandomConvolution({11, 10, 3, 3}, r), Pooling{PoolingKind::kMax, 2}};
     }},
    {"AveragePooling",
     {1, 2, 14, 17},
     [](Random& r) {
       return Network{RandomConvolution({20, 2, 3, 2}, r), Relu(),
                      Pooling{PoolingKind::kAverage, 3}};
     }},
    {"RootPooling",
     {1, 3, 12, 15},
     [](Random& r) {
       return Network{RandomConvolution({37, 3, 2, 3}, r), Tanh(), Pooling{PoolingKind::kL2, 4}};
     }},
    {"PoolingAlone",
     {1, 9, 7, 6},
     [](Random&) {
       return Network{Pooling{PoolingKind::kL2, 3}};
     }},
    {"SubtractiveNormalization",
     {1, 3, 12, 9},
     [](Random& r) {
       return Network{RandomConvolution({19, 3, 3, 3}, r), Tanh(), Pooling{PoolingKind::kL2, 2},
                      GaussianNormalization(5), RandomConvolution({21, 19, 2, 2}, r)};
     }},
    {"SubtractiveNormalizationOfASmallMap",
     {1, 5, 3, 2},
     [](Random&) { return Network{GaussianNormalization(5)}; }},
    {"Ghh",
     {1, 1, 21, 18},
     [](Random& r) {
       return Network{RandomConvolution({32, 1, 9, 7}, r), Ghh{}};
     }},
    {"OddGhh",
     {1, 2, 5, 4},
     [](Random& r) {
       return Network{RandomConvolution({18, 2, 2, 2}, r), Ghh{3, 2}, Relu()};
     }},
    {"FullyConnectedOfAMap",
     {1, 10, 5, 5},
     [](Random& r) {
       return Network{RandomConvolution({50, 10, 3, 3}, r), Relu(),
                      RandomFullyConnected(96, 50 * 9, r),  Ghh{},
                      RandomFullyConnected(32, 6, r),       Ghh{}};
     }},
    {"FullyConnectedAlone",
     {1, 4, 3, 2},
     [](Random& r) {
       return Network{RandomFullyConnected(5, 24, r), Tanh()};
     }},
};

class OneDnn : public testing::TestWithParam<Case> {};

TEST_P(OneDnn, AgreesWithTheReference) {
  Random random(7);
  const Network network = GetParam().make(random);
  const int count = 7;  // not a multiple of the batch
  const std::vector<float> samples = RandomValues(count * GetParam().input.sample_size(), random);
  ExecutorOptions options{.backend = Backend::kReference, .batch = 4};
  const auto reference = MakeExecutor(network, GetParam().input, options);
  options.backend = Backend::kOneDnn;
  const auto fast = MakeExecutor(network, GetParam().input, options);
  const auto expected = reference->Run(std::span<const float>(samples));
  EXPECT_EQ(expected.size(), count * reference->output_shape().sample_size());
  EXPECT_LT(LargestDifference(fast->Run(std::span<const float>(samples)), expected), 2e-5);
  // The second run finds memory used before; fewer samples than a batch.
  const auto few = std::span<const float>(samples).first(2 * GetParam().input.sample_size());
  EXPECT_LT(LargestDifference(fast->Run(few), expected.first(expected.size() * 2 / 7)), 2e-5);
}

TEST_P(OneDnn, LowerPrecisionIsNear) {
  Random random(8);
  const Network network = GetParam().make(random);
  const std::vector<float> samples = RandomValues(6 * GetParam().input.sample_size(), random);
  ExecutorOptions options{.backend = Backend::kReference, .batch = 4};
  const auto reference = MakeExecutor(network, GetParam().input, options);
  const auto expected = reference->Run(std::span<const float>(samples));
  options.backend = Backend::kOneDnn;
  options.activation_ranges = MeasureActivationRanges(network, GetParam().input, options, samples);
  float largest = 1e-3F;
  for (const float v : expected) largest = std::max(largest, std::abs(v));
  for (const Precision precision : {Precision::kBfloat16, Precision::kInt8}) {
    options.precision = precision;
    const auto executor = MakeExecutor(network, GetParam().input, options);
    const auto result = executor->Run(std::span<const float>(samples));
    EXPECT_LT(LargestDifference(result, expected), 0.1 * largest) << Name(precision);
  }
}

INSTANTIATE_TEST_SUITE_P(All, OneDnn, testing::ValuesIn(kCases),
                         [](const auto& test) { return std::string(test.param.name); });

// Two convolutions with all that goes between them.
Network SmallNetwork() {
  Random random(3);
  return {RandomConvolution({16, 1, 5, 5}, random),
          Tanh(),
          Pooling{PoolingKind::kL2, 2},
          GaussianNormalization(5),
          RandomConvolution({24, 16, 3, 3}, random),
          Relu()};
}

TEST(Executor, GivesTheSameBytesForAnyNumberOfThreads) {
  Random random(5);
  const Shape shape{1, 1, 20, 20};
  const std::vector<float> samples = RandomValues(41 * shape.size(), random);
  std::vector<float> first;
  for (const int num_threads : {1, 1, 2, 3}) {
    const auto executor = MakeExecutor(SmallNetwork(), shape, {.batch = 4},
                                       std::make_shared<WorkerTeam>(num_threads));
    const auto result = executor->Run(std::span<const float>(samples));
    if (first.empty()) first.assign(result.begin(), result.end());
    ASSERT_EQ(result.size(), first.size());
    EXPECT_EQ(std::memcmp(result.data(), first.data(), result.size_bytes()), 0) << num_threads;
  }
}

TEST(Executor, ScalesBytesAndFloatsAlike) {
  const Shape shape{1, 1, 20, 20};
  std::vector<std::uint8_t> bytes(3 * shape.size());
  Random random(6);
  for (std::uint8_t& v : bytes) v = static_cast<std::uint8_t>(random.UniformInt(0, 255));
  std::vector<float> scaled(bytes.size());
  for (std::size_t i = 0; i < bytes.size(); ++i) scaled[i] = (bytes[i] - 128.0F) / 64.0F;
  ExecutorOptions options;
  const auto plain = MakeExecutor(SmallNetwork(), shape, options);
  options.input_mean = 128.0F;
  options.input_scale = 64.0F;
  const auto scaling = MakeExecutor(SmallNetwork(), shape, options);
  EXPECT_EQ(LargestDifference(scaling->Run(std::span<const std::uint8_t>(bytes)),
                              plain->Run(std::span<const float>(scaled))),
            0.0);
}

TEST(Executor, NothingInNothingOut) {
  const auto executor = MakeExecutor(SmallNetwork(), {1, 1, 20, 20}, {});
  EXPECT_TRUE(executor->Run(std::span<const float>()).empty());
}

TEST(Executor, RefusesHalfASample) {
  const auto executor = MakeExecutor(SmallNetwork(), {1, 1, 20, 20}, {});
  EXPECT_THROW(executor->Run(std::span<const float>(std::vector<float>(399))), CheckError);
  EXPECT_THROW(MakeExecutor(SmallNetwork(), {1, 2, 20, 20}, {}), CheckError);
  EXPECT_THROW(MakeExecutor(SmallNetwork(), {2, 1, 20, 20}, {}), CheckError);
}

TEST(Executor, SaysWhatItFellBackTo) {
  const Shape shape{1, 1, 20, 20};
  const auto without_ranges = MakeExecutor(SmallNetwork(), shape, {.precision = Precision::kInt8});
  EXPECT_NE(without_ranges->precision().used, Precision::kInt8);
  EXPECT_THAT(without_ranges->precision().reason, testing::HasSubstr("ranges"));
  const auto reference = MakeExecutor(
      SmallNetwork(), shape, {.backend = Backend::kReference, .precision = Precision::kBfloat16});
  EXPECT_EQ(reference->precision().used, Precision::kFloat32);
  EXPECT_FALSE(reference->precision().reason.empty());
}

TEST(MeasureActivationRanges, FindsTheLargestInputOfEachLayer) {
  Tensor weights({1, 1, 1, 1});
  weights.at(0, 0, 0, 0) = -3.0F;
  const Network network = {Convolution{weights, {0.0F}}, Relu(), Convolution{weights, {0.0F}}};
  EXPECT_THAT(MeasureActivationRanges(network, {1, 1, 1, 2}, {}, std::vector<float>{1, -2, 4, -1}),
              testing::ElementsAre(4.0F, 6.0F));
}

TEST(ChoosePrecision, TakesTheNextBestThatTheCpuHas) {
  const std::vector<std::string> none = {"avx2"};
  const std::vector<std::string> vnni = {"avx2", "avx512f", "avx512_vnni"};
  const std::vector<std::string> all = {"avx2", "avx512f", "avx512_vnni", "avx512_bf16"};
  EXPECT_EQ(ChoosePrecision(Precision::kFloat32, none, false).reason, "");
  EXPECT_EQ(ChoosePrecision(Precision::kBfloat16, all, false).used, Precision::kBfloat16);
  EXPECT_EQ(ChoosePrecision(Precision::kBfloat16, vnni, false).used, Precision::kFloat32);
  EXPECT_EQ(ChoosePrecision(Precision::kInt8, vnni, true).used, Precision::kInt8);
  EXPECT_EQ(ChoosePrecision(Precision::kInt8, all, false).used, Precision::kBfloat16);
  EXPECT_EQ(ChoosePrecision(Precision::kInt8, none, true).used, Precision::kFloat32);
  EXPECT_EQ(ChoosePrecision(Precision::kAuto, all, true).used, Precision::kBfloat16);
  EXPECT_EQ(ChoosePrecision(Precision::kAuto, vnni, true).used, Precision::kInt8);
  EXPECT_EQ(ChoosePrecision(Precision::kAuto, vnni, true).reason, "");
  EXPECT_EQ(ChoosePrecision(Precision::kAuto, vnni, false).used, Precision::kFloat32);
  EXPECT_EQ(ChoosePrecision(Precision::kInt8, none, true).reason,
            "int8 needs a CPU with AVX-512 VNNI; bfloat16 needs a CPU with AVX-512 BF16");
}

TEST(WorkerTeam, DoesEveryPieceOnce) {
  WorkerTeam team(3);
  for (const int num_pieces : {0, 1, 2, 100}) {
    std::vector<int> done(static_cast<std::size_t>(num_pieces));
    team.ForEach(num_pieces, [&](int worker, int piece) {
      EXPECT_TRUE(worker >= 0 && worker < 3);
      ++done[static_cast<std::size_t>(piece)];
    });
    EXPECT_THAT(done, testing::Each(1));
  }
}

TEST(WorkerTeam, ThrowsOnWhatAPieceThrows) {
  WorkerTeam team(2);
  const auto fail = [](int, int piece) {
    if (piece == 3) throw std::runtime_error("three");
  };
  EXPECT_THROW(team.ForEach(10, fail), std::runtime_error);
  team.ForEach(2, [](int, int) {});
}

}  // namespace
}  // namespace lift_slam::nn
