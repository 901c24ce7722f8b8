#include "lift_slam/image/image.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "lift_slam/image/image_file.h"
#include "lift_slam/util/check.h"
#include "lift_slam/util/random.h"

namespace lift_slam {
namespace {

using testing::HasSubstr;

template <class Pixel>
int GrayOf(const Pixel& pixel) {
  const cv::Mat_<Pixel> image(2, 3, pixel);
  return ToGray(image).row(1)[2];
}

TEST(ToGray, WeighsTheColours) {
  EXPECT_EQ(GrayOf(cv::Vec3b(255, 0, 0)), 29);  // blue
  EXPECT_EQ(GrayOf(cv::Vec3b(0, 255, 0)), 150);
  EXPECT_EQ(GrayOf(cv::Vec3b(0, 0, 255)), 76);  // red
}

TEST(ToGray, DropsAlpha) {
  EXPECT_EQ(GrayOf(cv::Vec4b(80, 80, 80, 0)), 80);
  EXPECT_EQ(GrayOf(cv::Vec2b(123, 0)), 123);
}

TEST(ToGray, ScalesSixteenBitAndFloat) {
  EXPECT_EQ(GrayOf<std::uint16_t>(0x8000), 128);
  EXPECT_EQ(GrayOf<std::uint16_t>(0xFFFF), 255);
  EXPECT_EQ(GrayOf(cv::Vec<std::uint16_t, 3>(0x4000, 0x4000, 0x4000)), 64);
  EXPECT_EQ(GrayOf(1.0F), 255);
  EXPECT_EQ(GrayOf(0.2), 51);
  EXPECT_EQ(GrayOf(7.0F), 255);
  EXPECT_EQ(GrayOf(-1.0F), 0);
}

TEST(ToGray, RefusesOtherTypes) {
  EXPECT_THROW(ToGray(cv::Mat(2, 2, CV_32SC1)), CheckError);
  EXPECT_THROW(GrayImage(cv::Mat(2, 2, CV_8UC3)), CheckError);
}

// A folder for files of one test.
class ReadGrayImageTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ =
        std::filesystem::path(testing::TempDir()) / (std::string("lift_slam_") + info->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  // Writes the first `share` of the file and reads it as an image.
  std::optional<GrayImage> ReadShare(const std::vector<std::uint8_t>& file, double share) {
    const auto path = folder_ / "image";
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(file.data()),
               static_cast<std::streamsize>(share * static_cast<double>(file.size())));
    why_.clear();
    return ReadGrayImage(path, &why_);
  }

  std::filesystem::path folder_;
  std::string why_;
};

cv::Mat NoiseImage() {
  Random random(1);
  cv::Mat image(61, 83, CV_8UC1);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x)
      image.at<uchar>(y, x) = static_cast<uchar>(random.UniformInt(0, 255));
  }
  return image;
}

std::vector<std::uint8_t> Encode(const std::string& extension,
                                 const std::vector<int>& parameters = {}) {
  std::vector<std::uint8_t> file;
  cv::imencode(extension, NoiseImage(), file, parameters);
  return file;
}

TEST_F(ReadGrayImageTest, ReadsWholeFiles) {
  const auto png = ReadShare(Encode(".png"), 1.0);
  ASSERT_TRUE(png);
  EXPECT_EQ(cv::norm(png->mat(), NoiseImage(), cv::NORM_INF), 0.0);
  for (const std::string extension : {".jpg", ".bmp", ".pgm", ".tiff"}) {
    const auto image = ReadShare(Encode(extension), 1.0);
    ASSERT_TRUE(image) << extension << ": " << why_;
    EXPECT_EQ(image->width(), 83);
  }
}

TEST_F(ReadGrayImageTest, RefusesTruncatedPngAndJpeg) {
  for (const auto& file :
       {Encode(".png"), Encode(".jpg"), Encode(".jpg", {cv::IMWRITE_JPEG_PROGRESSIVE, 1}),
        Encode(".jpg", {cv::IMWRITE_JPEG_RST_INTERVAL, 2})}) {
    EXPECT_TRUE(ReadShare(file, 1.0)) << why_;
    for (const double share : {0.005, 0.02, 0.1, 0.5, 0.9, 0.999}) {
      EXPECT_FALSE(ReadShare(file, share)) << share;
      EXPECT_THAT(why_, HasSubstr("image: ")) << share;
    }
    EXPECT_THAT(why_, HasSubstr("is truncated"));
  }
}

TEST_F(ReadGrayImageTest, AnEmbeddedThumbnailDoesNotHideTheCut) {
  std::vector<std::uint8_t> file = Encode(".jpg");
  const std::vector<std::uint8_t> application_segment = {0xFF, 0xE1, 0x00, 0x06,
                                                         0xFF, 0xD9, 0x00, 0x00};
  file.insert(file.begin() + 2, application_segment.begin(), application_segment.end());
  EXPECT_TRUE(ReadShare(file, 1.0)) << why_;
  EXPECT_FALSE(ReadShare(file, 0.9));
}

TEST_F(ReadGrayImageTest, DataAfterTheEndIsIgnored) {
  std::vector<std::uint8_t> file = Encode(".jpg");
  file.insert(file.end(), 100, 0x42);
  EXPECT_TRUE(ReadShare(file, 1.0)) << why_;
}

TEST_F(ReadGrayImageTest, SaysWhyItRefuses) {
  EXPECT_FALSE(ReadGrayImage(folder_ / "none.png", &why_));
  EXPECT_THAT(why_, HasSubstr("none.png: no such file"));
  EXPECT_FALSE(ReadGrayImage(folder_, &why_));
  EXPECT_THAT(why_, HasSubstr("cannot be read"));
  ASSERT_EQ(mkfifo((folder_ / "pipe.png").c_str(), 0600), 0);
  EXPECT_FALSE(ReadGrayImage(folder_ / "pipe.png", &why_)) << "and does not wait for it";
  EXPECT_THAT(why_, HasSubstr("cannot be read"));
  EXPECT_FALSE(ReadShare({}, 1.0));
  EXPECT_THAT(why_, HasSubstr("is empty"));
  EXPECT_FALSE(ReadShare({'t', 'e', 'x', 't', '\n'}, 1.0));
  EXPECT_THAT(why_, HasSubstr("no image"));
  EXPECT_FALSE(ReadGrayImage(folder_ / "none.png"));
}

TEST(IsCompleteImageFile, NeverReadsBeyondTheEnd) {
  for (const std::string extension : {".png", ".jpg"}) {
    const std::vector<std::uint8_t> file = Encode(extension);
    for (std::size_t size = 3; size < 700; ++size) {
      const std::vector<std::uint8_t> start(file.begin(),
                                            file.begin() + static_cast<std::ptrdiff_t>(size));
      EXPECT_EQ(IsCompleteImageFile(start), extension == ".png" && size < 8) << size;
    }
  }
}

}  // namespace
}  // namespace lift_slam
