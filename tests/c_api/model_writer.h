#pragma once
#include <string>

/// Writes small_model() of small_model.h, whose headers svnet.hpp must not be mixed with.
void write_small_model(const std::string& path);
