#pragma once
#include <string>

#include "base/enum_names.h"

namespace svnet::semantics {

/// How agglomerative clustering measures the dissimilarity of two clusters.
enum class Linkage { ward, average, complete, single };
constexpr auto enum_table(Linkage) {
  return std::to_array<EnumName<Linkage>>({{Linkage::ward, "ward"},
                                           {Linkage::average, "average"},
                                           {Linkage::complete, "complete"},
                                           {Linkage::single, "single"}});
}
/// Throws Error for an unknown name.
Linkage linkage_named(const std::string& name);

}  // namespace svnet::semantics
