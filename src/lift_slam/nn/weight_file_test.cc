#include "lift_slam/nn/weight_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "lift_slam/util/check.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam::nn {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class WeightFileTest : public testing::Test {
 protected:
  ~WeightFileTest() override { std::filesystem::remove(path_); }

  // A file with this header and data, whatever they are.
  void WriteRaw(const std::string& header, const std::string& data) {
    const std::uint64_t length = header.size();
    std::string bytes(sizeof length, '\0');
    std::memcpy(bytes.data(), &length, sizeof length);
    WriteTextAtomically(path_, bytes + header + data);
  }

  std::string ReadError() {
    try {
      ReadWeightFile(path_);
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::StartsWith(path_.string() + ": "));
      return error.what();
    }
    return "no error";
  }

  static WeightFile Example() {
    WeightFile contents;
    contents.tensors["b"] = {{2, 3}, {1, 2, 3, 4, 5, 6}};
    contents.tensors["a.weight"] = {{}, {0.5F}};
    contents.metadata["note"] = "grüße \"x\"";
    return contents;
  }

  const std::filesystem::path path_ =
      std::filesystem::path(testing::TempDir()) /
      (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".safetensors");
};

std::string Bytes(const std::vector<float>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)};
}

TEST_F(WeightFileTest, WhatIsWrittenIsRead) {
  const std::string sha256 = WriteWeightFile(Example(), path_);
  const WeightFile read = ReadWeightFile(path_);
  EXPECT_EQ(read.sha256, sha256);
  EXPECT_EQ(sha256.size(), 64U);
  EXPECT_EQ(read.metadata, Example().metadata);
  EXPECT_EQ(read.tensors.size(), 2U);
  EXPECT_EQ(read.tensors.at("b").values, Example().tensors.at("b").values);
  EXPECT_THAT(read.tensors.at("b").shape, ElementsAre(2, 3));
  EXPECT_TRUE(read.tensors.at("a.weight").shape.empty());
}

TEST_F(WeightFileTest, HasTheSafetensorsLayout) {
  WriteWeightFile(Example(), path_);
  const std::string bytes = ReadText(path_);
  std::uint64_t length = 0;
  std::memcpy(&length, bytes.data(), sizeof length);
  EXPECT_EQ((8 + length) % 8, 0U);
  EXPECT_EQ(bytes.size(), 8 + length + 7 * sizeof(float));
  EXPECT_THAT(bytes.substr(8, length), HasSubstr(R"("b":{"data_offsets":[4,28],"dtype":"F32")"));
  EXPECT_EQ(bytes.substr(8 + length), Bytes({0.5F, 1, 2, 3, 4, 5, 6}));
}

TEST_F(WeightFileTest, HalfNumbersAreRead) {
  WriteRaw(R"({"h":{"dtype":"F16","shape":[4],"data_offsets":[0,8]},)"
           R"("b":{"dtype":"BF16","shape":[1],"data_offsets":[8,10]}})",
           std::string("\x00\x3C\x00\xC0\x01\x00\xFF\x7B", 8) + std::string("\x40\xC0", 2));
  const WeightFile read = ReadWeightFile(path_);
  EXPECT_THAT(read.tensors.at("h").values, ElementsAre(1.0F, -2.0F, 0x1p-24F, 65504.0F));
  EXPECT_THAT(read.tensors.at("b").values, ElementsAre(-3.0F));
  EXPECT_TRUE(read.metadata.empty());
}

TEST_F(WeightFileTest, LargeTensorsOfHalfNumbersAreWrittenAsSuch) {
  WeightFile file;
  WeightFile::Entry& entry = file.tensors["a"];
  entry = {{1 << 20}, std::vector<float>(1 << 20, 0.25F)};
  WriteWeightFile(file, path_);
  EXPECT_LT(std::filesystem::file_size(path_), (2U << 20) + 500);
  EXPECT_EQ(ReadWeightFile(path_).tensors.at("a").values, entry.values);
  entry.values[7] = 0.1F;  // none
  WriteWeightFile(file, path_);
  EXPECT_GT(std::filesystem::file_size(path_), 4U << 20);
  EXPECT_EQ(ReadWeightFile(path_).tensors.at("a").values, entry.values);
}

TEST_F(WeightFileTest, MissingFile) { EXPECT_THAT(ReadError(), HasSubstr("no such file")); }

TEST_F(WeightFileTest, EveryTruncationIsNoticed) {
  WriteWeightFile(Example(), path_);
  const std::string bytes = ReadText(path_);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    WriteTextAtomically(path_, bytes.substr(0, size));
    EXPECT_NE(ReadError(), "no error") << size;
  }
  WriteTextAtomically(path_, bytes + "x");
  EXPECT_NE(ReadError(), "no error");
}

TEST_F(WeightFileTest, EveryChangedBitIsNoticed) {
  WriteWeightFile(Example(), path_);
  const std::string bytes = ReadText(path_);
  std::uint64_t length = 0;
  std::memcpy(&length, bytes.data(), sizeof length);
  for (std::size_t i = 8 + length; i < bytes.size(); ++i) {
    std::string changed = bytes;
    changed[i] = static_cast<char>(changed[i] ^ 1);
    WriteTextAtomically(path_, changed);
    EXPECT_THAT(ReadError(), HasSubstr("damaged, or changed after it was written"));
  }
}

TEST_F(WeightFileTest, BadHeadersAreExplained) {
  const std::pair<const char*, const char*> cases[] = {
      {"{\"a\":", "header is not a JSON object"},
      {"[1]", "header is not a JSON object"},
      {R"({"__metadata__":{"x":1}})", "'x' is not a text"},
      {R"({"__metadata__":[]})", "is not a JSON object"},
      {R"({"a":{"shape":[1],"data_offsets":[0,4]}})", "'a' is not described by"},
      {R"({"a":5})", "'a' is not described by"},
      {R"({"a":{"dtype":"I64","shape":[1],"data_offsets":[0,4]}})", "number type I64"},
      {R"({"a":{"dtype":"F32","shape":[2],"data_offsets":[0,4]}})", "4 bytes, which do not fit"},
      {R"({"a":{"dtype":"F32","shape":[-1],"data_offsets":[0,4]}})", "impossible shape [-1]"},
      {R"({"a":{"dtype":"F32","shape":[9999999],"data_offsets":[0,4]}})", "impossible shape"},
      {R"({"a":{"dtype":"F32","shape":[4,4],"data_offsets":[0,4]}})", "larger than the file"},
      {R"({"a":{"dtype":"F32","shape":[2],"data_offsets":[0,8]}})", "only 4 (truncated?)"},
      {R"({"a":{"dtype":"F32","shape":[1],"data_offsets":[4,0]}})", "not a begin and an end"},
      {R"({"a":{"dtype":"F32","shape":[1],"data_offsets":[0]}})", "not a begin and an end"},
      {R"({"a":{"dtype":"F32","shape":[1],"data_offsets":[-4,0]}})", ""},
      {R"({})", "4 bytes after the last tensor"},
      {R"({"a":{"dtype":"F32","shape":[1],"data_offsets":[0,4]},)"
       R"("b":{"dtype":"F32","shape":[1],"data_offsets":[0,4]}})",
       "shares its data"},
      {R"({"a":{"dtype":"F16","shape":[1],"data_offsets":[2,4]}})", "gap or overlap at byte 0"},
  };
  for (const auto& [header, message] : cases) {
    WriteRaw(header, Bytes({1.0F}));
    EXPECT_NE(ReadError(), "no error") << header;
    EXPECT_THAT(ReadError(), HasSubstr(message)) << header;
  }
}

TEST_F(WeightFileTest, DeepHeadersAreRefused) {
  for (const std::size_t depth : {std::size_t{4}, std::size_t{1'000'000}}) {
    WriteRaw("{\"a\":" + std::string(depth, '[') + std::string(depth, ']') + "}", "");
    EXPECT_THAT(ReadError(), HasSubstr("nested too deeply")) << depth;
    WriteRaw("{\"a\":" + std::string(depth, '['), "");
    EXPECT_THAT(ReadError(), HasSubstr("not a safetensors file")) << depth;
  }
  WriteRaw(R"({"a":[[[]]]})", "");
  EXPECT_THAT(ReadError(), HasSubstr("'a' is not described by"));
}

TEST_F(WeightFileTest, HeaderLongerThanTheFile) {
  WriteTextAtomically(path_, std::string("\x10\0\0\0\0\0\0\0{}", 10));
  EXPECT_THAT(ReadError(), HasSubstr("truncated: 10 bytes"));
  WriteTextAtomically(path_, std::string(12, '\xFF'));
  EXPECT_THAT(ReadError(), HasSubstr("not a safetensors file"));
}

TEST_F(WeightFileTest, ValuesThatAreNotFinite) {
  WeightFile contents = Example();
  contents.tensors["b"].values[4] = std::numeric_limits<float>::quiet_NaN();
  WriteWeightFile(contents, path_);
  EXPECT_THAT(ReadError(), HasSubstr("tensor 'b' holds a value that is not finite (number 4)"));
}

TEST_F(WeightFileTest, TextThatIsNoUtf8IsReplaced) {
  WeightFile contents = Example();
  contents.metadata["note"] = "a\xFF";
  WriteWeightFile(contents, path_);
  EXPECT_EQ(ReadWeightFile(path_).metadata.at("note"), "a\xEF\xBF\xBD");
}

TEST_F(WeightFileTest, ShapeAndSizeMustAgreeWhenWriting) {
  WeightFile contents = Example();
  contents.tensors["b"].values.pop_back();
  EXPECT_THROW(WriteWeightFile(contents, path_), CheckError);
}

}  // namespace
}  // namespace lift_slam::nn
