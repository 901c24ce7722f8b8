#pragma once

#include <cstddef>

#include "lift_slam/nn/tensor.h"

namespace lift_slam::nn {

// Where the values of one sample lie in memory. Channels come in blocks (oneDNN's nChw16c), or all
// in one block (NHWC, and NCHW with its own channel stride). Channels from shape.c up to
// `padded_channels` exist in memory and are zero.
struct ChannelLayout {
  Shape shape;  // n = 1
  int block = 1;
  int padded_channels = 1;
  std::ptrdiff_t sample_stride = 0;  // from one sample to the next, in values, like all strides
  std::ptrdiff_t block_stride = 0, channel_stride = 0, row_stride = 0, column_stride = 0;

  std::ptrdiff_t Offset(int c, int y, int x) const {
    return (c / block) * block_stride + (c % block) * channel_stride + y * row_stride +
           x * column_stride;
  }
  // Whether channels [c, c + count) exist in memory one after the other.
  bool Contiguous(int c, int count) const {
    return channel_stride == 1 && c % block + count <= block && c + count <= padded_channels;
  }

  static ChannelLayout Nchw(const Shape& shape);
  // As this one is laid out, for another shape.
  ChannelLayout For(const Shape& other) const;
};

}  // namespace lift_slam::nn
