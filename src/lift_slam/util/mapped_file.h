#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

namespace lift_slam {

// A whole file, mapped into memory to be read: pages come from the disk when first touched, and
// processes that map the same file share them. The file must not be shortened meanwhile (one that
// is replaced by renaming another onto it is safe).
class MappedFile {
 public:
  MappedFile() = default;  // no file, no bytes
  // Throws InputError when the file is missing or cannot be read.
  explicit MappedFile(const std::filesystem::path& path);
  ~MappedFile();
  MappedFile(MappedFile&& other) noexcept;
  MappedFile& operator=(MappedFile&& other) noexcept;
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  // From a page's begin, so aligned for any type.
  std::span<const std::byte> bytes() const { return {data_, size_}; }

 private:
  const std::byte* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace lift_slam
