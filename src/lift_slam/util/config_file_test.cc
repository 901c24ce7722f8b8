#include "lift_slam/util/config_file.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <limits>

#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/nearest_name.h"
#include "lift_slam/util/option_writer.h"

namespace lift_slam {
namespace {

using testing::HasSubstr;

enum class Metric { kHamming, kL2 };
constexpr std::array<std::string_view, 2> kMetricNames = {"hamming", "l2"};

struct MatchingOptions {
  double max_distance = 50.0;
  Metric metric = Metric::kHamming;

  void Visit(OptionVisitor& visitor) {
    visitor.Field("max_distance", max_distance, "largest distance of a match, bits");
    visitor.Field("metric", metric, kMetricNames, "how descriptors are compared");
  }
};

struct TestOptions {
  int max_features = 2000;
  double scale_factor = 1.2;
  bool check_rotation = true;
  std::string vocabulary = "orb \"small\"\n# end";
  MatchingOptions matching;

  void Visit(OptionVisitor& visitor) {
    visitor.Field("max_features", max_features, "features per image");
    visitor.Field("scale_factor", scale_factor, "from one pyramid level to the next");
    visitor.Field("check_rotation", check_rotation, "");
    visitor.Field("vocabulary", vocabulary, "file");
    visitor.Group("matching", matching, "features to features");
  }
};

// Applies a YAML text and overrides; the message of the InputError, or "" when there was none.
std::string MessageOf(const std::string& yaml, const std::vector<std::string>& overrides = {}) {
  TestOptions options;
  const TestOptions defaults;
  try {
    std::vector<Setting> settings = ReadConfigText(yaml, "test.yaml");
    for (const std::string& assignment : overrides) settings.push_back(ParseOverride(assignment));
    ApplySettings(settings, MakeOptionRoot(options));
    return "";
  } catch (const InputError& error) {
    EXPECT_EQ(options.max_features, defaults.max_features) << "changed in spite of the error";
    return error.what();
  }
}

TEST(OptionWriter, PrintsValuesUnderTheirComments) {
  TestOptions options;
  EXPECT_EQ(OptionsToYaml(MakeOptionRoot(options)),
            "# features per image\n"
            "max_features: 2000\n"
            "# from one pyramid level to the next\n"
            "scale_factor: 1.2\n"
            "check_rotation: true\n"
            "# file\n"
            "vocabulary: \"orb \\\"small\\\"\\x0a# end\"\n"
            "\n"
            "# features to features\n"
            "matching:\n"
            "  # largest distance of a match, bits\n"
            "  max_distance: 50.0\n"
            "  # how descriptors are compared; one of: hamming, l2\n"
            "  metric: hamming\n");
}

TEST(OptionWriter, BreaksLongCommentsBetweenWords) {
  struct {
    int x = 1;
    void Visit(OptionVisitor& visitor) {
      visitor.Field("x", x, std::string(60, 'a') + " " + std::string(60, 'b'));
    }
  } options;
  EXPECT_EQ(OptionsToYaml(MakeOptionRoot(options)),
            "# " + std::string(60, 'a') + "\n# " + std::string(60, 'b') + "\nx: 1\n");
}

TEST(ConfigFile, WrittenFileReadsBackExactly) {
  const auto path = std::filesystem::path(testing::TempDir()) / "lift_slam_config_file_test.yaml";
  TestOptions written;
  written.max_features = -7;
  written.scale_factor = 1.0 / 3.0;
  written.check_rotation = false;
  written.matching.max_distance = std::numeric_limits<double>::denorm_min();
  written.matching.metric = Metric::kL2;
  WriteConfigFile(path, "title", MakeOptionRoot(written));
  TestOptions read;
  read.vocabulary = "to be replaced";
  ConfigureOptions(path, {}, MakeOptionRoot(read));
  EXPECT_EQ(OptionsToYaml(MakeOptionRoot(read)), OptionsToYaml(MakeOptionRoot(written)));
  EXPECT_EQ(read.scale_factor, written.scale_factor);
  EXPECT_EQ(read.matching.max_distance, written.matching.max_distance);
  EXPECT_EQ(ReadLines(path).front(), "# title");
  std::filesystem::remove(path);
}

TEST(ConfigFile, ChangesOnlyWhatItNames) {
  TestOptions options;
  ApplySettings(ReadConfigText("matching: {metric: l2}\nscale_factor: 2\n", "test.yaml"),
                MakeOptionRoot(options));
  EXPECT_EQ(options.matching.metric, Metric::kL2);
  EXPECT_EQ(options.scale_factor, 2.0);
  EXPECT_EQ(options.matching.max_distance, 50.0);
  EXPECT_EQ(options.max_features, 2000);
}

TEST(ConfigFile, EmptyFileAndEmptyGroupChangeNothing) {
  EXPECT_EQ(MessageOf(""), "");
  EXPECT_EQ(MessageOf("# only a comment\n"), "");
  EXPECT_EQ(MessageOf("matching:\n  # max_distance: 3\n"), "");
  EXPECT_EQ(MessageOf("matching: {}\n"), "");
}

TEST(ConfigFile, OverrideWinsOverFileAndLastOverrideWins) {
  const auto path = std::filesystem::path(testing::TempDir()) / "lift_slam_override_test.yaml";
  WriteTextAtomically(path, "max_features: 10\nmatching:\n  max_distance: 10\n");
  TestOptions options;
  ConfigureOptions(path, {"matching.max_distance=20", "matching.max_distance=+3e1"},
                   MakeOptionRoot(options));
  EXPECT_EQ(options.max_features, 10);
  EXPECT_EQ(options.matching.max_distance, 30.0);
  std::filesystem::remove(path);
}

TEST(ConfigFile, UnknownKeyNamesFileLineAndNearestKey) {
  EXPECT_EQ(MessageOf("scale_factor: 2\nmax_featurs: 5\n"),
            "test.yaml:2: unknown option 'max_featurs'; the nearest known is 'max_features'");
  EXPECT_EQ(MessageOf("\nmatching:\n  max_distanec: 5\n"),
            "test.yaml:3: unknown option 'matching.max_distanec'; the nearest known is "
            "'matching.max_distance'");
  EXPECT_EQ(MessageOf("", {"metrics=l2"}),
            "--set: unknown option 'metrics'; the nearest known is 'matching.metric'");
  EXPECT_THAT(MessageOf("matchin: {}\n"), HasSubstr("the nearest known is 'matching'"));
  EXPECT_THAT(MessageOf("max_features: {a: 1}\n"), HasSubstr("unknown option 'max_features.a'"));
}

TEST(ConfigFile, WrongTypeNamesLineKeyTypeAndMeaning) {
  EXPECT_EQ(MessageOf("max_features: 3.5\n"),
            "test.yaml:1: option 'max_features' is '3.5', expected an integer from -2147483648 to "
            "2147483647 (features per image)");
  EXPECT_THAT(MessageOf("max_features: 3000000000\n"), HasSubstr("expected an integer from"));
  EXPECT_THAT(MessageOf("max_features: 0x10\n"), HasSubstr("expected an integer from"));
  EXPECT_THAT(MessageOf("max_features: 5 6\n"), HasSubstr("expected an integer from"));
  EXPECT_THAT(MessageOf("max_features:\n"), HasSubstr("expected an integer from"));
  EXPECT_EQ(MessageOf("check_rotation: yes\n"),
            "test.yaml:1: option 'check_rotation' is 'yes', expected true or false");
  EXPECT_THAT(MessageOf("matching: {metric: L2}\n"), HasSubstr("expected one of: hamming, l2"));
  EXPECT_THAT(MessageOf("", {"scale_factor=big"}),
              HasSubstr("--set: option 'scale_factor' is 'big', expected a finite number"));
}

TEST(ConfigFile, RefusesNumbersThatAreNotFinite) {
  for (const char* value : {"nan", "inf", "-inf", ".nan", ".inf", "1e999", "-nan"}) {
    EXPECT_THAT(MessageOf(std::string("scale_factor: ") + value),
                HasSubstr("expected a finite number"))
        << value;
  }
}

TEST(ConfigFile, RefusesValueForGroupListAndSecondMention) {
  EXPECT_EQ(MessageOf("matching: 5\n"),
            "test.yaml:1: option 'matching' is a group of options, expected no value");
  EXPECT_EQ(MessageOf("max_features: [1, 2]\n"),
            "test.yaml:1: option 'max_features' is a list, expected one value");
  EXPECT_EQ(MessageOf("max_features: 1\nmax_features: 2\n"),
            "test.yaml:2: option 'max_features' is given twice");
}

TEST(ConfigFile, RefusesWhatIsNoConfiguration) {
  EXPECT_THAT(MessageOf("max_features: [1\n"), HasSubstr("test.yaml:2: not valid YAML"));
  EXPECT_EQ(MessageOf("max_features\n"), "test.yaml:1: expected 'key: value' lines");
  EXPECT_THAT(MessageOf("max_features: 1\n---\nmax_features: 2\n"), HasSubstr("a second"));
  EXPECT_THAT(MessageOf("[a, b]: 1\n"), HasSubstr("expected a name"));
  EXPECT_THAT(MessageOf("matching: &loop {a: *loop}\n"), HasSubstr("nested too deeply"));
  EXPECT_THROW(ReadConfigFile("/nonexistent/config.yaml"), InputError);
}

TEST(ConfigFile, RefusesTextThatIsHostile) {
  std::string bomb = "a: &a {x: 1, y: 2, z: 3}\n";
  for (char c = 'b'; c <= 'n'; ++c) {
    bomb += fmt::format("{0}: &{0} {{x: *{1}, y: *{1}, z: *{1}}}\n", c, static_cast<char>(c - 1));
  }
  EXPECT_THAT(MessageOf(bomb), HasSubstr("too long for a configuration"));
  EXPECT_NE(MessageOf(std::string(100000, '[')), "");
  EXPECT_NE(MessageOf(std::string("\0\x01\xff", 3)), "");
}

TEST(ParseOverride, SplitsAtTheFirstEqualsSign) {
  const Setting setting = ParseOverride("vocabulary=a=b");
  EXPECT_EQ(setting.path, "vocabulary");
  EXPECT_EQ(setting.value, "a=b");
  EXPECT_THROW(ParseOverride("vocabulary"), InputError);
  EXPECT_THROW(ParseOverride("=5"), InputError);
}

TEST(NearestName, CountsInsertionsDeletionsReplacementsAndSwaps) {
  EXPECT_EQ(EditDistance("", "abc"), 3);
  EXPECT_EQ(EditDistance("kitten", "sitting"), 3);
  EXPECT_EQ(EditDistance("ab", "ba"), 1);
  EXPECT_EQ(EditDistance("same", "same"), 0);
  const std::vector<std::string> names = {"run", "config", "info"};
  EXPECT_EQ(NearestName("cnofig", names), "config");
  EXPECT_EQ(NearestName("x", {}), "");
}

}  // namespace
}  // namespace lift_slam
