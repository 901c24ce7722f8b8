#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace lift_slam::nn {

// One cache line, and the widest vector register.
inline constexpr std::size_t kAlignmentBytes = 64;

template <class T>
struct AlignedAllocator {
  using value_type = T;
  AlignedAllocator() = default;
  template <class U>
  AlignedAllocator(const AlignedAllocator<U>&) {}  // NOLINT: converts, as allocators must

  T* allocate(std::size_t count) {
    return static_cast<T*>(::operator new (count * sizeof(T), std::align_val_t{kAlignmentBytes}));
  }
  void deallocate(T* pointer, std::size_t) {
    ::operator delete (pointer, std::align_val_t{kAlignmentBytes});
  }
  bool operator==(const AlignedAllocator&) const { return true; }
};

// A vector whose first element lies at a multiple of kAlignmentBytes.
template <class T>
using AlignedVector = std::vector<T, AlignedAllocator<T>>;

}  // namespace lift_slam::nn
