#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace svnet::io::hdf5 {

/// What is read of a file, and the order of what answers it:
///   has, is_group, has_attribute   truth
///   members                        texts
///   shape                          shape
///   dataset, attribute, list       shape, then values or texts; `attribute` has exactly one
enum class Ask : std::uint32_t { has, is_group, has_attribute, members, shape, dataset, attribute, list };

/// As what values are read.
enum class As : std::uint32_t { real32, real64, signed64, unsigned64, text };

struct Request {
  Ask ask = Ask::has;
  As as = As::text;
  std::string object{};
  std::string attribute{};
};

/// Takes an answer, piece by piece.
class Sink {
 public:
  virtual ~Sink() = default;

  virtual void truth(bool) = 0;
  virtual void shape(std::span<const std::uint64_t>) = 0;
  virtual void texts(std::span<const std::string>) = 0;
  /// Whole values of the type that was asked for. Fastest if they lie at the start of `room`.
  virtual void values(std::span<const std::byte>) = 0;
  /// Memory for the next values; a multiple of 8 bytes.
  virtual std::span<std::byte> room() = 0;
};

}  // namespace svnet::io::hdf5
