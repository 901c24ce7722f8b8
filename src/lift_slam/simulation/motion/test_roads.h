#pragma once

// Roads for tests.
#include <cmath>
#include <numbers>

#include "lift_slam/simulation/scene/road.h"

namespace lift_slam {

inline constexpr double kTestRoadHalfWidthM = 5.0;

// A level circle, driven to the left.
inline Road CircleRoad(double radius_m, int num_sections) {
  Road road;
  for (int i = 0; i < num_sections; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / num_sections;
    const Eigen::Vector3d outward(std::cos(angle), std::sin(angle), 0.0);
    road.sections.push_back(
        {(radius_m - kTestRoadHalfWidthM) * outward, (radius_m + kTestRoadHalfWidthM) * outward});
  }
  return road;
}

// Two straights of 200 m, 60 m apart, and two half circles, the second banked and over a hill.
inline Road OvalRoad() {
  Road road;
  const double radius = 30.0, straight = 200.0, hill = 6.0, banking = 0.2;
  const auto add = [&](const Eigen::Vector2d& center, const Eigen::Vector2d& forward, double z,
                       double bank) {
    const Eigen::Vector3d left(-forward.y() * std::cos(bank), forward.x() * std::cos(bank),
                               std::sin(bank));
    const Eigen::Vector3d middle(center.x(), center.y(), z);
    road.sections.push_back(
        {middle + kTestRoadHalfWidthM * left, middle - kTestRoadHalfWidthM * left});
  };
  for (int i = 0; i < 20; ++i) add({i * straight / 20, 0.0}, {1.0, 0.0}, 0.0, 0.0);
  for (int i = 0; i < 20; ++i) {
    const double a = std::numbers::pi * i / 20;
    add({straight + radius * std::sin(a), radius - radius * std::cos(a)},
        {std::cos(a), std::sin(a)}, 0.0, 0.0);
  }
  for (int i = 0; i < 20; ++i) {
    add({straight - i * straight / 20, 2 * radius}, {-1.0, 0.0}, 0.0, 0.0);
  }
  for (int i = 0; i < 20; ++i) {
    const double a = std::numbers::pi * i / 20;
    add({-radius * std::sin(a), radius + radius * std::cos(a)}, {-std::cos(a), -std::sin(a)},
        0.5 * hill * (1.0 - std::cos(2.0 * a)), -0.5 * banking * (1.0 - std::cos(2.0 * a)));
  }
  return road;
}

}  // namespace lift_slam
