#pragma once

namespace lift_slam {

// JavaScript of the map viewer: draws the points of #viewer-data into the canvas of #viewer.
const char* MapViewerScript();

}  // namespace lift_slam
