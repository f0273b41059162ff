#pragma once
#include <string>

/// Writes small_model() of small_model.h. In a file of its own, because its headers do not mix with svnet.hpp.
void write_small_model(const std::string& path);

/// Writes small_axis_model() with depth.
void write_depth_model(const std::string& path);
