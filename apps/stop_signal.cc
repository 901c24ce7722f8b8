#include "apps/stop_signal.h"

#include <atomic>

#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

// A signal handler reaches nothing but globals: 0, or the signal that came.
std::atomic<int> received_signal = 0;
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler must not take a lock");
std::atomic<bool> in_use = false;

extern "C" void NoteSignal(int signal) { received_signal.store(signal); }

}  // namespace

StopSignal::StopSignal() {
  LIFT_SLAM_CHECK(!in_use.exchange(true), "only one StopSignal at a time");
  received_signal.store(0);
  struct sigaction action {};
  action.sa_handler = NoteSignal;
  sigemptyset(&action.sa_mask);
  // SA_RESETHAND: the second signal finds the default, which kills.
  action.sa_flags = static_cast<int>(SA_RESTART | SA_RESETHAND);
  sigaction(SIGINT, &action, &old_interrupt_);
  sigaction(SIGTERM, &action, &old_terminate_);
}

StopSignal::~StopSignal() {
  sigaction(SIGINT, &old_interrupt_, nullptr);
  sigaction(SIGTERM, &old_terminate_, nullptr);
  in_use.store(false);
}

bool StopSignal::Requested() const { return received_signal.load() != 0; }

const char* StopSignal::Name() const {
  switch (received_signal.load()) {
    case SIGINT:
      return "SIGINT";
    case SIGTERM:
      return "SIGTERM";
    default:
      return "";
  }
}

}  // namespace lift_slam
