#include "predict/finite_check.h"

#include <cmath>

#include "base/error.h"

namespace svnet {

void check_finite(const Tensor& values, const char* what, std::size_t first) {
  const auto numbers = values.values<float>();
  for (std::size_t i = 0; i < numbers.size(); ++i)
    check(std::isfinite(numbers[i]), "[predict] ", what, " ", first + i, " is ", numbers[i], ", not a finite number");
}

}  // namespace svnet
