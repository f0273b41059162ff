#include "train/extraction.h"

#include <atomic>
#include <catch2/catch.hpp>
#include <limits>
#include <map>
#include <mutex>
#include <set>
#include <thread>

#include "base/error.h"
#include "base/text.h"

using namespace svnet;
using namespace svnet::train;

namespace {

constexpr Index kDimension = 3;

float value_of(Index input, Index i) { return static_cast<float>(10 * input + i); }

std::vector<float> all_rows(Index count) {
  std::vector<float> rows;
  for (Index input = 0; input < count; ++input)
    for (Index i = 0; i < kDimension; ++i) rows.push_back(value_of(input, i));
  return rows;
}

/// Inputs are their own numbers, and rows are made of them.
Extraction numbers(Index count) {
  Extraction e;
  e.network = "numbers";
  e.count = count;
  e.dimension = kDimension;
  e.prepared = [](Index begin, Index end, Parallel&) {
    Tensor batch = Tensor::empty({end - begin});
    for (Index i = begin; i < end; ++i) batch.data<float>()[i - begin] = static_cast<float>(i);
    return batch;
  };
  e.run = [](const Tensor& batch) {
    Tensor rows = Tensor::empty({batch.size(), kDimension});
    for (Index input = 0; input < batch.size(); ++input)
      for (Index i = 0; i < kDimension; ++i)
        rows.data<float>()[input * kDimension + i] = value_of(static_cast<Index>(batch.data<float>()[input]), i);
    return rows;
  };
  e.name = [](Index input) { return joined("input ", input); };
  return e;
}

std::vector<float> rows_of(const Extraction& e, const Messages& messages = {}) {
  return extracted(e, messages, SingleProcess::shared());
}

constexpr Index kTooMuchMemory = Index{1} << 40;

/// Calls body() with 1, 2 and 8 threads, which have a batch each or share one.
template <class Body>
void for_threads(Body&& body) {
  const int before = Parallel::shared().threads();
  for (const int threads : {1, 2, 8})
    for (const Index memory : {Index{0}, kTooMuchMemory}) {
      Parallel::shared().resize(threads);
      CAPTURE(threads, memory);
      body(memory);
    }
  Parallel::shared().resize(before);
}

}  // namespace

TEST_CASE("every input is prepared once and gets its row, whatever the number of threads") {
  for_threads([](Index memory) {
    for (const Index count : {0, 1, 7, 32, 33, 500})
      for (const Index unit : {1, 4}) {
        if (count % unit != 0) continue;
        CAPTURE(count, unit);
        Extraction e = numbers(count);
        e.unit = unit;
        e.memory = [memory](Index) { return memory; };
        std::mutex mutex;
        std::multiset<Index> prepared;
        bool cuts_units = false, exceeds_batch = false;
        const auto plain = e.prepared;
        e.prepared = [&](Index begin, Index end, Parallel& parallel) {
          const std::lock_guard lock(mutex);
          for (Index i = begin; i < end; ++i) prepared.insert(i);
          cuts_units |= begin % unit != 0 || end % unit != 0;
          exceeds_batch |= end - begin > e.batch;
          return plain(begin, end, parallel);
        };
        CHECK(rows_of(e) == all_rows(count));
        CHECK(static_cast<Index>(prepared.size()) == count);
        CHECK(std::set(prepared.begin(), prepared.end()).size() == prepared.size());
        CHECK_FALSE(cuts_units);
        CHECK_FALSE(exceeds_batch);
      }
  });
}

TEST_CASE("threads that have the memory each take batches of their own, smaller ones at the end") {
  const int before = Parallel::shared().threads();
  Parallel::shared().resize(4);
  std::mutex mutex;
  std::map<Index, Index> batches;
  std::atomic<int> inside = 0, most = 0;
  Extraction e = numbers(200);
  const auto plain = e.prepared;
  e.prepared = [&](Index begin, Index end, Parallel& parallel) {
    const int now = ++inside;
    for (int seen = most; seen < now && !most.compare_exchange_weak(seen, now);) {
    }
    // Waits for a second thread, which must come.
    for (int i = 0; i < 2000 && most < 2; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    {
      const std::lock_guard lock(mutex);
      batches[begin] = end - begin;
    }
    --inside;
    return plain(begin, end, parallel);
  };
  CHECK(rows_of(e) == all_rows(200));
  CHECK(most >= 2);
  CHECK(batches.begin()->second == 16);
  CHECK(batches.rbegin()->second == 1);
  Index last = e.batch;
  for (const auto& [begin, size] : batches) {
    CHECK(size <= last);
    last = size;
  }
  Parallel::shared().resize(before);
}

TEST_CASE("of several inputs that cannot be prepared or run, the first one is named") {
  for_threads([](Index memory) {
    Extraction e = numbers(300);
    e.memory = [memory](Index) { return memory; };
    const auto plain = e.prepared;
    e.prepared = [&](Index begin, Index end, Parallel& parallel) {
      for (const Index damaged : {70, 71, 150, 299})
        check(damaged < begin || damaged >= end, "input ", damaged, " is damaged");
      return plain(begin, end, parallel);
    };
    CHECK_THROWS_WITH(rows_of(e), "input 70 is damaged");
    const auto run = e.run;
    e.prepared = plain;
    e.run = [&](const Tensor& batch) {
      Tensor rows = run(batch);
      for (Index i = 0; i < batch.size(); ++i)
        if (batch.data<float>()[i] > 120)
          rows.data<float>()[i * kDimension + 1] = std::numeric_limits<float>::infinity();
      return rows;
    };
    CHECK_THROWS_WITH(rows_of(e),
                      "[numbers] a feature of input 121 is not finite: the weights do not fit this network");
  });
}

TEST_CASE("progress comes from the calling thread, grows and ends at the number of inputs") {
  for_threads([](Index memory) {
    Extraction e = numbers(100);
    e.memory = [memory](Index) { return memory; };
    const auto caller = std::this_thread::get_id();
    std::vector<Index> done;
    rows_of(e, {.line = {}, .progress = [&](std::string_view task, Index now, Index total, double) {
                  CHECK(std::this_thread::get_id() == caller);
                  CHECK(task == "features of numbers");
                  CHECK(total == 100);
                  done.push_back(now);
                }});
    REQUIRE(!done.empty());
    CHECK(std::is_sorted(done.begin(), done.end()));
    CHECK(done.back() == 100);
    CHECK(std::count(done.begin(), done.end(), 100) == 1);
  });
}

TEST_CASE("if progress throws, rows of the first inputs are kept, and the work goes on from them") {
  for_threads([](Index memory) {
    Extraction e = numbers(400);
    e.memory = [memory](Index) { return memory; };
    struct Stop {};
    std::vector<float> kept;
    e.keep = [&](std::span<const float> rows) { kept.assign(rows.begin(), rows.end()); };
    CHECK_THROWS_AS(rows_of(e, {.line = {},
                                .progress =
                                    [](std::string_view, Index done, Index, double) {
                                      if (done > 0) throw Stop{};
                                    }}),
                    Stop);
    const auto inputs = static_cast<Index>(kept.size()) / kDimension;
    REQUIRE(inputs > 0);
    REQUIRE(inputs <= 400);  // all, if the calling thread had no batch before the others took the last one
    CHECK(kept == all_rows(inputs));
    e.made = kept;
    std::atomic<bool> again = false;
    const auto plain = e.prepared;
    e.prepared = [&](Index begin, Index end, Parallel& parallel) {
      if (begin < inputs) again = true;
      return plain(begin, end, parallel);
    };
    CHECK(rows_of(e) == all_rows(400));
    CHECK_FALSE(again);
  });
}
