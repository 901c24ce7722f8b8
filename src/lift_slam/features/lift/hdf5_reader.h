#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace lift_slam {

// Reads arrays of numbers from an HDF5 file. Every failure is an InputError that names the file.
class Hdf5Reader {
 public:
  explicit Hdf5Reader(const std::filesystem::path& path);
  ~Hdf5Reader();
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;

  const std::filesystem::path& path() const { return path_; }
  // A path as "desc/conv1/weight".
  bool Has(const std::string& name) const;

  struct Array {
    std::vector<std::int64_t> shape;
    std::vector<float> values;  // row-major, finite
  };
  Array Read(const std::string& name) const;

 private:
  std::filesystem::path path_;
  std::int64_t file_ = -1;
};

}  // namespace lift_slam
