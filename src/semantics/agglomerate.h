#pragma once
#include "base/index.h"
#include "semantics/agglomeration_state.h"
#include "semantics/linkage.h"

namespace svnet::semantics {

/// Merges the nearest two clusters until k are left. Sets merged_into[i] to the earlier slot that slot i was merged
/// into, or to i. The result has the same bits on every instruction set: there is no fused multiply-add, and a minimum
/// does not depend on the order of its operands.
void agglomerate(Linkage linkage, Index k, AgglomerationState state);

}  // namespace svnet::semantics
