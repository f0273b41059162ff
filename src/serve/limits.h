#pragma once
#include <cstddef>

#include "base/index.h"

namespace svnet::serve {

/// What a server accepts. Memory is bounded by kBodies bodies of the largest size, and `parallel` images of kMostPixels
/// with what is computed from them.
struct Limits {
  std::size_t body_bytes = std::size_t{32} << 20;
  std::size_t header_bytes = std::size_t{16} << 10;  // the request line and all headers
  Index poses = 4096;                                // of one request
  double seconds = 30;                               // to read a request, to wait for its turn, and to write the answer
  double header_seconds = 10;                        // to read the request line and headers
  Index parallel = 2;                                // predictions at the same time
  Index waiting = 64;                                // predictions that wait for their turn
  Index connections = 128;
};

/// The bodies in memory have at most as many bytes as this number of the largest ones.
constexpr std::size_t kBodies = 8;

}  // namespace svnet::serve
