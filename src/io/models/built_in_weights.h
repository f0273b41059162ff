#pragma once
#include <cstddef>
#include <span>
#include <string>

namespace svnet::io {

/// The contents of the backbone's weights file that is part of the program; empty if there is none.
std::span<const std::byte> built_in_weights(const std::string& backbone);

}  // namespace svnet::io
