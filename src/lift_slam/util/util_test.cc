#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "lift_slam/util/blocking_queue.h"
#include "lift_slam/util/check.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/option_range.h"
#include "lift_slam/util/random.h"

namespace lift_slam {
namespace {

TEST(Check, ThrowsWithExpressionAndValues) {
  try {
    LIFT_SLAM_CHECK(1 > 2, "value {}", 42);
    FAIL();
  } catch (const CheckError& error) {
    EXPECT_NE(std::string(error.what()).find("1 > 2"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("value 42"), std::string::npos);
  }
}

TEST(BlockingQueue, KeepsOrderAcrossThreadsAndDrainsAfterClose) {
  BlockingQueue<int> queue(2);
  std::thread producer([&] {
    for (int i = 0; i < 100; ++i) queue.Push(i);
    queue.Close();
  });
  for (int i = 0; i < 100; ++i) EXPECT_EQ(queue.Pop(), i);
  EXPECT_EQ(queue.Pop(), std::nullopt);
  producer.join();
  EXPECT_FALSE(queue.Push(1));
}

TEST(OptionRange, NamesOptionValueAndRange) {
  EXPECT_NO_THROW(CheckOptionRange("drive.laps", 0.0, 0.0, 100.0));
  EXPECT_NO_THROW(CheckOptionRange("drive.laps", 100, 0, 100));
  EXPECT_THROW(CheckOptionRange("drive.laps", std::nan(""), 0.0, 100.0), InputError);
  try {
    CheckOptionRange("drive.laps", 101, 0, 100);
    ADD_FAILURE() << "no InputError";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "option 'drive.laps' is 101, expected a number from 0 to 100");
  }
}

TEST(Random, SameSeedSameNumbersAndUniformRange) {
  Random a(7), b(7), c(8);
  double mean = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const double x = a.Uniform();
    EXPECT_EQ(x, b.Uniform());
    mean += x / 1000.0;
    const int k = c.UniformInt(-2, 3);
    EXPECT_GE(k, -2);
    EXPECT_LE(k, 3);
  }
  EXPECT_NEAR(mean, 0.5, 0.05);
}

}  // namespace
}  // namespace lift_slam
