#include "apps/pdf_figure.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <vector>

#include "lift_slam/util/file.h"
#include "lift_slam/visualization/plain_svg.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;

// Runs a program of the PATH without input or output. Its exit code; -1: it is not there; -2: it
// could not be run or was killed.
int RunQuietly(std::vector<std::string> words, const std::string& variable) {
  std::vector<char*> arguments, environment{const_cast<char*>(variable.c_str())};
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  for (char** entry = environ; *entry != nullptr; ++entry) environment.push_back(*entry);
  environment.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_RDWR, 0);
  }
  pid_t child = 0;
  const int error = posix_spawnp(&child, arguments.front(), &actions, nullptr, arguments.data(),
                                 environment.data());
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) return error == ENOENT ? -1 : -2;
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -2;
}

}  // namespace

PdfOutcome WritePdf(const std::string& svg, const fs::path& file) {
  const fs::path source = file.string() + ".part.svg", target = file.string() + ".part";
  WriteTextAtomically(source, PlainSvg(svg));
  const int code =
      RunQuietly({"rsvg-convert", "--format=pdf", "--output", target.string(), source.string()},
                 "SOURCE_DATE_EPOCH=0");  // no date in the file
  std::error_code error;
  fs::remove(source, error);
  if (code == -1) return PdfOutcome::kNoConverter;
  if (code == 0) fs::rename(target, file, error);
  if (code == 0 && !error) return PdfOutcome::kWritten;
  fs::remove(target, error);
  return PdfOutcome::kFailed;
}

}  // namespace lift_slam
