#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "apps/program_for_test.h"
#include "lift_slam/features/lift/lift_networks.h"
#include "lift_slam/features/lift/lift_reference_for_test.h"
#include "lift_slam/testing/temporary_folder.h"
#include "lift_slam/util/random.h"

namespace lift_slam {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::vector<float> ReadNpy(const std::filesystem::path& path, const std::string& shape) {
  const std::string bytes = ReadText(path);
  EXPECT_THAT(bytes, StartsWith("\x93NUMPY\x01"));
  EXPECT_THAT(bytes, HasSubstr("'descr': '<f4', 'fortran_order': False, 'shape': " + shape));
  const std::size_t begin = bytes.find('\n') + 1;
  EXPECT_EQ(begin % 64, 0U);
  std::vector<float> values((bytes.size() - begin) / sizeof(float));
  std::memcpy(values.data(), bytes.data() + begin, values.size() * sizeof(float));
  return values;
}

double LargestDifference(std::span<const float> a, std::span<const float> b) {
  EXPECT_EQ(a.size(), b.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    largest = std::max(largest, std::abs(static_cast<double>(a[i]) - b[i]));
  }
  return largest;
}

class ExtractPatches : public testing::Test {
 protected:
  std::string Path(const std::string& name) const { return (folder_ / name).string(); }
  TemporaryFolder folder_;
};

class ExtractRandomPatches : public ExtractPatches {
 protected:
  void SetUp() override {
    WriteLiftWeights(weights_, folder_ / "w.safetensors");
    LiftWeights upright = RandomLiftWeights(LiftTopology::kT, 3, /*with_orientation=*/false);
    WriteLiftWeights(upright, folder_ / "upright.safetensors");
    Random random(2);
    for (std::uint8_t& v : patches_) v = static_cast<std::uint8_t>(random.Bits());
    WriteTextAtomically(folder_ / "p.raw", {patches_.begin(), patches_.end()});
  }
  std::string Arguments() const {
    return "extract --patches " + Path("p.raw") + " --weights " + Path("w.safetensors") +
           " --output " + Path("d.npy") + " ";
  }
  LiftWeights weights_ = RandomLiftWeights(LiftTopology::kF, 3);
  std::vector<std::uint8_t> patches_ = std::vector<std::uint8_t>(5 * 64 * 64);
};

TEST_F(ExtractRandomPatches, DescriptorsAndAnglesAreThoseOfTheNetworks) {
  const Outcome outcome =
      RunProgram(Arguments() + "--shape 5,64,64 --orientation --precision float32");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  LiftNetworks networks(weights_, {.backend = nn::Backend::kReference});
  EXPECT_LT(LargestDifference(ReadNpy(folder_ / "d.npy", "(5, 128,)"),
                              networks.DescribePatches(std::span<const std::uint8_t>(patches_))),
            1e-4);
  EXPECT_LT(LargestDifference(ReadNpy(folder_ / "d_angles.npy", "(5,)"),
                              networks.OrientPatches(patches_)),
            1e-4);
}

TEST_F(ExtractRandomPatches, BadInputIsOneSentence) {
  const std::string images = "extract --weights " + Path("w.safetensors") + " --output ";
  for (const auto& [arguments, part] : std::vector<std::pair<std::string, std::string>>{
           {Arguments() + "--shape 4,64,64", "20480 bytes, but --shape 4,64,64 needs 16384"},
           {Arguments() + "--shape 5,32,128", "expected N,64,64"},
           {Arguments() + "--shape x,64,64", "expected N,64,64"},
           {Arguments() + "--shape -1,64,64", "expected N,64,64"},
           {Arguments() + "--shape 99999999999999999999,64,64", "expected N,64,64"},
           {Arguments() + Path("p.raw"), "either IMAGES or --patches"},
           {images + Path("d.npy"), "either IMAGES or --patches"},
           {images + Path("out") + " --shape 5,64,64 a.png", "go with --patches"},
           {images + Path("d.npy") + " --patches " + Path("w.safetensors"), "no whole number"},
           {images + Path("d.npy") + " --patches " + Path("none.raw"), "none.raw"},
           {images + Path("d.npz") + " --patches " + Path("p.raw"), ".npy"},
           {"extract --orientation --weights " + Path("upright.safetensors") + " --output " +
                Path("d.npy") + " --patches " + Path("p.raw"),
            "no orientation network"}}) {
    const Outcome outcome = RunProgram(arguments);
    EXPECT_EQ(outcome.exit_code, 1) << arguments;
    EXPECT_THAT(outcome.output, StartsWith("lift_slam: "));
    EXPECT_THAT(outcome.output, HasSubstr(part));
    EXPECT_EQ(std::count(outcome.output.begin(), outcome.output.end(), '\n'), 1) << outcome.output;
  }
}

TEST_F(ExtractPatches, ReleasedWeightsGiveTheExpectedDescriptors) {
  LIFT_SLAM_SKIP_WITHOUT_REFERENCE();
  const std::string reference = LiftReferenceFolder().string() + "/";
  for (const std::string topology : {"F", "T"}) {
    RunProgram("weights import " + reference + "tf-lift-release.h5 " + reference +
               "new-CNN3-picc-iter-56k.h5 --descriptor " + topology + " --output " +
               Path("w.safetensors"));
    for (const auto& [set, count] :
         {std::pair<std::string, std::string>{"patches16", "16"}, {"edge_cases", "4"}}) {
      const Outcome outcome =
          RunProgram("extract --patches " + reference + set + "_u8.raw --shape " + count +
                     ",64,64 --weights " + Path("w.safetensors") +
                     " --precision float32 --output " + Path("d.npy"));
      ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
      const std::string expected = set + (topology == "F" ? "_desc_tflift" : "_desc_theano");
      EXPECT_LT(LargestDifference(ReadNpy(folder_ / "d.npy", "(" + count + ", 128,)"),
                                  ReadRaw<float>(reference + expected + "_f32.raw")),
                1e-4)
          << topology << " " << set;
    }
  }
}

}  // namespace
}  // namespace lift_slam
