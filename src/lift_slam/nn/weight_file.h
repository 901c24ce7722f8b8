#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace lift_slam::nn {

// Named float tensors of any number of dimensions (row-major) with named texts: the contents of a
// safetensors file (8 bytes header length, a JSON header with "__metadata__", the numbers), which
// Python's safetensors reads and writes too.
struct WeightFile {
  struct Entry {
    std::vector<std::int64_t> shape;
    std::vector<float> values;
  };
  std::map<std::string, Entry> tensors;
  std::map<std::string, std::string> metadata;  // without "sha256"
  // Of the header as JSON with sorted keys, without spaces and without "__metadata__"."sha256",
  // followed by the numbers. Filled in by both functions below.
  std::string sha256;
};

// "[32, 1, 7, 7]"
std::string ShapeText(const std::vector<std::int64_t>& shape);

// F32, F16 and BF16 tensors. Throws InputError, naming the file, when it is missing, truncated or
// too long, when its header is no JSON or describes tensors that are not there or overlap, when a
// value is not finite, or when it carries a SHA-256 ("sha256" in the metadata) that is not its own.
WeightFile ReadWeightFile(const std::filesystem::path& path);

// As float32 (a tensor of a million values or more as F16 when that changes none of them) with the
// SHA-256, atomically; returns the SHA-256. The same bytes for the same
// contents. CheckError when an entry's shape and size disagree.
std::string WriteWeightFile(const WeightFile& contents, const std::filesystem::path& path);

}  // namespace lift_slam::nn
