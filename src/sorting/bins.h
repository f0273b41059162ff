#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace svnet::sorting {

/// For each object, whether it is in a wrong bin. A bin stands for the category that has the most objects in it; if
/// several have, for that of its first object among them. An object is right if its bin stands for its category, and
/// no other bin has more objects of this category; of several such bins with as many, only the first one is right. So
/// at most one bin is right for a category. bins, categories: (objects) numbers from 0. Throws Error if there are not
/// as many of both.
std::vector<bool> in_wrong_bin(std::span<const std::int32_t> bins, std::span<const std::int32_t> categories);

}  // namespace svnet::sorting
