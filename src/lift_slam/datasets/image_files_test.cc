#include "lift_slam/datasets/image_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lift_slam/datasets/dataset_test_files.h"
#include "lift_slam/util/file.h"

namespace lift_slam {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(ListImages, SortsNumbersAsNumbersAndIgnoresOtherFiles) {
  const TestFolder folder;
  for (const char* name :
       {"frame10.png", "frame2.PNG", "frame1.jpg", "._frame3.png", "notes.txt"}) {
    folder.Write(name, "x");
  }
  std::vector<std::string> names;
  for (const auto& file : ListImages(folder.path())) names.push_back(file.filename().string());
  EXPECT_THAT(names, ElementsAre("frame1.jpg", "frame2.PNG", "frame10.png"));
}

TEST(NaturalLess, IsAStrictOrder) {
  EXPECT_TRUE(NaturalLess("a2b", "a10b"));
  EXPECT_FALSE(NaturalLess("a10b", "a2b"));
  EXPECT_NE(NaturalLess("01", "1"), NaturalLess("1", "01"));
  EXPECT_FALSE(NaturalLess("1", "1"));
  EXPECT_TRUE(NaturalLess("1305031102.175304", "1305031102.211214"));
}

TEST(ListImages, SaysWhenThereIsNone) {
  const TestFolder folder;
  EXPECT_THAT(InputErrorOf([&] { ListImages(folder.path()); }), HasSubstr("there is no image"));
  EXPECT_THAT(InputErrorOf([&] { ListImages(folder / "absent"); }), HasSubstr("no such folder"));
}

// Every format the readers accept, cut in the middle.
class TruncatedImage : public testing::TestWithParam<const char*> {};

TEST_P(TruncatedImage, IsRefusedWithItsName) {
  const TestFolder folder;
  const auto file = folder.WriteImage(std::string("image") + GetParam(), 0, 160, 120);
  std::string why;
  ASSERT_TRUE(ReadWholeImage(file, &why)) << why;
  std::filesystem::resize_file(file, std::filesystem::file_size(file) * 6 / 10);
  EXPECT_FALSE(ReadWholeImage(file, &why));
  EXPECT_THAT(why, HasSubstr(file.string()));
}

INSTANTIATE_TEST_SUITE_P(Formats, TruncatedImage,
                         testing::Values(".png", ".jpg", ".jpeg", ".pgm", ".bmp", ".tiff",
                                         ".webp"));

TEST(ReadWholeImage, RefusesPixelsThatAreNotSupported) {
  const TestFolder folder;
  cv::imwrite((folder / "a.tiff").string(), cv::Mat(8, 12, CV_32SC1, cv::Scalar(7)));
  std::string why;
  EXPECT_FALSE(ReadWholeImage(folder / "a.tiff", &why));
  EXPECT_THAT(why, HasSubstr("a.tiff"));
}

TEST(IsWholeJpeg, AcceptsBytesAfterTheEnd) {
  const TestFolder folder;
  const std::string data = ReadText(folder.WriteImage("image.jpg", 3, 64, 48));
  EXPECT_TRUE(IsWholeJpeg(data));
  EXPECT_TRUE(IsWholeJpeg(data + std::string(5000, 'x')));
  for (std::size_t size = 3; size < data.size(); ++size) {
    EXPECT_FALSE(IsWholeJpeg(data.substr(0, size))) << size;
  }
}

}  // namespace
}  // namespace lift_slam
