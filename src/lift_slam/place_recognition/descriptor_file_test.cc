#include "lift_slam/place_recognition/descriptor_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "lift_slam/place_recognition/places_for_test.h"
#include "lift_slam/testing/temporary_folder.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

using testing::HasSubstr;

class DescriptorFileTest : public testing::TestWithParam<DescriptorKind> {
 protected:
  DescriptorFileTest() : road_(GetParam(), 300, 1) {}

  std::string Refusal() const {
    try {
      const DescriptorFile file(path_);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  TemporaryFolder folder_;
  std::filesystem::path path_ = folder_ / "rows";
  TestRoad road_;
};

TEST_P(DescriptorFileTest, GivesBackRowsImageByImage) {
  {
    DescriptorFileWriter writer(path_, {GetParam(), "abc"});
    writer.AddImage(road_.View(0, 1, 0.0));
    writer.AddImage(Descriptors());
    writer.AddImage(road_.View(2, 1, 0.0));
    EXPECT_EQ(writer.num_rows(), 400U);
  }
  const DescriptorFile file(path_);
  EXPECT_EQ(file.kind(), GetParam());
  EXPECT_EQ(file.source_sha256(), "abc");
  EXPECT_EQ(file.num_images(), 3U);
  ASSERT_EQ(file.num_rows(), 400U);
  for (std::size_t i = 0; i < 400; ++i) {
    EXPECT_EQ(file.image_of_row(i), i < 200 ? 0U : 2U);
    const DescriptorView expected = road_.points.row(i < 200 ? i : i - 200 + 40);
    ASSERT_TRUE(std::ranges::equal(file.row(i), expected)) << i;
  }
}

TEST_P(DescriptorFileTest, AStoppedWriterGoesOnAfterTheLastWholeImage) {
  WriteViews(road_, 3, path_);
  const std::string whole = ReadText(path_);
  WriteViews(road_, 2, folder_ / "two");
  const std::size_t two = ReadText(folder_ / "two").size();
  for (const std::size_t size : {two, two + 1, whole.size() - 1}) {
    std::filesystem::resize_file(path_, size);
    EXPECT_THAT(Refusal(), size > two ? HasSubstr("truncated in image 2") : HasSubstr(""));
    DescriptorFileWriter writer(path_, {GetParam(), "test"});
    EXPECT_EQ(writer.num_images(), 2U);
    EXPECT_EQ(writer.num_rows(), 400U);
    writer.AddImage(road_.View(2, 1, NoiseOf(GetParam())));
    EXPECT_EQ(ReadText(path_), whole);
  }
}

TEST_P(DescriptorFileTest, WriterRefusesAnotherSourceOrKind) {
  WriteViews(road_, 2, path_);
  const DescriptorKind other{"other", GetParam().metric, GetParam().dimension};
  EXPECT_THROW(DescriptorFileWriter(path_, {GetParam(), "another"}), InputError);
  EXPECT_THROW(DescriptorFileWriter(path_, {other, "test"}), InputError);
  EXPECT_EQ(DescriptorFile(path_).num_images(), 2U);
}

TEST_P(DescriptorFileTest, EveryKindOfDamageIsRefused) {
  WriteViews(road_, 2, path_);
  const std::string whole = ReadText(path_);
  for (std::size_t at = 0; at < whole.size(); at += at < 300 ? 1 : 9973) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 4);
    std::ofstream(path_, std::ios::binary) << damaged;
    const bool is_padding = at >= 256 + 16 && at < 256 + GetParam().BytesPerRow();
    EXPECT_EQ(Refusal().empty(), is_padding) << at;
  }
  std::ofstream(path_, std::ios::binary) << whole.substr(0, 100);
  EXPECT_THAT(Refusal(), HasSubstr("truncated"));
  std::ofstream(path_, std::ios::binary) << "hello";
  EXPECT_THAT(Refusal(), HasSubstr("no file of descriptors"));
  std::ofstream(path_, std::ios::binary | std::ios::trunc);
  EXPECT_THAT(Refusal(), HasSubstr("no file of descriptors"));
}

INSTANTIATE_TEST_SUITE_P(Kinds, DescriptorFileTest, testing::Values(FloatKind(), BinaryKind()),
                         [](const auto& test) {
                           return test.param.metric == DescriptorMetric::kL2 ? "Float" : "Binary";
                         });

}  // namespace
}  // namespace lift_slam
