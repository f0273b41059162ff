#include "nn/ops/checks.h"

namespace svnet::ops {

void check_operands(const char* op, std::initializer_list<Tensor> operands) {
  for (const Tensor& x : operands) {
    check(x.defined(), "[", op, "] an operand is an empty tensor");
    check(x.dtype() == operands.begin()->dtype(), "[", op, "] operands mix ", name_of(operands.begin()->dtype()),
          " and ", name_of(x.dtype()));
  }
}

Index leading(const char* op, const Tensor& x) {
  check_operands(op, {x});
  check(x.rank() >= 1 && x.dim(-1) > 0, "[", op, "] expects at least one axis that is not empty, got ",
        to_string(x.shape()));
  return x.size() / x.dim(-1);
}

}  // namespace svnet::ops
