#pragma once
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <span>
#include <string>
#include <string_view>

#include "base/error.h"

// What every target is made of. A target is a function of the bytes of one input that hands them to a reader:
//   SVNET_FUZZ_TARGET(camera) { accept([&] { io::read_camera(MemoryFile(input).path()); }); }
// With SVNET_FUZZER it is the entry point of libFuzzer, one program per target. Otherwise replay.cpp finds it by its
// name.
namespace svnet::fuzz {

using Bytes = std::span<const std::uint8_t>;
using Target = void (*)(Bytes input);

inline std::string_view text_of(Bytes input) { return {reinterpret_cast<const char*>(input.data()), input.size()}; }

/// Ends the process, which libFuzzer and ctest count as a finding.
[[noreturn]] inline void report(std::string_view what) {
  std::cerr << "finding: " << what << std::endl;
  std::abort();
}

/// Errors are one line of printable text, whatever the file holds.
inline void check_message(std::string_view message) {
  for (const char c : message)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      report("an Error with a control character: " + std::string(message));
}

/// Runs a reader. It may return or throw svnet::Error; any other exception ends the process.
template <class Read>
void accept(const Read& read) {
  try {
    read();
  } catch (const Error& error) {
    check_message(error.what());
  } catch (const std::exception& error) {
    report(std::string("an exception that is no Error: ") + error.what());
  }
}

/// Adds a target to those that replay.cpp runs.
struct Registration {
  Registration(const char* name, Target target);
};

}  // namespace svnet::fuzz

#ifdef SVNET_FUZZER
#define SVNET_FUZZ_ENTRY(name)                                                        \
  extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) { \
    fuzz_##name({data, size});                                                        \
    return 0;                                                                         \
  }
#else
#define SVNET_FUZZ_ENTRY(name) static const svnet::fuzz::Registration registration_##name(#name, fuzz_##name);
#endif

#define SVNET_FUZZ_TARGET(name)                      \
  static void fuzz_##name(svnet::fuzz::Bytes input); \
  SVNET_FUZZ_ENTRY(name)                             \
  static void fuzz_##name(svnet::fuzz::Bytes input)
