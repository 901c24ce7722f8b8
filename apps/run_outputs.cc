#include "apps/run_outputs.h"

#include <fmt/format.h>

#include <ostream>
#include <set>
#include <system_error>

#include "apps/frame_table.h"
#include "apps/run_report_data.h"
#include "apps/run_result_json.h"
#include "lift_slam/geometry/trajectory_io.h"
#include "lift_slam/util/file.h"
#include "lift_slam/visualization/colmap_model.h"
#include "lift_slam/visualization/map_ply.h"
#include "lift_slam/visualization/report_html.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;

void WriteForms(const Trajectory& trajectory, const fs::path& stem,
                const RunOutputOptions& options) {
  WriteTrajectory(trajectory, TrajectoryFormat::kTum, stem.string() + ".tum");
  if (options.kitti) {
    WriteTrajectory(trajectory, TrajectoryFormat::kKitti, stem.string() + ".kitti");
  }
  if (options.euroc) {
    WriteTrajectory(trajectory, TrajectoryFormat::kEurocResult, stem.string() + ".euroc");
  }
}

void WriteTrajectories(const FinishedRun& finished, const fs::path& folder,
                       const RunOutputOptions& options) {
  WriteForms(finished.run.final_trajectory, folder / "trajectory", options);
  WriteForms(finished.run.online_trajectory, folder / "trajectory_online", options);
  Trajectory keyframes;
  for (const KeyFrameRecord& keyframe : finished.run.keyframes) {
    if (!keyframe.is_loaded) keyframes.push_back(keyframe.pose);
  }
  WriteForms(keyframes, folder / "keyframes", options);
  const EvaluationResult& result = finished.evaluation.final_trajectory;
  const fs::path aligned = folder / "trajectory_aligned";
  if (result.reference_from_estimate) {
    WriteForms(result.aligned_estimate, aligned, options);
    return;
  }
  for (const char* ending : {".tum", ".kitti", ".euroc"}) {  // of an earlier run with ground truth
    std::error_code ignored;
    fs::remove(aligned.string() + ending, ignored);
  }
}

void WriteColmapModel(const ColmapModel& model, const fs::path& folder) {
  CreateFolder(folder);
  WriteFileAtomically(folder / "cameras.txt", [&](std::ostream& s) { model.WriteCameras(s); });
  WriteFileAtomically(folder / "images.txt", [&](std::ostream& s) { model.WriteImages(s); });
  WriteFileAtomically(folder / "points3D.txt", [&](std::ostream& s) { model.WritePoints3d(s); });
}

void WriteColmapModels(const FinishedRun& finished, const fs::path& folder) {
  auto image_name = finished.image_name;
  if (!image_name) image_name = [](std::int64_t i) { return fmt::format("{:06d}.png", i); };
  std::set<int> maps;
  for (const KeyFrameRecord& keyframe : finished.run.keyframes) maps.insert(keyframe.map_index);
  for (const int map_index : maps) {
    WriteColmapModel({finished.run, map_index, image_name}, folder / std::to_string(map_index));
  }
}

}  // namespace

void RunOutputOptions::Visit(OptionVisitor& visitor) {
  visitor.Field("kitti", kitti, "write the trajectories also in KITTI's form");
  visitor.Field("euroc", euroc, "write the trajectories also with stamps in nanoseconds");
  visitor.Field("colmap", colmap, "write a COLMAP text model of each map");
  visitor.Field("report", report, "write report.html");
}

void WriteRunOutputs(const FinishedRun& finished, const fs::path& folder,
                     RunOutputOptions options) {
  std::error_code ignored;
  fs::remove(folder / "result.json", ignored);  // of an earlier run: it vouches for the others
  WriteTrajectories(finished, folder, options);
  WriteFileAtomically(folder / "map.ply", [&](std::ostream& s) { WriteMapPly(finished.run, s); });
  WriteTextAtomically(folder / "frames.csv", FrameTableCsv(finished.run));
  if (options.colmap) WriteColmapModels(finished, folder / "colmap");
  WriteTextAtomically(folder / "config.yaml", finished.config_yaml);
  if (options.report) {
    WriteTextAtomically(folder / "report.html", ReportHtml(finished.run, MakeReportData(finished)));
  }
  WriteTextAtomically(folder / "result.json", RunResultJson(finished));
}

}  // namespace lift_slam
