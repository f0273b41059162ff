#include "predict/familiarity_note.h"

#include <cmath>

#include "base/error.h"

namespace svnet::predict {

std::string familiarity_note(const Familiarity& familiarity) {
  if (familiarity.trust >= 1) return {};
  return joined("the object's shape is unlike those that the model was trained on: distance ", familiarity.distance,
                ", theirs are up to ", familiarity.limit, "; the shape counts ", std::lround(100 * familiarity.trust),
                " %, the rest is what holds for every object");
}

}  // namespace svnet::predict
