#pragma once
#include <cstddef>

/// The number of calls of operator new so far, by all threads of this program.
std::size_t allocations();
