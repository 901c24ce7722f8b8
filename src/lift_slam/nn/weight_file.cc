#include "lift_slam/nn/weight_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string_view>

#include "lift_slam/nn/half_float.h"
#include "lift_slam/util/check.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/sha256.h"

namespace lift_slam::nn {
namespace {

using Json = nlohmann::json;  // keys sorted

static_assert(std::endian::native == std::endian::little, "numbers in the file are little-endian");

constexpr std::size_t kLengthBytes = 8;
constexpr std::uint64_t kMaxHeaderBytes = 100'000'000;  // as the format's authors' reader
constexpr std::size_t kHeaderAlignment = 8;
constexpr int kMaxHeaderDepth = 4;  // the format needs 3: the header, a tensor, its shape
constexpr const char* kMetadata = "__metadata__";
constexpr const char* kSha256 = "sha256";

// Bytes that are no UTF-8 (of a file name, say) are replaced.
std::string Dump(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

float FromBrainFloat(std::uint16_t bits) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(bits) << 16);
}

template <class Number>
Number ReadNumber(std::string_view bytes, std::size_t index) {
  Number number;
  std::memcpy(&number, bytes.data() + index * sizeof number, sizeof number);
  return number;
}

// Everything that is known while one file is read, for the messages.
class Reader {
 public:
  explicit Reader(const std::filesystem::path& path) : path_(path), bytes_(ReadText(path)) {}

  WeightFile Read() {
    ParseHeader();
    WeightFile contents;
    ReadMetadata(contents);
    CheckHash(contents);
    for (const auto& [name, description] : header_.items()) {
      if (name != kMetadata) contents.tensors.emplace(name, ReadEntry(name, description));
    }
    CheckWholeFileIsUsed(contents);
    return contents;
  }

 private:
  [[noreturn]] void Fail(const std::string& what) const {
    throw InputError(fmt::format("{}: {}", path_.string(), what));
  }

  void ParseHeader() {
    if (bytes_.size() < kLengthBytes) {
      Fail(fmt::format("{} bytes are too few for a safetensors file", bytes_.size()));
    }
    const auto length = ReadNumber<std::uint64_t>(bytes_, 0);
    if (length > kMaxHeaderBytes) Fail("not a safetensors file (its header would be too long)");
    if (length > bytes_.size() - kLengthBytes) {
      Fail(
          fmt::format("truncated: {} bytes, shorter than its header of {}", bytes_.size(), length));
    }
    const std::string_view text = std::string_view(bytes_).substr(kLengthBytes, length);
    // What works on a JSON value calls itself for each level of it.
    const auto check_depth = [&](int depth, Json::parse_event_t event, const Json&) {
      const bool opens =
          event == Json::parse_event_t::object_start || event == Json::parse_event_t::array_start;
      if (opens && depth >= kMaxHeaderDepth) {
        Fail("not a safetensors file (its header is nested too deeply)");
      }
      return true;
    };
    header_ = Json::parse(text, check_depth, /*allow_exceptions=*/false);
    if (!header_.is_object()) Fail("not a safetensors file (its header is not a JSON object)");
    data_ = std::string_view(bytes_).substr(kLengthBytes + length);
  }

  void ReadMetadata(WeightFile& contents) {
    if (!header_.contains(kMetadata)) return;
    Json& metadata = header_[kMetadata];
    if (!metadata.is_object()) Fail("'__metadata__' is not a JSON object");
    for (const auto& [key, value] : metadata.items()) {
      if (!value.is_string()) Fail(fmt::format("'__metadata__' entry '{}' is not a text", key));
      contents.metadata.emplace(key, value.get<std::string>());
    }
    metadata.erase(kSha256);
  }

  void CheckHash(WeightFile& contents) const {
    contents.sha256 = Sha256Hex(Dump(header_) + std::string(data_));
    const auto found = contents.metadata.find(kSha256);
    if (found == contents.metadata.end()) return;
    if (found->second != contents.sha256) {
      Fail(
          fmt::format("damaged, or changed after it was written: its contents have SHA-256 {}, "
                      "not {}",
                      contents.sha256, found->second));
    }
    contents.metadata.erase(found);
  }

  WeightFile::Entry ReadEntry(const std::string& name, const Json& description) const {
    try {
      const auto type = description.at("dtype").get<std::string>();
      const auto offsets = description.at("data_offsets").get<std::vector<std::uint64_t>>();
      WeightFile::Entry entry{description.at("shape").get<std::vector<std::int64_t>>(), {}};
      const std::string_view bytes = Bytes(name, offsets);
      entry.values = ReadValues(name, type, bytes, NumValues(name, entry.shape));
      return entry;
    } catch (const Json::exception&) {
      Fail(fmt::format("tensor '{}' is not described by dtype, shape and data_offsets", name));
    }
  }

  std::string_view Bytes(const std::string& name, const std::vector<std::uint64_t>& offsets) const {
    if (offsets.size() != 2 || offsets[0] > offsets[1]) {
      Fail(fmt::format("tensor '{}' has data_offsets that are not a begin and an end", name));
    }
    if (offsets[1] > data_.size()) {
      Fail(fmt::format("tensor '{}' ends at byte {} of the data, which are only {} (truncated?)",
                       name, offsets[1], data_.size()));
    }
    return data_.substr(offsets[0], offsets[1] - offsets[0]);
  }

  // No more than the file could hold, so that products cannot overflow.
  std::size_t NumValues(const std::string& name, const std::vector<std::int64_t>& shape) const {
    std::size_t count = 1;
    for (const std::int64_t size : shape) {
      if (size < 0 || static_cast<std::uint64_t>(size) > data_.size()) {
        Fail(fmt::format("tensor '{}' has an impossible shape {}", name, ShapeText(shape)));
      }
      count *= static_cast<std::size_t>(size);
      if (count > data_.size()) {
        Fail(
            fmt::format("tensor '{}' of shape {} is larger than the file", name, ShapeText(shape)));
      }
    }
    return count;
  }

  std::vector<float> ReadValues(const std::string& name, const std::string& type,
                                std::string_view bytes, std::size_t count) const {
    if (type != "F32" && type != "F16" && type != "BF16") {
      Fail(
          fmt::format("tensor '{}' has the number type {}, expected F32, F16 or BF16", name, type));
    }
    if (bytes.size() != count * (type == "F32" ? 4 : 2)) {
      Fail(fmt::format("tensor '{}' has {} bytes, which do not fit its shape ({} values of {})",
                       name, bytes.size(), count, type));
    }
    std::vector<float> values(count);
    for (std::size_t i = 0; i < count; ++i) {
      values[i] = type == "F32"   ? ReadNumber<float>(bytes, i)
                  : type == "F16" ? FromHalf(ReadNumber<std::uint16_t>(bytes, i))
                                  : FromBrainFloat(ReadNumber<std::uint16_t>(bytes, i));
      if (!std::isfinite(values[i])) {
        Fail(fmt::format("tensor '{}' holds a value that is not finite (number {})", name, i));
      }
    }
    return values;
  }

  // The format allows no gaps: with none, equal totals mean that nothing overlaps.
  void CheckWholeFileIsUsed(const WeightFile& contents) const {
    std::uint64_t next = 0;
    std::map<std::uint64_t, std::uint64_t> ranges;
    for (const auto& [name, entry] : contents.tensors) {
      if (entry.values.empty()) continue;
      const auto offsets = header_[name]["data_offsets"].get<std::vector<std::uint64_t>>();
      if (!ranges.emplace(offsets[0], offsets[1]).second) {
        Fail(fmt::format("tensor '{}' shares its data with another", name));
      }
    }
    for (const auto& [begin, end] : ranges) {
      if (begin != next) Fail(fmt::format("gap or overlap at byte {} of the data", next));
      next = end;
    }
    if (next != data_.size()) {
      Fail(fmt::format("{} bytes after the last tensor", data_.size() - next));
    }
  }

  std::filesystem::path path_;
  std::string bytes_;
  Json header_;
  std::string_view data_;
};

}  // namespace

namespace {

// Of a large tensor that loses nothing by it.
bool FitsHalf(const std::vector<float>& values) {
  constexpr std::size_t kLarge = 1U << 20;
  return values.size() >= kLarge &&
         std::ranges::all_of(values, [](float value) { return FromHalf(ToHalf(value)) == value; });
}

void AppendAsHalf(const std::vector<float>& values, std::string& data) {
  for (const float value : values) {
    const std::uint16_t half = ToHalf(value);
    data.append(reinterpret_cast<const char*>(&half), sizeof half);
  }
}

}  // namespace

std::string ShapeText(const std::vector<std::int64_t>& shape) {
  return fmt::format("[{}]", fmt::join(shape, ", "));
}

WeightFile ReadWeightFile(const std::filesystem::path& path) { return Reader(path).Read(); }

std::string WriteWeightFile(const WeightFile& contents, const std::filesystem::path& path) {
  Json header;
  header[kMetadata] = contents.metadata;
  std::string data;
  for (const auto& [name, entry] : contents.tensors) {
    std::int64_t count = 1;
    for (const std::int64_t size : entry.shape) count *= size;
    LIFT_SLAM_CHECK(count == static_cast<std::int64_t>(entry.values.size()),
                    "tensor '{}' of shape {} has {} values", name, ShapeText(entry.shape),
                    entry.values.size());
    const std::size_t begin = data.size();
    const bool half = FitsHalf(entry.values);
    if (half) {
      AppendAsHalf(entry.values, data);
    } else {
      data.append(reinterpret_cast<const char*>(entry.values.data()),
                  entry.values.size() * sizeof(float));
    }
    header[name] = {{"dtype", half ? "F16" : "F32"},
                    {"shape", entry.shape},
                    {"data_offsets", {begin, data.size()}}};
  }
  const std::string sha256 = Sha256Hex(Dump(header) + data);
  header[kMetadata][kSha256] = sha256;
  std::string text = Dump(header);
  text.append((kHeaderAlignment - text.size() % kHeaderAlignment) % kHeaderAlignment, ' ');
  const std::uint64_t length = text.size();
  WriteFileAtomically(path, [&](std::ostream& stream) {
    stream.write(reinterpret_cast<const char*>(&length), sizeof length);
    stream << text << data;
  });
  return sha256;
}

}  // namespace lift_slam::nn
