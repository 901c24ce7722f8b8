#include "lift_slam/util/mapped_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "lift_slam/util/input_error.h"

namespace lift_slam {

MappedFile::MappedFile(const std::filesystem::path& path) {
  // Without O_NONBLOCK opening a pipe waits for who writes to it; files are read as ever.
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) {
    throw InputError(errno == ENOENT ? fmt::format("{}: no such file", path.string())
                                     : fmt::format("{}: cannot be read: {}", path.string(),
                                                   std::strerror(errno)));
  }
  struct stat status = {};
  void* mapped = nullptr;
  const bool is_file = fstat(file, &status) == 0 && S_ISREG(status.st_mode);
  size_ = is_file ? static_cast<std::size_t>(status.st_size) : 0;
  if (size_ > 0) mapped = mmap(nullptr, size_, PROT_READ, MAP_SHARED, file, 0);
  close(file);
  if (!is_file || mapped == MAP_FAILED) {
    throw InputError(fmt::format("{}: cannot be read: {}", path.string(),
                                 is_file ? "it does not fit into memory" : "it is no file"));
  }
  data_ = static_cast<const std::byte*>(mapped);
}

MappedFile::~MappedFile() {
  if (data_ != nullptr) munmap(const_cast<std::byte*>(data_), size_);
}

MappedFile::MappedFile(MappedFile&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)) {}

MappedFile& MappedFile::operator=(MappedFile&& other) noexcept {
  std::swap(data_, other.data_);
  std::swap(size_, other.size_);
  return *this;
}

}  // namespace lift_slam
