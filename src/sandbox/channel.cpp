#include "sandbox/channel.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include <poll.h>
#include <sys/mman.h>
#include <sys/socket.h>

namespace svnet::sandbox {
namespace {

constexpr std::uint32_t kRoomIsFree = Channel::kFirstOwnKind;

using Control = std::array<char, CMSG_SPACE(sizeof(int))>;

void attach(msghdr& message, Control& control, int descriptor) {
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  cmsghdr* header = CMSG_FIRSTHDR(&message);
  header->cmsg_level = SOL_SOCKET;
  header->cmsg_type = SCM_RIGHTS;
  header->cmsg_len = CMSG_LEN(sizeof(int));
  std::memcpy(CMSG_DATA(header), &descriptor, sizeof descriptor);
}

void detach(msghdr& message, Descriptor& descriptor) {
  for (cmsghdr* header = CMSG_FIRSTHDR(&message); header != nullptr; header = CMSG_NXTHDR(&message, header)) {
    if (header->cmsg_level != SOL_SOCKET || header->cmsg_type != SCM_RIGHTS) continue;
    int number = -1;
    std::memcpy(&number, CMSG_DATA(header), sizeof number);
    descriptor = Descriptor(number);
  }
}

}  // namespace

Bulk::Bulk() : memory_(nullptr) {
  void* memory = ::mmap(nullptr, 2 * kRoomBytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  check(memory != MAP_FAILED, "no memory to share with another process: ", std::generic_category().message(errno));
  memory_ = static_cast<std::byte*>(memory);
}
Bulk::~Bulk() { ::munmap(memory_, 2 * kRoomBytes); }

void Bulk::keep_from_later_processes() { ::madvise(memory_, 2 * kRoomBytes, MADV_DONTFORK); }

std::array<Descriptor, 2> Channel::socket_pair() {
  int ends[2];
  check(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) == 0,
        "no sockets between two processes: ", std::generic_category().message(errno));
  return {Descriptor(ends[0]), Descriptor(ends[1])};
}

void Channel::send(std::uint32_t kind, std::span<const std::byte> bytes, int descriptor) {
  check(bytes.size() <= kMostMessageBytes, "a message between two processes has ", bytes.size(), " bytes");
  const Header header{kind, 0, bytes.size()};
  send_whole(bytes_of(header), descriptor);
  send_whole(bytes, -1);
}

std::span<std::byte> Channel::room() {
  while (free_rooms_ == 0) {
    Descriptor none;
    const Header header = receive_header(&none);
    if (header.kind != kRoomIsFree || header.size != 0) throw ChannelClosed(ChannelClosed::Why::broken);
    ++free_rooms_;
  }
  return bulk_.room(sent_rooms_);
}

void Channel::send_room(std::uint32_t kind, std::size_t size) {
  const Header header{kind, 1, size};
  --free_rooms_;
  ++sent_rooms_;
  send_whole(bytes_of(header), -1);
}

Message Channel::receive() {
  if (patience_) deadline_ = std::chrono::steady_clock::now() + *patience_;
  if (std::exchange(room_is_in_use_, false)) {
    try {
      send(kRoomIsFree, {});
    } catch (const ChannelClosed&) {  // what the other end sent before it ended can still be read
    }
  }
  for (;;) {
    Message message;
    const Header header = receive_header(&message.descriptor);
    message.kind = header.kind;
    if (header.kind == kRoomIsFree) {
      if (header.size != 0) throw ChannelClosed(ChannelClosed::Why::broken);
      ++free_rooms_;
      continue;
    }
    if (header.is_bulk != 0) {
      if (header.size > Bulk::kRoomBytes) throw ChannelClosed(ChannelClosed::Why::broken);
      room_is_in_use_ = true;
      message.bytes = bulk_.room(received_rooms_++).first(header.size);
    } else {
      if (header.size > kMostMessageBytes) throw ChannelClosed(ChannelClosed::Why::broken);
      received_.resize(header.size);
      receive_whole(received_, nullptr);
      message.bytes = received_;
    }
    return message;
  }
}

Channel::Header Channel::receive_header(Descriptor* descriptor) {
  Header header{};
  receive_whole(std::as_writable_bytes(std::span(&header, 1)), descriptor);
  return header;
}

void Channel::send_whole(std::span<const std::byte> bytes, int descriptor) {
  while (!bytes.empty()) {
    iovec part{const_cast<std::byte*>(bytes.data()), bytes.size()};
    msghdr message{};
    message.msg_iov = &part;
    message.msg_iovlen = 1;
    Control control{};
    if (descriptor >= 0) attach(message, control, descriptor);
    const ssize_t sent = ::sendmsg(socket_.number(), &message, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) throw ChannelClosed(ChannelClosed::Why::gone);
    descriptor = -1;
    bytes = bytes.subspan(static_cast<std::size_t>(sent));
  }
}

void Channel::wait_until_readable() {
  for (;;) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(deadline_ - std::chrono::steady_clock::now()).count();
    if (left <= 0) throw ChannelClosed(ChannelClosed::Why::late);
    pollfd waited{socket_.number(), POLLIN, 0};
    if (::poll(&waited, 1, static_cast<int>(std::min<std::int64_t>(left, 60'000))) > 0) return;
  }
}

void Channel::receive_whole(std::span<std::byte> bytes, Descriptor* descriptor) {
  while (!bytes.empty()) {
    if (patience_) wait_until_readable();
    iovec part{bytes.data(), bytes.size()};
    msghdr message{};
    message.msg_iov = &part;
    message.msg_iovlen = 1;
    Control control{};
    if (descriptor != nullptr) {
      message.msg_control = control.data();
      message.msg_controllen = control.size();
    }
    const ssize_t got = ::recvmsg(socket_.number(), &message, MSG_CMSG_CLOEXEC);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) throw ChannelClosed(ChannelClosed::Why::gone);
    if (descriptor != nullptr) detach(message, *descriptor);
    bytes = bytes.subspan(static_cast<std::size_t>(got));
  }
}

}  // namespace svnet::sandbox
