#include <barrier>
#include <bit>
#include <catch2/catch.hpp>
#include <mutex>
#include <thread>

#include "base/communicator.h"
#include "nn/autograd.h"
#include "nn/numbers.h"
#include "nn/ops/dense.h"

using namespace svnet;
using namespace svnet::test;

namespace {

/// A communicator whose processes are threads of this one.
class Meeting {
 public:
  explicit Meeting(int members) : size(members), everybody(members) {}

  const int size;
  std::barrier<> everybody;
  std::mutex mutex{};
  std::vector<std::uint32_t> sums{};
};

class Member : public Communicator {
 public:
  Member(Meeting& meeting, int rank) : meeting_(meeting), rank_(rank) {}
  int rank() const override { return rank_; }
  int size() const override { return meeting_.size; }
  void all_reduce(std::span<std::uint64_t>) override { FAIL("not asked for by a dense layer"); }
  std::uint64_t broadcast(std::uint64_t value) override { return value; }

  void all_reduce(std::span<float> values) override {
    {
      std::lock_guard lock(meeting_.mutex);
      meeting_.sums.resize(values.size());
      for (std::size_t i = 0; i < values.size(); ++i) meeting_.sums[i] += std::bit_cast<std::uint32_t>(values[i]);
    }
    meeting_.everybody.arrive_and_wait();
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = std::bit_cast<float>(meeting_.sums[i]);
    meeting_.everybody.arrive_and_wait();
    if (rank_ == 0) meeting_.sums.clear();
    meeting_.everybody.arrive_and_wait();
  }

 private:
  Meeting& meeting_;
  int rank_;
};

struct Made {
  Tensor y, dx, dw;
};

Made made(const Tensor& x, const Tensor& w, const Tensor& dy, Communicator* communicator) {
  const Tensor x_leaf = x.as_parameter(), w_leaf = w.as_parameter();
  const Tensor y = ops::dense(x_leaf, w_leaf, communicator);
  autograd::GradientMap gradients;
  autograd::backward(y, gradients, dy);
  return {y, gradients.of(x_leaf), gradients.of(w_leaf)};
}

}  // namespace

TEST_CASE("several processes give a dense layer's output and gradients with the bits of one process") {
  struct Sizes {
    Index m, c, k;
  };
  // Few rows (streamed), more rows (tiles of columns), many rows (tiles of rows), and fewer tiles than processes.
  const auto [m, c, k] = GENERATE(Sizes{5, 130, 700}, Sizes{70, 90, 1100}, Sizes{800, 70, 33}, Sizes{3, 200, 1});
  const Tensor x = random_tensor({m, c}, 1, DType::f32), w = random_tensor({c, k}, 2, DType::f32),
               dy = random_tensor({m, k}, 3, DType::f32);
  const Made alone = made(x, w, dy, nullptr);
  for (const int size : {1, 2, 3}) {
    Meeting meeting(size);
    std::vector<Made> all(static_cast<std::size_t>(size));
    std::vector<std::thread> threads;
    for (int rank = 0; rank < size; ++rank)
      threads.emplace_back([&, rank] {
        Member member(meeting, rank);
        all[static_cast<std::size_t>(rank)] = made(x, w, dy, &member);
      });
    for (auto& thread : threads) thread.join();
    for (const Made& one : all) {
      CHECK(same_bits(one.y, alone.y));
      CHECK(same_bits(one.dx, alone.dx));
      CHECK(same_bits(one.dw, alone.dw));
    }
  }
}
