#include "predict/finite_check.h"

#include "base/error.h"
#include "base/finite.h"

namespace svnet::predict {

void check_finite(std::span<const float> values, const char* what, std::size_t first) {
  if (const auto bad = first_not_finite(values))
    fail("[predict] ", what, " ", first + *bad, " is ", values[*bad], ", not a finite number");
}

}  // namespace svnet::predict
