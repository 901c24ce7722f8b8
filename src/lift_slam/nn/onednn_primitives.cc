#include "lift_slam/nn/onednn_primitives.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "lift_slam/util/check.h"

namespace lift_slam::nn {
namespace {

using dnnl::memory;
using Tag = memory::format_tag;
using Type = memory::data_type;

memory::dims Dims(const Shape& shape) { return {shape.n, shape.c, shape.h, shape.w}; }

Type SourceType(const PrimitiveRequest& request) {
  switch (request.precision) {
    case Precision::kFloat32:
      return Type::f32;
    case Precision::kBfloat16:
      return Type::bf16;
    case Precision::kInt8:
      return request.nonnegative_input ? Type::u8 : Type::s8;
    case Precision::kAuto:
      break;  // ChoosePrecision has decided
  }
  return Type::f32;
}

Type WeightsType(Precision precision) {
  return precision == Precision::kInt8       ? Type::s8
         : precision == Precision::kBfloat16 ? Type::bf16
                                             : Type::f32;
}

// Symmetric 8-bit quantisation: real = integer * scale.
struct Quantization {
  float source_scale = 1.0F;         // integer = real * source_scale
  std::vector<float> weight_scales;  // integer = real * weight_scales[o]
  std::vector<float> output_scales;  // real = integer sum * output_scales[o]
};

Quantization Quantize(const Tensor& weights, const PrimitiveRequest& request) {
  const float steps = request.nonnegative_input ? 255.0F : 127.0F;
  Quantization quantization;
  quantization.source_scale = steps / std::max(request.activation_range, 1e-20F);
  const std::size_t size = weights.shape().sample_size();
  for (std::size_t o = 0; o * size < weights.size(); ++o) {
    float range = 1e-20F;
    for (const float w : weights.values().subspan(o * size, size)) {
      range = std::max(range, std::abs(w));
    }
    quantization.weight_scales.push_back(127.0F / range);
    quantization.output_scales.push_back(range / 127.0F / quantization.source_scale);
  }
  return quantization;
}

dnnl::primitive_attr MakeAttributes(const PrimitiveRequest& request,
                                    const Quantization& quantization) {
  dnnl::primitive_attr attributes;
  attributes.set_scratchpad_mode(dnnl::scratchpad_mode::user);
  if (request.precision == Precision::kInt8) {
    attributes.set_output_scales(/*mask=*/1 << 1, quantization.output_scales);
  }
  if (request.activation) {
    dnnl::post_ops post_ops;
    post_ops.append_eltwise(1.0F,
                            *request.activation == ActivationKind::kRelu
                                ? dnnl::algorithm::eltwise_relu
                                : dnnl::algorithm::eltwise_tanh,
                            0.0F, 0.0F);
    attributes.set_post_ops(post_ops);
  }
  return attributes;
}

void Execute(const dnnl::reorder& reorder, memory& from, memory& to, const dnnl::engine& engine) {
  dnnl::stream stream(engine);
  reorder.execute(stream, from, to);
  stream.wait();
}

memory ReorderedWeights(const Tensor& weights, const memory::dims& dims, const memory::desc& wanted,
                        const Quantization& quantization, const dnnl::engine& engine) {
  const Tag tag = dims.size() == 2 ? Tag::oi : Tag::oihw;
  Tensor copy = weights;  // oneDNN takes no pointer to const
  memory plain(memory::desc(dims, Type::f32, tag), engine, copy.data());
  memory reordered(wanted, engine);
  dnnl::primitive_attr attributes;
  if (!quantization.weight_scales.empty()) {
    attributes.set_output_scales(/*mask=*/1 << 0, quantization.weight_scales);
  }
  Execute({{engine, plain.get_desc(), engine, wanted, attributes}}, plain, reordered, engine);
  return reordered;
}

// oneDNN adds the bias to the integer sums, before the output scale.
memory ScaledBias(const std::vector<float>& bias, const Quantization& quantization,
                  const dnnl::engine& engine) {
  memory result({{static_cast<memory::dim>(bias.size())}, Type::f32, Tag::x}, engine);
  auto* values = static_cast<float*>(result.get_data_handle());
  for (std::size_t o = 0; o < bias.size(); ++o) {
    values[o] =
        quantization.output_scales.empty() ? bias[o] : bias[o] / quantization.output_scales[o];
  }
  return result;
}

template <class Description>
WeightedPrimitive Finish(const Description& description, const Tensor& weights,
                         const memory::dims& weight_dims, const std::vector<float>& bias,
                         const Quantization& quantization, const dnnl::engine& engine) {
  const std::string implementation = description.impl_info_str();
  LIFT_SLAM_CHECK(implementation.find("ref") == std::string::npos,
                  "oneDNN would compute weights {} by its reference implementation {}",
                  ToString(weights.shape()), implementation);
  return {.primitive = {description},
          .weights = ReorderedWeights(weights, weight_dims, description.weights_desc(),
                                      quantization, engine),
          .bias = ScaledBias(bias, quantization, engine),
          .source = description.src_desc(),
          .destination = description.dst_desc(),
          .scratchpad = description.scratchpad_desc(),
          .source_scale = quantization.source_scale};
}

Quantization QuantizationFor(const Tensor& weights, const PrimitiveRequest& request) {
  return request.precision == Precision::kInt8 ? Quantize(weights, request) : Quantization{};
}

}  // namespace

WeightedPrimitive MakePrimitive(const Convolution& layer, const PrimitiveRequest& request,
                                const dnnl::engine& engine) {
  const Quantization quantization = QuantizationFor(layer.weights, request);
  const memory::dims weight_dims = Dims(layer.weights.shape());
  const memory::dim outputs = layer.weights.shape().n;
  const dnnl::convolution_forward::desc desc(
      dnnl::prop_kind::forward_inference, dnnl::algorithm::convolution_direct,
      {Dims(request.input), SourceType(request), Tag::any},
      {weight_dims, WeightsType(request.precision), Tag::any}, {{outputs}, Type::f32, Tag::any},
      {Dims(OutputShape(layer, request.input)), Type::f32, Tag::any},
      /*strides=*/{1, 1}, /*padding_l=*/{0, 0}, /*padding_r=*/{0, 0});
  const dnnl::convolution_forward::primitive_desc description(
      desc, MakeAttributes(request, quantization), engine);
  return Finish<dnnl::convolution_forward::primitive_desc>(description, layer.weights, weight_dims,
                                                           layer.bias, quantization, engine);
}

WeightedPrimitive MakePrimitive(const FullyConnected& layer, const PrimitiveRequest& request,
                                const dnnl::engine& engine) {
  const Quantization quantization = QuantizationFor(layer.weights, request);
  const Shape& in = request.input;
  const memory::dim outputs = layer.weights.shape().n;
  const bool flat = in.h == 1 && in.w == 1;
  const memory::dims source_dims = flat ? memory::dims{in.n, in.c} : Dims(in);
  const memory::dims weight_dims =
      flat ? memory::dims{outputs, in.c} : memory::dims{outputs, in.c, in.h, in.w};
  const dnnl::inner_product_forward::desc desc(
      dnnl::prop_kind::forward_inference, {source_dims, SourceType(request), Tag::any},
      {weight_dims, WeightsType(request.precision), Tag::any}, {{outputs}, Type::f32, Tag::any},
      {{in.n, outputs}, Type::f32, Tag::any});
  const dnnl::inner_product_forward::primitive_desc description(
      desc, MakeAttributes(request, quantization), engine);
  return Finish<dnnl::inner_product_forward::primitive_desc>(
      description, layer.weights, weight_dims, layer.bias, quantization, engine);
}

memory::desc AsFloat32(const memory::desc& desc) {
  dnnl_memory_desc_t data = desc.data;
  data.data_type = dnnl_f32;
  return memory::desc(data);
}

memory::desc PlainDesc(const Shape& shape) { return {Dims(shape), Type::f32, Tag::nchw}; }

ChannelLayout LayoutOf(const memory::desc& desc, const Shape& shape) {
  const dnnl_memory_desc_t& data = desc.data;
  const dnnl_blocking_desc_t& blocking = data.format_desc.blocking;
  const bool blocked = blocking.inner_nblks == 1 && blocking.inner_idxs[0] == 1;
  LIFT_SLAM_CHECK(data.format_kind == dnnl_blocked && (blocked || blocking.inner_nblks == 0),
                  "activations of an unknown layout");
  ChannelLayout layout;
  layout.shape = {1, shape.c, shape.h, shape.w};
  layout.block = blocked ? static_cast<int>(blocking.inner_blks[0]) : shape.c;
  layout.padded_channels = static_cast<int>(data.padded_dims[1]);
  layout.sample_stride = blocking.strides[0];
  layout.block_stride = blocked ? blocking.strides[1] : 0;
  layout.channel_stride = blocked ? 1 : blocking.strides[1];
  if (data.ndims == 4) {
    layout.row_stride = blocking.strides[2];
    layout.column_stride = blocking.strides[3];
  }
  return layout;
}

dnnl::reorder MakeReorder(const memory::desc& from, const memory::desc& to, float scale,
                          const dnnl::engine& engine) {
  dnnl::primitive_attr attributes;
  attributes.set_scratchpad_mode(dnnl::scratchpad_mode::user);
  if (scale != 1.0F) attributes.set_output_scales(/*mask=*/0, {scale});
  return dnnl::reorder({engine, from, engine, to, attributes});
}

}  // namespace lift_slam::nn
