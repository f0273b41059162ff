#pragma once
#include "base/index.h"

namespace svnet::bench {

/// Multiply-adds of vectors in registers, on the calling thread, with the instruction set in force. Returns their sum.
float multiply_adds(Index rounds);
/// Flops of that call: two for each product.
double multiply_add_flops(Index rounds);

}  // namespace svnet::bench
