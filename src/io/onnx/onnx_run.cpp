#include "io/onnx/onnx_run.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <numeric>

#include "base/error.h"
#include "nn/kernels/gemm.h"

namespace svnet::io {
namespace {

using Integers = std::vector<std::int64_t>;
using Sizes = std::vector<Index>;

Index count_of(const Sizes& shape) {
  return std::accumulate(shape.begin(), shape.end(), Index{1}, std::multiplies<>());
}

OnnxTensor tensor_of(Sizes shape, float value = 0) {
  const auto count = static_cast<std::size_t>(count_of(shape));
  return {std::move(shape), std::vector<float>(count, value)};
}

/// Distances between neighbours along each axis.
Sizes strides_of(const Sizes& shape) {
  Sizes strides(shape.size(), 1);
  for (std::size_t i = shape.size(); i-- > 1;) strides[i - 1] = strides[i] * shape[i];
  return strides;
}

/// y[i] = x[offset + Σ index_k · stride_k] for all indices of `shape`, in order.
template <class Body>
void for_strided(const Sizes& shape, const Sizes& strides, Index offset, const Body& body) {
  Sizes index(shape.size(), 0);
  const Index count = count_of(shape);
  for (Index i = 0; i < count; ++i) {
    body(i, offset);
    for (std::size_t axis = shape.size(); axis-- > 0;) {
      offset += strides[axis];
      if (++index[axis] < shape[axis]) break;
      offset -= strides[axis] * shape[axis];
      index[axis] = 0;
    }
  }
}

/// A window of a convolution or pool over images (N, C, H, W).
struct Window2d {
  Index n, c, h, w, kh, kw, sh, sw, top, left, oh, ow;
};

class Node {
 public:
  Node(const OnnxNode& node, std::map<std::string, const OnnxTensor*> tensors,
       std::map<std::string, const OnnxConstant*> constants)
      : node_(node), tensors_(std::move(tensors)), constants_(std::move(constants)) {}

  OnnxTensor value() const {
    const std::string& op = node_.op;
    if (op == "Identity") return x();
    if (op == "Relu") return mapped([](float v) { return v < 0 ? 0 : v; });
    if (op == "Sigmoid") return mapped([](float v) { return 1 / (1 + std::exp(-v)); });
    if (op == "Floor") return mapped([](float v) { return std::floor(v); });
    if (op == "Sin") return mapped([](float v) { return std::sin(v); });
    if (op == "Cos") return mapped([](float v) { return std::cos(v); });
    if (op == "Clip") {
      const float low = x(1).values.at(0), high = x(2).values.at(0);
      return mapped([=](float v) { return std::min(std::max(v, low), high); });
    }
    if (op == "HardSigmoid") {
      const float alpha = number("alpha"), beta = number("beta");
      return mapped([=](float v) { return std::min(std::max(alpha * v + beta, 0.0f), 1.0f); });
    }
    if (op == "Add") return combined(std::plus<>());
    if (op == "Sub") return combined(std::minus<>());
    if (op == "Mul") return combined(std::multiplies<>());
    if (op == "MatMul") return product();
    if (op == "Conv") return convolution();
    if (op == "MaxPool" || op == "AveragePool") return pool(op == "MaxPool");
    if (op == "GlobalAveragePool" || op == "GlobalMaxPool") return global_pool(op == "GlobalMaxPool");
    if (op == "BatchNormalization") return normed();
    if (op == "Softmax") return softmax();
    if (op == "Transpose") return transposed();
    if (op == "Flatten") return {{x().shape.at(0), count_of(x().shape) / x().shape.at(0)}, x().values};
    if (op == "Reshape") return reshaped();
    if (op == "Concat") return concatenated();
    if (op == "Pad") return padded();
    if (op == "Slice") return reversed();
    if (op == "ReduceMean") return mean();
    if (op == "Cast") return from_bf16();
    if (op == "DequantizeLinear") return from_int8();
    refuse("the operation is not known here");
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    fail("[onnx] node '", node_.name, "', ", node_.op, ": ", why);
  }

  const OnnxTensor& x(std::size_t i = 0) const {
    const auto found = i < node_.inputs.size() ? tensors_.find(node_.inputs[i]) : tensors_.end();
    if (found == tensors_.end()) refuse(joined("input ", i, " is missing"));
    return *found->second;
  }
  const OnnxConstant& constant(std::size_t i) const {
    const auto found = i < node_.inputs.size() ? constants_.find(node_.inputs[i]) : constants_.end();
    if (found == constants_.end()) refuse(joined("input ", i, " is not a constant"));
    return *found->second;
  }
  Integers integers(std::size_t i) const {
    const OnnxConstant& from = constant(i);
    if (from.type != OnnxType::i64) refuse(joined("input ", i, " is not int64"));
    Integers values(from.bytes.size() / sizeof(std::int64_t));
    std::memcpy(values.data(), from.bytes.data(), values.size() * sizeof(std::int64_t));
    return values;
  }
  template <class T>
  T attribute(const char* name, T value) const {
    for (const auto& [known, given] : node_.attributes)
      if (known == name) return std::get<T>(given);
    return value;
  }
  float number(const char* name) const { return attribute<float>(name, 0.0f); }
  std::int64_t integer(const char* name, std::int64_t value) const { return attribute(name, value); }

  template <class F>
  OnnxTensor mapped(const F& f) const {
    OnnxTensor y = x();
    std::ranges::transform(y.values, y.values.begin(), f);
    return y;
  }

  /// Two operands of shapes that are aligned at their last axes; axes of size 1 are repeated.
  template <class F>
  OnnxTensor combined(const F& f) const {
    const OnnxTensor &a = x(0), &b = x(1);
    const std::size_t rank = std::max(a.shape.size(), b.shape.size());
    const auto padded_shape = [&](Sizes shape) {
      shape.insert(shape.begin(), rank - shape.size(), 1);
      return shape;
    };
    const Sizes sa = padded_shape(a.shape), sb = padded_shape(b.shape);
    Sizes shape(rank), ta = strides_of(sa), tb = strides_of(sb);
    for (std::size_t i = 0; i < rank; ++i) {
      if (sa[i] != sb[i] && sa[i] != 1 && sb[i] != 1) refuse("shapes do not fit");
      shape[i] = sa[i] == 1 ? sb[i] : sa[i];
      if (sa[i] == 1) ta[i] = 0;
      if (sb[i] == 1) tb[i] = 0;
    }
    OnnxTensor y = tensor_of(shape);
    for_strided(shape, ta, 0, [&](Index i, Index from) { y.values[at(i)] = a.values[at(from)]; });
    for_strided(shape, tb, 0, [&](Index i, Index from) { y.values[at(i)] = f(y.values[at(i)], b.values[at(from)]); });
    return y;
  }

  /// a (…, M, K) · b (K, N).
  OnnxTensor product() const {
    const OnnxTensor &a = x(0), &b = x(1);
    if (a.shape.empty() || b.shape.size() != 2 || a.shape.back() != b.shape[0]) refuse("shapes do not fit");
    const Index k = b.shape[0], n = b.shape[1], m = count_of(a.shape) / k;
    Sizes shape = a.shape;
    shape.back() = n;
    OnnxTensor y = tensor_of(shape);
    kernels::gemm<float>(Parallel::shared(), {.m = m, .n = n, .k = k}, a.values.data(), b.values.data(),
                         y.values.data());
    return y;
  }

  Window2d window(Index kh, Index kw) const {
    const OnnxTensor& from = x();
    if (from.shape.size() != 4) refuse("the input is not (N, C, H, W)");
    const Integers strides = attribute<Integers>("strides", {1, 1}), pads = attribute<Integers>("pads", {0, 0, 0, 0});
    Window2d w{from.shape[0], from.shape[1], from.shape[2], from.shape[3], kh, kw,
               strides.at(0), strides.at(1), pads.at(0),    pads.at(1),    0,  0};
    w.oh = (w.h + w.top + pads.at(2) - kh) / w.sh + 1;
    w.ow = (w.w + w.left + pads.at(3) - kw) / w.sw + 1;
    return w;
  }

  OnnxTensor convolution() const {
    const OnnxTensor& kernel = x(1);
    const Window2d w = window(kernel.shape.at(2), kernel.shape.at(3));
    const Index groups = integer("group", 1), in = w.c / groups, out = kernel.shape[0] / groups;
    if (in != kernel.shape[1]) refuse("channels do not fit");
    const Index taps = w.kh * w.kw, pixels = w.oh * w.ow, depth = in * taps;
    OnnxTensor y = tensor_of({w.n, kernel.shape[0], w.oh, w.ow});
    std::vector<float> columns(static_cast<std::size_t>(depth * pixels));
    for (Index n = 0; n < w.n; ++n)
      for (Index g = 0; g < groups; ++g) {
        const float* image = x().values.data() + (n * w.c + g * in) * w.h * w.w;
        Parallel::shared().for_chunks(in, 1, [&](Index channel, Index, int) {
          gather(w, image + channel * w.h * w.w, columns.data() + channel * taps * pixels);
        });
        kernels::gemm<float>(Parallel::shared(), {.m = out, .n = pixels, .k = depth},
                             kernel.values.data() + g * out * depth, columns.data(),
                             y.values.data() + (n * groups + g) * out * pixels);
      }
    if (node_.inputs.size() < 3) return y;
    for (std::size_t i = 0; i < y.values.size(); ++i) y.values[i] += x(2).values[i / at(pixels) % x(2).values.size()];
    return y;
  }

  /// (H, W) -> (KH · KW, OH · OW): the pixel under each tap, 0 outside the image.
  static void gather(const Window2d& w, const float* image, float* to) {
    for (Index i = 0; i < w.kh; ++i)
      for (Index j = 0; j < w.kw; ++j)
        for (Index oh = 0; oh < w.oh; ++oh)
          for (Index ow = 0; ow < w.ow; ++ow) {
            const Index row = oh * w.sh - w.top + i, column = ow * w.sw - w.left + j;
            *to++ = row >= 0 && row < w.h && column >= 0 && column < w.w ? image[row * w.w + column] : 0;
          }
  }

  OnnxTensor pool(bool is_max) const {
    const Integers kernel = attribute<Integers>("kernel_shape", {1, 1});
    const Window2d w = window(kernel.at(0), kernel.at(1));
    OnnxTensor y = tensor_of({w.n, w.c, w.oh, w.ow});
    Parallel::shared().for_chunks(w.n * w.c, 1, [&](Index plane, Index, int) {
      const float* image = x().values.data() + plane * w.h * w.w;
      float* to = y.values.data() + plane * w.oh * w.ow;
      for (Index oh = 0; oh < w.oh; ++oh)
        for (Index ow = 0; ow < w.ow; ++ow) {
          float largest = -std::numeric_limits<float>::infinity(), sum = 0, count = 0;
          for (Index row = std::max<Index>(0, oh * w.sh - w.top); row < std::min(w.h, oh * w.sh - w.top + w.kh); ++row)
            for (Index column = std::max<Index>(0, ow * w.sw - w.left);
                 column < std::min(w.w, ow * w.sw - w.left + w.kw); ++column) {
              const float value = image[row * w.w + column];
              largest = std::max(largest, value);
              sum += value;
              count += 1;
            }
          *to++ = is_max ? largest : sum / count;
        }
    });
    return y;
  }

  OnnxTensor global_pool(bool is_max) const {
    const Sizes& shape = x().shape;
    if (shape.size() != 4) refuse("the input is not (N, C, H, W)");
    OnnxTensor y = tensor_of({shape[0], shape[1], 1, 1});
    const Index pixels = shape[2] * shape[3];
    for (std::size_t i = 0; i < y.values.size(); ++i) {
      const float* from = x().values.data() + static_cast<Index>(i) * pixels;
      y.values[i] = is_max
                        ? *std::max_element(from, from + pixels)
                        : static_cast<float>(std::accumulate(from, from + pixels, 0.0) / static_cast<double>(pixels));
    }
    return y;
  }

  OnnxTensor normed() const {
    OnnxTensor y = x();
    const Index channels = y.shape.at(1), pixels = count_of(y.shape) / y.shape[0] / channels;
    for (std::size_t i = 0; i < y.values.size(); ++i) {
      const std::size_t c = i / at(pixels) % at(channels);
      y.values[i] = (y.values[i] - x(3).values[c]) / std::sqrt(x(4).values[c] + number("epsilon")) * x(1).values[c] +
                    x(2).values[c];
    }
    return y;
  }

  OnnxTensor softmax() const {
    OnnxTensor y = x();
    const Index columns = y.shape.back();
    for (auto row = y.values.begin(); row != y.values.end(); row += columns) {
      const float largest = *std::max_element(row, row + columns);
      std::transform(row, row + columns, row, [&](float v) { return std::exp(v - largest); });
      const float sum = std::accumulate(row, row + columns, 0.0f);
      std::transform(row, row + columns, row, [&](float v) { return v / sum; });
    }
    return y;
  }

  OnnxTensor transposed() const {
    const Integers perm = attribute<Integers>("perm", {});
    const Sizes strides = strides_of(x().shape);
    if (perm.size() != strides.size()) refuse("perm does not fit");
    Sizes shape, from;
    for (const std::int64_t axis : perm) {
      shape.push_back(x().shape.at(at(axis)));
      from.push_back(strides.at(at(axis)));
    }
    OnnxTensor y = tensor_of(shape);
    for_strided(shape, from, 0, [&](Index i, Index place) { y.values[at(i)] = x().values[at(place)]; });
    return y;
  }

  OnnxTensor reshaped() const {
    const Integers wanted = integers(1);
    Sizes shape;
    for (std::size_t i = 0; i < wanted.size(); ++i) shape.push_back(wanted[i] == 0 ? x().shape.at(i) : wanted[i]);
    const Index given = -count_of(shape);  // if one size is -1
    if (given > 0) std::ranges::replace(shape, Index{-1}, count_of(x().shape) / given);
    if (count_of(shape) != count_of(x().shape)) refuse("the number of elements differs");
    return {shape, x().values};
  }

  OnnxTensor concatenated() const {
    const std::int64_t given = integer("axis", 0);
    const std::size_t rank = x().shape.size(), axis = at(given < 0 ? given + static_cast<std::int64_t>(rank) : given);
    Sizes shape = x().shape;
    shape.at(axis) = 0;
    for (std::size_t i = 0; i < node_.inputs.size(); ++i) shape[axis] += x(i).shape.at(axis);
    OnnxTensor y = tensor_of(shape);
    const Index outer =
        std::accumulate(shape.begin(), shape.begin() + static_cast<Index>(axis), Index{1}, std::multiplies<>());
    auto to = y.values.begin();
    for (Index o = 0; o < outer; ++o)
      for (std::size_t i = 0; i < node_.inputs.size(); ++i) {
        const Index run = count_of(x(i).shape) / outer;
        to = std::copy_n(x(i).values.begin() + o * run, run, to);
      }
    return y;
  }

  OnnxTensor padded() const {
    const Integers pads = integers(1);
    const Sizes& from = x().shape;
    if (pads.size() != 2 * from.size()) refuse("pads do not fit");
    Sizes shape = from;
    for (std::size_t i = 0; i < from.size(); ++i) shape[i] += pads[i] + pads[i + from.size()];
    OnnxTensor y = tensor_of(shape);
    const Sizes strides = strides_of(shape);
    Index first = 0;
    for (std::size_t i = 0; i < from.size(); ++i) first += pads[i] * strides[i];
    for_strided(from, strides, first, [&](Index i, Index place) { y.values[at(place)] = x().values[at(i)]; });
    return y;
  }

  /// A slice of step -1 over a whole axis, the only one that svnet writes.
  OnnxTensor reversed() const {
    const std::size_t axis = at(integers(3).at(0));
    if (integers(1).at(0) != -1 || integers(4).at(0) != -1) refuse("only whole axes can be reversed");
    Sizes strides = strides_of(x().shape);
    const Index last = (x().shape.at(axis) - 1) * strides[axis];
    strides[axis] = -strides[axis];
    OnnxTensor y = tensor_of(x().shape);
    for_strided(y.shape, strides, last, [&](Index i, Index place) { y.values[at(i)] = x().values[at(place)]; });
    return y;
  }

  /// Over the first axis, which is dropped.
  OnnxTensor mean() const {
    if (attribute<Integers>("axes", {}) != Integers{0}) refuse("only the first axis can be averaged");
    OnnxTensor y = tensor_of(Sizes(x().shape.begin() + 1, x().shape.end()));
    const Index count = x().shape.at(0), run = count_of(y.shape);
    for (Index i = 0; i < run; ++i) {
      double sum = 0;
      for (Index j = 0; j < count; ++j) sum += static_cast<double>(x().values[at(j * run + i)]);
      y.values[at(i)] = static_cast<float>(sum / static_cast<double>(count));
    }
    return y;
  }

  OnnxTensor from_bf16() const {
    const OnnxConstant& from = constant(0);
    if (from.type != OnnxType::bf16) refuse("the input is not bfloat16");
    OnnxTensor y = tensor_of(from.shape);
    for (std::size_t i = 0; i < y.values.size(); ++i) {
      std::uint16_t upper = 0;
      std::memcpy(&upper, from.bytes.data() + 2 * i, 2);
      y.values[i] = std::bit_cast<float>(std::uint32_t{upper} << 16);
    }
    return y;
  }

  OnnxTensor from_int8() const {
    const OnnxConstant& from = constant(0);
    if (from.type != OnnxType::i8) refuse("the input is not int8");
    OnnxTensor y = tensor_of(from.shape);
    const std::size_t axis = at(integer("axis", 1));
    const Index inner = strides_of(from.shape).at(axis);
    for (std::size_t i = 0; i < y.values.size(); ++i) {
      const auto value = static_cast<std::int8_t>(from.bytes[i]);
      y.values[i] = static_cast<float>(value) * x(1).values[i / at(inner) % x(1).values.size()];
    }
    return y;
  }

  static std::size_t at(Index i) { return static_cast<std::size_t>(i); }

  const OnnxNode& node_;
  std::map<std::string, const OnnxTensor*> tensors_;
  std::map<std::string, const OnnxConstant*> constants_;
};

OnnxTensor f32_tensor(const OnnxConstant& constant) {
  OnnxTensor tensor{constant.shape, std::vector<float>(constant.bytes.size() / sizeof(float))};
  std::memcpy(tensor.values.data(), constant.bytes.data(), tensor.values.size() * sizeof(float));
  return tensor;
}

}  // namespace

OnnxTensor run_onnx(const OnnxGraph& graph, const std::map<std::string, OnnxTensor>& inputs) {
  std::map<std::string, const OnnxConstant*> constants;
  for (const OnnxConstant& constant : graph.constants) constants[constant.name] = &constant;
  std::map<std::string, OnnxTensor> values = inputs;
  std::map<std::string, std::size_t> last_use;  // values are freed after their last reader
  for (std::size_t i = 0; i < graph.nodes.size(); ++i)
    for (const std::string& input : graph.nodes[i].inputs) last_use[input] = i;
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    const OnnxNode& node = graph.nodes[i];
    std::map<std::string, const OnnxTensor*> seen;
    for (const std::string& input : node.inputs) {
      const auto constant = constants.find(input);
      if (constant != constants.end() && constant->second->type == OnnxType::f32 && !values.contains(input))
        values.emplace(input, f32_tensor(*constant->second));
      if (const auto found = values.find(input); found != values.end()) seen[input] = &found->second;
    }
    OnnxTensor value = Node(node, std::move(seen), constants).value();
    for (const std::string& input : node.inputs)
      if (last_use.at(input) == i) values.erase(input);
    values[node.name] = std::move(value);
  }
  return values.at(graph.outputs.at(0).name);
}

}  // namespace svnet::io
