#include "lift_slam/map/map_file_records.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <ostream>

#include "lift_slam/util/checksum64.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

static_assert(std::endian::native == std::endian::little, "map files hold native numbers");

struct Head {
  std::array<char, 8> magic = {'L', 'I', 'F', 'T', 'M', 'A', 'P', '\n'};
  std::uint32_t version = 1;
  std::uint32_t reserved = 0;
};

struct RecordHead {
  std::uint32_t kind = 0;
  std::uint32_t reserved = 0;
  std::uint64_t num_bytes = 0;
};

template <class T>
std::span<const std::byte> BytesOf(const T& value) {
  return std::as_bytes(std::span(&value, 1));
}

std::uint64_t ChecksumOf(const RecordHead& head, std::span<const std::byte> bytes,
                         std::uint64_t before) {
  return Checksum64(bytes, Checksum64(BytesOf(head), before));
}

void WriteBytes(std::span<const std::byte> bytes, std::ostream& stream) {
  stream.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
}

template <class T>
void ReadInto(std::istream& stream, T& value) {
  stream.read(reinterpret_cast<char*>(&value), sizeof value);
}

}  // namespace

void RecordBytes::PutText(const std::string& text) {
  Put(static_cast<std::uint64_t>(text.size()));
  PutArray(std::span(text.data(), text.size()));
}

void RecordBytes::Append(std::span<const std::byte> bytes) {
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
}

MapRecordWriter::MapRecordWriter(std::ostream& stream) : stream_(stream) {
  const Head head;
  WriteBytes(BytesOf(head), stream_);
  checksum_ = Checksum64(BytesOf(head));
}

void MapRecordWriter::Write(MapRecord kind, const RecordBytes& record) {
  const RecordHead head{static_cast<std::uint32_t>(kind), 0, record.bytes().size()};
  checksum_ = ChecksumOf(head, record.bytes(), checksum_);
  WriteBytes(BytesOf(head), stream_);
  WriteBytes(BytesOf(checksum_), stream_);
  WriteBytes(record.bytes(), stream_);
}

MapRecordReader::MapRecordReader(const std::filesystem::path& path) : path_(path) {
  if (!std::filesystem::exists(path)) Fail("no such file");
  if (!std::filesystem::is_regular_file(path)) Fail("is no file");
  bytes_left_ = std::filesystem::file_size(path);
  stream_.open(path, std::ios::binary);
  if (!stream_) Fail("cannot be read");
  ReadHead();
}

void MapRecordReader::ReadHead() {
  Head head;
  const Head expected;
  head.magic = {};
  ReadInto(stream_, head);
  const auto read = static_cast<std::size_t>(stream_.gcount());
  if (read < sizeof head.magic || head.magic != expected.magic) {
    Fail("is no map file of lift_slam (.liftmap)");
  }
  if (read < sizeof head) Fail("is truncated (within its head)");
  if (head.version != expected.version) {
    Fail(fmt::format("is a map file of version {}, this program reads version {}", head.version,
                     expected.version));
  }
  bytes_left_ -= sizeof head;
  checksum_ = Checksum64(BytesOf(head));
}

MapRecord MapRecordReader::Next() {
  if (taken_ != bytes_.size()) FailDamaged();
  RecordHead head;
  std::uint64_t checksum = 0;
  if (bytes_left_ < sizeof head + sizeof checksum) {
    Fail("is truncated: expected a further record at its end");
  }
  ReadInto(stream_, head);
  ReadInto(stream_, checksum);
  bytes_left_ -= sizeof head + sizeof checksum;
  if (!stream_) Fail("cannot be read");
  if (head.num_bytes > bytes_left_) {
    Fail(fmt::format("is truncated or damaged: {} bytes where {} were expected", bytes_left_,
                     head.num_bytes));
  }
  bytes_.resize(head.num_bytes);
  taken_ = 0;
  stream_.read(reinterpret_cast<char*>(bytes_.data()), static_cast<std::streamsize>(bytes_.size()));
  if (!stream_) Fail("cannot be read");
  bytes_left_ -= head.num_bytes;
  checksum_ = ChecksumOf(head, bytes_, checksum_);
  if (checksum != checksum_) {
    Fail("is damaged, or changed after it was written (checksum)");
  }
  return static_cast<MapRecord>(head.kind);
}

void MapRecordReader::Expect(MapRecord kind) {
  if (Next() != kind) FailDamaged();
}

std::string MapRecordReader::TakeText() {
  std::string text(TakeCount(1), '\0');
  TakeArray(std::span(text.data(), text.size()));
  return text;
}

std::size_t MapRecordReader::TakeCount(std::size_t least_bytes) {
  const auto count = Take<std::uint64_t>();
  CheckLeft(count, least_bytes);
  return count;
}

void MapRecordReader::CheckLeft(std::size_t count, std::size_t bytes_each) const {
  if (count > (bytes_.size() - taken_) / bytes_each) FailDamaged();
}

void MapRecordReader::CheckEnd() {
  if (taken_ != bytes_.size()) FailDamaged();
  if (bytes_left_ > 0) Fail(fmt::format("has {} bytes after its end", bytes_left_));
}

void MapRecordReader::Fail(const std::string& what) const {
  throw InputError(fmt::format("{}: {}", path_.string(), what));
}

void MapRecordReader::FailDamaged() const {
  Fail("is no map file of this program (its contents contradict one another)");
}

}  // namespace lift_slam
