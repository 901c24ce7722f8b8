#include "lift_slam/simulation/scene/sgi_image.h"

#include <fmt/format.h>

#include <array>

#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

constexpr std::size_t kHeaderBytes = 512;
constexpr std::size_t kMaxPixels = std::size_t{1} << 26;

class SgiDecoder {
 public:
  SgiDecoder(std::string_view bytes, const std::filesystem::path& path)
      : bytes_(bytes), path_(path) {}

  SceneTexture Decode() {
    ReadHeader();
    SceneTexture texture;
    texture.name = path_.filename().string();
    texture.width = static_cast<int>(width_);
    texture.height = static_cast<int>(height_);
    texture.rgba.assign(width_ * height_ * 4, 255);
    for (std::size_t channel = 0; channel < channels_; ++channel) {
      for (std::size_t row = 0; row < height_; ++row) StoreRow(channel, row, texture);
    }
    return texture;
  }

 private:
  [[noreturn]] void Fail(const std::string& what) const {
    throw InputError(fmt::format("{}: {} in this SGI picture", path_.string(), what));
  }

  std::size_t Number(std::size_t offset, std::size_t size) const {
    if (offset + size > bytes_.size()) Fail("the data ends too early");
    std::size_t value = 0;
    for (std::size_t i = 0; i < size; ++i) {
      value = value << 8 | static_cast<unsigned char>(bytes_[offset + i]);
    }
    return value;
  }

  void ReadHeader() {
    if (bytes_.size() < kHeaderBytes || Number(0, 2) != 0x01DA) Fail("no header found");
    run_length_coded_ = Number(2, 1) == 1;
    sample_bytes_ = Number(3, 1);
    const std::size_t dimension = Number(4, 2);
    width_ = Number(6, 2);
    height_ = dimension >= 2 ? Number(8, 2) : 1;
    channels_ = dimension >= 3 ? Number(10, 2) : 1;
    if (Number(2, 1) > 1) Fail("unknown storage (neither verbatim nor run-length coded)");
    if (sample_bytes_ != 1 && sample_bytes_ != 2) Fail("samples of neither 8 nor 16 bits");
    if (Number(104, 4) != 0) Fail("a colour map, which is not supported,");
    if (channels_ < 1 || channels_ > 4) {
      Fail(fmt::format("{} channels, expected 1 to 4,", channels_));
    }
    if (width_ == 0 || height_ == 0 || width_ * height_ > kMaxPixels) {
      Fail(fmt::format("an impossible size of {}x{}", width_, height_));
    }
  }

  // Rows are stored from the bottom up, one channel after the other.
  void StoreRow(std::size_t channel, std::size_t row, SceneTexture& texture) {
    const std::vector<std::uint8_t>& samples = DecodeRow(channel * height_ + row);
    std::uint8_t* out = texture.rgba.data() + (height_ - 1 - row) * width_ * 4;
    const bool grey = channels_ < 3;
    const std::size_t first = grey && channel == 1 ? 3 : channel;
    const std::size_t copies = grey && channel == 0 ? 3 : 1;
    for (std::size_t x = 0; x < width_; ++x) {
      for (std::size_t copy = 0; copy < copies; ++copy) out[4 * x + first + copy] = samples[x];
    }
  }

  const std::vector<std::uint8_t>& DecodeRow(std::size_t index) {
    samples_.clear();
    if (run_length_coded_) {
      DecodeRuns(Number(kHeaderBytes + 4 * index, 4));
    } else {
      const std::size_t start = kHeaderBytes + index * width_ * sample_bytes_;
      Number(start, width_ * sample_bytes_);
      for (std::size_t x = 0; x < width_; ++x) samples_.push_back(HighByte(start, x));
    }
    return samples_;
  }

  std::uint8_t HighByte(std::size_t start, std::size_t i) const {
    return static_cast<std::uint8_t>(bytes_[start + i * sample_bytes_]);
  }

  // A run's head: the low 7 bits count the pixels (0 ends the row), bit 7 says that they follow one
  // by one; else the next sample is repeated.
  void DecodeRuns(std::size_t offset) {
    while (samples_.size() < width_) {
      const std::size_t head = Number(offset, sample_bytes_);
      offset += sample_bytes_;
      const std::size_t count = std::min(head & 0x7F, width_ - samples_.size());
      if (count == 0) Fail("a row ends too early");
      const bool literal = (head & 0x80) != 0;
      const std::size_t stored = literal ? count : 1;
      if (offset + stored * sample_bytes_ > bytes_.size()) Fail("the data ends too early");
      for (std::size_t i = 0; i < count; ++i) {
        samples_.push_back(HighByte(offset, literal ? i : 0));
      }
      offset += stored * sample_bytes_;
    }
  }

  std::string_view bytes_;
  const std::filesystem::path& path_;
  bool run_length_coded_ = false;
  std::size_t sample_bytes_ = 1;
  std::size_t width_ = 0;
  std::size_t height_ = 0;
  std::size_t channels_ = 0;
  std::vector<std::uint8_t> samples_;
};

}  // namespace

SceneTexture DecodeSgiImage(std::string_view bytes, const std::filesystem::path& path) {
  return SgiDecoder(bytes, path).Decode();
}

}  // namespace lift_slam
