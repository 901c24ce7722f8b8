#include "apps/program_for_test.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <sstream>
#include <thread>
#include <vector>

namespace lift_slam {

Outcome RunProgram(const std::string& arguments, const std::string& prefix) {
  Outcome outcome;
  const std::string command =
      prefix + std::string(LIFT_SLAM_PROGRAM) + " " + arguments + " 2>&1 </dev/null";
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return outcome;
  std::array<char, 4096> buffer{};
  while (const std::size_t size = fread(buffer.data(), 1, buffer.size(), pipe)) {
    outcome.output.append(buffer.data(), size);
  }
  const int status = pclose(pipe);
  if (WIFEXITED(status)) outcome.exit_code = WEXITSTATUS(status);
  return outcome;
}

BackgroundProgram::BackgroundProgram(const std::string& arguments, const std::string& output_file) {
  std::vector<std::string> words{LIFT_SLAM_PROGRAM};
  std::istringstream stream(arguments);
  for (std::string word; stream >> word;) words.push_back(word);
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  pid_ = fork();
  if (pid_ != 0) return;
  const int file = open(output_file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  dup2(file, STDOUT_FILENO);
  dup2(file, STDERR_FILENO);
  execv(pointers[0], pointers.data());
  _exit(127);
}

BackgroundProgram::~BackgroundProgram() {
  if (pid_ <= 0 || Ended()) return;
  Send(SIGKILL);
  waitpid(pid_, &status_, 0);
}

void BackgroundProgram::Send(int signal) const { kill(pid_, signal); }

bool BackgroundProgram::Ended() {
  if (!ended_) ended_ = waitpid(pid_, &status_, WNOHANG) == pid_;
  return ended_;
}

int BackgroundProgram::Wait() {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (!Ended() && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  if (!ended_) return 1000;  // hangs
  return WIFEXITED(status_) ? WEXITSTATUS(status_) : -WTERMSIG(status_);
}

}  // namespace lift_slam
