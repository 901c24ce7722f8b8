#pragma once

#include <string>

namespace lift_slam {

struct DotChart;
struct Plot;

// A figure of a benchmark, as it stands in the page and as a file.
struct BenchmarkPicture {
  std::string section;    // heading it belongs under
  std::string file_name;  // "trajectory_00.svg"
  std::string title, note;
  std::string svg;       // element; its colours come from PlotStyleSheet()
  std::string svg_file;  // a file of its own
};

// The file is named after `name`, with an underscore for what no file name should have.
BenchmarkPicture MakePicture(std::string section, const std::string& name, std::string title,
                             std::string note, const Plot& plot);
BenchmarkPicture MakePicture(std::string section, const std::string& name, std::string title,
                             std::string note, const DotChart& chart);

}  // namespace lift_slam
