#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#if __has_include(<sqlite3.h>)
#include <sqlite3.h>
#endif

#include <cstdlib>
#include <opencv2/imgcodecs.hpp>

#include "lift_slam/testing/temporary_folder.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"
#include "training/colmap_reader.h"
#include "training/colmap_run.h"
#include "training/photograph_import.h"
#include "training/rendered_import.h"
#include "training/sift_keypoints.h"
#include "training/training_set.h"

namespace lift_slam::training {
namespace {

using testing::HasSubstr;

const ImportProgress kQuiet = [](int, int, std::size_t) {};

// Discs of all sizes, shifted by (dx, dy).
cv::Mat Discs(int seed, int dx = 0) {
  cv::Mat image(200, 300, CV_8UC1, cv::Scalar(120));
  Random random(static_cast<std::uint64_t>(seed));
  for (int i = 0; i < 150; ++i) {
    const int x = random.UniformInt(-100, 400) + dx, y = random.UniformInt(0, 199);
    const int radius = random.UniformInt(2, 10), grey = random.UniformInt(0, 255);
    for (int v = std::max(0, y - radius); v < std::min(200, y + radius); ++v) {
      for (int u = std::max(0, x - radius); u < std::min(300, x + radius); ++u) {
        if (std::hypot(u - x, v - y) < radius) {
          image.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(grey);
        }
      }
    }
  }
  return image;
}

template <class Function>
std::string ErrorOf(const Function& function) {
  try {
    function();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(SiftKeypoints, LieWhereTheBlobsAre) {
  constexpr double kSigma = 4.0;
  for (const auto& [x, y] :
       {std::pair(60.0, 50.0), std::pair(60.3, 48.6), std::pair(55.5, 51.75)}) {
    cv::Mat image(100, 120, CV_8UC1);
    for (int row = 0; row < image.rows; ++row) {
      for (int column = 0; column < image.cols; ++column) {
        const double squared = (column - x) * (column - x) + (row - y) * (row - y);
        image.at<std::uint8_t>(row, column) = static_cast<std::uint8_t>(
            std::lround(20 + 200 * std::exp(-squared / (2 * kSigma * kSigma))));
      }
    }
    const std::vector<View> found = DetectSift(GrayImage(image), 2.0, 1);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(found[0].x, x, 0.1);
    EXPECT_NEAR(found[0].y, y, 0.1);
    EXPECT_NEAR(found[0].sigma, kSigma, 0.6);
  }
}

TEST(SiftKeypoints, EmptyPlacesHardlyOverlapKeypoints) {
  const GrayImage image(Discs(1));
  std::vector<View> keypoints = DetectSift(image, 2.0, 20);
  ASSERT_EQ(keypoints.size(), 20U);
  Random random(1);
  const std::vector<View> places = EmptyPlaces(image, keypoints, 20, random);
  ASSERT_FALSE(places.empty());
  for (const View& place : places) {
    for (const View& keypoint : keypoints) {
      if (std::abs(place.sigma / keypoint.sigma - 1.0F) > 0.1F) continue;
      EXPECT_GT(std::max(std::abs(place.x - keypoint.x), std::abs(place.y - keypoint.y)),
                4.0F * place.sigma);
    }
  }
}

TEST(PhotographImport, TakesLicencesFromTheManifest) {
  const TemporaryFolder folder;
  cv::imwrite(folder / "a.png", Discs(1));
  cv::imwrite(folder / "not_listed.png", Discs(2));
  folder.Write("manifest.tsv",
               "file\tlicence\tauthor\tpackage\tpath\na.png\tCC-BY-2.0\tSomebody\tpkg 1\tx\n");
  TrainingSetWriter writer(folder / "set");
  ImportPhotographs(folder.path(), {.num_warps = 2}, kQuiet, writer);
  writer.Finish("");
  const TrainingSet set(folder / "set");
  ASSERT_EQ(set.num_images(), 1U);
  EXPECT_EQ(set.origin(0).author, "Somebody");
  EXPECT_EQ(set.origin(0).source, "pkg 1");
  EXPECT_GT(set.num_points(), 10U);
  EXPECT_EQ(set.views(0).size(), 1U);
}

TEST(PhotographImport, NamesTheFolderWithAndWithoutASlashBehindIt) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "holiday");
  cv::imwrite(folder / "holiday/a.png", Discs(1));
  for (const char* input : {"holiday", "holiday/"}) {
    TrainingSetWriter writer(folder / "set");
    ImportPhotographs(folder / input, {.num_warps = 0}, kQuiet, writer);
    writer.Finish("");
    EXPECT_EQ(TrainingSet(folder / "set").origin(0).source, "holiday") << input;
  }
}

TEST(PhotographImport, PartsShareNoImage) {
  int training = 0, validation = 0;
  for (int i = 0; i < 300; ++i) {
    const std::string name = std::to_string(i) + ".png";
    training += IsWanted(name, Part::kTraining) ? 1 : 0;
    validation += IsWanted(name, Part::kValidation) ? 1 : 0;
    EXPECT_TRUE(IsWanted(name, Part::kAll));
  }
  EXPECT_EQ(training + validation, 300);
  EXPECT_NEAR(validation, 30, 15);
}

TEST(PhotographImport, RefusesFoldersWithoutPhotographs) {
  const TemporaryFolder folder;
  TrainingSetWriter writer(folder / "set");
  EXPECT_THAT(ErrorOf([&] { ImportPhotographs(folder / "none", {}, kQuiet, writer); }),
              HasSubstr("there is no such folder"));
  folder.Write("texts/readme.txt", "no picture");
  EXPECT_THAT(ErrorOf([&] { ImportPhotographs(folder / "texts", {}, kQuiet, writer); }),
              HasSubstr("no usable photograph"));
  folder.Write("bad/manifest.tsv", "file\tlicence\nx.png\tCC0\n");
  EXPECT_THAT(ErrorOf([&] { ImportPhotographs(folder / "bad", {}, kQuiet, writer); }),
              HasSubstr("manifest.tsv:2"));
}

// A camera that moves to the right by 1 m before a wall 10 m away: the picture shifts by fx / 10.
void WriteRendered(const TemporaryFolder& folder, int shift_px) {
  std::filesystem::create_directories(folder / "r/sequences/00/image_0");
  std::filesystem::create_directories(folder / "r/sequences/00/depth_0");
  std::string calibration, times, poses;
  for (int i = 0; i < 4; ++i) {
    calibration += fmt::format("P{}: 200 0 149.5 0 0 200 99.5 0 0 0 1 0\n", i);
  }
  for (int i = 0; i < 2; ++i) {
    const std::string file = fmt::format("00000{}.png", i);
    cv::imwrite(folder / ("r/sequences/00/image_0/" + file), Discs(3, -i * shift_px));
    cv::imwrite(folder / ("r/sequences/00/depth_0/" + file),
                cv::Mat(200, 300, CV_16UC1, cv::Scalar(10 * 256)));
    times += fmt::format("{}\n", i);
    poses += fmt::format("1 0 0 {} 0 1 0 0 0 0 1 0\n", i);
  }
  folder.Write("r/sequences/00/calib.txt", calibration);
  folder.Write("r/sequences/00/times.txt", times);
  folder.Write("r/poses/00.txt", poses);
  folder.Write("r/pairs.txt", "# first second\n0 1 1 0 0.9\n");
}

TEST(RenderedImport, RelatesKeypointsByDepthAndPose) {
  const TemporaryFolder folder;
  WriteRendered(folder, 20);
  TrainingSetWriter writer(folder / "set");
  ImportRendered(folder / "r", {.scene = "wall"}, {}, kQuiet, writer);
  writer.Finish("");
  const TrainingSet set(folder / "set");
  EXPECT_GT(set.num_points(), 20U);
  for (std::size_t i = 0; i < set.num_points(); ++i) {
    const auto views = set.views(i);
    ASSERT_EQ(views.size(), 2U);
    const float sign = views[0].image == 0 ? 1.0F : -1.0F;
    EXPECT_NEAR(views[0].x - views[1].x, 20.0F * sign, 0.3F * views[0].sigma + 1.5F);
  }
}

TEST(RenderedImport, NamesTheFolderWithASlashBehindIt) {
  const TemporaryFolder folder;
  WriteRendered(folder, 20);
  TrainingSetWriter writer(folder / "set");
  ImportRendered(folder / "r/", {}, {}, kQuiet, writer);
  writer.Finish("");
  EXPECT_EQ(TrainingSet(folder / "set").origin(0).name, "r/000000");
}

TEST(RenderedImport, FindsNothingWherePosesAreWrong) {
  const TemporaryFolder right, wrong;
  WriteRendered(right, 20);
  WriteRendered(wrong, 40);
  TrainingSetWriter writer(right / "set"), other(wrong / "set");
  ImportRendered(right / "r", {}, {}, kQuiet, writer);
  ImportRendered(wrong / "r", {}, {}, kQuiet, other);
  EXPECT_LT(other.num_points() * 3, writer.num_points());
}

TEST(RenderedImport, NamesWhatIsMissing) {
  const TemporaryFolder folder;
  WriteRendered(folder, 20);
  std::filesystem::remove(folder / "r/pairs.txt");
  TrainingSetWriter writer(folder / "set");
  EXPECT_THAT(ErrorOf([&] { ImportRendered(folder / "r", {}, {}, kQuiet, writer); }),
              HasSubstr("pairs.txt"));
}

// Without COLMAP: up to where it would be started.
TEST(ReconstructSequence, RefusesTheFolderOfAnotherSequenceOrOtherOptions) {
  const TemporaryFolder folder;
  WriteRendered(folder, 20);
  const std::string sequence = (folder / "r/sequences/00").string();
  const std::string path = std::getenv("PATH");
  setenv("PATH", folder.path().c_str(), 1);
  const auto error_of = [&](const std::string& of, const ReconstructionOptions& options) {
    return ErrorOf([&] { ReconstructSequence(of, folder / "work", options); });
  };
  EXPECT_THAT(error_of(sequence, {}), HasSubstr("colmap: cannot be run"));
  EXPECT_EQ(cv::imread(folder / "work/images/000001.png", cv::IMREAD_GRAYSCALE).rows, 200);
  EXPECT_THAT(error_of(sequence + "/", {}), HasSubstr("colmap: cannot be run"));
  EXPECT_THAT(error_of(sequence, {.step = 2}), HasSubstr("another sequence, or one with other"));
  EXPECT_THAT(error_of(sequence + "/image_0", {}), HasSubstr("another sequence"));
  std::filesystem::remove(folder / "work/source");
  EXPECT_THAT(error_of(sequence, {}), HasSubstr("another sequence")) << "unknown whose it is";
  setenv("PATH", path.c_str(), 1);
}

template <class T>
void Append(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string BinaryImages() {
  std::string bytes;
  Append(bytes, std::uint64_t{1});
  Append(bytes, std::uint32_t{7});
  for (int i = 0; i < 7; ++i) Append(bytes, 0.0);
  Append(bytes, std::uint32_t{1});
  bytes += std::string("a b.png") + '\0';
  Append(bytes, std::uint64_t{2});
  for (const std::uint64_t point : {~std::uint64_t{0}, std::uint64_t{12}}) {
    Append(bytes, 1.5);
    Append(bytes, 2.5);
    Append(bytes, point);
  }
  return bytes;
}

TEST(ColmapReader, BinaryAndTextGiveTheSame) {
  const TemporaryFolder folder;
  folder.Write("binary/images.bin", BinaryImages());
  folder.Write("text/images.txt", "# comment\n7 1 0 0 0 0 0 0 1 a b.png\n1.5 2.5 -1 1.5 2.5 12\n");
  for (const char* kind : {"binary", "text"}) {
    const auto images = ReadColmapImages(folder / kind);
    ASSERT_EQ(images.size(), 1U) << kind;
    EXPECT_EQ(images[0].id, 7U);
    EXPECT_EQ(images[0].name, "a b.png");
    ASSERT_EQ(images[0].observations.size(), 1U);
    EXPECT_EQ(images[0].observations[0].keypoint, 1U);
    EXPECT_EQ(images[0].observations[0].point, 12U);
  }
}

TEST(ColmapReader, RefusesWhatIsDamaged) {
  const TemporaryFolder folder;
  folder.Write("short/images.bin", BinaryImages().substr(0, 90));
  EXPECT_THAT(ErrorOf([&] { ReadColmapImages(folder / "short"); }),
              HasSubstr("ends in the middle"));
  folder.Write("text/images.txt", "7 1 0 0\n\n");
  EXPECT_THAT(ErrorOf([&] { ReadColmapImages(folder / "text"); }), HasSubstr("images.txt:1"));
  EXPECT_THAT(ErrorOf([&] { ReadColmapImages(folder / "nothing"); }), HasSubstr("neither"));
  folder.Write("database.db", "no database");
  EXPECT_NE(ErrorOf([&] { ReadColmapKeypoints(folder / "database.db"); }), "");
}

TEST(ColmapReader, RefusesWhatIsCutOrLongerThanItSays) {
  const TemporaryFolder folder;
  const std::string head = "# Number of images: 1, mean observations per image: 2\n";
  const std::string image = "7 1 0 0 0 0 0 0 1 a.png\n";
  const auto error_of = [&](const std::string& text) {
    folder.Write("text/images.txt", text);
    return ErrorOf([&] { ReadColmapImages(folder / "text"); });
  };
  EXPECT_EQ(error_of(head + image + "1.5 2.5 -1 1.5 2.5 12 \n"), "");
  EXPECT_EQ(error_of(head + image + "\n"), "") << "an image without keypoints";
  EXPECT_THAT(error_of(image + "1.5 2.5 -1 1.5 2.5\n"), HasSubstr("images.txt:2: expected x, y"));
  EXPECT_THAT(error_of(image + "1.5 2.5 -1 1.5 2.5 1"), HasSubstr("images.txt:2: expected an end"));
  EXPECT_THAT(error_of(head + image + "\n" + image + "\n"), HasSubstr("2 images, but 1"));
  EXPECT_THAT(error_of("# Number of images: 3\n" + image + "\n"), HasSubstr("1 images, but 3"));
  folder.Write("long/images.bin", BinaryImages() + "x");
  EXPECT_THAT(ErrorOf([&] { ReadColmapImages(folder / "long"); }),
              HasSubstr("1 bytes after its last image"));
}

#if __has_include(<sqlite3.h>)
// COLMAP's table with 200 images of one keypoint each.
void WriteKeypointDatabase(const std::filesystem::path& path) {
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(path.c_str(), &database), SQLITE_OK);
  std::string commands = "BEGIN; CREATE TABLE keypoints (image_id, rows, cols, data);";
  for (int i = 0; i < 200; ++i) {
    commands += fmt::format("INSERT INTO keypoints VALUES ({}, 1, 4, x'{:032x}');", i, 0);
  }
  EXPECT_EQ(sqlite3_exec(database, (commands + "COMMIT;").c_str(), nullptr, nullptr, nullptr),
            SQLITE_OK);
  sqlite3_close(database);
}

TEST(ColmapReader, RefusesADatabaseWithADamagedPage) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "database.db";
  WriteKeypointDatabase(path);
  EXPECT_EQ(ReadColmapKeypoints(path).size(), 200U);
  std::string bytes = ReadText(path);
  constexpr std::size_t kPageBytes = 4096;
  ASSERT_GT(bytes.size(), 3 * kPageBytes);
  bytes.replace(bytes.size() - kPageBytes, kPageBytes, kPageBytes, '\xEE');
  WriteTextAtomically(path, bytes);
  EXPECT_THAT(ErrorOf([&] { ReadColmapKeypoints(path); }), HasSubstr("cannot be read to its end"));
}
#endif

}  // namespace
}  // namespace lift_slam::training
