#include "sandbox/child.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <mutex>
#include <new>
#include <system_error>
#include <utility>

#include <sys/wait.h>
#include <unistd.h>

#include "base/text.h"

namespace svnet::sandbox {
namespace {

constexpr const char* kWhose = "the file is damaged or was made to attack, and nothing outside its process was touched";

enum OwnKind : std::uint32_t { kReady = Channel::kFirstOwnKind + 1, kNoSandbox, kFailed, kNoMemory };

void send_text(Channel& channel, std::uint32_t kind, std::string_view text) {
  constexpr std::size_t kMostText = 4000;
  channel.send(kind, bytes_of(text.substr(0, kMostText)));
}

std::string line_of(const Message& message) { return printable(text_of(message.bytes)); }

/// The life of the child. Nothing of the parent's is cleaned up in it: its destructors and exit handlers never run.
[[noreturn]] void live(Channel& channel, std::span<const int> kept, const Limits& limits,
                       const std::function<void(Channel&)>& body) noexcept {
  try {
    try {
      if (const std::string refused = confine_this_process(kept, limits); !refused.empty()) {
        send_text(channel, kNoSandbox, refused);
        ::_exit(0);
      }
      channel.send(kReady, {});
      body(channel);
    } catch (const Error& error) {
      send_text(channel, kFailed, error.what());
    } catch (const std::bad_alloc&) {
      channel.send(kNoMemory, {});
    }
  } catch (...) {  // the parent is gone
  }
  ::_exit(0);
}

std::string status_text(int status, const Limits& limits) {
  if (WIFSIGNALED(status)) {
    const int number = WTERMSIG(status);
    if (number == SIGKILL) return "was killed; is there enough memory?";
    if (number == SIGXCPU)
      return joined("took more than ", limits.processor_time.count(), " s of processor time, and was stopped");
    if (number == SIGSYS) return "tried to start a program or to open a connection, and was stopped";
    return joined("crashed (", ::strsignal(number), ")");
  }
  return "ended without an answer";
}

}  // namespace

Process::~Process() {
  if (id_ <= 0) return;
  ::kill(id_, SIGKILL);
  wait();
}

std::optional<int> Process::wait() {
  int status = 0;
  pid_t ended = -1;
  do ended = ::waitpid(id_, &status, 0);
  while (ended < 0 && errno == EINTR);
  id_ = -1;
  return ended < 0 ? std::nullopt : std::optional(status);
}

Child::Child(Task task, std::span<const int> descriptors, const Limits& limits,
             const std::function<void(Channel&)>& body)
    : task_(std::move(task)), limits_(limits) {
  const auto refuse = [&](const std::string& why) {
    fail(task_.file, ": ", task_.decoder, " reads it in a process that can do nothing else, and there can be no such ",
         "process here (", why, "); --sandbox off reads files that you trust without it");
  };
  auto [here, there] = Channel::socket_pair();
  {
    // One at a time, so that no child shares the memory of another one's channel.
    static std::mutex only_one;
    const std::lock_guard lock(only_one);
    bulk_ = std::make_unique<Bulk>();
    Channel channel(std::move(there), *bulk_, std::nullopt);
    std::vector<int> kept(descriptors.begin(), descriptors.end());
    kept.push_back(channel.number());
    process_ = Process(::fork());
    if (process_.is_this()) live(channel, kept, limits, body);
    bulk_->keep_from_later_processes();
  }
  channel_ = std::make_unique<Channel>(std::move(here), *bulk_, limits.answer_time);
  if (!process_.exists()) refuse("fork: " + std::generic_category().message(errno));
  try {
    const Message first = channel_->receive();
    if (first.kind == kNoSandbox) refuse(line_of(first));
    if (first.kind == kNoMemory) fail_memory();
    if (first.kind != kReady) refuse_answer();
  } catch (const ChannelClosed& closed) {
    fail_closed(closed);
  }
}

Child::~Child() = default;

void Child::send(std::uint32_t kind, std::span<const std::byte> bytes, int descriptor) {
  try {
    channel_->send(kind, bytes, descriptor);
  } catch (const ChannelClosed&) {  // `receive` says why the child ended
  }
}

Message Child::receive() {
  try {
    Message message = channel_->receive();
    if (message.kind == kFailed) fail_as_child(line_of(message));
    if (message.kind == kNoMemory) fail_memory();
    if (message.kind >= Channel::kFirstOwnKind) refuse_answer();
    return message;
  } catch (const ChannelClosed& closed) {
    fail_closed(closed);
  }
}

void Child::refuse_answer() const {
  fail(task_.file, ": ", task_.decoder, " gave an answer that makes no sense; ", kWhose);
}

void Child::fail_as_child(const std::string& text) const {
  // Whatever the child says, the line begins with the file.
  const bool names_file = text.starts_with(task_.file);
  fail(names_file ? "" : task_.file + ": ", text);
}

void Child::fail_memory() const {
  fail(task_.file, ": ", task_.decoder, " needs more than ", limits_.memory_bytes >> 20, " MiB of memory for it; ",
       kWhose);
}

void Child::fail_closed(const ChannelClosed& closed) {
  switch (closed.why) {
    case ChannelClosed::Why::broken:
      refuse_answer();
    case ChannelClosed::Why::late:
      fail(task_.file, ": ", task_.decoder, " took more than ", limits_.answer_time.count(), " s; ", kWhose);
    case ChannelClosed::Why::gone:
      break;
  }
  const std::optional<int> status = process_.exists() ? process_.wait() : std::nullopt;
  fail(task_.file, ": ", task_.decoder, " ", status ? status_text(*status, limits_) : "ended", "; ", kWhose);
}

}  // namespace svnet::sandbox
