#include "lift_slam/util/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <sstream>
#include <system_error>

#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxLinks = 40;  // that lead to one another, as Linux

[[noreturn]] void FailReading(const fs::path& path, const std::string& why) {
  throw InputError(fmt::format("{}: cannot be read: {}", path.string(), why));
}

[[noreturn]] void FailWriting(const fs::path& path, const char* what, const std::string& why) {
  throw InputError(fmt::format("{}: cannot {}: {}", path.string(), what, why));
}

// Asked before it is opened: opening a pipe waits for who writes to it.
void CheckIsFile(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::none) FailReading(path, error.message());
  if (!fs::exists(status)) throw InputError(fmt::format("{}: no such file", path.string()));
  if (!fs::is_regular_file(status)) FailReading(path, "it is no file");
}

// False for a file and for nothing: what may be replaced.
bool IsDeviceToWriteTo(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::none) FailWriting(path, "create the file", error.message());
  if (!fs::exists(status) || fs::is_regular_file(status)) return false;
  if (fs::is_character_file(status)) return true;
  throw InputError(fmt::format("{}: is {}, expected a file to write", path.string(),
                               fs::is_directory(status) ? "a folder" : "no file"));
}

// Where symbolic links lead, whether or not there is something.
fs::path LinkTarget(fs::path path) {
  std::error_code error;
  for (int i = 0; i < kMaxLinks; ++i) {
    const fs::path next = fs::read_symlink(path, error);
    if (error) break;
    path = path.parent_path() / next;
  }
  return path;
}

// A new file beside another, of no other process (several may write the same file); removed again
// unless it takes that one's place. A killed process leaves it behind; nobody reads that name.
class TemporaryFile {
 public:
  // Throws InputError about `path` when it cannot be made.
  TemporaryFile(const fs::path& target, const fs::path& path) {
    static std::atomic<unsigned> counter = 0;
    constexpr std::size_t kMaxNameBytes = 200;  // leaves room for what follows it
    const std::string name = target.filename().string().substr(0, kMaxNameBytes);
    int file = -1;
    do {
      path_ = target.parent_path() / fmt::format("{}.{}-{}.tmp", name, getpid(), counter++);
      file = open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    } while (file < 0 && errno == EEXIST);  // left by a process of the same number
    if (file < 0) FailWriting(path, "create the file", std::strerror(errno));
    close(file);
  }
  ~TemporaryFile() {
    if (!path_.empty()) unlink(path_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const fs::path& path() const { return path_; }
  bool TakePlaceOf(const fs::path& target) {
    if (std::rename(path_.c_str(), target.c_str()) != 0) return false;
    path_.clear();
    return true;
  }

 private:
  fs::path path_;
};

// Throws InputError about `path` when `file` cannot be written.
void WriteInto(const fs::path& file, const fs::path& path,
               const std::function<void(std::ostream&)>& write) {
  errno = 0;
  std::ofstream stream(file, std::ios::binary | std::ios::trunc);
  if (!stream) FailWriting(path, "create the file", std::strerror(errno));
  write(stream);
  stream.close();
  if (!stream) FailWriting(path, "write the file (disk full?)", std::strerror(errno));
}

}  // namespace

std::string ReadText(const std::filesystem::path& path) {
  CheckIsFile(path);
  std::ifstream stream(path, std::ios::binary);
  if (!stream) FailReading(path, std::strerror(errno));
  std::ostringstream text;
  if (text << stream.rdbuf()) return std::move(text).str();
  // An empty file also makes operator<< fail; it is no error.
  std::error_code ignored;
  if (fs::file_size(path, ignored) != 0) FailReading(path, std::strerror(errno));
  return {};
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
  if (IsDeviceToWriteTo(path)) return WriteInto(path, path, write);
  const fs::path target = LinkTarget(path);
  TemporaryFile temporary(target, path);
  WriteInto(temporary.path(), path, write);
  if (!temporary.TakePlaceOf(target)) {
    FailWriting(path, "rename the finished file", std::strerror(errno));
  }
}

void WriteTextAtomically(const std::filesystem::path& path, const std::string& text) {
  WriteFileAtomically(path, [&](std::ostream& stream) { stream << text; });
}

void CreateFolder(const std::filesystem::path& folder) {
  std::error_code error, ignored;
  fs::create_directories(folder, error);
  const fs::file_status status = fs::status(folder, ignored);
  if (fs::exists(status) && !fs::is_directory(status)) {
    throw InputError(fmt::format("{}: is a file, expected a folder", folder.string()));
  }
  if (error) {
    throw InputError(
        fmt::format("{}: cannot create the folder: {}", folder.string(), error.message()));
  }
}

}  // namespace lift_slam
