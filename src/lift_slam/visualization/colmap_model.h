#pragma once

#include <functional>
#include <iosfwd>
#include <string>

#include "lift_slam/slam/run_record.h"

namespace lift_slam {

// One map of a run as COLMAP's sparse text model: cameras.txt, images.txt, points3D.txt.
// COLMAP puts the origin at the top-left CORNER of the top-left pixel, so every pixel coordinate
// and the principal point are half a pixel larger than ours. The images are those of the ideal
// pinhole: undistort them to use the model for dense work. Ids count from 1; an image's id is its
// position in RunRecord::keyframes plus 1, a point's its position in RunRecord::points plus 1.
struct ColmapModel {
  const RunRecord& run;
  int map_index = 0;
  // File name of a frame's image, by frame index.
  std::function<std::string(std::int64_t)> image_name;

  void WriteCameras(std::ostream& stream) const;
  void WriteImages(std::ostream& stream) const;
  void WritePoints3d(std::ostream& stream) const;
};

}  // namespace lift_slam
