#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <opencv2/core.hpp>
#include <sstream>

#include "lift_slam/visualization/annotate.h"
#include "lift_slam/visualization/colmap_model.h"
#include "lift_slam/visualization/fake_run_for_test.h"
#include "lift_slam/visualization/map_ply.h"

namespace lift_slam {
namespace {

std::string Name(std::int64_t frame_index) { return std::to_string(frame_index) + ".png"; }

// The lines that are not comments.
std::vector<std::string> DataLines(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) {
    if (line.empty() || line[0] != '#') lines.push_back(line);
  }
  return lines;
}

TEST(MapPly, HoldsEveryPointAndCamera) {
  const RunRecord run = MakeFakeRun({.num_frames = 60}).run;
  std::ostringstream stream;
  WriteMapPly(run, stream);
  const std::string ply = stream.str();
  const std::size_t body = ply.find("end_header\n") + 11;
  const std::size_t count = run.points.size() + run.keyframes.size();
  EXPECT_NE(ply.find("element vertex " + std::to_string(count) + "\n"), std::string::npos);
  ASSERT_EQ(ply.size() - body, count * 19);
  float x = 0.0F;
  std::memcpy(&x, ply.data() + body + 19, 4);
  EXPECT_FLOAT_EQ(x, static_cast<float>(run.points[1].position.x()));
  EXPECT_EQ(static_cast<std::uint8_t>(ply[body + 19 + 12]), run.points[1].gray);
}

TEST(ColmapModel, CameraIsShiftedByHalfAPixel) {
  const RunRecord run = MakeFakeRun({.num_frames = 30}).run;
  std::ostringstream stream;
  ColmapModel{run, 0, Name}.WriteCameras(stream);
  EXPECT_EQ(DataLines(stream.str()).at(0),
            "1 PINHOLE 620 188 360.000000000 360.000000000 310.000000000 94.000000000");
}

TEST(ColmapModel, TracksAndImagePointsAgree) {
  const RunRecord run = MakeFakeRun({.num_frames = 60, .num_maps = 2}).run;
  std::ostringstream images, points;
  const ColmapModel model{run, 0, Name};
  model.WriteImages(images);
  model.WritePoints3d(points);
  std::map<int, std::vector<std::pair<double, std::size_t>>> image_points;  // id -> x, point
  const std::vector<std::string> lines = DataLines(images.str());
  ASSERT_EQ(lines.size() % 2, 0U);
  for (std::size_t i = 0; i < lines.size(); i += 2) {
    std::istringstream list(lines[i + 1]);
    double x, y;
    std::size_t id;
    auto& entry = image_points[std::stoi(lines[i])];
    while (list >> x >> y >> id) entry.emplace_back(x, id);
  }
  std::size_t expected_images = 0;
  for (const auto& keyframe : run.keyframes) expected_images += keyframe.map_index == 0 ? 1 : 0;
  EXPECT_EQ(image_points.size(), expected_images);
  int num_tracks = 0;
  for (const std::string& line : DataLines(points.str())) {
    std::istringstream fields(line);
    std::size_t id, r, g, b;
    double x, y, z, error;
    fields >> id >> x >> y >> z >> r >> g >> b >> error;
    const PointRecord& point = run.points[id - 1];
    EXPECT_EQ(point.map_index, 0);
    EXPECT_NEAR(z, point.position.z(), 1e-8);
    std::size_t image, index, k = 0;
    while (fields >> image >> index) {
      const auto& [seen_x, seen_id] = image_points.at(static_cast<int>(image)).at(index);
      EXPECT_EQ(seen_id, id);
      EXPECT_NEAR(seen_x, point.observations[k++].x + 0.5, 1e-3);
    }
    EXPECT_EQ(k, point.observations.size());
    ++num_tracks;
  }
  EXPECT_GT(num_tracks, 100);
}

TEST(ColmapModel, ImagePoseIsCamFromWorld) {
  const RunRecord run = MakeFakeRun({.num_frames = 30}).run;
  std::ostringstream stream;
  ColmapModel{run, 0, Name}.WriteImages(stream);
  std::istringstream line(DataLines(stream.str()).at(2));
  int id, camera;
  double qw, qx, qy, qz, tx, ty, tz;
  std::string name;
  line >> id >> qw >> qx >> qy >> qz >> tx >> ty >> tz >> camera >> name;
  EXPECT_EQ(id, 2);
  const TrajectoryPose& pose = run.keyframes[1].pose;
  EXPECT_EQ(name, Name(pose.frame_index));
  const Rigid3d cam_from_world(Eigen::Quaterniond(qw, qx, qy, qz), Eigen::Vector3d(tx, ty, tz));
  EXPECT_LT((cam_from_world * pose.world_from_cam.translation).norm(), 1e-9);
}

TEST(Annotate, MarksAreDrawnAtTheScaledPixel) {
  AnnotatedFrame frame;
  frame.image = GrayImage(cv::Mat(100, 200, CV_8UC1, cv::Scalar(0)));
  frame.marks = {{99.5F, 49.5F, false}};
  const cv::Mat drawn = DrawTrackedPoints(frame, 100);
  ASSERT_EQ(drawn.cols, 100);
  ASSERT_EQ(drawn.rows, 50);
  EXPECT_GT(drawn.at<cv::Vec3b>(25, 50)[2], 100);
  EXPECT_EQ(drawn.at<cv::Vec3b>(10, 50)[2], 0);
}

TEST(Annotate, AnEmptyImageGivesAnEmptyPicture) {
  EXPECT_TRUE(DrawTrackedPoints(AnnotatedFrame(), 100).empty());
}

}  // namespace
}  // namespace lift_slam
