#include "base/parallel.h"

#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

#include "base/communicator.h"
#include "base/error.h"

using namespace svnet;

TEST_CASE("chunks cover the range once and do not depend on the number of threads") {
  for (int threads : {1, 2, 8}) {
    Parallel pool(threads);
    std::mutex mutex;
    std::set<std::pair<Index, Index>> chunks;
    pool.for_chunks(103, 10, [&](Index begin, Index end, int worker) {
      std::lock_guard lock(mutex);
      CHECK(worker >= 0);
      CHECK(worker < threads);
      CHECK(chunks.emplace(begin, end).second);
    });
    REQUIRE(chunks.size() == 11);
    Index expected = 0;
    for (auto [begin, end] : chunks) {
      CHECK(begin == expected);
      expected = end;
    }
    CHECK(expected == 103);
  }
}

TEST_CASE("nested and concurrent calls finish") {
  Parallel pool(3);
  std::atomic<int> sum{0};
  auto call = [&] {
    for (int i = 0; i < 200; ++i)
      pool.for_chunks(8, 1, [&](Index, Index, int) { pool.for_chunks(4, 1, [&](Index, Index, int) { ++sum; }); });
  };
  std::thread other(call);
  call();
  other.join();
  CHECK(sum == 2 * 200 * 8 * 4);
}

TEST_CASE("the exception of the lowest chunk is rethrown after all chunks have run") {
  Parallel pool(4);
  std::atomic<int> ran{0};
  const auto call = [&] {
    pool.for_chunks(64, 1, [&](Index begin, Index, int) {
      ++ran;
      if (begin >= 5) fail("chunk ", begin);
    });
  };
  CHECK_THROWS_WITH(call(), "chunk 5");
  CHECK(ran == 64);
}

TEST_CASE("the pool can be resized between calls") {
  Parallel pool(1);
  for (int threads : {2, 5, 1, 8}) {
    pool.resize(threads);
    CHECK(pool.threads() == threads);
    std::atomic<Index> sum{0};
    pool.for_chunks(1000, 7, [&](Index begin, Index end, int) { sum += end - begin; });
    CHECK(sum == 1000);
  }
  CHECK_THROWS_WITH(pool.resize(0), "[threads] number of threads must be between 1 and 1024");
}

TEST_CASE("a share runs whole chunks, each in one process of the communicator") {
  class Member : public SingleProcess {
   public:
    Member(int rank, int size) : rank_(rank), size_(size) {}
    int rank() const override { return rank_; }
    int size() const override { return size_; }

   private:
    int rank_, size_;
  };
  Parallel pool(3);
  for (const int size : {1, 2, 5}) {
    std::vector<int> owner(23, -1);
    for (int rank = 0; rank < size; ++rank) {
      const Member member(rank, size);
      Parallel share = pool.share(member);
      CHECK(share.threads() == 3);
      share.for_chunks(23, 7, [&](Index begin, Index end, int) {
        CHECK(begin % 7 == 0);
        CHECK(end == std::min<Index>(begin + 7, 23));
        for (Index i = begin; i < end; ++i) {
          CHECK(owner[static_cast<std::size_t>(i)] == -1);
          owner[static_cast<std::size_t>(i)] = rank;
        }
      });
    }
    CHECK(std::is_sorted(owner.begin(), owner.end()));
    CHECK(owner.front() == 0);
    CHECK(owner.back() == std::min(size, 4) - 1);
  }
}
