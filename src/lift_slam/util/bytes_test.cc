#include <gtest/gtest.h>

#include <cstring>
#include <set>
#include <vector>

#include "lift_slam/testing/temporary_folder.h"
#include "lift_slam/util/checksum64.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/mapped_file.h"

namespace lift_slam {
namespace {

TEST(MappedFile, ShowsTheBytesOfTheFile) {
  const TemporaryFolder folder;
  const MappedFile file(folder.Write("a", "some bytes"));
  ASSERT_EQ(file.bytes().size(), 10U);
  EXPECT_EQ(std::memcmp(file.bytes().data(), "some bytes", 10), 0);
}

TEST(MappedFile, EmptyFileIsEmpty) {
  const TemporaryFolder folder;
  EXPECT_TRUE(MappedFile(folder.Write("a", "")).bytes().empty());
}

TEST(MappedFile, MissingFileOrFolderIsRefusedByName) {
  const TemporaryFolder folder;
  for (const std::filesystem::path& path : {folder / "none", folder.path()}) {
    try {
      const MappedFile file(path);
      FAIL() << path;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos);
    }
  }
}

TEST(Checksum64, EveryFlippedBitAndEveryLengthGivesAnother) {
  std::vector<std::byte> bytes(75, std::byte{0});
  std::set<std::uint64_t> seen;
  for (std::size_t length = 0; length <= bytes.size(); ++length) {
    seen.insert(Checksum64({bytes.data(), length}));
  }
  EXPECT_EQ(seen.size(), bytes.size() + 1);
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    bytes[bit / 8] ^= std::byte{1} << (bit % 8);
    EXPECT_TRUE(seen.insert(Checksum64(bytes)).second) << bit;
    bytes[bit / 8] ^= std::byte{1} << (bit % 8);
  }
}

TEST(Checksum64, DependsOnTheOrderOfBlocksAndTheSeed) {
  std::vector<std::byte> bytes(128, std::byte{0});
  bytes[0] = std::byte{1};
  const std::uint64_t first = Checksum64(bytes);
  std::swap(bytes[0], bytes[32]);
  EXPECT_NE(Checksum64(bytes), first);
  EXPECT_NE(Checksum64(bytes, 1), Checksum64(bytes));
}

}  // namespace
}  // namespace lift_slam
