#include "nn/kernels/convolution_choice.h"

#include "nn/kernels/environment_word.h"

namespace svnet::kernels {

Convolution convolution_from_environment() {
  return environment_word("SVNET_CONVOLUTION", "direct", Convolution::direct, "winograd", Convolution::winograd,
                          Convolution::automatic);
}

}  // namespace svnet::kernels
