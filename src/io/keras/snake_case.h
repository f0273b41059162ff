#pragma once
#include <string>

namespace svnet::io {

/// "SeparableConv2D" -> "separable_conv2d", as Keras makes layer names of class names.
std::string snake_case(const std::string& class_name);

}  // namespace svnet::io
