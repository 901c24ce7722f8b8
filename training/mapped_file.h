#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

namespace lift_slam::training {

// A file's bytes in memory, read only, loaded by the system as they are looked at.
class MappedFile {
 public:
  MappedFile() = default;
  // Throws InputError when the file cannot be read. An empty file gives no bytes.
  explicit MappedFile(const std::filesystem::path& path);
  ~MappedFile();
  MappedFile(MappedFile&& other) noexcept;
  MappedFile& operator=(MappedFile&& other) noexcept;
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  std::span<const std::byte> bytes() const { return bytes_; }

 private:
  std::span<const std::byte> bytes_;
};

}  // namespace lift_slam::training
