#include "lift_slam/nn/channel_layout.h"

namespace lift_slam::nn {

ChannelLayout ChannelLayout::Nchw(const Shape& shape) {
  const std::ptrdiff_t area = std::ptrdiff_t{shape.h} * shape.w;
  return {.shape = shape,
          .block = shape.c,
          .padded_channels = shape.c,
          .sample_stride = shape.c * area,
          .block_stride = shape.c * area,
          .channel_stride = area,
          .row_stride = shape.w,
          .column_stride = 1};
}

ChannelLayout ChannelLayout::For(const Shape& other) const {
  const bool one_block = block >= shape.c;
  if (channel_stride != 1) return Nchw(other);
  const int new_block = one_block ? other.c : block;
  const int padded = (other.c + new_block - 1) / new_block * new_block;
  const std::ptrdiff_t block_size = std::ptrdiff_t{new_block} * other.h * other.w;
  return {.shape = other,
          .block = new_block,
          .padded_channels = padded,
          .sample_stride = padded / new_block * block_size,
          .block_stride = block_size,
          .channel_stride = 1,
          .row_stride = std::ptrdiff_t{new_block} * other.w,
          .column_stride = new_block};
}

}  // namespace lift_slam::nn
