#pragma once
#include <cstddef>

/// How often operator new was called so far, by any thread of this program.
std::size_t allocations();
