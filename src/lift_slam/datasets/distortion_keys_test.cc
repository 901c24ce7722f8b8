#include "lift_slam/datasets/distortion_keys.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lift_slam/datasets/camera_file.h"
#include "lift_slam/datasets/dataset_test_files.h"

// No kind of camera file loses its distortion in silence.
namespace lift_slam {
namespace {

using testing::AllOf;
using testing::HasSubstr;

Camera Read(const std::string& text) {
  const TestFolder folder;
  return ReadCameraFile(folder.Write("c.yaml", text));
}

std::string ReadError(const std::string& text) {
  return InputErrorOf([&] { Read(text); });
}

bool HasNone(const Camera& camera) {
  return std::holds_alternative<NoDistortion>(camera.distortion);
}

constexpr char kEuroc[] = "intrinsics: [10, 11, 5.5, 3.5]\nresolution: [12, 8]\n";
constexpr char kOpenCv[] = "camera_matrix: [650, 0, 320, 0, 651, 241, 0, 0, 1]\n";
constexpr char kOrbSlam[] = "Camera.fx: 517\nCamera.fy: 516\nCamera.cx: 318\nCamera.cy: 255\n";
constexpr char kOrbSlam3[] = "Camera1.fx: 517\nCamera1.fy: 516\nCamera1.cx: 318\nCamera1.cy: 255\n";

TEST(RigDistortion, CoefficientsNeedTheNameOfTheirModel) {
  const std::string rig = kEuroc;
  EXPECT_THAT(ReadError(rig + "distortion_coefficients: [-0.28, 0.07, 0, 0]\n"),
              AllOf(HasSubstr("c.yaml:3: key 'distortion_coefficients'"),
                    HasSubstr("a key 'distortion_model' beside it")));
  EXPECT_THAT(ReadError("cam0:\n  intrinsics: [10, 11, 5.5, 3.5]\n"
                        "  distortion_coeffs: [-0.28, 0.07, 0, 0]\n"),
              AllOf(HasSubstr("c.yaml:3"), HasSubstr("'cam0/distortion_model'")));
  EXPECT_TRUE(HasNone(Read(rig + "distortion_coefficients: [0, 0, 0, 0]\n")));
  EXPECT_TRUE(HasNone(Read(rig + "distortion_model: none\ndistortion_coefficients: []\n")));
  EXPECT_TRUE(HasNone(Read(rig)));
}

TEST(RigDistortion, TheKeyOfAnotherFormatIsRefused) {
  EXPECT_THAT(ReadError(kEuroc + std::string("distortion_coeffs: [-0.28, 0.07, 0, 0]\n")),
              AllOf(HasSubstr("c.yaml:3: key 'distortion_coeffs': expected no such key"),
                    HasSubstr("read from distortion_coefficients")));
  EXPECT_THAT(ReadError("cam0:\n  intrinsics: [10, 11, 5.5, 3.5]\n"
                        "  distortion_coefficients: [-0.28, 0.07, 0, 0]\n"),
              HasSubstr("read from cam0/distortion_coeffs"));
  // Of another camera.
  EXPECT_TRUE(
      HasNone(Read("cam0:\n  intrinsics: [10, 11, 5.5, 3.5]\n"
                   "cam1:\n  distortion_coefficients: [-0.28, 0.07, 0, 0]\n")));
}

TEST(OpenCvDistortion, OtherKeysAreRefused) {
  for (const char* key :
       {"distortion_coeffs", "dist_coeffs", "Distortion_Coefficients", "distCoeffs"}) {
    EXPECT_THAT(ReadError(fmt::format("{}{}: [-0.28, 0.09, 0, 0]\n", kOpenCv, key)),
                AllOf(HasSubstr(fmt::format("c.yaml:2: key '{}'", key)),
                      HasSubstr("read from distortion_coefficients")));
  }
  const std::string file = kOpenCv;
  EXPECT_THAT(ReadError(file + "dist_coeffs:\n  cols: 4\n  data: [0.1, 0, 0, 0]\n"),
              HasSubstr("key 'dist_coeffs/data'"));
  EXPECT_TRUE(HasNone(Read(file + "dist_coeffs: [0, 0, 0, 0]\n")));
  EXPECT_TRUE(HasNone(Read(file + "dist_coeffs:\n  cols: 4\n  dt: d\n  data: [0, 0, 0, 0]\n")));
  EXPECT_TRUE(HasNone(Read(file + "distance_to_target: 3\n")));
}

TEST(OpenCvDistortion, FisheyeNeedsCoefficients) {
  EXPECT_THAT(ReadError(kOpenCv + std::string("fisheye_model: 1\n")),
              HasSubstr("key 'distortion_coefficients' is missing"));
  EXPECT_THAT(ReadError(kOpenCv + std::string("distortion_model: equidistant\n")),
              HasSubstr("key 'distortion_coefficients' is missing"));
}

TEST(OrbSlamDistortion, MisspelledCoefficientsAreRefused) {
  const std::string expected = "read from Camera.k1, Camera.k2, Camera.p1, Camera.p2, Camera.k3";
  for (const char* key : {"Camera.K1", "camera.k1", "Camera.k_1", "Camera.P2", "Camera.k4",
                          "Camera1.k1", "Camera.distCoeffs"}) {
    EXPECT_THAT(ReadError(fmt::format("{}{}: 0.26\n", kOrbSlam, key)),
                AllOf(HasSubstr(fmt::format("c.yaml:5: key '{}'", key)), HasSubstr(expected)));
  }
  EXPECT_THAT(ReadError(kOrbSlam3 + std::string("Camera.k1: 0.26\n")),
              HasSubstr("read from Camera1.k1"));
  EXPECT_THAT(ReadError(kOrbSlam3 + std::string("Camera.type: KannalaBrandt8\nCamera1.p1: 0.2\n")),
              HasSubstr("read from Camera1.k1, Camera1.k2, Camera1.k3, Camera1.k4"));
}

TEST(OrbSlamDistortion, OtherKeysMayStand) {
  const std::string rest =
      "Camera.k1: 0.26\nCamera.k3: 1.16\nCamera.k4: 0\nCamera.bf: 40.0\nCamera.RGB: 1\n"
      "Camera.pixel_format: 3\nCamera2.k1: 0.3\nCamera.fps: 30.0\n";
  EXPECT_EQ(std::get<RadialTangential>(Read(kOrbSlam + rest).distortion).k3, 1.16);
  EXPECT_EQ(std::get<RadialTangential>(
                Read(kOrbSlam3 + std::string("Camera.k1: 0.26\nCamera1.k1: 0.26\n")).distortion)
                .k1,
            0.26);
}

}  // namespace
}  // namespace lift_slam
