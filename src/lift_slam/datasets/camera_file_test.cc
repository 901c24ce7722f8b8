#include "lift_slam/datasets/camera_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lift_slam/datasets/dataset_test_files.h"
#include "lift_slam/util/file.h"

namespace lift_slam {
namespace {

using testing::AllOf;
using testing::HasSubstr;

Camera Read(const std::string& name, const std::string& text, const std::string& camera = {}) {
  const TestFolder folder;
  return ReadCameraFile(folder.Write(name, text), camera);
}

std::string ReadError(const std::string& name, const std::string& text,
                      const std::string& camera = {}) {
  return InputErrorOf([&] { Read(name, text, camera); });
}

void ExpectPinhole(const Camera& camera, const PinholeIntrinsics& expected) {
  EXPECT_DOUBLE_EQ(camera.pinhole.fx, expected.fx);
  EXPECT_DOUBLE_EQ(camera.pinhole.fy, expected.fy);
  EXPECT_DOUBLE_EQ(camera.pinhole.cx, expected.cx);
  EXPECT_DOUBLE_EQ(camera.pinhole.cy, expected.cy);
  EXPECT_EQ(camera.pinhole.width, expected.width);
  EXPECT_EQ(camera.pinhole.height, expected.height);
}

void ExpectRadialTangential(const Camera& camera, double k1, double k2, double p1, double p2,
                            double k3) {
  const auto* d = std::get_if<RadialTangential>(&camera.distortion);
  ASSERT_NE(d, nullptr);
  EXPECT_EQ((std::array{d->k1, d->k2, d->p1, d->p2, d->k3}), (std::array{k1, k2, p1, p2, k3}));
}

void ExpectKannalaBrandt(const Camera& camera, double k1, double k2, double k3, double k4) {
  const auto* d = std::get_if<KannalaBrandt>(&camera.distortion);
  ASSERT_NE(d, nullptr);
  EXPECT_EQ((std::array{d->k1, d->k2, d->k3, d->k4}), (std::array{k1, k2, k3, k4}));
}

// Own format.

TEST(OwnCameraFile, ComesBackAsWritten) {
  const TestFolder folder;
  for (const Distortion& distortion :
       {Distortion(NoDistortion{}), Distortion(RadialTangential{-0.28340811, 0.1, 1e-5, 2e-5, 0.3}),
        Distortion(KannalaBrandt{0.1, 0.2, 0.3, 0.4}), Distortion(FieldOfView{0.933271})}) {
    Camera camera;
    camera.pinhole = {458.654, 457.296, 367.215, 248.375, 752, 480};
    camera.distortion = distortion;
    camera.frame_rate_hz = 1.0 / 3.0;
    WriteCameraFile(folder / "camera.yaml", camera);
    const Camera read = ReadCameraFile(folder / "camera.yaml");
    ExpectPinhole(read, camera.pinhole);
    EXPECT_EQ(read.frame_rate_hz, camera.frame_rate_hz);
    EXPECT_EQ(read.distortion.index(), distortion.index());
    EXPECT_EQ(read.source, (folder / "camera.yaml").string());
    if (distortion.index() == 1) ExpectRadialTangential(read, -0.28340811, 0.1, 1e-5, 2e-5, 0.3);
    if (distortion.index() == 2) ExpectKannalaBrandt(read, 0.1, 0.2, 0.3, 0.4);
    if (distortion.index() == 3) {
      EXPECT_EQ(std::get<FieldOfView>(read.distortion).omega, 0.933271);
    }
  }
}

TEST(OwnCameraFile, TheExampleOfTheMessagesIsValid) {
  ExpectPinhole(Read("camera.yaml", std::string(kCameraFileExample)),
                {525, 525, 319.5, 239.5, 640, 480});
}

TEST(OwnCameraFile, NamesWhatIsWrong) {
  const std::string rest = "width: 640\nheight: 480\nfx: 5\nfy: 5\ncx: 5\ncy: 5\n";
  EXPECT_THAT(ReadError("c.yaml", "model: pinhole\n"), HasSubstr("key 'fx' is missing"));
  EXPECT_THAT(ReadError("c.yaml", "model: pinhole\nfocal: 3\n" + rest),
              AllOf(HasSubstr("c.yaml:2: key 'focal'"), HasSubstr("width, height, fx")));
  EXPECT_THAT(ReadError("c.yaml", "model: omni\n" + rest), HasSubstr("expected pinhole, radial_"));
  EXPECT_THAT(ReadError("c.yaml", "model: pinhole\nwidth: wide\n"), HasSubstr("is missing"));
  EXPECT_THAT(ReadError("c.yaml", "model: fov\nomega: .nan\n" + rest), HasSubstr("finite number"));
  EXPECT_THAT(ReadError("c.yaml",
                        "{model: pinhole, width: 4, height: 4, fx: 0, fy: 1, cx: 1, "
                        "cy: 1}"),
              HasSubstr("positive focal lengths"));
  EXPECT_THAT(ReadError("c.yaml",
                        "{model: pinhole, width: 4, height: 4, fx: 1, fy: 1, cx: 9, "
                        "cy: 1}"),
              HasSubstr("outside the image of 4x4"));
}

TEST(CameraFile, NamesLineOfBrokenYaml) {
  EXPECT_THAT(ReadError("c.yaml", "model: pinhole\nfx: [1, 2\n"), HasSubstr("no valid YAML"));
  EXPECT_THAT(ReadError("c.yaml", "hello\n"), HasSubstr("key: value"));
  EXPECT_THAT(ReadError("c.yaml", "fx: 3\n"), HasSubstr("no known camera calibration"));
  EXPECT_THAT(ReadError("c.yaml", ""), HasSubstr("the file is empty"));
  EXPECT_THAT(InputErrorOf([] { ReadCameraFile("/nowhere/c.yaml"); }),
              HasSubstr("/nowhere/c.yaml: no such camera file"));
}

// OpenCV and ROS.

constexpr char kOpenCvYaml[] = R"(%YAML:1.0
---
calibration_time: "Mon 01 Jan 2024"
image_width: 640
image_height: 480
camera_matrix: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 6.5e+02, 0., 3.2e+02, 0., 651., 241., 0., 0., 1. ]
distortion_coefficients: !!opencv-matrix
   rows: 5
   cols: 1
   dt: d
   data: [ -0.28, 0.09, 1.0e-03, -2.0e-03, 0.01 ]
)";

TEST(OpenCvCameraFile, ReadsYaml) {
  const Camera camera = Read("out_camera_data.yml", kOpenCvYaml);
  ExpectPinhole(camera, {650, 651, 320, 241, 640, 480});
  ExpectRadialTangential(camera, -0.28, 0.09, 0.001, -0.002, 0.01);
}

TEST(OpenCvCameraFile, ReadsXml) {
  const Camera camera = Read("out_camera_data.xml", R"(<?xml version="1.0"?>
<!-- made <by> hand -->
<opencv_storage>
<image_width>640</image_width>
<image_height>480</image_height>
<fisheye_model>1</fisheye_model>
<camera_matrix type_id="opencv-matrix">
  <rows>3</rows>
  <cols>3</cols>
  <dt>d</dt>
  <data>
    650. 0. 320. 0. 651. 241. 0. 0. 1.</data></camera_matrix>
<distortion_coefficients type_id="opencv-matrix">
  <rows>4</rows><cols>1</cols><dt>d</dt>
  <data>0.1 0.2
    0.3 0.4</data></distortion_coefficients>
</opencv_storage>
)");
  ExpectPinhole(camera, {650, 651, 320, 241, 640, 480});
  ExpectKannalaBrandt(camera, 0.1, 0.2, 0.3, 0.4);
}

TEST(OpenCvCameraFile, ReadsWhatFileStorageWrites) {
  const std::string byte_order_mark = "\xEF\xBB\xBF";
  for (const char* name : {"c.yaml", "c.xml", "c.json"}) {
    const TestFolder folder;
    {
      cv::FileStorage storage((folder / name).string(), cv::FileStorage::WRITE);
      storage << "image_width" << 640 << "image_height" << 480;
      storage << "camera_matrix" << (cv::Mat_<double>(3, 3) << 650, 0, 320, 0, 651, 241, 0, 0, 1);
      storage << "distortion_coefficients" << (cv::Mat_<double>(1, 5) << -0.28, 0.09, 0, 0, 0.01);
    }
    const std::string text = ReadText(folder / name);
    for (const std::string& start : {std::string(), byte_order_mark}) {
      const Camera camera = Read(name, start + text);
      ExpectPinhole(camera, {650, 651, 320, 241, 640, 480});
      ExpectRadialTangential(camera, -0.28, 0.09, 0.0, 0.0, 0.01);
    }
  }
}

TEST(OpenCvCameraFile, ReadsRosCameraInfo) {
  const Camera camera = Read("ost.yaml",
                             "image_width: 640\nimage_height: 480\ncamera_name: left\n"
                             "camera_matrix:\n  rows: 3\n  cols: 3\n"
                             "  data: [650, 0, 320, 0, 651, 241, 0, 0, 1]\n"
                             "distortion_model: equidistant\ndistortion_coefficients:\n"
                             "  rows: 1\n  cols: 4\n  data: [0.1, 0.2, 0.3, 0.4]\n");
  ExpectPinhole(camera, {650, 651, 320, 241, 640, 480});
  ExpectKannalaBrandt(camera, 0.1, 0.2, 0.3, 0.4);
}

TEST(OpenCvCameraFile, RefusesTheRationalModel) {
  std::string text = kOpenCvYaml;
  text.replace(text.find("0.01 ]"), 6, "0.01, 0, 0.5, 0 ]");
  EXPECT_THAT(ReadError("c.yml", text),
              AllOf(HasSubstr("distortion_coefficients/data"), HasSubstr("not supported")));
}

TEST(OpenCvCameraFile, NamesWhereXmlBreaks) {
  EXPECT_THAT(ReadError("c.xml", "<a>\n<b>1</c></a>"), HasSubstr("c.xml:2: no valid XML"));
  EXPECT_THAT(ReadError("c.xml", "<a><b>1</b>"), HasSubstr("'a' is not closed"));
  EXPECT_THAT(ReadError("c.xml", "plain text"), HasSubstr("no valid XML"));
}

// Kalibr, EuRoC, ORB-SLAM.

constexpr char kKalibr[] = R"(cam0:
  T_cam_imu:
  - [1.0, 0.0, 0.0, 0.1]
  - [0.0, 1.0, 0.0, 0.2]
  - [0.0, 0.0, 1.0, 0.3]
  - [0.0, 0.0, 0.0, 1.0]
  camera_model: pinhole
  distortion_coeffs: [0.0034, 0.0007, -0.0002, 0.0001]
  distortion_model: equidistant
  intrinsics: [190.97, 190.98, 254.93, 256.89]
  resolution: [512, 512]
  rostopic: /cam0/image_raw
cam1:
  camera_model: pinhole
  distortion_coeffs: [-0.2, 0.1, 0.001, 0.002]
  distortion_model: radtan
  intrinsics: [290.97, 290.98, 354.93, 356.89]
  resolution: [712, 712]
cam2:
  camera_model: omni
  intrinsics: [1.1, 290.97, 290.98, 354.93, 356.89]
)";

TEST(KalibrCameraFile, ReadsTheCameraAskedFor) {
  ExpectPinhole(Read("camchain.yaml", kKalibr), {190.97, 190.98, 254.93, 256.89, 512, 512});
  ExpectKannalaBrandt(Read("camchain.yaml", kKalibr), 0.0034, 0.0007, -0.0002, 0.0001);
  ExpectRadialTangential(Read("camchain.yaml", kKalibr, "cam1"), -0.2, 0.1, 0.001, 0.002, 0.0);
}

TEST(KalibrCameraFile, RefusesOtherProjections) {
  EXPECT_THAT(ReadError("camchain.yaml", kKalibr, "cam2"),
              AllOf(HasSubstr("cam2/camera_model"), HasSubstr("expected pinhole")));
  EXPECT_THAT(ReadError("camchain.yaml", kKalibr, "cam7"), HasSubstr("no camera 'cam7'"));
}

TEST(OrbSlamCameraFile, ReadsBothGenerations) {
  const Camera second = Read("TUM1.yaml",
                             "%YAML:1.0\n\n#----\nCamera.fx: 517.3\nCamera.fy: 516.5\n"
                             "Camera.cx: 318.6\nCamera.cy: 255.3\nCamera.k1: 0.26\n"
                             "Camera.k2: -0.95\nCamera.p1: -0.005\nCamera.p2: 0.003\n"
                             "Camera.k3: 1.16\nCamera.fps: 30.0\nORBextractor.nFeatures: 1000\n");
  ExpectPinhole(second, {517.3, 516.5, 318.6, 255.3, 0, 0});
  ExpectRadialTangential(second, 0.26, -0.95, -0.005, 0.003, 1.16);
  EXPECT_EQ(second.frame_rate_hz, 30.0);

  const Camera third = Read("TUM-VI.yaml",
                            "%YAML:1.0\nFile.version: \"1.0\"\nCamera.type: \"KannalaBrandt8\"\n"
                            "Camera1.fx: 190.9\nCamera1.fy: 191.0\nCamera1.cx: 254.9\n"
                            "Camera1.cy: 256.9\nCamera1.k1: 0.003\nCamera1.k2: 0.0007\n"
                            "Camera1.k3: -0.002\nCamera1.k4: 0.0002\nCamera.width: 512\n"
                            "Camera.height: 513\nCamera.fps: 20\n");
  ExpectPinhole(third, {190.9, 191.0, 254.9, 256.9, 512, 513});
  ExpectKannalaBrandt(third, 0.003, 0.0007, -0.002, 0.0002);
}

TEST(OrbSlamCameraFile, NamesWhatIsMissing) {
  EXPECT_THAT(ReadError("c.yaml", "Camera.fx: 517.3\nCamera.fy: 516.5\nCamera.cx: 318.6\n"),
              HasSubstr("key 'Camera.cy' is missing"));
}

// COLMAP, TUM-mono, KITTI.

TEST(ColmapCameraFile, MovesTheCornerToTheCentreOfThePixel) {
  const std::string header = "# Camera list\n#   CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n";
  const auto read = [&](const std::string& line) { return Read("cameras.txt", header + line); };
  ExpectPinhole(read("1 SIMPLE_PINHOLE 640 480 500 320 240"), {500, 500, 319.5, 239.5, 640, 480});
  ExpectPinhole(read("1 PINHOLE 640 480 500 501 320 240"), {500, 501, 319.5, 239.5, 640, 480});
  ExpectRadialTangential(read("1 SIMPLE_RADIAL 640 480 500 320 240 0.1"), 0.1, 0, 0, 0, 0);
  ExpectRadialTangential(read("1 RADIAL 640 480 500 320 240 0.1 0.2"), 0.1, 0.2, 0, 0, 0);
  ExpectRadialTangential(read("1 OPENCV 640 480 500 501 320 240 0.1 0.2 0.3 0.4"), 0.1, 0.2, 0.3,
                         0.4, 0);
  ExpectRadialTangential(read("1 FULL_OPENCV 640 480 500 501 320 240 .1 .2 .3 .4 .5 0 0 0"), 0.1,
                         0.2, 0.3, 0.4, 0.5);
  ExpectKannalaBrandt(read("1 OPENCV_FISHEYE 640 480 500 501 320 240 0.1 0.2 0.3 0.4"), 0.1, 0.2,
                      0.3, 0.4);
  const Camera fov = read("1 FOV 640 480 500 501 320 240 0.9");
  ExpectPinhole(fov, {500, 501, 319.5, 239.5, 640, 480});
  EXPECT_EQ(std::get<FieldOfView>(fov.distortion).omega, 0.9);
}

TEST(ColmapCameraFile, RefusesWhatItCannotKeep) {
  EXPECT_THAT(ReadError("cameras.txt", "1 PINHOLE 640 480 500 320 240"),
              AllOf(HasSubstr("cameras.txt:1"), HasSubstr("4 parameters")));
  EXPECT_THAT(ReadError("cameras.txt",
                        "1 PINHOLE 640 480 500 500 320 240\n"
                        "2 PINHOLE 640 480 500 500 320 240"),
              HasSubstr("holds 2 cameras"));
  EXPECT_THAT(
      ReadError("cameras.txt", "1 FULL_OPENCV 640 480 500 501 320 240 .1 .2 .3 .4 .5 .6 0 0"),
      HasSubstr("k4, k5 and k6 zero"));
  EXPECT_THAT(ReadError("cameras.txt", "1 THIN_PRISM_FISHEYE 640 480 500 501 320 240 0 0 0 0 0 0"),
              HasSubstr("a supported camera model"));
}

TEST(TumMonoCameraFile, ScalesRelativeNumbersAndTakesOffHalfAPixel) {
  const Camera camera = Read("camera.txt",
                             "0.535719308086809 0.669566858850269 0.493248545285398 "
                             "0.500408664348414 0.897966326944875\n1280 1024\n"
                             "0.4 0.53 0.5 0.5 0\n640 480\n");
  ExpectPinhole(camera,
                {0.535719308086809 * 1280, 0.669566858850269 * 1024, 0.493248545285398 * 1280 - 0.5,
                 0.500408664348414 * 1024 - 0.5, 1280, 1024});
  EXPECT_EQ(std::get<FieldOfView>(camera.distortion).omega, 0.897966326944875);
}

TEST(TumMonoCameraFile, KeepsAbsoluteNumbers) {
  const Camera camera = Read("camera.txt", "Pinhole 500 501 320 240 0\n640 480\ncrop\n640 480\n");
  ExpectPinhole(camera, {500, 501, 320, 240, 640, 480});
  EXPECT_TRUE(std::holds_alternative<NoDistortion>(camera.distortion));
  ExpectRadialTangential(Read("camera.txt", "RadTan 500 501 320 240 0.1 0.2 0.3 0.4\n640 480\n"),
                         0.1, 0.2, 0.3, 0.4, 0);
}

TEST(TumMonoCameraFile, NamesTheMissingSize) {
  EXPECT_THAT(ReadError("camera.txt", "0.5 0.6 0.49 0.5 0.9\n"), HasSubstr("width and height"));
  EXPECT_THAT(ReadError("camera.txt", "0.5 0.6 0.49 0.5 0.9\n640\n"), HasSubstr("camera.txt:2"));
}

TEST(KittiCameraFile, ReadsTheProjectionOfTheCameraAskedFor) {
  const std::string text =
      "P0: 700 0 600 0 0 701 180 0 0 0 1 0\nP2: 702 0 601 45 0 703 181 0.1 0 0 1 0.003\n";
  ExpectPinhole(Read("calib.txt", text), {700, 701, 600, 180, 0, 0});
  ExpectPinhole(Read("calib.txt", text, "image_2"), {702, 703, 601, 181, 0, 0});
  EXPECT_THAT(ReadError("calib.txt", "P0: 700 0 600 0 0 701 180 0 0 0 1\n"),
              AllOf(HasSubstr("calib.txt:1"), HasSubstr("12 numbers")));
  EXPECT_THAT(ReadError("calib.txt", "P0: 700 0 abc 0 0 701 180 0 0 0 1 0\n"),
              HasSubstr("a number in column 4"));
}

}  // namespace
}  // namespace lift_slam
