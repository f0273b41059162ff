#pragma once
#include <map>
#include <string>

#include "nn/kernels/packed/byte_input.h"

namespace svnet {

/// What the left operands of a network's products have been over pictures, by the name of the layer that multiplies
/// them. Products in int8 need it.
using ActivationRanges = std::map<std::string, kernels::ChannelRanges>;

/// A text that is the same if and only if all numbers are: 64 hexadecimal digits.
std::string fingerprint(const ActivationRanges& ranges);

}  // namespace svnet
