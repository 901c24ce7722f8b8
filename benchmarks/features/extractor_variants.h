#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/features/quality_tables.h"
#include "lift_slam/features/feature_extractor.h"

namespace lift_slam {

using MakeExtractor = std::function<std::unique_ptr<FeatureExtractor>()>;

// One row of a table: weights in a precision, upright or turned.
struct Variant {
  const LiftWeights* weights;
  nn::Precision precision;
  bool upright;
  std::string name;
};

// Those that the CPU and the weights allow.
std::vector<Variant> Variants(std::span<const NamedWeights> all, const QualityOptions& options);

// "ORB" or "SIFT".
MakeExtractor Baseline(const std::string& name, const QualityOptions& options);

struct ExtractorVariant {
  std::string name;
  MakeExtractor make;
};

// ORB, SIFT and all variants of LIFT; the weights must outlive them.
std::vector<ExtractorVariant> Extractors(std::span<const NamedWeights> all,
                                         const QualityOptions& options);

}  // namespace lift_slam
