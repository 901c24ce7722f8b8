#include "lift_slam/features/lift/lift_weights.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lift_slam/features/lift/lift_reference_for_test.h"
#include "lift_slam/features/lift/lift_weights_import.h"
#include "lift_slam/features/lift/lift_weights_topology.h"
#include "lift_slam/nn/weight_file.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

using testing::HasSubstr;

class LiftWeightsTest : public testing::Test {
 protected:
  ~LiftWeightsTest() override { std::filesystem::remove(path_); }

  // Changes a good file and says what reading it complains about.
  std::string ErrorAfter(const std::function<void(nn::WeightFile&)>& change) {
    LiftWeights weights = RandomLiftWeights(LiftTopology::kT, 1, /*with_orientation=*/false);
    WriteLiftWeights(weights, path_);
    nn::WeightFile file = nn::ReadWeightFile(path_);
    change(file);
    nn::WriteWeightFile(file, path_);
    try {
      ReadLiftWeights(path_);
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::StartsWith(path_.string() + ": "));
      return error.what();
    }
    return "no error";
  }

  const std::filesystem::path path_ =
      std::filesystem::path(testing::TempDir()) /
      (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".safetensors");
};

std::size_t NumParameters(LiftWeights weights, const std::string& module) {
  std::size_t count = 0;
  for (const LiftParameter& parameter : Parameters(weights)) {
    if (parameter.name.starts_with(module) && !parameter.name.ends_with(".kernel")) {
      count += parameter.values.size();
    }
  }
  return count;
}

TEST(LiftTopologyTest, HasThePapersNumberOfParameters) {
  for (const LiftTopology topology : {LiftTopology::kF, LiftTopology::kT}) {
    const LiftWeights weights = ZeroLiftWeights(topology, /*with_orientation=*/true);
    EXPECT_EQ(NumParameters(weights, "detector."), 10'016U);
    EXPECT_EQ(NumParameters(weights, "orientation."), 2'019'162U);
    EXPECT_EQ(NumParameters(weights, "descriptor."), 280'320U);
    EXPECT_EQ(OutputShape(weights.detector, {1, 1, 48, 48}), (nn::Shape{1, 1, 24, 24}));
    EXPECT_EQ(OutputShape(*weights.orientation, {1, 1, 64, 64}), (nn::Shape{1, 2, 1, 1}));
    EXPECT_EQ(OutputShape(weights.descriptor, {1, 1, 64, 64}), (nn::Shape{1, 128, 1, 1}));
  }
}

TEST_F(LiftWeightsTest, EverythingComesBackFromTheFile) {
  LiftWeights weights = RandomLiftWeights(LiftTopology::kT, 5);
  weights.name = "mine";
  weights.detector_input = {1.25F, 2.5F};
  weights.orientation_input = {3.0F, 4.0F};
  weights.descriptor_input = {110.75390F, 61.536888F};
  weights.provenance = "made up";
  weights.distances = DistanceQuantiles{{0.1F, 0.2F, 0.3F, 0.4F, 0.5F}, {1, 2, 3, 4, 5}};
  weights.descriptor_ranges = {1, 2.5F, 3};
  WriteLiftWeights(weights, path_);
  LiftWeights read = ReadLiftWeights(path_);
  EXPECT_EQ(read.name, weights.name);
  EXPECT_EQ(read.topology, weights.topology);
  EXPECT_EQ(read.detector_input, weights.detector_input);
  EXPECT_EQ(read.orientation_input, weights.orientation_input);
  EXPECT_EQ(read.descriptor_input, weights.descriptor_input);
  EXPECT_EQ(read.provenance, weights.provenance);
  EXPECT_EQ(read.distances, weights.distances);
  EXPECT_EQ(read.descriptor_ranges, weights.descriptor_ranges);
  EXPECT_EQ(read.sha256, weights.sha256);
  const std::vector<LiftParameter> expected = Parameters(weights), found = Parameters(read);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_TRUE(std::equal(found[i].values.begin(), found[i].values.end(),
                           expected[i].values.begin(), expected[i].values.end()))
        << found[i].name;
  }
}

TEST_F(LiftWeightsTest, OrientationMayBeAbsent) {
  LiftWeights weights = RandomLiftWeights(LiftTopology::kF, 5, /*with_orientation=*/false);
  WriteLiftWeights(weights, path_);
  EXPECT_FALSE(ReadLiftWeights(path_).orientation.has_value());
}

TEST_F(LiftWeightsTest, WrongTensorsAreRefused) {
  EXPECT_THAT(ErrorAfter([](auto& file) { file.tensors.erase("descriptor.conv2.bias"); }),
              HasSubstr("tensor 'descriptor.conv2.bias' [64] is missing (topology T)"));
  EXPECT_THAT(ErrorAfter([](auto& file) {
                file.tensors["descriptor.conv1.weight"].shape = {32, 7, 7, 1};
              }),
              HasSubstr("'descriptor.conv1.weight' has shape [32, 7, 7, 1], expected "
                        "[32, 1, 7, 7]"));
  EXPECT_THAT(ErrorAfter([](auto& file) {
                file.tensors["descriptor.conv4.bias"] = {{1}, {0}};
              }),
              HasSubstr("unknown tensor 'descriptor.conv4.bias' (topology T)"));
  EXPECT_THAT(ErrorAfter([](auto& file) {
                file.tensors["orientation.x"] = {{1}, {0}};
              }),
              HasSubstr("tensor 'orientation.conv1.weight' [10, 1, 5, 5] is missing"));
  EXPECT_THAT(ErrorAfter([](auto& file) { file.metadata["topology"] = "F"; }),
              HasSubstr("unknown tensor 'descriptor.norm1.kernel' (topology F)"));
}

TEST_F(LiftWeightsTest, WrongMetadataIsRefused) {
  const std::tuple<const char*, const char*, const char*> cases[] = {
      {"format", "other", "not a file of LIFT weights"},
      {"topology", "G", "topology 'G' is unknown, expected F or T"},
      {"detector.input", "128", "must be the mean and the scale"},
      {"descriptor.input", "128 0", "must be the mean and the scale"},
      {"descriptor.input", "128 x", "is '128 x', expected numbers"},
      {"descriptor.ranges", "1 2", "must be 3 numbers"},
      {"distances.matching", "1 2 3 4 5", "go together"},
      {"distances.matching", "1 2 3 5 4", "ascending"},
  };
  for (const auto& [key, value, message] : cases) {
    EXPECT_THAT(ErrorAfter([&](auto& file) { file.metadata[key] = value; }), HasSubstr(message));
  }
  for (const char* key : {"name", "provenance", "topology"}) {
    EXPECT_THAT(ErrorAfter([&](auto& file) { file.metadata.erase(key); }),
                HasSubstr(std::string("'") + key + "' is missing"));
  }
  EXPECT_EQ(ErrorAfter([](auto&) {}), "no error");
}

TEST_F(LiftWeightsTest, FilesThatAreNoWeightsToImportAreRefused) {
  WriteTextAtomically(path_, "hello");
  for (const auto& path : {path_, std::filesystem::path("/nonexistent.h5")}) {
    const std::filesystem::path files[] = {path};
    EXPECT_THROW(ImportLiftWeights(files, {}), InputError);
  }
}

TEST_F(LiftWeightsTest, ReleasedWeightsAreImportedSavedAndRead) {
  LIFT_SLAM_SKIP_WITHOUT_REFERENCE();
  const std::filesystem::path files[] = {LiftReferenceFolder() / "new-CNN3-picc-iter-56k.h5",
                                         LiftReferenceFolder() / "tf-lift-release.h5"};
  for (const LiftTopology topology : {LiftTopology::kF, LiftTopology::kT}) {
    LiftWeights weights = ImportLiftWeights(files, {.topology = topology});
    EXPECT_FALSE(weights.orientation.has_value());
    WriteLiftWeights(weights, path_);
    const LiftWeights read = ReadLiftWeights(path_);
    EXPECT_EQ(read.name, std::string("lift-released-") + std::string(Name(topology)) + "-kp_aug");
    EXPECT_EQ(read.descriptor_input, weights.descriptor_input);
    EXPECT_EQ(read.sha256, weights.sha256);
  }
  try {
    ImportLiftWeights(std::span(files).first(1), {.topology = LiftTopology::kT});
    FAIL() << "no detector in that file";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("no detector in there"));
  }
}

}  // namespace
}  // namespace lift_slam
