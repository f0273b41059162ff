#pragma once
#include <cstdint>

#include "base/parallel.h"
#include "nn/kernels/window.h"

namespace svnet::kernels {

/// y (N, OH, OW, C) = largest value of each window inside the image; source[i] = offset in x that y[i] came from (the
/// first in row order among equals; -1 for a window completely in the border, where y is 0). NaN counts as the largest.
template <class T>
void max_pool(Parallel&, const Window&, const T* x, T* y, std::int64_t* source);
/// dx from dy and the sources.
template <class T>
void max_pool_gradient(Parallel&, const Window&, const T* dy, const std::int64_t* source, T* dx);

/// y = mean of the values of each window inside the image: the border does not count, as in Keras.
template <class T>
void average_pool(Parallel&, const Window&, const T* x, T* y);
template <class T>
void average_pool_gradient(Parallel&, const Window&, const T* dy, T* dx);

}  // namespace svnet::kernels
