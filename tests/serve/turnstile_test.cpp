#include "serve/turnstile.h"

#include <atomic>
#include <thread>
#include <vector>

#include "serve/requests.h"

using namespace svnet::serve;
using namespace std::chrono_literals;

TEST_CASE("a turnstile that is full refuses at once, or at the deadline") {
  Turnstile none(1, 0);
  const auto inside = none.enter(Clock::now());
  CHECK(refusal_of([&] { (void)none.enter(Clock::now() + 10s); }) == "503 the server is busy; try again");
  Turnstile one(1, 1);
  const auto first = one.enter(Clock::now());
  const auto begin = Clock::now();
  CHECK(refusal_of([&] { (void)one.enter(begin + 50ms); }) == "503 the server is busy; try again");
  CHECK(Clock::now() - begin >= 50ms);
}

TEST_CASE("a turnstile counts weights") {
  Turnstile turnstile(10, 0);
  const auto first = turnstile.enter(Clock::now(), 7);
  CHECK_THAT(refusal_of([&] { (void)turnstile.enter(Clock::now(), 4); }), Catch::StartsWith("503 "));
  {
    const auto second = turnstile.enter(Clock::now(), 3);
    CHECK_THAT(refusal_of([&] { (void)turnstile.enter(Clock::now(), 1); }), Catch::StartsWith("503 "));
  }
  CHECK(refusal_of([&] { (void)turnstile.enter(Clock::now(), 3); }) == "");
}

TEST_CASE("a turnstile lets no more through than it says, and all in the end") {
  Turnstile turnstile(2, 30);
  std::atomic<int> inside = 0, most = 0, done = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < 20; ++i)
    threads.emplace_back([&] {
      for (int k = 0; k < 20; ++k) {
        const auto turn = turnstile.enter(Clock::now() + 60s);
        const int now = ++inside;
        for (int before = most; before < now && !most.compare_exchange_weak(before, now);) {
        }
        std::this_thread::yield();
        --inside;
        ++done;
      }
    });
  for (std::thread& thread : threads) thread.join();
  CHECK(done == 400);
  CHECK(most <= 2);
}
