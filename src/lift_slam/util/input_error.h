#pragma once

#include <stdexcept>

namespace lift_slam {

// Bad input from outside (file, option, camera). The message is one clear sentence that names the
// file, line or key and what was expected; the program prints it and exits with code 1.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace lift_slam
