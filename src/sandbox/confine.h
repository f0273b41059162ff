#pragma once
#include <chrono>
#include <cstdint>
#include <span>
#include <string>

namespace svnet::sandbox {

/// What a child may use. Under the sanitizers of address and thread, which reserve terabytes, memory has no limit.
struct Limits {
  std::uint64_t memory_bytes = std::uint64_t{256} << 20;  // besides what the process has when the child begins
  std::chrono::seconds processor_time{10};
  std::chrono::seconds answer_time{60};  // how long the parent waits for a message
};

/// Gives up everything but memory and the descriptors `kept`: all others are closed, signals have their default
/// effects, and syscall_filter.h holds from now on. For the only thread of a child process. Returns what the system
/// refuses, or an empty text.
std::string confine_this_process(std::span<const int> kept, const Limits& limits);

}  // namespace svnet::sandbox
