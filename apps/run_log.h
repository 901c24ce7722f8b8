#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace lift_slam {

// The log of one run: every line goes to a file (log.txt) with its time, warnings also to stderr.
// The library itself never logs: it returns what happened. Thread safe; no global logger.
class RunLog {
 public:
  // Throws InputError when the file cannot be created.
  explicit RunLog(const std::filesystem::path& path);
  ~RunLog();

  void Info(std::string_view message);
  void Warning(std::string_view message);
  // The first failure to write a line (a full disk), or empty. Lines after it may be missing.
  std::string WriteError() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace lift_slam
