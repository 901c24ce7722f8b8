#pragma once

#include <string>

// Runs the program itself, for tests of its exit codes and of what it prints.
namespace lift_slam {

struct Outcome {
  int exit_code = -1;  // -1: ended by a signal
  std::string output;  // standard output and error together
};

// Runs `lift_slam ARGUMENTS` by the shell; `prefix` goes before it in the same shell line.
Outcome RunProgram(const std::string& arguments, const std::string& prefix = "");

// The program running beside the test.
class BackgroundProgram {
 public:
  // Arguments without spaces in them; output goes to `output_file`.
  BackgroundProgram(const std::string& arguments, const std::string& output_file);
  ~BackgroundProgram();
  BackgroundProgram(const BackgroundProgram&) = delete;
  BackgroundProgram& operator=(const BackgroundProgram&) = delete;

  void Send(int signal) const;
  bool Ended();
  // Waits for the end, a minute at most: exit code, or minus the number of the signal.
  int Wait();

 private:
  int pid_ = -1;
  int status_ = 0;
  bool ended_ = false;
};

}  // namespace lift_slam
