#pragma once

#include <csignal>

namespace lift_slam {

// While it lives, SIGINT and SIGTERM only raise a flag that the run asks for, so that a run ends
// with all of its outputs; a second signal of the same kind ends the program at once. At most one
// at a time; the handlers before are put back at the end.
class StopSignal {
 public:
  StopSignal();
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

  // Whether to stop; callable from any thread.
  bool Requested() const;
  // "SIGINT" or "SIGTERM"; empty when none came.
  const char* Name() const;

 private:
  struct sigaction old_interrupt_, old_terminate_;
};

}  // namespace lift_slam
