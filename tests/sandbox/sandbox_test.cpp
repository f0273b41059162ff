// What a child process can do, and what becomes of one that tries more.
#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <thread>

#include <fcntl.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/error.h"
#include "sandbox/child.h"
#include "sandbox/mode.h"
#include "temporary_folder.h"

using namespace svnet;
using namespace svnet::sandbox;
using Catch::Contains;

namespace {

constexpr std::uint32_t kResult = 1;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

void send_number(Channel& channel, int number) { channel.send(kResult, std::as_bytes(std::span(&number, 1))); }

/// What the child's function returned: 0, or the number of its error.
int result_of(const std::function<int()>& body, std::span<const int> descriptors = {}) {
  Child child({"a.file", "the test"}, descriptors, {}, [&](Channel& channel) {
    errno = 0;
    const int result = body();
    send_number(channel, result < 0 ? errno : 0);
  });
  const Message message = child.receive();
  int number = -1;
  REQUIRE(message.bytes.size() == sizeof number);
  std::memcpy(&number, message.bytes.data(), sizeof number);
  return number;
}

std::string failure_of(const std::function<void(Channel&)>& body, Limits limits = {}) {
  try {
    Child child({"a.file", "the test"}, {}, limits, body);
    child.receive();
  } catch (const Error& error) {
    const std::string text = error.what();
    CHECK(text.find('\n') == std::string::npos);
    return text;
  }
  return "no failure";
}

}  // namespace

TEST_CASE("a child opens no file, and changes none") {
  const TemporaryFolder folder;
  const std::string file = folder.write("file", "contents");
  CHECK(result_of([&] { return ::open(file.c_str(), O_RDONLY); }) == EPERM);
  CHECK(result_of([&] { return ::open((folder.path() / "new").c_str(), O_CREAT | O_WRONLY, 0600); }) == EPERM);
  CHECK(result_of([&] { return ::unlink(file.c_str()); }) == EPERM);
  CHECK(result_of([&] { return ::mkdir((folder.path() / "new").c_str(), 0700); }) == EPERM);
  CHECK(result_of([&] { return ::rename(file.c_str(), (file + "2").c_str()); }) == EPERM);
  CHECK(file_contents(file) == "contents");
  CHECK_FALSE(std::filesystem::exists(folder.path() / "new"));
}

TEST_CASE("a child reads the descriptor that it was given, and no other") {
  const TemporaryFolder folder;
  const Descriptor given(::open(folder.write("given", "contents").c_str(), O_RDONLY)),
      other(::open(folder.write("other", "secret").c_str(), O_RDWR));
  const int numbers[] = {given.number()};
  char text[9] = "";
  CHECK(result_of([&] { return ::pread(given.number(), text, 8, 0) == 8 ? 0 : -1; }, numbers) == 0);
  CHECK(result_of([&] { return static_cast<int>(::pread(other.number(), text, 8, 0)); }, numbers) == EBADF);
  CHECK(result_of([&] { return static_cast<int>(::write(given.number(), text, 8)); }, numbers) == EBADF);
  CHECK(result_of([&] { return static_cast<int>(::write(STDOUT_FILENO, "x", 1)); }, numbers) == EBADF);
}

TEST_CASE("a child has no memory that can be executed") {
  CHECK(result_of([] {
          return ::mmap(nullptr, 4096, PROT_READ | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) == MAP_FAILED ? -1
                                                                                                                : 0;
        }) == EPERM);
}

TEST_CASE("a child that wants a connection or a program is stopped") {
  CHECK(failure_of([](Channel&) { ::socket(AF_INET, SOCK_STREAM, 0); }) ==
        "a.file: the test tried to start a program or to open a connection, and was stopped; the file is damaged or "
        "was made to attack, and nothing outside its process was touched");
  CHECK_THAT(failure_of([](Channel&) { ::execl("/bin/true", "true", nullptr); }), Contains("tried to start a program"));
}

TEST_CASE("a child that crashes is an error") {
  CHECK_THAT(failure_of([](Channel&) { std::abort(); }), Contains("a.file: the test crashed (Aborted)"));
  CHECK_THAT(failure_of([](Channel&) { ::_exit(3); }), Contains("a.file: the test ended without an answer"));
  if (!kSanitized) CHECK_THAT(failure_of([](Channel&) { ::raise(SIGSEGV); }), Contains("crashed (Segmentation fault)"));
}

TEST_CASE("a child that throws has its text") {
  CHECK(failure_of([](Channel&) { fail("a.file: 'x': is missing"); }) == "a.file: 'x': is missing");
  CHECK(failure_of([](Channel&) { fail("two\nlines"); }) == "a.file: two lines");
}

TEST_CASE("a child is stopped at its limits") {
  Limits limits;
  SECTION("of processor time") {
    limits.processor_time = std::chrono::seconds(1);
    const auto spin = [](Channel&) {
      for (volatile bool run = true; run;) {
      }
    };
    CHECK_THAT(failure_of(spin, limits), Contains("took more than 1 s of processor time"));
  }
  SECTION("of waiting") {
    limits.answer_time = std::chrono::seconds(1);
    CHECK_THAT(failure_of([](Channel& channel) { channel.receive(); }, limits), Contains("took more than 1 s; "));
  }
  SECTION("of memory") {
    if (kSanitized) return;
    limits.memory_bytes = 64 << 20;
    const auto take = [](Channel&) { std::vector<char>(80 << 20, 'x').back() = 'y'; };
    CHECK_THAT(failure_of(take, limits), Contains("needs more than 64 MiB of memory"));
  }
}

TEST_CASE("messages and bulk arrive intact") {
  constexpr std::size_t kCount = 5'000'000;
  Child child({"a.file", "the test"}, {}, {}, [](Channel& channel) {
    for (std::uint32_t number = 0; number < kCount;) {
      const std::span<std::byte> room = channel.room();
      std::size_t size = 0;
      for (; size < room.size() && number < kCount; size += sizeof number, ++number)
        std::memcpy(room.data() + size, &number, sizeof number);
      channel.send_room(kResult, size);
    }
    const Message asked = channel.receive();
    channel.send(asked.kind + 1, asked.bytes);
  });
  std::vector<std::uint32_t> numbers;
  while (numbers.size() < kCount) {
    const Message message = child.receive();
    REQUIRE(message.kind == kResult);
    const std::size_t before = numbers.size();
    numbers.resize(before + message.bytes.size() / 4);
    std::memcpy(numbers.data() + before, message.bytes.data(), message.bytes.size());
  }
  bool same = true;
  for (std::uint32_t i = 0; i < kCount; ++i) same = same && numbers[i] == i;
  CHECK(same);
  child.send(7, std::as_bytes(std::span("again", 5)));
  const Message answer = child.receive();
  CHECK(answer.kind == 8);
  CHECK(std::memcmp(answer.bytes.data(), "again", 5) == 0);
}

TEST_CASE("a child has no part in what others share with this process") {
  if (kSanitized) return;
  Child first({"a.file", "the test"}, {}, {}, [](Channel& channel) {
    channel.room()[0] = std::byte{7};
    channel.send_room(kResult, 1);
    channel.receive();
  });
  const Message message = first.receive();
  auto* shared = const_cast<std::byte*>(message.bytes.data());
  REQUIRE(*shared == std::byte{7});
  CHECK_THAT(failure_of([&](Channel&) { *shared = std::byte{8}; }), Contains("crashed"));
  CHECK(*shared == std::byte{7});
}

TEST_CASE("children of several threads") {
  std::vector<std::thread> threads;
  std::atomic<int> right{0};
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      for (int i = 0; i < 20; ++i) {
        const int sent = 100 * t + i;
        Child child({"a.file", "the test"}, {}, {}, [&](Channel& channel) {
          const std::vector<int> copies(10'000, sent);  // memory is allocated while other threads do too
          send_number(channel, copies.back());
        });
        int number = -1;
        std::memcpy(&number, child.receive().bytes.data(), sizeof number);
        right += number == sent ? 1 : 0;
      }
    });
  for (std::thread& thread : threads) thread.join();
  CHECK(right == 80);
}

TEST_CASE("descriptors are passed on") {
  const TemporaryFolder folder;
  const Descriptor file(::open(folder.write("file", "contents").c_str(), O_RDONLY));
  Child child({"a.file", "the test"}, {}, {}, [](Channel& channel) {
    const Message message = channel.receive();
    char text[8];
    const ssize_t got = ::pread(message.descriptor.number(), text, sizeof text, 0);
    channel.send(kResult, std::as_bytes(std::span(text, got > 0 ? static_cast<std::size_t>(got) : 0)));
  });
  child.send(1, {}, file.number());
  CHECK(child.receive().bytes.size() == 8);
}

TEST_CASE("an answer that breaks the protocol is refused") {
  const auto lie = [](Channel& channel) {
    const std::uint64_t header[2] = {1, std::uint64_t{1} << 40};
    if (::write(channel.number(), header, sizeof header) < 0) return;
    channel.receive();
  };
  CHECK_THAT(failure_of(lie), Contains("a.file: the test gave an answer that makes no sense"));
}

TEST_CASE("where the system has no such processes, the error says what to do") {
  // A process that may not install filters, as in some containers.
  int ends[2];
  REQUIRE(::pipe(ends) == 0);
  const pid_t process = ::fork();
  if (process == 0) {
    sock_filter refuse_seccomp[] = {BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
                                    BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_prctl, 0, 3),
                                    BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, args)),
                                    BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, PR_SET_SECCOMP, 0, 1),
                                    BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EINVAL),
                                    BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW)};
    const sock_fprog program{std::size(refuse_seccomp), refuse_seccomp};
    ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
    ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program, 0, 0);
    const std::string text = failure_of([](Channel&) {});
    if (::write(ends[1], text.data(), text.size()) < 0) ::_exit(1);
    ::_exit(0);
  }
  ::close(ends[1]);
  char text[1000] = "";
  CHECK(::read(ends[0], text, sizeof text - 1) > 0);
  ::close(ends[0]);
  ::waitpid(process, nullptr, 0);
  CHECK(text ==
        std::string("a.file: the test reads it in a process that can do nothing else, and there can be no such "
                    "process here (seccomp: Invalid argument); --sandbox off reads files that you trust without "
                    "it"));
}

TEST_CASE("the sandbox is on, until it is switched off") {
  CHECK(mode() == Mode::on);
  set_mode(Mode::off);
  CHECK(mode() == Mode::off);
  set_mode(Mode::on);
}
