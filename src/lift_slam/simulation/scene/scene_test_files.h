#pragma once

#include <gtest/gtest.h>

#include <string>

#include "lift_slam/testing/temporary_folder.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {

// What the InputError says that `action` throws; a failure when it throws none.
template <class Action>
std::string InputErrorOf(Action&& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "no InputError";
  return {};
}

// A verbatim 8-bit SGI picture of so many channels; samples channel by channel, rows from the
// bottom up.
inline std::string SgiBytes(int width, int height, int channels, const std::string& samples) {
  std::string bytes(512, '\0');
  const auto put = [&](std::size_t at, int value) {
    bytes[at] = static_cast<char>(value >> 8);
    bytes[at + 1] = static_cast<char>(value & 0xFF);
  };
  put(0, 0x01DA);
  bytes[3] = 1;
  put(4, 3);
  put(6, width);
  put(8, height);
  put(10, channels);
  return bytes + samples;
}

}  // namespace lift_slam
