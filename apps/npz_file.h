#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace lift_slam {

// One array as a .npy file, atomically; row-major. CheckError unless the shape's product is the
// number of values, InputError when the file cannot be written.
void WriteNpy(const std::filesystem::path& path, const std::vector<std::size_t>& shape,
              std::span<const float> values);

// Collects arrays and writes them as an NPZ file (a zip archive of .npy files, not compressed),
// which numpy.load reads. Little-endian machines only, as all that the program runs on.
class NpzFile {
 public:
  // Row-major; CheckError unless the shape's product is the number of values.
  void Add(const std::string& name, const std::vector<std::size_t>& shape,
           std::span<const float> values);
  void Add(const std::string& name, const std::vector<std::size_t>& shape,
           std::span<const std::int32_t> values);

  // Atomically; throws InputError when the file cannot be written. The same bytes for the same
  // arrays.
  void Write(const std::filesystem::path& path) const;

 private:
  struct Entry {
    std::string name, contents;
  };
  void AddBytes(const std::string& name, const std::vector<std::size_t>& shape, const char* type,
                std::span<const std::byte> bytes);

  std::vector<Entry> entries_;
};

}  // namespace lift_slam
