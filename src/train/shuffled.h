#pragma once
#include <utility>
#include <vector>

#include "base/random.h"

namespace svnet::train {

/// The elements in random order (Fisher and Yates, from the last to the first).
template <class T>
std::vector<T> shuffled(std::vector<T> elements, RandomStream& random) {
  for (std::size_t i = elements.size(); i > 1; --i)
    std::swap(elements[i - 1], elements[random.below(static_cast<std::uint32_t>(i))]);
  return elements;
}

}  // namespace svnet::train
