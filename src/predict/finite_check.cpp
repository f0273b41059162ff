#include "predict/finite_check.h"

#include "base/error.h"
#include "base/finite.h"

namespace svnet::predict {

void check_finite(const Tensor& values, const char* what, std::size_t first) {
  const auto all = values.values<float>();
  if (const auto bad = first_not_finite(all))
    fail("[predict] ", what, " ", first + *bad, " is ", all[*bad], ", not a finite number");
}

}  // namespace svnet::predict
