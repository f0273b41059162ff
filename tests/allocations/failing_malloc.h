#pragma once
#include <cstddef>
#include <span>

// Replaces the allocation functions of the C library, for all libraries of the program (operator new ends there too),
// by ones of which a chosen call fails.
namespace svnet::allocations {

/// Which calls count and fail: those of the process that calls `fail_at`, or those of processes that it forks.
enum class Where { here, children };
/// once: that call alone fails. from_there_on: and all later ones.
enum class Kind { once, from_there_on };

/// From now on the `number`-th call fails, from 1 on.
void fail_at(std::size_t number, Where, Kind);
/// Ends that. Whether a call has failed, in any of the processes.
bool end_failures();

/// Who asked for the first and for the last allocation that failed, in any of the processes: return addresses, from the
/// inside out.
std::span<void* const> first_failed_stack();
std::span<void* const> last_failed_stack();

/// Allocations of this process that are not freed.
std::ptrdiff_t live_allocations();

}  // namespace svnet::allocations
