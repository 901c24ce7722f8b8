#include "lift_slam/datasets/keyed_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lift_slam/datasets/dataset_test_files.h"

namespace lift_slam {
namespace {

using testing::AllOf;
using testing::HasSubstr;

KeyedFile ReadYaml(const std::string& text) {
  const TestFolder folder;
  return KeyedFile::ReadYaml(folder.Write("c.yaml", text));
}

std::string YamlError(const std::string& text) {
  return InputErrorOf([&] { ReadYaml(text); });
}

TEST(KeyedYaml, AnAliasStandsForItsValues) {
  const KeyedFile file = ReadYaml("size: &size [640, 480]\ncam0:\n  resolution: *size\n");
  EXPECT_EQ(file.WholeNumbers("cam0/resolution", 2), (std::vector<int>{640, 480}));
}

TEST(KeyedYaml, AnAliasToItselfIsRefused) {
  EXPECT_THAT(YamlError("fx: 1\nmap: &map\n  inner: *map\n"),
              AllOf(HasSubstr("c.yaml:"), HasSubstr("nested too deeply")));
  EXPECT_THAT(YamlError("fx: 1\nlist: &list [*list]\n"),
              AllOf(HasSubstr("c.yaml:2:"), HasSubstr("nested too deeply")));
}

TEST(KeyedYaml, AliasesThatMultiplyAreRefused) {
  for (const char* leaf : {"[1, 2, 3, 4, 5, 6, 7, 8, 9]", "[[], [], [], [], [], [], [], [], []]"}) {
    std::string text = fmt::format("a0: &a0 {}\n", leaf);
    for (int i = 1; i < 12; ++i) {
      const std::string alias = fmt::format("*a{}", i - 1);
      text += fmt::format("a{0}: &a{0} [{1}, {1}, {1}, {1}, {1}, {1}, {1}, {1}]\n", i, alias);
    }
    EXPECT_THAT(YamlError(text), AllOf(HasSubstr("c.yaml:"), HasSubstr("too long")));
  }
}

TEST(KeyedYaml, ThePointsOfAllImagesAreNotTooLong) {
  std::string text = "fx: 5\nimage_points: [0";
  for (int i = 1; i < 50'000; ++i) text += ", 1";
  EXPECT_EQ(ReadYaml(text + "]\n").Number("fx"), 5.0);
}

TEST(KeyedYaml, ASecondDocumentIsRefused) {
  EXPECT_THAT(YamlError("%YAML:1.0\n---\nfx: 1\n...\n---\nfx: 2\n"),
              HasSubstr("c.yaml:6: expected one YAML document, this is a second"));
  EXPECT_EQ(ReadYaml("%YAML:1.0\n---\nfx: 1\n...\n---\n").Number("fx"), 1.0);
}

}  // namespace
}  // namespace lift_slam
