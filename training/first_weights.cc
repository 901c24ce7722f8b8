#include "training/first_weights.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <string_view>

#include "lift_slam/util/check.h"

namespace lift_slam::training {
namespace {

constexpr float kNoise = 0.1F;  // of the random weights that are there

std::span<float> Values(LiftWeights& weights, std::string_view name) {
  for (const LiftParameter& parameter : Parameters(weights)) {
    if (parameter.name == name) return parameter.values;
  }
  LIFT_SLAM_CHECK(false, "no parameter {}", name);
  return {};
}

void Weaken(std::span<float> values) {
  for (float& value : values) value *= kNoise;
}

// Random filters of images: they must not answer to plain brightness, which says nothing.
void WeakenFilters(std::span<float> filters, std::size_t pixels) {
  Weaken(filters);
  for (std::size_t begin = 0; begin < filters.size(); begin += pixels) {
    const std::span<float> filter = filters.subspan(begin, pixels);
    const float sum = std::accumulate(filter.begin(), filter.end(), 0.0F);
    for (float& value : filter) value -= sum / static_cast<float>(pixels);
  }
}

// Adds f(x, y), from the middle of a square filter.
void AddFilter(std::span<float> filter, const std::function<double(double, double)>& f) {
  const auto size = static_cast<int>(std::lround(std::sqrt(static_cast<double>(filter.size()))));
  for (int row = 0; row < size; ++row) {
    for (int column = 0; column < size; ++column) {
      const double x = column - 0.5 * (size - 1), y = row - 0.5 * (size - 1);
      filter[static_cast<std::size_t>(row * size + column)] += static_cast<float>(f(x, y));
    }
  }
}

// Filter (output, input) of a convolution's weights.
std::span<float> FilterAt(std::span<float> weights, int output, int input, int inputs, int pixels) {
  return weights.subspan(static_cast<std::size_t>((output * inputs + input) * pixels),
                         static_cast<std::size_t>(pixels));
}

double Gaussian(double x, double y, double sigma) {
  const double variance = sigma * sigma;
  return std::exp(-0.5 * (x * x + y * y) / variance) / (2.0 * std::numbers::pi * variance);
}

// Second derivatives of a Gaussian times its variance: along x and y, and across.
double Along(double u, double x, double y, double sigma) {
  return (u * u / (sigma * sigma) - 1.0) * Gaussian(x, y, sigma);
}

}  // namespace

void BeginWithBlobs(LiftWeights& weights) {
  constexpr int kPixels = 25 * 25;
  constexpr double kSigma = 23.5 / 12.0;  // of a keypoint in the detector's patch
  constexpr double kGain = 16.0;          // a blob of 30 grey values scores 1
  constexpr double kEdge = 1.3;           // weight of the curvatures' difference
  const std::span<float> filters = Values(weights, "detector.conv1.weight");
  WeakenFilters(filters, kPixels);
  for (int i = 0; i < 4; ++i) {
    const double sign = i % 2 == 0 ? kGain : -kGain;
    const double sigma = i < 2 ? kSigma : 1.26 * kSigma;
    AddFilter(FilterAt(filters, i, 0, 1, kPixels), [&](double x, double y) {
      return sign * (Along(x, x, y, sigma) + Along(y, x, y, sigma));
    });
    const double c = std::cos(i * std::numbers::pi / 4.0), s = std::sin(i * std::numbers::pi / 4.0);
    AddFilter(FilterAt(filters, 4 + i, 0, 1, kPixels), [&](double x, double y) {
      const double u = c * x + s * y, v = c * y - s * x;
      return kEdge * kGain * (Along(u, x, y, 1.13 * kSigma) - Along(v, x, y, 1.13 * kSigma));
    });
  }
  for (float& bias : Values(weights, "detector.conv1.bias").first(4)) bias = -1.0F;
}

void BeginWithGradients(LiftWeights& weights) {
  constexpr int kDirections = 8;
  constexpr int kSide = 5;  // of the last maps
  LIFT_SLAM_CHECK(weights.orientation.has_value(), "no orientation network");
  for (const char* layer : {"conv2", "conv3", "fc1", "fc2"}) {
    Weaken(Values(weights, std::string("orientation.") + layer + ".weight"));
  }
  const std::span<float> first = Values(weights, "orientation.conv1.weight");
  WeakenFilters(first, 25);
  const std::span<float> second = Values(weights, "orientation.conv2.weight");
  const std::span<float> third = Values(weights, "orientation.conv3.weight");
  const std::span<float> sums = Values(weights, "orientation.fc1.weight");
  for (int i = 0; i < kDirections; ++i) {
    const double angle = i * 2.0 * std::numbers::pi / kDirections;
    const double c = std::cos(angle), s = std::sin(angle);
    AddFilter(FilterAt(first, i, 0, 1, 25),
              [&](double x, double y) { return 3.0 * (c * x + s * y) * Gaussian(x, y, 1.2); });
    AddFilter(FilterAt(second, i, i, 10, 25),
              [](double x, double y) { return Gaussian(x, y, 1.2); });
    AddFilter(FilterAt(third, i, i, 20, 9), [](double x, double y) { return Gaussian(x, y, 0.8); });
    for (int unit = 0; unit < 2; ++unit) {
      const double part = unit == 0 ? c : s;
      for (int hinge = 0; hinge < 4; ++hinge) {  // the first sum's; all alike: their maximum is it
        const auto row = static_cast<std::size_t>((16 * unit + hinge) * 50 + i);
        AddFilter(sums.subspan(row * kSide * kSide, kSide * kSide),
                  [&](double x, double y) { return 10.0 * part * Gaussian(x, y, 1.5); });
      }
    }
  }
  const std::span<float> outputs = Values(weights, "orientation.fc2.weight");
  for (int unit = 0; unit < 2; ++unit) {
    for (int hinge = 0; hinge < 4; ++hinge) {
      outputs[static_cast<std::size_t>((16 * unit + hinge) * 100 + unit)] += 1.0F;
    }
  }
}

}  // namespace lift_slam::training
