#include "lift_slam/place_recognition/descriptor_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "lift_slam/place_recognition/descriptor_file_layout.h"
#include "lift_slam/util/check.h"
#include "lift_slam/util/checksum64.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {

DescriptorFileWriter::DescriptorFileWriter(const std::filesystem::path& path,
                                           const DescriptorFileSource& source)
    : path_(path), source_(source) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  const bool is_new = error || size == 0;
  if (!is_new) GoOn();
  file_ = open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (file_ < 0) {
    throw InputError(
        fmt::format("{}: cannot be written: {}", path_.string(), std::strerror(errno)));
  }
  if (is_new) Create();
}

DescriptorFileWriter::~DescriptorFileWriter() {
  if (file_ >= 0) close(file_);
}

void DescriptorFileWriter::Create() {
  const DescriptorFileHeader header = MakeHeader(source_);
  Write(&header, sizeof header);
}

void DescriptorFileWriter::GoOn() {
  std::size_t end = sizeof(DescriptorFileHeader);
  {
    const MappedFile file(path_);
    const DescriptorFileSource found = ParseHeader(file.bytes(), path_);
    if (found.kind != source_.kind || found.sha256 != source_.sha256) {
      throw InputError(
          fmt::format("{}: holds descriptors of other images, options or weights ('{}'); remove it "
                      "or name another file",
                      path_.string(), found.kind.name));
    }
    while (end < file.bytes().size()) {
      const ImageRecord record = ParseRecord(file.bytes().subspan(end), source_.kind.BytesPerRow());
      if (record.state != RecordState::kComplete) break;
      end += record.num_bytes;
      num_rows_ += record.num_rows;
      ++num_images_;
    }
  }
  std::filesystem::resize_file(path_, end);
}

void DescriptorFileWriter::Write(const void* bytes, std::size_t size) {
  const auto* next = static_cast<const char*>(bytes);
  while (size > 0) {
    const ssize_t written = write(file_, next, size);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      throw InputError(
          fmt::format("{}: cannot be written: {}", path_.string(), std::strerror(errno)));
    }
    next += written;
    size -= static_cast<std::size_t>(written);
  }
}

void DescriptorFileWriter::AddImage(const Descriptors& descriptors) {
  const std::size_t stride = source_.kind.BytesPerRow();
  const std::size_t size = descriptors.size() * stride;
  LIFT_SLAM_CHECK(descriptors.size() == 0 || descriptors.kind() == source_.kind,
                  "descriptors '{}' for a file of '{}'", descriptors.kind().name,
                  source_.kind.name);
  ImageRecordHeader header;
  header.num_rows = static_cast<std::uint32_t>(descriptors.size());
  header.checksum = Checksum64({descriptors.data(), size});
  std::vector<std::byte> record(stride + size);
  std::memcpy(record.data(), &header, sizeof header);
  if (size > 0) std::memcpy(record.data() + stride, descriptors.data(), size);
  Write(record.data(), record.size());
  num_rows_ += descriptors.size();
  ++num_images_;
}

DescriptorFile::DescriptorFile(const std::filesystem::path& path)
    : file_(path), source_(ParseHeader(file_.bytes(), path)), stride_(kind().BytesPerRow()) {
  std::size_t at = sizeof(DescriptorFileHeader);
  while (at < file_.bytes().size()) {
    const ImageRecord record = ParseRecord(file_.bytes().subspan(at), stride_);
    if (record.state != RecordState::kComplete) {
      throw InputError(fmt::format("{}: is {} in image {} (counted from 0)", path.string(),
                                   record.state == RecordState::kCutOff ? "truncated" : "damaged",
                                   num_images_));
    }
    image_of_row_.insert(image_of_row_.end(), record.num_rows,
                         static_cast<std::uint32_t>(num_images_));
    at += record.num_bytes;
    ++num_images_;
  }
}

// Before row r of image i lie the header, r other rows and i + 1 record headers.
DescriptorView DescriptorFile::row(std::size_t row) const {
  const std::size_t before = row + image_of_row_[row] + 1;
  return file_.bytes().subspan(sizeof(DescriptorFileHeader) + before * stride_, stride_);
}

}  // namespace lift_slam
