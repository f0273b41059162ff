#pragma once
#include "base/parallel.h"
#include "nn/kernels/epilogue.h"

namespace svnet::kernels {

/// x is (M, C): features, or images with M = N·H·W.
struct RowsShape {
  Index rows, channels;
};

/// mean (C) and biased variance (C) of the rows, by two passes with double accumulators over fixed runs of rows.
template <class T>
void moments(Parallel&, const RowsShape&, const T* x, T* mean, T* variance);

/// sums (C) over the rows of a, or of the products a·b if b is not nullptr.
template <class T>
void column_sums(Parallel&, const RowsShape&, const T* a, const T* b, T* sums);

/// y = clamp(x·scale + shift), per channel; y may be x.
template <class T>
void scale_shift_reference(Parallel&, const RowsShape&, const T* x, const T* scale, const T* shift, Clamp, T* y);
void scale_shift(Parallel&, const RowsShape&, const float* x, const float* scale, const float* shift, Clamp, float* y);
inline void scale_shift(Parallel& parallel, const RowsShape& shape, const double* x, const double* scale,
                        const double* shift, Clamp clamp, double* y) {
  scale_shift_reference(parallel, shape, x, scale, shift, clamp, y);
}

}  // namespace svnet::kernels
