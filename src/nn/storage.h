#pragma once
#include <cstddef>
#include <memory>

namespace svnet {

/// 64-byte-aligned memory for `bytes` bytes, with room for one more vector, so that a kernel may read past the end of
/// the last row. Not initialised. Freed blocks of at least 64 KiB are kept for the next request of their size, up to
/// 256 MiB in all: a network asks for the same sizes again and again, and fresh pages cost more than most layers.
/// Thread-safe.
std::shared_ptr<void> allocate_storage(std::size_t bytes);

}  // namespace svnet
