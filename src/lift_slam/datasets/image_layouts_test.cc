#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lift_slam/datasets/dataset_test_files.h"
#include "lift_slam/datasets/sequence.h"

// One small sequence of each layout, read as a whole.
namespace lift_slam {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::int64_t> Times(const std::vector<SequenceFrame>& frames) {
  std::vector<std::int64_t> times_ns;
  for (const SequenceFrame& frame : frames) times_ns.push_back(frame.timestamp_ns);
  return times_ns;
}

std::vector<std::int64_t> Indices(const std::vector<SequenceFrame>& frames) {
  std::vector<std::int64_t> indices;
  for (const SequenceFrame& frame : frames) indices.push_back(frame.frame_index);
  return indices;
}

std::vector<int> TopLeftPixels(const std::vector<SequenceFrame>& frames) {
  std::vector<int> values;
  for (const SequenceFrame& frame : frames) {
    values.push_back(frame.image ? frame.image->row(0)[0] : -1);
  }
  return values;
}

void WriteKitti(const TestFolder& folder, const std::string& sequence) {
  for (int i = 0; i < 3; ++i) {
    folder.WriteImage(fmt::format("{}/image_0/{:06}.png", sequence, i), 10 * i);
    folder.WriteImage(fmt::format("{}/image_2/{:06}.png", sequence, i), 10 * i + 5);
  }
  folder.Write(sequence + "/calib.txt", kKittiCalibration);
  folder.Write(sequence + "/times.txt", "0.000000e+00\n1.037359e-01\n2.073381e-01\n");
}

TEST(KittiOdometry, ReadsImagesTimesAndCalibration) {
  const TestFolder folder;
  WriteKitti(folder, "sequences/07");
  const auto sequence = OpenSequence((folder / "sequences/07/").string());
  const SequenceInfo& info = sequence->info();
  EXPECT_EQ(info.format, SequenceFormat::kKittiOdometry);
  EXPECT_EQ(info.name, "07");
  EXPECT_EQ(info.num_frames, 3);
  EXPECT_EQ(info.camera->pinhole.cx, 5.5);
  EXPECT_EQ(info.camera->pinhole.width, 12);
  EXPECT_NEAR(info.camera->frame_rate_hz, 10.0, 0.5);
  EXPECT_FALSE(info.ground_truth);
  EXPECT_THAT(info.warnings, IsEmpty());
  const auto frames = ReadAll(*sequence);
  EXPECT_THAT(Indices(frames), ElementsAre(0, 1, 2));
  EXPECT_THAT(Times(frames), ElementsAre(0, 103735900, 207338100));
  EXPECT_THAT(TopLeftPixels(frames), ElementsAre(0, 10, 20));
  EXPECT_FALSE(sequence->Next());
}

TEST(KittiOdometry, FindsTheTruthBesideTheSequences) {
  const TestFolder folder;
  WriteKitti(folder, "sequences/07");
  folder.Write("poses/07.txt",
               "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 1 0 1 0 0 0 0 1 2\n"
               "1 0 0 2 0 1 0 0 0 0 1 4\n1 0 0 3 0 1 0 0 0 0 1 6\n");
  const auto sequence = OpenSequence((folder / "sequences/07").string());
  const auto& truth = sequence->info().ground_truth;
  ASSERT_TRUE(truth);
  EXPECT_TRUE(truth->by_index);
  EXPECT_FALSE(truth->body_poses);
  ASSERT_EQ(truth->poses.size(), 3u);
  EXPECT_EQ(truth->poses[2].frame_index, 2);
  EXPECT_EQ(truth->poses[2].timestamp_ns, 207338100);
  EXPECT_EQ(truth->poses[2].world_from_cam.translation, Eigen::Vector3d(2, 0, 4));
  ASSERT_EQ(sequence->info().warnings.size(), 1u);
  EXPECT_THAT(sequence->info().warnings[0], HasSubstr("4 poses for 3 images"));
}

TEST(KittiOdometry, TruthOfAnotherCameraIsMovedByTheBaseline) {
  const TestFolder folder;
  WriteKitti(folder, "sequences/07");
  folder.Write("poses/07.txt",
               "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 1 0 1 0 0 0 0 1 2\n"
               "0 -1 0 2 1 0 0 0 0 0 1 4\n");
  SequenceOptions options;
  options.camera_name = "image_2";
  const auto sequence = OpenSequence((folder / "sequences/07").string(), options);
  EXPECT_THAT(TopLeftPixels(ReadAll(*sequence)), ElementsAre(5, 15, 25));
  const auto& truth = *sequence->info().ground_truth;
  // P2 = K [I | -0.5 0 0]: the camera sits 0.5 m to the right of camera 0.
  EXPECT_EQ(truth.poses[1].world_from_cam.translation, Eigen::Vector3d(1.5, 0, 2));
  EXPECT_NEAR((truth.poses[2].world_from_cam.translation - Eigen::Vector3d(2, 0.5, 4)).norm(), 0,
              1e-12);
  EXPECT_EQ(truth.body_poses->at(1).world_from_cam.translation, Eigen::Vector3d(1, 0, 2));
}

TEST(KittiOdometry, AMissingImageShiftsNothing) {
  const TestFolder folder;
  WriteKitti(folder, "07");
  std::filesystem::remove(folder / "07/image_0/000001.png");
  const auto sequence = OpenSequence((folder / "07").string());
  EXPECT_THAT(sequence->info().warnings, ElementsAre(HasSubstr("1 images are missing")));
  const auto frames = ReadAll(*sequence);
  EXPECT_THAT(Indices(frames), ElementsAre(0, 2));
  EXPECT_THAT(Times(frames), ElementsAre(0, 207338100));
}

TEST(KittiRaw, ReadsDatesAndTheDaysCalibration) {
  const TestFolder folder;
  const std::string drive = "2011_09_26/2011_09_26_drive_0001_sync/";
  folder.WriteImage(drive + "image_00/data/0000000000.png");
  folder.WriteImage(drive + "image_00/data/0000000001.png", 50);
  folder.Write(drive + "image_00/timestamps.txt",
               "2011-09-26 13:02:25.964389445\n2011-09-26 13:02:26.067892311\n");
  folder.Write("2011_09_26/calib_cam_to_cam.txt",
               "calib_time: 09-Jan-2012 13:57:47\ncorner_dist: 9.95e-02\n"
               "S_00: 1.4e+01 1.0e+01\nK_00: 20 0 6 0 21 4 0 0 1\nD_00: -0.3 0.2 0 0 -0.1\n"
               "S_rect_00: 1.2e+01 8.0e+00\nP_rect_00: 10 0 5.5 0 0 10 3.5 0 0 0 1 0\n");
  const auto sequence = OpenSequence((folder / drive).string());
  EXPECT_EQ(sequence->info().format, SequenceFormat::kKittiRaw);
  EXPECT_EQ(sequence->info().camera->pinhole.fx, 10.0);
  EXPECT_THAT(sequence->info().warnings, IsEmpty());
  EXPECT_THAT(Times(ReadAll(*sequence)), ElementsAre(1317042145964389445, 1317042146067892311));
}

TEST(KittiRaw, UnrectifiedImagesTakeTheUnrectifiedCalibration) {
  const TestFolder folder;
  folder.WriteImage("day/drive/image_00/data/0000000000.png", 0, 14, 10);
  folder.Write("day/calib_cam_to_cam.txt",
               "S_00: 1.4e+01 1.0e+01\nK_00: 20 0 6 0 21 4 0 0 1\nD_00: -0.3 0.2 0 0 -0.1\n"
               "S_rect_00: 1.2e+01 8.0e+00\nP_rect_00: 10 0 5.5 0 0 10 3.5 0 0 0 1 0\n");
  const auto sequence = OpenSequence((folder / "day/drive").string());
  EXPECT_EQ(sequence->info().camera->pinhole.fx, 20.0);
  EXPECT_EQ(std::get<RadialTangential>(sequence->info().camera->distortion).k3, -0.1);
  EXPECT_THAT(sequence->info().warnings,
              ElementsAre(HasSubstr("timestamps.txt is missing"), HasSubstr("only one frame")));
}

constexpr char kSensor[] =
    "%YAML:1.0\nsensor_type: camera\nT_BS:\n  cols: 4\n  rows: 4\n"
    "  data: [0.0, -1.0, 0.0, 0.1,\n         1.0, 0.0, 0.0, 0.2,\n"
    "         0.0, 0.0, 1.0, 0.3,\n         0.0, 0.0, 0.0, 1.0]\n"
    "rate_hz: 20\nresolution: [12, 8]\ncamera_model: pinhole\n"
    "intrinsics: [10, 11, 5.5, 3.5]\ndistortion_model: radial-tangential\n"
    "distortion_coefficients: [-0.28, 0.07, 0.0002, 1.7e-05]\n";

void WriteEuroc(const TestFolder& folder) {
  for (int i = 1; i <= 2; ++i) {
    folder.WriteImage(fmt::format("MH/mav0/cam0/data/140000000000000000{}.png", i), i);
  }
  folder.Write("MH/mav0/cam0/data.csv",
               "#timestamp [ns],filename\r\n1400000000000000001,1400000000000000001.png\r\n"
               "1400000000000000002,1400000000000000002.png\r\n");
  folder.Write("MH/mav0/cam0/sensor.yaml", kSensor);
}

TEST(Euroc, ReadsImagesAndCalibration) {
  const TestFolder folder;
  WriteEuroc(folder);
  for (const char* path : {"MH", "MH/mav0"}) {
    const auto sequence = OpenSequence((folder / path).string());
    const SequenceInfo& info = sequence->info();
    EXPECT_EQ(info.format, SequenceFormat::kEuroc);
    EXPECT_EQ(info.name, "MH");
    EXPECT_EQ(info.camera->pinhole.fy, 11.0);
    EXPECT_EQ(info.camera->frame_rate_hz, 20.0);
    EXPECT_EQ(std::get<RadialTangential>(info.camera->distortion).k2, 0.07);
    const auto frames = ReadAll(*sequence);
    EXPECT_THAT(Times(frames), ElementsAre(1400000000000000001, 1400000000000000002));
    EXPECT_THAT(TopLeftPixels(frames), ElementsAre(1, 2));
  }
}

TEST(Euroc, CameraPoseIsBodyPoseTimesMounting) {
  const TestFolder folder;
  WriteEuroc(folder);
  // The body is turned by 180 degrees about x: y and z change sign.
  folder.Write("MH/mav0/state_groundtruth_estimate0/data.csv",
               "#timestamp, p, q\n1400000000000000001,1,2,3,0,1,0,0,0,0,0\n");
  const auto sequence = OpenSequence((folder / "MH").string());
  const auto& truth = *sequence->info().ground_truth;
  EXPECT_FALSE(truth.by_index);
  EXPECT_EQ(truth.body_poses->at(0).world_from_cam.translation, Eigen::Vector3d(1, 2, 3));
  const Rigid3d& camera = truth.poses[0].world_from_cam;
  EXPECT_NEAR((camera.translation - Eigen::Vector3d(1.1, 1.8, 2.7)).norm(), 0.0, 1e-12);
  // x of the camera is y of the body (T_BS), which is -y of the world.
  EXPECT_NEAR((camera.rotation * Eigen::Vector3d::UnitX() + Eigen::Vector3d::UnitY()).norm(), 0.0,
              1e-12);
}

TEST(Euroc, TruthWithPositionsOnlyIsNamed) {
  const TestFolder folder;
  WriteEuroc(folder);
  folder.Write("MH/mav0/leica0/data.csv", "#timestamp, p\n1400000000000000001,1,2,3\n");
  const auto sequence = OpenSequence((folder / "MH").string());
  EXPECT_FALSE(sequence->info().ground_truth);
  EXPECT_THAT(sequence->info().warnings, ElementsAre(HasSubstr("positions only")));
}

TEST(Euroc, TumViTakesCalibrationAndMountingFromKalibr) {
  const TestFolder folder;
  WriteEuroc(folder);
  std::filesystem::remove(folder / "MH/mav0/cam0/sensor.yaml");
  folder.Write("MH/dso/camchain.yaml",
               "cam0:\n  T_cam_imu:\n  - [1.0, 0.0, 0.0, -0.1]\n  - [0.0, 1.0, 0.0, 0.0]\n"
               "  - [0.0, 0.0, 1.0, 0.0]\n  - [0.0, 0.0, 0.0, 1.0]\n  camera_model: pinhole\n"
               "  distortion_coeffs: [0.1, 0.2, 0.3, 0.4]\n  distortion_model: equidistant\n"
               "  intrinsics: [10, 11, 5.5, 3.5]\n  resolution: [12, 8]\n");
  folder.Write("MH/mav0/mocap0/data.csv", "#t\n1400000000000000001,1,2,3,1,0,0,0\n");
  const auto sequence = OpenSequence((folder / "MH").string());
  EXPECT_TRUE(std::holds_alternative<KannalaBrandt>(sequence->info().camera->distortion));
  EXPECT_NEAR(sequence->info().ground_truth->poses[0].world_from_cam.translation.x(), 1.1, 1e-12);
}

void WriteTumRgbd(const TestFolder& folder, const std::string& name) {
  folder.WriteImage(name + "/rgb/1305031102.175304.png", 1);
  folder.WriteImage(name + "/rgb/1305031102.211214.png", 2);
  folder.Write(name + "/rgb.txt",
               "# color images\n# file: 'x.bag'\n# timestamp filename\n"
               "1305031102.175304 rgb/1305031102.175304.png\n"
               "1305031102.211214 rgb/1305031102.211214.png\n");
  folder.Write(name + "/groundtruth.txt",
               "# timestamp tx ty tz qx qy qz qw\n1305031102.1758 1.3 0.6 1.6 0 0 0 1\n");
}

TEST(TumRgbd, ReadsIndexTruthAndCameraFile) {
  const TestFolder folder;
  WriteTumRgbd(folder, "desk");
  folder.Write("desk/camera.yaml", kTestCamera);
  const auto sequence = OpenSequence((folder / "desk").string());
  EXPECT_EQ(sequence->info().format, SequenceFormat::kTumRgbd);
  EXPECT_EQ(sequence->info().camera->pinhole.cx, 5.5);
  EXPECT_EQ(sequence->info().ground_truth->poses[0].timestamp_ns, 1305031102175800000);
  EXPECT_THAT(Times(ReadAll(*sequence)), ElementsAre(1305031102175304000, 1305031102211214000));
}

TEST(TumRgbd, KnowsThePublishedCalibrations) {
  for (const auto& [name, fx] :
       {std::pair("rgbd_dataset_freiburg1_xyz", 517.3),
        std::pair("rgbd_dataset_freiburg2_desk", 520.9), std::pair("fr3_office", 535.4)}) {
    const TestFolder folder;
    WriteTumRgbd(folder, name);
    for (const char* image : {"1305031102.175304.png", "1305031102.211214.png"}) {
      folder.WriteImage(std::string(name) + "/rgb/" + image, 0, 640, 480);
    }
    const auto sequence = OpenSequence((folder / name).string());
    EXPECT_EQ(sequence->info().camera->pinhole.fx, fx);
    const Distortion& distortion = sequence->info().camera->distortion;
    EXPECT_EQ(std::holds_alternative<NoDistortion>(distortion), fx == 535.4);
  }
}

TEST(TumMono, ReadsIdsTimesAndTheFovModel) {
  const TestFolder folder;
  folder.WriteImage("seq/images/00000.jpg");
  folder.WriteImage("seq/images/00001.jpg");
  folder.Write("seq/times.txt", "00000 1444915848.7893 0.0124\n00001 1444915848.8293 0.0124\n");
  folder.Write("seq/camera.txt", "0.5 0.6 0.5 0.5 0.9\n12 8\nfull\n12 8\n");
  folder.Write("seq/groundtruthSync.txt",
               "1444915848.7893 1 2 3 0 0 0 1\n1444915848.8293 NaN NaN NaN NaN NaN NaN NaN\n");
  const auto sequence = OpenSequence((folder / "seq").string());
  EXPECT_EQ(sequence->info().format, SequenceFormat::kTumMono);
  EXPECT_DOUBLE_EQ(sequence->info().camera->pinhole.fx, 6.0);
  EXPECT_DOUBLE_EQ(sequence->info().camera->pinhole.cx, 5.5);
  EXPECT_EQ(sequence->info().ground_truth->poses.size(), 1u);
  EXPECT_THAT(Times(ReadAll(*sequence)), ElementsAre(1444915848789300000, 1444915848829300000));
}

TEST(TumMono, PairsTimesById) {
  const TestFolder folder;
  for (const char* id : {"00000", "00002", "00003"}) {
    folder.WriteImage(fmt::format("images/{}.png", id));
  }
  folder.Write("times.txt", "00000 1.5 1\n00001 1.6 1\n00002 1.7 1\n");
  folder.Write("camera.txt", "0.5 0.6 0.5 0.5 0.9\n12 8\n");
  const auto sequence = OpenSequence(folder.path().string());
  EXPECT_THAT(sequence->info().warnings,
              ElementsAre(HasSubstr("3 times for 3 images; the 2 images")));
  const auto frames = ReadAll(*sequence);
  EXPECT_THAT(Indices(frames), ElementsAre(0, 2));
  EXPECT_THAT(Times(frames), ElementsAre(1500000000, 1700000000));
}

TEST(ImageFolder, CountsAtTheCamerasRate) {
  const TestFolder folder;
  for (const char* name : {"f1.png", "f2.jpg", "f10.pgm", "f11.bmp", "f12.tiff"}) {
    folder.WriteImage(name);
  }
  cv::imwrite((folder / "f13.ppm").string(), cv::Mat(8, 12, CV_8UC3));
  folder.Write("camera.yaml", std::string(kTestCamera) + "frame_rate_hz: 3\n");
  const auto sequence = OpenSequence(folder.path().string());
  EXPECT_EQ(sequence->info().format, SequenceFormat::kImageFolder);
  EXPECT_THAT(sequence->info().warnings, IsEmpty());
  EXPECT_THAT(Times(ReadAll(*sequence)),
              ElementsAre(0, 333333333, 666666667, 1000000000, 1333333333, 1666666667));
}

TEST(ImageFolder, AssumedRateIsSaid) {
  const TestFolder folder;
  folder.WriteImage("images/a1.png");
  folder.WriteImage("images/a2.png");
  folder.Write("camera.yaml", kTestCamera);
  const auto sequence = OpenSequence(folder.path().string());
  EXPECT_THAT(sequence->info().warnings, ElementsAre(HasSubstr("30 frames/s are assumed")));
  SequenceOptions options;
  options.frame_rate_hz = 20.0;
  EXPECT_THAT(Times(ReadAll(*OpenSequence(folder.path().string(), options))),
              ElementsAre(0, 50000000));
}

TEST(ImageFolder, ColourAlphaAndSixteenBitBecomeGrey) {
  const TestFolder folder;
  folder.Write("camera.yaml", kTestCamera);
  cv::imwrite((folder / "1.png").string(), cv::Mat(8, 12, CV_8UC3, cv::Scalar(100, 100, 100)));
  cv::imwrite((folder / "2.png").string(), cv::Mat(8, 12, CV_8UC4, cv::Scalar(90, 90, 90, 7)));
  cv::imwrite((folder / "3.png").string(), cv::Mat(8, 12, CV_16UC1, cv::Scalar(80 * 256)));
  EXPECT_THAT(TopLeftPixels(ReadAll(*OpenSequence(folder.path().string()))),
              ElementsAre(100, 90, 80));
}

TEST(FrameRange, SelectsByIndex) {
  const TestFolder folder;
  for (int i = 0; i < 10; ++i) folder.WriteImage(fmt::format("{}.png", i), i);
  folder.Write("camera.yaml", kTestCamera);
  SequenceOptions options;
  options.first = 2;
  options.last = 8;
  options.step = 3;
  const auto sequence = OpenSequence(folder.path().string(), options);
  EXPECT_EQ(sequence->info().num_frames, 3);
  const auto frames = ReadAll(*sequence);
  EXPECT_THAT(Indices(frames), ElementsAre(2, 5, 8));
  EXPECT_THAT(TopLeftPixels(frames), ElementsAre(2, 5, 8));
  ASSERT_EQ(sequence->info().frames.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(sequence->info().frames[i].frame_index, frames[i].frame_index);
    EXPECT_EQ(sequence->info().frames[i].timestamp_ns, frames[i].timestamp_ns);
  }
}

TEST(CameraFileOption, ReplacesTheSequencesOwnCalibration) {
  const TestFolder folder;
  WriteKitti(folder, "07");
  folder.Write("07/calib.txt", "malformed\n");
  SequenceOptions options;
  options.camera_file = folder.Write("mine.yaml", kTestCamera);
  const auto sequence = OpenSequence((folder / "07").string(), options);
  EXPECT_EQ(sequence->info().camera->source, options.camera_file->string());
}

TEST(GroundTruthOption, ReplacesTheSequencesOwnTruth) {
  const TestFolder folder;
  WriteKitti(folder, "sequences/07");
  folder.Write("poses/07.txt", "malformed\n");
  SequenceOptions options;
  options.ground_truth_file = folder.Write("mine.txt", "1 1 0 0 7 0 1 0 0 0 0 1 2\n");
  const auto sequence = OpenSequence((folder / "sequences/07").string(), options);
  ASSERT_EQ(sequence->info().ground_truth->poses.size(), 1u);
  EXPECT_EQ(sequence->info().ground_truth->poses[0].timestamp_ns, 103735900);
}

}  // namespace
}  // namespace lift_slam
