#pragma once

#include <variant>

#include "lift_slam/nn/channel_layout.h"
#include "lift_slam/nn/layers.h"

namespace lift_slam::nn {

// The layers that oneDNN has not (or not as fast as it should), eight channels at a time, for one
// sample in any layout. Convolution and FullyConnected are not among them.
class VectorLayer {
 public:
  // CheckError when the output's shape is not what the layer makes of the input's.
  VectorLayer(const Layer& layer, const ChannelLayout& input, const ChannelLayout& output);
  // Copies from one layout to another.
  VectorLayer(const ChannelLayout& input, const ChannelLayout& output);

  const ChannelLayout& output() const { return output_; }
  std::size_t scratch_size() const { return scratch_size_; }  // floats that Run needs

  // Writes every channel of the output, not the padding. Input and output do not overlap.
  void Run(const float* input, float* output, float* scratch) const;

 private:
  struct Copy {};
  using Kind = std::variant<Copy, Ghh, Activation, Pooling, SubtractiveNormalization>;

  void Apply(const Copy&, const float* in, float* out, float* scratch) const;
  void Apply(const Ghh& layer, const float* in, float* out, float* scratch) const;
  void Apply(const Activation& layer, const float* in, float* out, float* scratch) const;
  void Apply(const Pooling& layer, const float* in, float* out, float* scratch) const;
  void Apply(const SubtractiveNormalization& layer, const float* in, float* out,
             float* scratch) const;
  // The mean over the channels, in the middle of a frame of `radius` zeros.
  void ChannelMean(int radius, const float* in, float* mean) const;
  void Subtract(const float* in, const float* mean, float* out) const;

  Kind kind_;
  ChannelLayout input_, output_;
  std::size_t scratch_size_ = 0;
  std::vector<float> inverse_coverage_;  // of SubtractiveNormalization, one a pixel
};

}  // namespace lift_slam::nn
