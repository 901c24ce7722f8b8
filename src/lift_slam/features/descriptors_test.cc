#include "lift_slam/features/descriptors.h"

#include <gtest/gtest.h>

#include <cstring>

namespace lift_slam {
namespace {

TEST(Descriptors, HammingCountsDifferingBits) {
  Descriptors descriptors({"orb", DescriptorMetric::kHamming, 256}, 2);
  descriptors.mutable_row(0)[3] = std::byte{0x0F};
  descriptors.mutable_row(1)[31] = std::byte{0x81};
  EXPECT_EQ(DescriptorDistance(descriptors.kind(), descriptors.row(0), descriptors.row(1)), 6.0F);
  EXPECT_EQ(DescriptorDistance(descriptors.kind(), descriptors.row(0), descriptors.row(0)), 0.0F);
}

TEST(Descriptors, EuclideanIsTheNormOfTheDifference) {
  Descriptors descriptors({"lift:test", DescriptorMetric::kL2, 128}, 2);
  const float three = 3.0F, four = 4.0F;
  std::memcpy(descriptors.mutable_row(0).data(), &three, sizeof three);
  std::memcpy(descriptors.mutable_row(1).data() + 4, &four, sizeof four);
  EXPECT_FLOAT_EQ(DescriptorDistance(descriptors.kind(), descriptors.row(0), descriptors.row(1)),
                  5.0F);
}

}  // namespace
}  // namespace lift_slam
