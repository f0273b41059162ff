#include "nn/storage.h"

#include <map>
#include <mutex>
#include <new>
#include <vector>

#include "base/aligned.h"

namespace svnet {
namespace {

constexpr std::align_val_t kAlign{kAlignment};
constexpr std::size_t kSmallest = std::size_t{64} << 10;
#ifdef __SANITIZE_ADDRESS__
constexpr std::size_t kMostKept = 0;  // so that the sanitizer sees a use after free
#else
constexpr std::size_t kMostKept = std::size_t{256} << 20;
#endif

/// Freed blocks by size. Never destroyed: a shared pointer may free its block after every static object is gone.
class FreeBlocks {
 public:
  static FreeBlocks& instance() {
    static auto* blocks = new FreeBlocks;
    return *blocks;
  }

  void* take(std::size_t size) {
    if (size < kSmallest) return nullptr;
    std::lock_guard lock(mutex_);
    const auto found = by_size_.find(size);
    if (found == by_size_.end() || found->second.empty()) return nullptr;
    void* block = found->second.back();
    found->second.pop_back();
    kept_ -= size;
    return block;
  }

  void give(void* block, std::size_t size) noexcept {
    if (size >= kSmallest) try {
        std::lock_guard lock(mutex_);
        if (kept_ + size <= kMostKept) {
          by_size_[size].push_back(block);
          kept_ += size;
          return;
        }
      } catch (...) {  // no memory for the list: then the block is not kept
      }
    ::operator delete(block, kAlign);
  }

 private:
  std::mutex mutex_;
  std::map<std::size_t, std::vector<void*>> by_size_;
  std::size_t kept_ = 0;
};

}  // namespace

std::shared_ptr<void> allocate_storage(std::size_t bytes) {
  const std::size_t size = bytes + 64;
  void* block = FreeBlocks::instance().take(size);
  if (block == nullptr) {
    block = ::operator new(size, kAlign);
    advise_huge_pages(block, size);
  }
  return {block, [size](void* p) { FreeBlocks::instance().give(p, size); }};
}

}  // namespace svnet
