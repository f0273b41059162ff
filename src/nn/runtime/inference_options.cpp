#include "nn/runtime/inference_options.h"

#include <initializer_list>
#include <vector>

#include "base/environment.h"
#include "base/text.h"

namespace svnet {
namespace {

/// The value that `word` names, one of `values`; `if_empty` for no word. Throws Error, prefixed by the variable's name.
template <class Enum>
Enum chosen(const char* variable, const std::string& word, std::initializer_list<Enum> values, Enum if_empty) {
  if (word.empty()) return if_empty;
  std::vector<std::string> names;
  for (const Enum value : values) {
    if (word == name_of(value)) return value;
    names.push_back(name_of(value));
  }
  fail("[", variable, "] '", word, "' is none of ", joined_with(", ", names));
}

}  // namespace

InferenceOptions inference_options_from_environment(const std::string& precision) {
  using kernels::Convolution, kernels::Precision;
  const InferenceOptions options{
      .convolution = chosen("SVNET_CONVOLUTION", environment_variable("SVNET_CONVOLUTION"),
                            {Convolution::direct, Convolution::winograd}, Convolution::automatic),
      .precision = chosen("SVNET_PRECISION", precision.empty() ? environment_variable("SVNET_PRECISION") : precision,
                          {Precision::f32, Precision::bf16, Precision::int8}, Precision::f32)};
  kernels::check_available(options.precision);
  return options;
}

}  // namespace svnet
