#include "lift_slam/place_recognition/clustering.h"

#include <gtest/gtest.h>

#include <set>

#include "lift_slam/place_recognition/places_for_test.h"

namespace lift_slam {
namespace {

class ClusteringTest : public testing::TestWithParam<DescriptorKind> {
 protected:
  // `copies` disturbed rows of each of `num_places` random ones; row i is of place i % num_places.
  Descriptors Rows(std::size_t num_places, std::size_t copies, double noise) const {
    const TestRoad road(GetParam(), static_cast<int>(num_places), 5);
    Random random(9);
    Descriptors rows(GetParam(), num_places * copies);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const DescriptorView place = road.points.row(i % num_places);
      std::memcpy(rows.mutable_row(i).data(), place.data(), place.size());
      Disturb(GetParam(), random, noise, rows.mutable_row(i));
    }
    return rows;
  }
};

TEST_P(ClusteringTest, FindsWellSeparatedClusters) {
  const Descriptors rows = Rows(6, 500, 0.5 * NoiseOf(GetParam()));
  const Clustering clustering = ClusterDescriptors(rows, {.num_clusters = 6}, 1);
  ASSERT_EQ(clustering.centers.size(), 6U);
  std::set<int> used;
  for (std::size_t i = 0; i < 6; ++i) used.insert(clustering.assignment[i]);
  EXPECT_EQ(used.size(), 6U);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ASSERT_EQ(clustering.assignment[i], clustering.assignment[i % 6]) << i;
  }
}

TEST_P(ClusteringTest, CenterIsTheMeanOrMajority) {
  const Descriptors rows = Rows(1, 301, NoiseOf(GetParam()));
  const Clustering clustering = ClusterDescriptors(rows, {.num_clusters = 1}, 1);
  ASSERT_EQ(clustering.centers.size(), 1U);
  for (std::size_t k = 0; k < static_cast<std::size_t>(GetParam().dimension); ++k) {
    double sum = 0.0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      sum += GetParam().metric == DescriptorMetric::kL2
                 ? static_cast<double>(reinterpret_cast<const float*>(rows.row(i).data())[k])
                 : static_cast<double>((rows.row(i)[k / 8] >> (k % 8)) & std::byte{1});
    }
    const DescriptorView center = clustering.centers.row(0);
    if (GetParam().metric == DescriptorMetric::kL2) {
      EXPECT_NEAR(reinterpret_cast<const float*>(center.data())[k], sum / 301.0, 1e-5);
    } else {
      EXPECT_EQ(((center[k / 8] >> (k % 8)) & std::byte{1}) != std::byte{0}, 2.0 * sum > 301.0);
    }
  }
}

TEST_P(ClusteringTest, SameBitsForAnyNumberOfThreads) {
  const Descriptors rows = Rows(50, 200, 3 * NoiseOf(GetParam()));
  const Clustering one = ClusterDescriptors(rows, {.num_clusters = 10, .num_threads = 1}, 7);
  const Clustering three = ClusterDescriptors(rows, {.num_clusters = 10, .num_threads = 3}, 7);
  EXPECT_EQ(one.assignment, three.assignment);
  ASSERT_EQ(one.centers.size(), three.centers.size());
  for (std::size_t i = 0; i < one.centers.size(); ++i) {
    EXPECT_TRUE(std::ranges::equal(one.centers.row(i), three.centers.row(i)));
  }
}

TEST_P(ClusteringTest, FewerClustersThanDifferentRowsAskedFor) {
  const Clustering clustering = ClusterDescriptors(Rows(3, 20, 0.0), {.num_clusters = 10}, 1);
  EXPECT_EQ(clustering.centers.size(), 3U);
}

TEST_P(ClusteringTest, EveryRowIsWithItsNearestCenter) {
  const Descriptors rows = Rows(40, 50, 2 * NoiseOf(GetParam()));
  const Clustering clustering = ClusterDescriptors(rows, {.num_clusters = 8}, 3);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(clustering.assignment[i], NearestCenter(clustering.centers, rows.row(i)));
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, ClusteringTest, testing::Values(FloatKind(), BinaryKind()),
                         [](const auto& test) {
                           return test.param.metric == DescriptorMetric::kL2 ? "Float" : "Binary";
                         });

}  // namespace
}  // namespace lift_slam
