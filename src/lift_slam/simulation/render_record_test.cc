#include "lift_slam/simulation/render_record.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lift_slam/simulation/sensor_options.h"
#include "lift_slam/testing/temporary_folder.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

using ::testing::HasSubstr;

class RenderRecord : public ::testing::Test {
 protected:
  TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_ / "render.yaml";
  SensorOptions options_;
};

TEST_F(RenderRecord, IsAcceptedWhenNothingChanged) {
  options_.vignetting = 0.123456789;
  WriteOrCheckRenderRecord(file_, MakeOptionRoot(options_));
  EXPECT_NO_THROW(WriteOrCheckRenderRecord(file_, MakeOptionRoot(options_)));
}

TEST_F(RenderRecord, NamesWhatDiffersWithBothValues) {
  WriteOrCheckRenderRecord(file_, MakeOptionRoot(options_));
  options_.salt_and_pepper = 0.25;
  try {
    WriteOrCheckRenderRecord(file_, MakeOptionRoot(options_));
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("salt_and_pepper = 0"));
    EXPECT_THAT(error.what(), HasSubstr("now it is 0.25"));
    EXPECT_THAT(error.what(), HasSubstr(file_.string()));
  }
}

TEST_F(RenderRecord, RefusesOptionsThatAreNoLongerKnown) {
  WriteTextAtomically(file_, "forgotten: 1\n");
  EXPECT_THROW(WriteOrCheckRenderRecord(file_, MakeOptionRoot(options_)), InputError);
}

}  // namespace
}  // namespace lift_slam
