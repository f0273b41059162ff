#pragma once
#include <cstddef>

/// How often the program has asked the C library for memory so far, by any function (operator new ends there too).
std::size_t malloc_count();
