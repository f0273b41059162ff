#include "nn/runtime/inference_options.h"

#include "base/environment.h"

namespace svnet {
namespace {

/// The value that `word` names, one of two; `if_empty` for no word. Throws Error, prefixed by the variable's name.
template <class Enum>
Enum chosen(const char* variable, const std::string& word, Enum first, Enum second, Enum if_empty) {
  if (word.empty()) return if_empty;
  const std::string first_name = name_of(first), second_name = name_of(second);
  check(word == first_name || word == second_name, "[", variable, "] '", word, "' is neither ", first_name, " nor ",
        second_name);
  return word == first_name ? first : second;
}

}  // namespace

InferenceOptions inference_options_from_environment(const std::string& precision) {
  using kernels::Convolution, kernels::Precision;
  const InferenceOptions options{
      .convolution = chosen("SVNET_CONVOLUTION", environment_variable("SVNET_CONVOLUTION"), Convolution::direct,
                            Convolution::winograd, Convolution::automatic),
      .precision = chosen("SVNET_PRECISION", precision.empty() ? environment_variable("SVNET_PRECISION") : precision,
                          Precision::f32, Precision::bf16, Precision::f32)};
  kernels::check_available(options.precision);
  return options;
}

}  // namespace svnet
