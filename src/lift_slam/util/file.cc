#include "lift_slam/util/file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <system_error>

#include "lift_slam/util/input_error.h"

namespace lift_slam {

std::string ReadText(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) {
    throw InputError(fmt::format("{}: no such file", path.string()));
  }
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  if (!stream || !std::filesystem::is_regular_file(path) || !(text << stream.rdbuf())) {
    // An empty file also makes operator<< fail; it is no error.
    if (stream && std::filesystem::is_regular_file(path) && std::filesystem::file_size(path) == 0) {
      return {};
    }
    throw InputError(fmt::format("{}: cannot be read", path.string()));
  }
  return std::move(text).str();
}

std::vector<std::string> ReadLines(const std::filesystem::path& path) {
  std::istringstream text(ReadText(path));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (lines.empty() && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
    lines.push_back(std::move(line));
  }
  return lines;
}

void WriteFileAtomically(const std::filesystem::path& path,
                         const std::function<void(std::ostream&)>& write) {
  const std::filesystem::path temporary = path.string() + ".tmp";
  const auto fail = [&](const char* what) {
    const int error = errno;
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw InputError(fmt::format("{}: cannot {}: {}", path.string(), what, std::strerror(error)));
  };
  errno = 0;
  std::ofstream stream(temporary, std::ios::binary | std::ios::trunc);
  if (!stream) fail("create the file");
  write(stream);
  stream.close();
  if (!stream) fail("write the file (disk full?)");
  if (std::rename(temporary.c_str(), path.c_str()) != 0) fail("rename the finished file");
}

void WriteTextAtomically(const std::filesystem::path& path, const std::string& text) {
  WriteFileAtomically(path, [&](std::ostream& stream) { stream << text; });
}

void CreateFolder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (std::filesystem::exists(folder) && !std::filesystem::is_directory(folder)) {
    throw InputError(fmt::format("{}: is a file, expected a folder", folder.string()));
  }
  if (error) {
    throw InputError(
        fmt::format("{}: cannot create the folder: {}", folder.string(), error.message()));
  }
}

}  // namespace lift_slam
