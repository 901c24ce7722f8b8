// Precision and recall of place recognition on a sequence that comes back: for each image the most
// alike of those at least GAP before it. Prints a row a vocabulary and score, as Markdown. Features
// are those that each vocabulary is made for.
//
// Usage: place_recognition_benchmark SEQUENCE [--period N] [--step N] [--gap N] [--weights FILE]
//        [--turned] [--curves FILE] [--picture FILE] VOCABULARY...
//   --period   images a lap: image i shows the place of image i - N, up to 2 images beside; without
//              it the sequence's ground truth decides: within --distance of the camera and --angle
//   --weights  of LIFT (default: those that ship)
//   --curves   writes every point of every curve: name, threshold, precision, recall
//   --picture  draws the curves (.svg)
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <iostream>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "benchmarks/place_recognition/precision_recall.h"
#include "benchmarks/place_recognition/vlad.h"
#include "lift_slam/datasets/sequence.h"
#include "lift_slam/features/lift/default_weights.h"
#include "lift_slam/features/lift/lift_extractor.h"
#include "lift_slam/features/orb/orb_extractor.h"
#include "lift_slam/place_recognition/vocabulary.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/visualization/plain_svg.h"
#include "lift_slam/visualization/svg_plot.h"

namespace lift_slam {
namespace {

struct Arguments {
  std::string sequence, weights, curves, picture;
  int period = 0, step = 1, gap = 10;
  double distance = 2.0, angle_deg = 25.0;
  bool upright = true;
  std::vector<std::string> vocabularies;
};

struct Images {
  std::vector<Descriptors> descriptors;
  std::vector<std::optional<Rigid3d>> world_from_cam;
};

// Score of image `query` against an earlier one.
using Scorer = std::function<double(std::size_t query, std::size_t earlier)>;

class Truth {
 public:
  Truth(const Arguments& arguments, const Images& images)
      : arguments_(arguments), images_(images) {}

  bool SamePlace(std::size_t i, std::size_t j) const {
    if (arguments_.period > 0) {
      const int apart = static_cast<int>(i) - static_cast<int>(j);
      const int rest = apart % arguments_.period;
      return apart > arguments_.period / 2 && std::min(rest, arguments_.period - rest) <= 2;
    }
    const auto &a = images_.world_from_cam[i], &b = images_.world_from_cam[j];
    if (!a || !b) return false;
    const double angle = RotationAngle(a->rotation * b->rotation.conjugate());
    return (a->translation - b->translation).norm() <= arguments_.distance &&
           angle * 180.0 / std::numbers::pi <= arguments_.angle_deg;
  }

  std::vector<PlaceAnswer> Answers(const Scorer& score) const {
    std::vector<PlaceAnswer> answers;
    const auto gap = static_cast<std::size_t>(arguments_.gap);
    for (std::size_t i = gap; i < images_.descriptors.size(); ++i) {
      PlaceAnswer answer{false, false, -1.0};
      for (std::size_t j = 0; j + gap <= i; ++j) {
        answer.has_match = answer.has_match || SamePlace(i, j);
        const double value = score(i, j);
        if (!(value > answer.score)) continue;
        answer.score = value;
        answer.is_correct = SamePlace(i, j);
      }
      answers.push_back(answer);
    }
    return answers;
  }

 private:
  const Arguments& arguments_;
  const Images& images_;
};

Images Extract(const Arguments& arguments, FeatureExtractor& extractor) {
  SequenceOptions options;
  options.calibration = CalibrationNeed::kOptional;
  options.step = arguments.step;
  const auto sequence = OpenSequence(arguments.sequence, options);
  Images images;
  while (const auto frame = sequence->Next()) {
    if (!frame->image) continue;
    images.descriptors.push_back(extractor.Extract(*frame->image).descriptors);
    images.world_from_cam.emplace_back();
    if (!sequence->info().ground_truth) continue;
    const GroundTruth& truth = *sequence->info().ground_truth;
    for (const TrajectoryPose& pose : truth.poses) {
      const bool is_of_frame = truth.by_index
                                   ? pose.frame_index == frame->frame_index
                                   : std::abs(pose.timestamp_ns - frame->timestamp_ns) < 20'000'000;
      if (is_of_frame) images.world_from_cam.back() = pose.world_from_cam;
    }
  }
  return images;
}

// A score relative to that with the image before (Galvez-Lopez and Tardos, 2012, eq. 2): what the
// best is to expect here.
Scorer Relative(const Scorer& score) {
  return [score](std::size_t i, std::size_t j) {
    const double expected = i > 0 ? score(i, i - 1) : 0.0;
    return expected > 0.0 ? score(i, j) / expected : 0.0;
  };
}

// Where the results go.
struct Results {
  std::ofstream curves;
  Plot plot;

  void Add(const std::string& name, const std::string& method, double megabytes,
           const std::vector<PrecisionRecall>& curve) {
    fmt::print("| {} | {} | {:.2f} | {:.1f} | {:.1f} | {:.3f} |\n", name, method, megabytes,
               100.0 * RecallAtFullPrecision(curve), 100.0 * FullRecall(curve),
               AveragePrecision(curve));
    std::fflush(stdout);
    for (const PrecisionRecall& point : curve) {
      if (!curves) break;
      curves << fmt::format("{} {}\t{:.6f}\t{:.4f}\t{:.4f}\n", name, method, point.threshold,
                            point.precision, point.recall);
    }
  }

  void Draw(const std::string& label, const std::vector<PrecisionRecall>& curve) {
    PlotSeries series;
    series.label = label;
    series.color = static_cast<PlotColor>(1 + plot.series.size() % (kNumPlotColors - 1));
    for (const PrecisionRecall& point : curve) {
      series.x.push_back(100.0 * point.recall);
      series.y.push_back(100.0 * point.precision);
    }
    plot.series.push_back(std::move(series));
  }
};

void Measure(const std::string& path, const Images& images, const Truth& truth, Results& results) {
  const auto begin = std::chrono::steady_clock::now();
  const Vocabulary vocabulary(path);
  const auto loaded = std::chrono::steady_clock::now();
  vocabulary.CheckKind(images.descriptors.at(0).kind());
  std::vector<BagOfWords> bags;
  std::size_t features = 0;
  for (const Descriptors& descriptors : images.descriptors) {
    bags.push_back(vocabulary.Transform(descriptors).bag);
    features += descriptors.size();
  }
  const auto transformed = std::chrono::steady_clock::now();
  const VocabularyInfo& info = vocabulary.info();
  const std::string features_name = info.kind.name.substr(0, info.kind.name.find(':'));
  const std::string name = fmt::format("{}, k {}, L {}, {} words", features_name, info.branching,
                                       info.depth, info.num_words);
  const double megabytes = static_cast<double>(info.num_bytes) * 1e-6;
  for (const BagScore kind : {BagScore::kL1, BagScore::kL2}) {
    const Scorer score = [&, kind](std::size_t i, std::size_t j) {
      return Score(bags[i], bags[j], kind);
    };
    const std::string method = kind == BagScore::kL1 ? "L1" : "L2";
    const auto curve = PrecisionRecallCurve(truth.Answers(score));
    results.Add(name, method, megabytes, curve);
    results.Draw(features_name + " " + method, curve);
    results.Add(name, method + " relative", megabytes,
                PrecisionRecallCurve(truth.Answers(Relative(score))));
  }
  const VladAggregator aggregator(vocabulary);
  std::vector<std::vector<float>> vectors;
  for (const Descriptors& descriptors : images.descriptors) {
    vectors.push_back(aggregator.Aggregate(descriptors));
  }
  const auto curve = PrecisionRecallCurve(
      truth.Answers([&](std::size_t i, std::size_t j) { return Cosine(vectors[i], vectors[j]); }));
  results.Add(name, fmt::format("VLAD {}", aggregator.dimension()), megabytes, curve);
  results.Draw(features_name + " VLAD", curve);
  const std::chrono::duration<double, std::milli> load = loaded - begin;
  const std::chrono::duration<double, std::micro> words = transformed - loaded;
  fmt::print(stderr, "{}: loaded in {:.1f} ms, {:.2f} us a feature\n", path, load.count(),
             words.count() / static_cast<double>(features));
}

Arguments Parse(int argc, char** argv) {
  Arguments arguments;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const auto value = [&]() -> std::string {
      if (i + 1 == argc) throw InputError(word + " needs a value");
      return argv[++i];
    };
    if (word == "--period") {
      arguments.period = std::stoi(value());
    } else if (word == "--step") {
      arguments.step = std::stoi(value());
    } else if (word == "--gap") {
      arguments.gap = std::stoi(value());
    } else if (word == "--distance") {
      arguments.distance = std::stod(value());
    } else if (word == "--angle") {
      arguments.angle_deg = std::stod(value());
    } else if (word == "--weights") {
      arguments.weights = value();
    } else if (word == "--turned") {
      arguments.upright = false;
    } else if (word == "--picture") {
      arguments.picture = value();
    } else if (word == "--curves") {
      arguments.curves = value();
    } else if (arguments.sequence.empty()) {
      arguments.sequence = word;
    } else {
      arguments.vocabularies.push_back(word);
    }
  }
  if (arguments.vocabularies.empty()) throw InputError("expected a sequence and vocabularies");
  return arguments;
}

std::unique_ptr<FeatureExtractor> MakeExtractor(const Arguments& arguments, bool is_orb) {
  if (is_orb) return CreateOrbExtractor({});
  LiftExtractorOptions options;
  options.upright = arguments.upright;
  return CreateLiftExtractor(ReadLiftWeightsOrDefault(arguments.weights), options);
}

void PrintHead(const Images& images, const Truth& truth) {
  int with_match = 0, queries = 0;
  for (const PlaceAnswer& answer : truth.Answers([](std::size_t, std::size_t) { return 0.0; })) {
    with_match += answer.has_match;
    ++queries;
  }
  fmt::print("{} images, {} queries, {} of them with an earlier image of the place\n\n",
             images.descriptors.size(), queries, with_match);
  fmt::print(
      "| vocabulary | score | MB | recall at 100 % precision, % | recall at any, % | average "
      "precision |\n| --- | --- | --- | --- | --- | --- |\n");
}

void Run(const Arguments& arguments) {
  Results results;
  if (!arguments.curves.empty()) results.curves.open(arguments.curves);
  results.plot.description = "Precision over recall";
  results.plot.x = {"recall [%]", false, 0.0, 100.0};
  results.plot.y = {"precision [%]", false, std::nullopt, 100.0};
  std::map<bool, Images> images_of;  // by whether they are ORB's features
  for (const std::string& path : arguments.vocabularies) {
    const bool is_orb = Vocabulary(path).info().kind.name == "orb";
    if (images_of.count(is_orb) == 0) {
      images_of[is_orb] = Extract(arguments, *MakeExtractor(arguments, is_orb));
    }
    const Truth truth(arguments, images_of[is_orb]);
    if (path == arguments.vocabularies.front()) PrintHead(images_of[is_orb], truth);
    Measure(path, images_of[is_orb], truth, results);
  }
  if (!arguments.picture.empty()) {
    WriteTextAtomically(arguments.picture, PlainSvg(RenderSvgFile(results.plot)));
  }
}

}  // namespace
}  // namespace lift_slam

int main(int argc, char** argv) {
  try {
    lift_slam::Run(lift_slam::Parse(argc, argv));
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
