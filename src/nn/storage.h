#pragma once
#include <cstddef>
#include <memory>

namespace svnet {

/// 64-byte-aligned memory of `bytes` bytes, not initialised. 64 more bytes follow, so that a kernel may read one vector
/// past the end. Freed blocks of at least 64 KiB are kept for the next request of their size, up to 256 MiB in all: a
/// network asks for the same sizes again and again, and fresh pages cost more than most layers. Thread-safe.
std::shared_ptr<void> allocate_storage(std::size_t bytes);

}  // namespace svnet
