#pragma once

#include <cstring>
#include <filesystem>
#include <vector>

#include "lift_slam/place_recognition/descriptor_file.h"
#include "lift_slam/place_recognition/vocabulary_trainer.h"
#include "lift_slam/util/random.h"

namespace lift_slam {

inline DescriptorKind FloatKind() { return {"lift:test", DescriptorMetric::kL2, 128}; }
inline DescriptorKind BinaryKind() { return {"orb", DescriptorMetric::kHamming, 256}; }

inline void RandomRow(const DescriptorKind& kind, Random& random, std::span<std::byte> row) {
  if (kind.metric == DescriptorMetric::kHamming) {
    for (std::byte& byte : row) byte = static_cast<std::byte>(random.Bits() >> 56);
    return;
  }
  auto* values = reinterpret_cast<float*>(row.data());
  for (int i = 0; i < kind.dimension; ++i) values[i] = static_cast<float>(random.Normal());
}

// Moves a row: flips each bit with a chance of `noise`, or adds normal noise of that deviation.
inline void Disturb(const DescriptorKind& kind, Random& random, double noise,
                    std::span<std::byte> row) {
  auto* values = reinterpret_cast<float*>(row.data());
  for (std::size_t i = 0; i < static_cast<std::size_t>(kind.dimension); ++i) {
    if (kind.metric == DescriptorMetric::kL2) {
      values[i] += static_cast<float>(noise * random.Normal());
    } else if (random.Uniform() < noise) {
      row[i / 8] ^= std::byte{1} << (i % 8);
    }
  }
}

// A world of points, each with a descriptor, along a road; view v sees the points v * step to
// v * step + width - 1 with noise. Neighbouring views share points.
struct TestRoad {
  Descriptors points;
  int step = 20, width = 200;

  TestRoad(const DescriptorKind& kind, int num_points, std::uint64_t seed)
      : points(kind, static_cast<std::size_t>(num_points)) {
    Random random(seed);
    for (std::size_t i = 0; i < points.size(); ++i) RandomRow(kind, random, points.mutable_row(i));
  }

  Descriptors View(int v, std::uint64_t seed, double noise) const {
    Random random(seed * 1000 + static_cast<std::uint64_t>(v));
    Descriptors rows(points.kind(), static_cast<std::size_t>(width));
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const std::size_t point = (static_cast<std::size_t>(v * step) + i) % points.size();
      std::memcpy(rows.mutable_row(i).data(), points.row(point).data(), rows.row(i).size());
      Disturb(rows.kind(), random, noise, rows.mutable_row(i));
    }
    return rows;
  }
};

inline double NoiseOf(const DescriptorKind& kind) {
  return kind.metric == DescriptorMetric::kHamming ? 0.05 : 0.3;
}

// Views 0 to count - 1 as a file of descriptors.
inline void WriteViews(const TestRoad& road, int count, const std::filesystem::path& path) {
  DescriptorFileWriter writer(path, {road.points.kind(), "test"});
  for (int v = 0; v < count; ++v) writer.AddImage(road.View(v, 1, NoiseOf(road.points.kind())));
}

}  // namespace lift_slam
