#include "io/models/built_in_weights.h"

// The assembler puts the file into the program, which so needs no other file, wherever it is installed.
__asm__(
    ".pushsection .rodata\n"
    ".balign 64\n"
    "svnet_tiny_xception_begin:\n"
    ".incbin \"" TINY_XCEPTION_WEIGHTS
    "\"\n"
    "svnet_tiny_xception_end:\n"
    ".popsection\n");

extern "C" {
[[gnu::visibility("hidden")]] extern const std::byte svnet_tiny_xception_begin[];
[[gnu::visibility("hidden")]] extern const std::byte svnet_tiny_xception_end[];
}

namespace svnet::io {

std::span<const std::byte> built_in_weights(const std::string& backbone) {
  if (backbone != "tiny_xception") return {};
  return {svnet_tiny_xception_begin, svnet_tiny_xception_end};
}

}  // namespace svnet::io
