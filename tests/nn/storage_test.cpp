#include "nn/storage.h"

#include <catch2/catch.hpp>
#include <cstdint>
#include <cstring>
#include <thread>
#include <vector>

#include "nn/allocations.h"
#include "nn/numbers.h"

using namespace svnet;
using namespace svnet::test;

namespace {

constexpr std::size_t kMegabyte = std::size_t{1} << 20;

}  // namespace

TEST_CASE("freed storage is reused by the next request of its size, and never while it is in use") {
  auto first = allocate_storage(kMegabyte);
  const void* address = first.get();
  CHECK(reinterpret_cast<std::uintptr_t>(address) % 64 == 0);
  auto second = allocate_storage(kMegabyte);
  CHECK(second.get() != address);
  auto copy = first;
  first = {};
  CHECK(allocate_storage(kMegabyte).get() != address);
  copy = {};
#ifndef __SANITIZE_ADDRESS__  // which has to see every use after free
  CHECK(allocate_storage(kMegabyte).get() == address);
#endif
  CHECK(allocate_storage(kMegabyte + 1).get() != address);
}

TEST_CASE("tensors on reused storage have the right initial values") {
  const Shape shape{300, 300};
  std::memset(Tensor::empty(shape).data<float>(), 0x7f, 300 * 300 * sizeof(float));
  CHECK(same_bits(absolute(Tensor::zeros(shape)), Tensor::full(shape, 0)));
}

TEST_CASE("at most 256 MiB of freed storage are kept") {
  const std::size_t before = bytes_in_use();
  {
    std::vector<std::shared_ptr<void>> blocks;
    for (std::size_t i = 0; i < 6; ++i) blocks.push_back(allocate_storage(64 * kMegabyte + i));
    CHECK(bytes_in_use() - before >= 6 * 64 * kMegabyte);
  }
  CHECK(bytes_in_use() - before <= 256 * kMegabyte);
}

TEST_CASE("storage has one owner at a time if several threads request it") {
  std::vector<std::thread> threads;
  std::vector<int> disturbed(4, 0);
  for (unsigned char id = 0; id < 4; ++id)
    threads.emplace_back([id, &disturbed] {
      for (int i = 0; i < 2000; ++i) {
        const auto block = allocate_storage(kMegabyte / 8);
        auto* bytes = static_cast<unsigned char*>(block.get());
        bytes[0] = bytes[kMegabyte / 8 - 1] = id;
        std::this_thread::yield();
        if (bytes[0] != id || bytes[kMegabyte / 8 - 1] != id) ++disturbed[id];
      }
    });
  for (auto& thread : threads) thread.join();
  CHECK(disturbed == std::vector<int>(4, 0));
}
