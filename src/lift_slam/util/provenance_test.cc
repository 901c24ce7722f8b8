#include "lift_slam/util/provenance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "lift_slam/util/sha256.h"
#include "lift_slam/util/system_info.h"

namespace lift_slam {
namespace {

struct SeedOptions {
  int seed = 1;
  void Visit(OptionVisitor& visitor) { visitor.Field("seed", seed, "of all that is random"); }
};

// Test vectors of FIPS 180-4's publisher (NIST, SHA examples).
TEST(Sha256, AgreesWithPublishedExamples) {
  EXPECT_EQ(Sha256Hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(Sha256Hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(Sha256Hex("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(Sha256Hex(std::string(1000000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Provenance, HoldsVersionMachineAndDate) {
  SeedOptions options;
  const Provenance provenance = CollectProvenance("1.2.3", "abcdef", MakeOptionRoot(options));
  EXPECT_EQ(provenance.program_version, "1.2.3");
  EXPECT_EQ(provenance.git_revision, "abcdef");
  EXPECT_EQ(provenance.config_sha256, Sha256Hex("# of all that is random\nseed: 1\n"));
  EXPECT_FALSE(provenance.cpu_name.empty());
  EXPECT_GE(provenance.threads, 1);
  EXPECT_THAT(provenance.date_utc,
              testing::MatchesRegex("20[0-9][0-9]-[0-1][0-9]-[0-3][0-9]T.*:.*:[0-9][0-9]Z"));
}

TEST(Provenance, ConfigHashFollowsTheOptions) {
  SeedOptions a, b;
  b.seed = 2;
  EXPECT_NE(CollectProvenance("", "", MakeOptionRoot(a)).config_sha256,
            CollectProvenance("", "", MakeOptionRoot(b)).config_sha256);
}

TEST(SystemInfo, PeakMemoryGrowsWithUse) {
  const std::int64_t before = PeakMemoryBytes();
  std::vector<char> block(200 << 20, 'x');
  EXPECT_GE(PeakMemoryBytes(), before + (100 << 20)) << block[block.size() / 2];
  EXPECT_GT(TotalMemoryBytes(), PeakMemoryBytes());
}

}  // namespace
}  // namespace lift_slam
