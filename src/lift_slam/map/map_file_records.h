#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iosfwd>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace lift_slam {

// A map file is a head and then records, each with a kind, a size and a checksum that goes on from
// the one before it: records lost, doubled or in another order are found. Little-endian.
enum class MapRecord : std::uint32_t { kInfo = 1, kMap, kKeyFrame, kPoints, kEnd };

// The bytes of a record, field after field.
class RecordBytes {
 public:
  template <class T>
  void Put(const T& value) {
    static_assert(std::is_arithmetic_v<T>);
    PutArray(std::span(&value, 1));
  }
  template <class T>
  void PutArray(std::span<const T> values) {
    Append(std::as_bytes(values));
  }
  void PutText(const std::string& text);

  const std::vector<std::byte>& bytes() const { return bytes_; }

 private:
  void Append(std::span<const std::byte> bytes);

  std::vector<std::byte> bytes_;
};

// Writes head and records to a stream, one at a time.
class MapRecordWriter {
 public:
  explicit MapRecordWriter(std::ostream& stream);
  void Write(MapRecord kind, const RecordBytes& record);

 private:
  std::ostream& stream_;
  std::uint64_t checksum_;  // of everything so far
};

// Reads them again, one at a time. Throws InputError, which names the file, when it is missing,
// foreign, of another version, truncated or damaged.
class MapRecordReader {
 public:
  explicit MapRecordReader(const std::filesystem::path& path);

  // The next record, whose fields are then taken one after another.
  MapRecord Next();
  // The same, which must be of this kind.
  void Expect(MapRecord kind);

  template <class T>
  T Take() {
    static_assert(std::is_arithmetic_v<T>);
    T value;
    TakeArray(std::span(&value, 1));
    return value;
  }
  template <class T>
  void TakeArray(std::span<T> values) {
    CheckLeft(values.size(), sizeof(T));
    if (!values.empty()) std::memcpy(values.data(), bytes_.data() + taken_, values.size_bytes());
    taken_ += values.size_bytes();
  }
  std::string TakeText();
  // A number of things to come in this record, of at least `least_bytes` each.
  std::size_t TakeCount(std::size_t least_bytes);
  // The file must end after this record.
  void CheckEnd();
  [[noreturn]] void Fail(const std::string& what) const;
  [[noreturn]] void FailDamaged() const;

 private:
  void ReadHead();
  void CheckLeft(std::size_t count, std::size_t bytes_each) const;

  std::filesystem::path path_;
  std::ifstream stream_;
  std::uint64_t bytes_left_ = 0;  // in the file
  std::uint64_t checksum_ = 0;
  std::vector<std::byte> bytes_;  // of the record
  std::size_t taken_ = 0;
};

}  // namespace lift_slam
