#include "lift_slam/place_recognition/vocabulary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <limits>
#include <span>

#include "lift_slam/place_recognition/places_for_test.h"
#include "lift_slam/place_recognition/vocabulary_layout.h"
#include "lift_slam/testing/temporary_folder.h"
#include "lift_slam/util/check.h"
#include "lift_slam/util/checksum64.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

using testing::HasSubstr;

class VocabularyTest : public testing::TestWithParam<DescriptorKind> {
 protected:
  VocabularyTest() : road_(GetParam(), 2000, 3) {
    WriteViews(road_, 100, folder_ / "rows");
    VocabularyTrainingOptions options;
    options.branching = 8;
    options.depth = 4;
    tree_ = *TrainVocabulary(DescriptorFile(folder_ / "rows"), options);
    tree_.description = "a road of points";
    WriteVocabulary(tree_, path_);
  }

  std::string Refusal() const {
    try {
      const Vocabulary vocabulary(path_);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  // Rewrites the vocabulary with this changed, and the checksum that belongs to it.
  void Forge(const std::function<void(VocabularyHeader&, std::string&)>& change) const {
    WriteVocabulary(tree_, path_);
    std::string bytes = ReadText(path_);
    VocabularyHeader header;
    std::memcpy(&header, bytes.data(), sizeof header);
    change(header, bytes);
    const auto sections = std::as_bytes(std::span(bytes)).subspan(sizeof header);
    const auto begin = std::as_bytes(std::span(&header, 1));
    header.checksum =
        Checksum64(begin.first(offsetof(VocabularyHeader, checksum)), Checksum64(sections));
    std::memcpy(bytes.data(), &header, sizeof header);
    WriteTextAtomically(path_, bytes);
  }

  // The word by walking through the tree of float centers.
  std::uint32_t WordInTree(DescriptorView row) const {
    std::uint32_t node = 0;
    while (tree_.children_begin[node] < tree_.children_begin[node + 1]) {
      std::uint32_t best = tree_.children_begin[node];
      for (std::uint32_t c = best; c < tree_.children_begin[node + 1]; ++c) {
        if (Distance(row, c) < Distance(row, best)) best = c;
      }
      node = best;
    }
    return node;
  }
  float Distance(DescriptorView row, std::uint32_t node) const {
    return DescriptorDistance(GetParam(), row, tree_.centers.row(node));
  }

  TemporaryFolder folder_;
  std::filesystem::path path_ = folder_ / "road.vocabulary";
  TestRoad road_;
  VocabularyTree tree_;
};

TEST_P(VocabularyTest, FileHoldsWhatWasTrained) {
  const VocabularyInfo info = Vocabulary(path_).info();
  EXPECT_EQ(info.kind, GetParam());
  EXPECT_EQ(info.branching, 8);
  EXPECT_EQ(info.depth, 4);
  EXPECT_EQ(info.num_nodes, tree_.num_nodes());
  EXPECT_EQ(info.num_images, 100U);
  EXPECT_EQ(info.num_rows, 20000U);
  EXPECT_EQ(info.num_bytes, std::filesystem::file_size(path_));
  EXPECT_EQ(info.description, "a road of points");
}

TEST_P(VocabularyTest, WordsAreThoseOfTheTree) {
  const Vocabulary vocabulary(path_);
  const Descriptors view = road_.View(7, 2, NoiseOf(GetParam()));
  int same = 0;
  for (std::size_t i = 0; i < view.size(); ++i) {
    same += vocabulary.Find(view.row(i)).word == WordInTree(view.row(i));
  }
  // int8 centers move few rows to a neighbouring word; bits none.
  EXPECT_GE(same, GetParam().metric == DescriptorMetric::kL2 ? 190 : 200);
}

TEST_P(VocabularyTest, DirectIndexHasAboutAHundredNodesAndHoldsEveryFeatureOnce) {
  const Vocabulary vocabulary(path_);
  EXPECT_EQ(vocabulary.direct_level(), 2);  // 64 nodes; 8 and 512 are further from 100
  EXPECT_EQ(vocabulary.direct_nodes().size(), 64U);
  const DirectIndex direct = vocabulary.Transform(road_.View(3, 2, 0.0)).direct;
  std::vector<int> seen(200);
  for (std::size_t g = 0; g < direct.size(); ++g) {
    EXPECT_TRUE(g == 0 || direct.nodes[g - 1] < direct.nodes[g]);
    EXPECT_TRUE(std::ranges::binary_search(vocabulary.direct_nodes(), direct.nodes[g]));
    for (const std::uint32_t feature : direct.group(g)) ++seen[feature];
  }
  EXPECT_EQ(seen, std::vector<int>(200, 1));
}

TEST_P(VocabularyTest, ViewsOfTheSamePointsScoreHighestWithEitherScore) {
  const Vocabulary vocabulary(path_);
  std::vector<BagOfWords> bags;
  for (int v = 0; v < 100; ++v) {
    bags.push_back(vocabulary.Transform(road_.View(v, 1, NoiseOf(GetParam()))).bag);
  }
  for (const BagScore score : {BagScore::kL1, BagScore::kL2}) {
    for (int v = 0; v < 20; ++v) {
      const BagOfWords query = vocabulary.Transform(road_.View(v, 5, NoiseOf(GetParam()))).bag;
      double best = -1.0;
      int best_view = -1;
      for (int other = 0; other < 100; ++other) {
        const double value = Score(query, bags[static_cast<std::size_t>(other)], score);
        if (value > best) {
          best = value;
          best_view = other;
        }
      }
      EXPECT_LE(std::abs(best_view - v), 2);  // which share 160 of 200 points
    }
  }
}

TEST_P(VocabularyTest, NoDescriptorsGiveNoWords) {
  const ImageWords words = Vocabulary(path_).Transform(Descriptors());
  EXPECT_TRUE(words.bag.words.empty());
  EXPECT_EQ(words.direct.size(), 0U);
}

TEST_P(VocabularyTest, OtherDescriptorsAreRefused) {
  const Vocabulary vocabulary(path_);
  const DescriptorKind other{"other", GetParam().metric, GetParam().dimension};
  EXPECT_NO_THROW(vocabulary.CheckKind(GetParam()));
  try {
    vocabulary.CheckKind(other);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("not for 'other'"));
  }
  EXPECT_THROW(vocabulary.Transform(Descriptors(other, 1)), CheckError);
}

TEST_P(VocabularyTest, ForeignTruncatedAndDamagedFilesAreRefused) {
  const std::string whole = ReadText(path_);
  const auto refusal_of = [&](const std::string& bytes) {
    std::ofstream(path_, std::ios::binary | std::ios::trunc) << bytes;
    return Refusal();
  };
  EXPECT_EQ(refusal_of(whole), "");
  EXPECT_THAT(refusal_of(""), HasSubstr("no vocabulary"));
  EXPECT_THAT(refusal_of("%YAML:1.0\nvocabulary: ..."), HasSubstr("no vocabulary"));
  EXPECT_THAT(refusal_of(whole.substr(0, 100)), HasSubstr("truncated"));
  EXPECT_THAT(refusal_of(whole.substr(0, whole.size() - 1)), HasSubstr("truncated"));
  EXPECT_THAT(refusal_of(whole + "x"), HasSubstr("damaged"));
  std::string version = whole;
  version[8] = 9;
  EXPECT_THAT(refusal_of(version), HasSubstr("has version 9"));
  for (std::size_t at = 12; at < whole.size(); at += at < 320 ? 1 : 4099) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 1);
    EXPECT_NE(refusal_of(damaged), "") << at;
  }
  std::filesystem::remove(path_);
  EXPECT_THAT(Refusal(), HasSubstr("no such file"));
}

TEST_P(VocabularyTest, SectionsOutsideTheFileAreRefusedWhateverTheChecksum) {
  for (const auto offset : {&VocabularyHeader::scales_offset, &VocabularyHeader::children_offset,
                            &VocabularyHeader::idf_offset, &VocabularyHeader::description_offset}) {
    for (const std::uint64_t value : {~std::uint64_t{7}, std::uint64_t{1} << 40}) {
      Forge([&](VocabularyHeader& header, std::string&) { header.*offset = value; });
      EXPECT_THAT(Refusal(), HasSubstr("its sections overlap")) << value;
    }
  }
  if (GetParam().metric != DescriptorMetric::kHamming) return;
  Forge([](VocabularyHeader& header, std::string&) { header.scales_offset = sizeof header; });
  EXPECT_THAT(Refusal(), HasSubstr("its sections overlap"));
}

TEST_P(VocabularyTest, WeightsAndScalesThatAreNotFiniteAreRefused) {
  constexpr float kNoNumber = std::numeric_limits<float>::quiet_NaN();
  Forge([](VocabularyHeader&, std::string&) {});
  EXPECT_EQ(Refusal(), "");
  for (const auto offset : {&VocabularyHeader::idf_offset, &VocabularyHeader::scales_offset}) {
    Forge([&](VocabularyHeader& header, std::string& bytes) {
      if (header.*offset > 0) std::memcpy(&bytes[header.*offset + 4], &kNoNumber, 4);
    });
    const bool has_none = offset == &VocabularyHeader::scales_offset &&
                          GetParam().metric == DescriptorMetric::kHamming;
    EXPECT_THAT(Refusal(), HasSubstr(has_none ? "" : "not finite"));
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, VocabularyTest, testing::Values(FloatKind(), BinaryKind()),
                         [](const auto& test) {
                           return test.param.metric == DescriptorMetric::kL2 ? "Float" : "Binary";
                         });

}  // namespace
}  // namespace lift_slam
