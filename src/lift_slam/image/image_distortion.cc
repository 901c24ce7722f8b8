#include "lift_slam/image/image_distortion.h"

#include <fmt/format.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "lift_slam/image/gamma.h"
#include "lift_slam/image/gray_histogram.h"
#include "lift_slam/image/noise.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/number_text.h"
#include "lift_slam/util/random.h"

namespace lift_slam {
namespace {

// What a word of the text stands for, and which amounts it takes.
struct Word {
  std::string_view name;
  ImageDistortionKind kind;
  double least, most;      // both 0: the word stands alone
  std::string_view range;  // for messages
};

constexpr Word kWords[] = {
    {"gamma", ImageDistortionKind::kGamma, 0.01, 100.0, "a number from 0.01 to 100"},
    {"q1", ImageDistortionKind::kQ1, 0.0, 0.0, ""},
    {"q3", ImageDistortionKind::kQ3, 0.0, 0.0, ""},
    {"q1-clip", ImageDistortionKind::kQ1Clip, 0.0, 0.0, ""},
    {"q3-clip", ImageDistortionKind::kQ3Clip, 0.0, 0.0, ""},
    {"salt-pepper", ImageDistortionKind::kSaltPepper, 0.0, 1.0, "a share of pixels from 0 to 1"},
    {"noise", ImageDistortionKind::kNoise, 0.0, 255.0, "grey levels from 0 to 255"},
    {"blur", ImageDistortionKind::kBlur, 0.0, 100.0, "pixels from 0 to 100"},
};
constexpr const char* kKnown =
    "gamma=G, q1, q3, q1-clip, q3-clip, salt-pepper=SHARE, noise=SIGMA or blur=SIGMA";

const Word& WordOf(ImageDistortionKind kind) { return kWords[static_cast<std::size_t>(kind)]; }

bool TakesAmount(const Word& word) { return word.most > 0.0; }

ImageDistortion ParseOne(std::string_view text) {
  const std::size_t equals = text.find('=');
  const std::string_view name = text.substr(0, equals);
  for (const Word& word : kWords) {
    if (word.name != name) continue;
    if (!TakesAmount(word)) {
      if (equals == std::string_view::npos) return {word.kind, 1.0};
      throw InputError(fmt::format("distortion '{}': {} takes no number", text, name));
    }
    const auto amount =
        equals == std::string_view::npos ? std::nullopt : ParseDouble(text.substr(equals + 1));
    if (amount && *amount >= word.least && *amount <= word.most) return {word.kind, *amount};
    throw InputError(fmt::format("distortion '{}': expected {}= and {}", text, name, word.range));
  }
  throw InputError(fmt::format("distortion '{}' is unknown; expected {}", text, kKnown));
}

GrayImage Truncate(const GrayImage& image, ImageDistortionKind kind) {
  const bool is_low = kind == ImageDistortionKind::kQ1 || kind == ImageDistortionKind::kQ1Clip;
  const bool is_clip = kind == ImageDistortionKind::kQ1Clip || kind == ImageDistortionKind::kQ3Clip;
  const std::uint8_t quantile = GrayQuantile(image, is_low ? 0.25 : 0.75);
  cv::Mat table(1, 256, CV_8UC1), result;
  for (int v = 0; v < 256; ++v) {
    const bool is_beyond = is_low ? v <= quantile : v >= quantile;
    const int replaced = is_clip ? quantile : (is_low ? 0 : 255);
    table.at<std::uint8_t>(v) = static_cast<std::uint8_t>(is_beyond ? replaced : v);
  }
  cv::LUT(image.mat(), table, result);
  return GrayImage(result);
}

GrayImage AddSaltAndPepper(const GrayImage& image, double share, Random& random) {
  cv::Mat pixels = image.mat().clone();
  for (int y = 0; y < pixels.rows; ++y) {
    auto* row = pixels.ptr<std::uint8_t>(y);
    for (int x = 0; x < pixels.cols; ++x) {
      const double chance = random.Uniform();
      if (chance < share) row[x] = chance < 0.5 * share ? 0 : 255;
    }
  }
  return GrayImage(pixels);
}

GrayImage Blur(const GrayImage& image, double sigma_px) {
  if (sigma_px == 0.0) return image;
  cv::Mat result;
  cv::GaussianBlur(image.mat(), result, cv::Size(), sigma_px, sigma_px, cv::BORDER_REFLECT_101);
  return GrayImage(result);
}

GrayImage DistortOnce(const GrayImage& image, const ImageDistortion& distortion, Random& random) {
  switch (distortion.kind) {
    case ImageDistortionKind::kGamma:
      return ApplyGamma(image, distortion.amount);
    case ImageDistortionKind::kSaltPepper:
      return AddSaltAndPepper(image, distortion.amount, random);
    case ImageDistortionKind::kNoise:
      return AddNoise(image, distortion.amount, random);
    case ImageDistortionKind::kBlur:
      return Blur(image, distortion.amount);
    default:
      return Truncate(image, distortion.kind);
  }
}

}  // namespace

std::vector<ImageDistortion> ParseImageDistortions(std::string_view text) {
  std::vector<ImageDistortion> chain;
  while (true) {
    const std::size_t comma = text.find(',');
    chain.push_back(ParseOne(text.substr(0, comma)));
    if (comma == std::string_view::npos) return chain;
    text.remove_prefix(comma + 1);
  }
}

std::string ToText(std::span<const ImageDistortion> chain) {
  std::string text;
  for (const ImageDistortion& distortion : chain) {
    const Word& word = WordOf(distortion.kind);
    if (!text.empty()) text += ",";
    text += word.name;
    if (TakesAmount(word)) text += fmt::format("={}", distortion.amount);
  }
  return text;
}

std::uint8_t GrayQuantile(const GrayImage& image, double share) {
  const auto histogram = GrayHistogram(image);
  const double wanted = share * image.width() * image.height();
  std::int64_t seen = 0;
  for (std::size_t v = 0; v < 256; ++v) {
    seen += histogram[v];
    if (static_cast<double>(seen) >= wanted) return static_cast<std::uint8_t>(v);
  }
  return 255;
}

GrayImage Distort(const GrayImage& image, std::span<const ImageDistortion> chain,
                  std::uint64_t seed, std::int64_t frame_index) {
  if (image.empty()) return image;
  // Neighbouring frames must not see neighbouring streams: an odd constant spreads the numbers.
  constexpr std::uint64_t kSpread = 0x9E3779B97F4A7C15ULL;
  Random random(seed ^ (kSpread * (static_cast<std::uint64_t>(frame_index) + 1)));
  GrayImage result = image;
  for (const ImageDistortion& distortion : chain) {
    result = DistortOnce(result, distortion, random);
  }
  return result;
}

}  // namespace lift_slam
