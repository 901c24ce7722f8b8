#pragma once

namespace lift_slam {

// What the program's exit codes mean. A command that returns ends with kDone; bad input is thrown
// as InputError; the third way out is `throw CLI::RuntimeError(kNoTrajectory)`, after all outputs
// have been written.
enum ExitCode : int {
  kDone = 0,           // status OK or PARTIAL
  kBadInput = 1,       // InputError or a wrong command line: one sentence on stderr; a benchmark's
                       // run that broke: console.txt says why
  kInternalError = 2,  // a bug, or no memory left
  kNoTrajectory = 3,   // ran, but failed to initialise or was lost
  kStopped = 130,      // a signal ended the work before it was complete; what is there is whole
};

}  // namespace lift_slam
