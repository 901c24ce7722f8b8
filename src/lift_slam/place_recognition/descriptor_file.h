#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "lift_slam/features/descriptors.h"
#include "lift_slam/util/mapped_file.h"

namespace lift_slam {

// Descriptors of many images on disk, image by image: what a vocabulary is trained from. Layout
// (little-endian; see descriptor_file_layout.h): a header with the descriptors' kind and the
// source, then for each image a record, a header as long as one row and the rows. Records are
// complete or cut off at the end of the file, so that a writer that was stopped goes on.

// What was read from where: a writer goes on only with a file of the same kind and source.
struct DescriptorFileSource {
  DescriptorKind kind;
  std::string sha256;  // of whatever determines the descriptors: list of images, options
};

class DescriptorFileWriter {
 public:
  // Creates the file, or goes on with it: complete images are kept, the file is cut off at the
  // first that is incomplete or damaged. Throws InputError when it cannot be written, is another
  // kind of file, or has another kind or source.
  DescriptorFileWriter(const std::filesystem::path& path, const DescriptorFileSource& source);
  ~DescriptorFileWriter();
  DescriptorFileWriter(const DescriptorFileWriter&) = delete;
  DescriptorFileWriter& operator=(const DescriptorFileWriter&) = delete;

  std::size_t num_images() const { return num_images_; }  // in the file by now
  std::size_t num_rows() const { return num_rows_; }
  // Appends an image; it may have no descriptors. Throws InputError when the disk is full.
  void AddImage(const Descriptors& descriptors);

 private:
  void Create();
  void GoOn();
  void Write(const void* bytes, std::size_t size);

  std::filesystem::path path_;
  DescriptorFileSource source_;
  int file_ = -1;
  std::size_t num_images_ = 0, num_rows_ = 0;
};

// Reads such a file; rows are seen where they lie, whatever the memory.
class DescriptorFile {
 public:
  // Throws InputError when the file is missing, of another kind, truncated or damaged; reads all of
  // it once for that.
  explicit DescriptorFile(const std::filesystem::path& path);

  const DescriptorKind& kind() const { return source_.kind; }
  const std::string& source_sha256() const { return source_.sha256; }
  std::size_t num_images() const { return num_images_; }
  std::size_t num_rows() const { return image_of_row_.size(); }
  std::size_t image_of_row(std::size_t row) const { return image_of_row_[row]; }
  DescriptorView row(std::size_t row) const;

 private:
  MappedFile file_;
  DescriptorFileSource source_;
  std::size_t stride_ = 0;
  std::size_t num_images_ = 0;
  std::vector<std::uint32_t> image_of_row_;
};

}  // namespace lift_slam
