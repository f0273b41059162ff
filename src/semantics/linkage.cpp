#include "semantics/linkage.h"

namespace svnet::semantics {

Linkage linkage_named(const std::string& name) {
  const auto found = find_enum<Linkage>(name);
  check(found.has_value(), "[linkage] '", name, "' is unknown", suggestion(name, names_of<Linkage>()));
  return *found;
}

}  // namespace svnet::semantics
