#pragma once
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/error.h"
#include "sandbox/descriptor.h"

namespace svnet::sandbox {

/// The other end of a channel is gone, breaks the protocol, or takes longer than the limit.
class ChannelClosed : public std::runtime_error {
 public:
  enum class Why { gone, broken, late };
  explicit ChannelClosed(Why reason) : std::runtime_error("the channel is closed"), why(reason) {}
  Why why;
};

/// Messages may be this long; bulk messages as long as a room (Bulk).
inline constexpr std::size_t kMostMessageBytes = std::size_t{1} << 20;

/// A message. Its bytes are valid until the next one is received from the channel.
struct Message {
  std::uint32_t kind = 0;
  std::span<const std::byte> bytes{};
  Descriptor descriptor{};  // of a file, if one came with it
};

/// Texts and the values of plain types as bytes, and back.
inline std::span<const std::byte> bytes_of(std::string_view text) { return std::as_bytes(std::span(text)); }
inline std::string text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}
template <class T>
requires(std::is_arithmetic_v<T> || std::is_aggregate_v<T>) std::span<const std::byte> bytes_of(const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  return std::as_bytes(std::span(&value, 1));
}

/// Memory that both ends share, in two rooms: while the parent copies one, the child fills the other.
class Bulk {
 public:
  static constexpr std::size_t kRoomBytes = std::size_t{1} << 20;

  /// Throws Error if there is no memory.
  Bulk();
  ~Bulk();
  Bulk(const Bulk&) = delete;
  Bulk& operator=(const Bulk&) = delete;

  /// Processes that are forked later do not have this memory.
  void keep_from_later_processes();

  std::span<std::byte> room(std::uint64_t number) { return {memory_ + number % 2 * kRoomBytes, kRoomBytes}; }

 private:
  std::byte* memory_;
};

/// One end of a connection between two processes. A message has a kind of the caller's, below kFirstOwnKind, and bytes.
/// Not thread-safe.
class Channel {
 public:
  static constexpr std::uint32_t kFirstOwnKind = 0xffffff00;

  /// `bulk` must outlive the channel. `patience`: how long `receive` waits; none: for ever.
  Channel(Descriptor socket, Bulk& bulk, std::optional<std::chrono::seconds> patience)
      : socket_(std::move(socket)), bulk_(bulk), patience_(patience) {}

  /// A pair of connected sockets, closed if another program is started. Throws Error if there is none.
  static std::array<Descriptor, 2> socket_pair();

  void send(std::uint32_t kind, std::span<const std::byte> bytes, int descriptor = -1);
  /// A bulk message: memory to be filled, and what sends the first `size` bytes of it. For one end only. `room` waits
  /// until the other end is done with what it held.
  std::span<std::byte> room();
  void send_room(std::uint32_t kind, std::size_t size);

  /// Throws ChannelClosed.
  Message receive();

  int number() const { return socket_.number(); }

 private:
  struct Header {
    std::uint32_t kind, is_bulk;
    std::uint64_t size;
  };
  void send_whole(std::span<const std::byte> bytes, int descriptor);
  void receive_whole(std::span<std::byte> bytes, Descriptor* descriptor);
  void wait_until_readable();
  Header receive_header(Descriptor* descriptor);

  Descriptor socket_;
  Bulk& bulk_;
  std::optional<std::chrono::seconds> patience_;
  std::chrono::steady_clock::time_point deadline_{};
  std::vector<std::byte> received_;
  std::uint64_t sent_rooms_ = 0, free_rooms_ = 2, received_rooms_ = 0;
  bool room_is_in_use_ = false;  // by the reader of the last message
};

}  // namespace svnet::sandbox
