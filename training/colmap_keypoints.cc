#include <fmt/format.h>
#include <sqlite3.h>

#include <cmath>
#include <cstring>
#include <memory>

#include "lift_slam/util/input_error.h"
#include "training/colmap_reader.h"

namespace lift_slam::training {
namespace {

struct CloseDatabase {
  void operator()(sqlite3* database) const { sqlite3_close(database); }
};
struct FinalizeStatement {
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};

// COLMAP counts pixels from the top-left corner; its rows are x, y, then scale and orientation, or
// a 2 x 2 matrix.
ColmapKeypoint ToKeypoint(const float* row, int columns) {
  const float scale =
      columns == 4 ? row[2] : std::sqrt(std::abs(row[2] * row[5] - row[3] * row[4]));
  return {row[0] - 0.5F, row[1] - 0.5F, scale};
}

}  // namespace

std::map<std::uint32_t, std::vector<ColmapKeypoint>> ReadColmapKeypoints(
    const std::filesystem::path& path) {
  const auto refuse = [&](const std::string& why) {
    throw InputError(fmt::format("{}: {}", path.string(), why));
  };
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) {
    refuse(
        "is missing; training needs COLMAP's database beside the model, for the keypoints' scales");
  }
  sqlite3* opened = nullptr;
  sqlite3_open_v2(path.c_str(), &opened, SQLITE_OPEN_READONLY, nullptr);
  const std::unique_ptr<sqlite3, CloseDatabase> database(opened);
  sqlite3_stmt* prepared = nullptr;
  if (sqlite3_prepare_v2(opened, "SELECT image_id, rows, cols, data FROM keypoints", -1, &prepared,
                         nullptr) != SQLITE_OK) {
    refuse(fmt::format("is no database of COLMAP: {}", sqlite3_errmsg(opened)));
  }
  const std::unique_ptr<sqlite3_stmt, FinalizeStatement> statement(prepared);
  std::map<std::uint32_t, std::vector<ColmapKeypoint>> keypoints;
  int step = sqlite3_step(prepared);
  for (; step == SQLITE_ROW; step = sqlite3_step(prepared)) {
    const auto image = static_cast<std::uint32_t>(sqlite3_column_int64(prepared, 0));
    const int rows = sqlite3_column_int(prepared, 1), columns = sqlite3_column_int(prepared, 2);
    if (rows == 0) continue;
    if (columns != 4 && columns != 6) {
      refuse("its keypoints have no scale: expected SIFT keypoints of 'colmap feature_extractor'");
    }
    const auto values = static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
    if (static_cast<std::size_t>(sqlite3_column_bytes(prepared, 3)) != values * sizeof(float)) {
      refuse(fmt::format("the keypoints of image {} are damaged", image));
    }
    std::vector<float> data(values);
    std::memcpy(data.data(), sqlite3_column_blob(prepared, 3), values * sizeof(float));
    std::vector<ColmapKeypoint>& list = keypoints[image];
    for (std::size_t at = 0; at < values; at += static_cast<std::size_t>(columns)) {
      list.push_back(ToKeypoint(&data[at], columns));
    }
  }
  if (step != SQLITE_DONE) {
    refuse(fmt::format("cannot be read to its end: {}; copy or make it again",
                       sqlite3_errmsg(opened)));
  }
  if (keypoints.empty()) refuse("holds no keypoints");
  return keypoints;
}

}  // namespace lift_slam::training
