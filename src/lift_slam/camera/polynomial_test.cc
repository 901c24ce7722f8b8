#include "lift_slam/camera/polynomial.h"

#include <gtest/gtest.h>

#include <array>

namespace lift_slam {
namespace {

TEST(Polynomial, EvaluatesByPowers) {
  EXPECT_DOUBLE_EQ(EvaluatePolynomial(std::array{1.0, -2.0, 3.0}, 2.0), 9.0);
}

TEST(Polynomial, FindsTheFirstOfSeveralRoots) {
  // (1 - x)(2 - x)(3 - x) = 6 - 11 x + 6 x^2 - x^3
  EXPECT_NEAR(FirstPositiveRoot(std::array{6.0, -11.0, 6.0, -1.0}, 10.0), 1.0, 1e-12);
  // (1.5 - x)(1.6 - x) = 2.4 - 3.1 x + x^2: positive at both ends of [0, 3].
  EXPECT_NEAR(FirstPositiveRoot(std::array{2.4, -3.1, 1.0}, 3.0), 1.5, 1e-12);
}

TEST(Polynomial, WithoutARootGivesTheLimit) {
  EXPECT_EQ(FirstPositiveRoot(std::array{1.0, 0.3, 0.1}, 7.0), 7.0);
  EXPECT_EQ(FirstPositiveRoot(std::array{1.0, 0.0, 0.0}, 7.0), 7.0);
  EXPECT_EQ(FirstPositiveRoot(std::array{1.0, -0.1}, 7.0), 7.0);
}

TEST(Polynomial, PositiveUpToSeesADipBeforeTheEnd) {
  const std::array dips = {2.4, -3.1, 1.0};
  EXPECT_TRUE(IsPositiveUpTo(dips, 1.4));
  EXPECT_FALSE(IsPositiveUpTo(dips, 1.55));
  EXPECT_FALSE(IsPositiveUpTo(dips, 3.0));
  EXPECT_TRUE(IsPositiveUpTo(std::array{2.5, -3.1, 1.0}, 3.0));
}

}  // namespace
}  // namespace lift_slam
