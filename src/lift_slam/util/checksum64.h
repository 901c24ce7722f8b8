#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace lift_slam {

// A number that changes when the bytes do: finds damage, not malice (for that: sha256.h). Any
// change within 8 bytes is found for certain. Several gigabytes a second.
std::uint64_t Checksum64(std::span<const std::byte> bytes, std::uint64_t seed = 0);

}  // namespace lift_slam
