#include "lift_slam/place_recognition/vocabulary_trainer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "lift_slam/place_recognition/places_for_test.h"
#include "lift_slam/place_recognition/vocabulary.h"
#include "lift_slam/testing/temporary_folder.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

using testing::HasSubstr;

class VocabularyTrainerTest : public testing::TestWithParam<DescriptorKind> {
 protected:
  VocabularyTrainerTest() {
    WriteViews(TestRoad(GetParam(), 2000, 3), 150, folder_ / "rows");
    options_.branching = 6;
    options_.depth = 4;
  }

  std::string Bytes(const VocabularyTree& tree) const {
    WriteVocabulary(tree, folder_ / "bytes");
    return ReadText(folder_ / "bytes");
  }

  TemporaryFolder folder_;
  VocabularyTrainingOptions options_;
};

TEST_P(VocabularyTrainerTest, MakesATreeInOrderOfLevel) {
  const VocabularyTree tree = *TrainVocabulary(DescriptorFile(folder_ / "rows"), options_);
  ASSERT_EQ(tree.children_begin.size(), tree.num_nodes() + 1);
  EXPECT_EQ(tree.children_begin[0], 1U);
  EXPECT_EQ(tree.children_begin.back(), tree.num_nodes());
  std::size_t words = 0;
  for (std::size_t i = 0; i < tree.num_nodes(); ++i) {
    const std::uint32_t children = tree.children_begin[i + 1] - tree.children_begin[i];
    EXPECT_TRUE(children == 0 || (children >= 2 && children <= 6));
    EXPECT_EQ(tree.idf[i] == 0.0F, children > 0) << i;
    words += children == 0;
  }
  EXPECT_GT(words, 600U);  // 6^4 = 1296 at most
}

TEST_P(VocabularyTrainerTest, IdfCountsImagesNotDescriptors) {
  options_.depth = 1;
  options_.branching = 2;
  {
    DescriptorFileWriter writer(folder_ / "few", {GetParam(), "test"});
    Random random(1);
    Descriptors rows(GetParam(), 10);  // ten of place 0 in image 0, one of place 1 in the others
    const TestRoad road(GetParam(), 2, 8);
    for (std::size_t i = 0; i < 10; ++i) {
      std::memcpy(rows.mutable_row(i).data(), road.points.row(0).data(), rows.row(i).size());
    }
    writer.AddImage(rows);
    for (int i = 0; i < 19; ++i) {
      Descriptors one(GetParam(), 1);
      std::memcpy(one.mutable_row(0).data(), road.points.row(1).data(), one.row(0).size());
      writer.AddImage(one);
    }
  }
  const VocabularyTree tree = *TrainVocabulary(DescriptorFile(folder_ / "few"), options_);
  ASSERT_EQ(tree.num_nodes(), 3U);
  EXPECT_NEAR(std::max(tree.idf[1], tree.idf[2]), std::log(20.0), 1e-6);
  EXPECT_NEAR(std::min(tree.idf[1], tree.idf[2]), std::log(20.0 / 19.0), 1e-6);
}

TEST_P(VocabularyTrainerTest, SameBytesForAnyNumberOfThreadsAndWhenGoneOn) {
  const DescriptorFile file(folder_ / "rows");
  options_.max_rows_per_clustering = 5000;  // the root sees a part of its 30000
  const std::string expected = Bytes(*TrainVocabulary(file, options_));
  options_.num_threads = 3;
  EXPECT_TRUE(Bytes(*TrainVocabulary(file, options_)) == expected);
  const auto stop = [](const TrainingProgress& progress) { return progress.level < 2; };
  EXPECT_FALSE(TrainVocabulary(file, options_, folder_ / "state", stop));
  std::set<int> levels;
  const auto watch = [&](const TrainingProgress& progress) {
    levels.insert(progress.level);
    return true;
  };
  EXPECT_TRUE(Bytes(*TrainVocabulary(file, options_, folder_ / "state", watch)) == expected);
  EXPECT_THAT(levels, testing::ElementsAre(2, 3));
}

TEST_P(VocabularyTrainerTest, CheckpointOfOtherOptionsOrDamagedIsNotUsed) {
  const DescriptorFile file(folder_ / "rows");
  const auto stop = [](const TrainingProgress& progress) { return progress.level < 2; };
  EXPECT_FALSE(TrainVocabulary(file, options_, folder_ / "state", stop));
  std::string state = ReadText(folder_ / "state");
  state[state.size() / 2] = static_cast<char>(state[state.size() / 2] ^ 1);
  WriteTextAtomically(folder_ / "damaged", state);
  options_.depth = 3;
  const std::string expected = Bytes(*TrainVocabulary(file, options_));
  EXPECT_TRUE(Bytes(*TrainVocabulary(file, options_, folder_ / "state")) == expected);
  EXPECT_TRUE(Bytes(*TrainVocabulary(file, options_, folder_ / "damaged")) == expected);
}

TEST_P(VocabularyTrainerTest, TooFewDescriptorsOrBadOptionsAreRefused) {
  WriteViews(TestRoad(GetParam(), 300, 3), 1, folder_ / "one");
  try {
    TrainVocabulary(DescriptorFile(folder_ / "one"), options_);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("too few descriptors"));
  }
  options_.branching = 1;
  EXPECT_THROW(TrainVocabulary(DescriptorFile(folder_ / "rows"), options_), InputError);
}

INSTANTIATE_TEST_SUITE_P(Kinds, VocabularyTrainerTest, testing::Values(FloatKind(), BinaryKind()),
                         [](const auto& test) {
                           return test.param.metric == DescriptorMetric::kL2 ? "Float" : "Binary";
                         });

}  // namespace
}  // namespace lift_slam
