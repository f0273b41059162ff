#include "nn/kernels/convolution_choice.h"

#include <cstdlib>
#include <string>

#include "base/error.h"

namespace svnet::kernels {

Convolution convolution_from_environment() {
  const char* text = std::getenv("SVNET_CONVOLUTION");
  if (text == nullptr || *text == '\0') return Convolution::automatic;
  const std::string word = text;
  check(word == "direct" || word == "winograd", "[SVNET_CONVOLUTION] '", word, "' is neither direct nor winograd");
  return word == "direct" ? Convolution::direct : Convolution::winograd;
}

}  // namespace svnet::kernels
