#pragma once
#include "base/enum_names.h"

namespace svnet {

/// What a pool takes of each window.
enum class PoolKind { max, average };

constexpr auto enum_table(PoolKind) {
  return std::to_array<EnumName<PoolKind>>({{PoolKind::max, "max"}, {PoolKind::average, "average"}});
}

}  // namespace svnet
