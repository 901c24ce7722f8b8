#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <type_traits>

namespace lift_slam {

// The begin of a file as a Header; what a shorter file lacks stays as it is constructed. Not by
// memcpy: the bytes of an empty file are at nullptr.
template <typename Header>
Header ReadHeader(std::span<const std::byte> bytes) {
  static_assert(std::is_trivially_copyable_v<Header>);
  Header header;
  std::ranges::copy(bytes.first(std::min(bytes.size(), sizeof header)),
                    std::as_writable_bytes(std::span(&header, 1)).begin());
  return header;
}

}  // namespace lift_slam
