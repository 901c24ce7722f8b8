#include "lift_slam/features/lift/hdf5_reader.h"

#include <fmt/format.h>
#include <hdf5.h>

#include <cmath>

#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

constexpr std::int64_t kMaxValues = 1 << 27;

// Closes an HDF5 object.
struct Handle {
  hid_t id;
  herr_t (*close)(hid_t);
  ~Handle() {
    if (id >= 0) close(id);
  }
};

}  // namespace

Hdf5Reader::Hdf5Reader(const std::filesystem::path& path) : path_(path) {
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  if (!std::filesystem::exists(status)) {
    throw InputError(fmt::format("{}: no such file", path.string()));
  }
  if (!std::filesystem::is_regular_file(status)) {
    throw InputError(fmt::format("{}: not an HDF5 file", path.string()));
  }
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // failures are told here, not on stderr
  file_ = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file_ < 0) throw InputError(fmt::format("{}: not an HDF5 file", path.string()));
}

Hdf5Reader::~Hdf5Reader() { H5Fclose(file_); }

bool Hdf5Reader::Has(const std::string& name) const {
  // Each group on the way must be asked for.
  for (std::size_t end = name.find('/'); end != std::string::npos; end = name.find('/', end + 1)) {
    if (H5Lexists(file_, name.substr(0, end).c_str(), H5P_DEFAULT) <= 0) return false;
  }
  return H5Lexists(file_, name.c_str(), H5P_DEFAULT) > 0;
}

Hdf5Reader::Array Hdf5Reader::Read(const std::string& name) const {
  const auto fail = [&](const char* what) {
    throw InputError(fmt::format("{}: '{}' {}", path_.string(), name, what));
  };
  if (!Has(name)) fail("is missing");
  const Handle dataset{H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose};
  if (dataset.id < 0) fail("is not an array");
  const Handle space{H5Dget_space(dataset.id), H5Sclose};
  const int rank = H5Sget_simple_extent_ndims(space.id);
  const hssize_t count = H5Sget_simple_extent_npoints(space.id);
  if (rank < 0 || count < 1 || count > kMaxValues) fail("has an impossible size");
  std::vector<hsize_t> sizes(static_cast<std::size_t>(rank));
  H5Sget_simple_extent_dims(space.id, sizes.data(), nullptr);
  Array array{{sizes.begin(), sizes.end()}, std::vector<float>(static_cast<std::size_t>(count))};
  if (H5Dread(dataset.id, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, array.values.data()) <
      0) {
    fail("cannot be read (damaged, or not numbers)");
  }
  for (const float v : array.values) {
    if (!std::isfinite(v)) fail("holds a value that is not finite");
  }
  return array;
}

}  // namespace lift_slam
