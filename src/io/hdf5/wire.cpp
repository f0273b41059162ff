#include "io/hdf5/wire.h"

#include <algorithm>
#include <cstring>
#include <vector>

#include "base/text.h"
#include "io/hdf5/limits.h"

namespace svnet::io::hdf5 {
namespace {

enum MessageKind : std::uint32_t { kRequest, kTruth, kShape, kTextPart, kTextEnd, kTexts, kValues, kEnd, kError };

using sandbox::bytes_of;
using sandbox::text_of;

struct RequestHead {
  Ask ask;
  As as;
  std::uint64_t object_bytes;
};

/// Strings that are shorter than this travel together.
constexpr std::size_t kShort = 4096;

}  // namespace

void ChannelSink::truth(bool value) { channel_.send(kTruth, bytes_of(static_cast<unsigned char>(value))); }
void ChannelSink::shape(std::span<const std::uint64_t> shape) { channel_.send(kShape, std::as_bytes(shape)); }

/// Short strings travel together, each with a NUL at its end; long ones in parts.
void ChannelSink::texts(std::span<const std::string> texts) {
  std::string together;
  const auto send_together = [&] {
    if (!together.empty()) channel_.send(kTexts, bytes_of(together));
    together.clear();
  };
  for (const std::string& text : texts) {
    if (text.size() < kShort) {
      together.append(text).push_back('\0');
      if (together.size() > sandbox::kMostMessageBytes - kShort) send_together();
      continue;
    }
    send_together();
    for (std::span<const std::byte> left = bytes_of(text); !left.empty();) {
      const auto part = left.first(std::min(left.size(), sandbox::kMostMessageBytes));
      channel_.send(kTextPart, part);
      left = left.subspan(part.size());
    }
    channel_.send(kTextEnd, {});
  }
  send_together();
}

void ChannelSink::values(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const std::span<std::byte> to = room();
    const std::size_t size = std::min(bytes.size(), to.size());
    if (to.data() != bytes.data()) std::memcpy(to.data(), bytes.data(), size);
    channel_.send_room(kValues, size);
    bytes = bytes.subspan(size);
  }
}

void ChannelSink::end() { channel_.send(kEnd, {}); }
void ChannelSink::error(const std::string& text) {
  constexpr std::size_t kMostText = 4000;
  channel_.send(kError, bytes_of(text).first(std::min(text.size(), kMostText)));
}

Request receive_request(sandbox::Channel& channel) {
  const sandbox::Message message = channel.receive();
  RequestHead head{};
  const auto broken = [] { throw sandbox::ChannelClosed(sandbox::ChannelClosed::Why::broken); };
  if (message.kind != kRequest || message.bytes.size() < sizeof head) broken();
  std::memcpy(&head, message.bytes.data(), sizeof head);
  const std::string names = text_of(message.bytes.subspan(sizeof head));
  if (head.object_bytes > names.size()) broken();
  return {head.ask, head.as, names.substr(0, head.object_bytes), names.substr(head.object_bytes)};
}

std::string ask(sandbox::Child& child, const Request& request, Sink& to) {
  const RequestHead head{request.ask, request.as, request.object.size()};
  child.send(kRequest, bytes_of(text_of(bytes_of(head)) + request.object + request.attribute));
  std::string long_text;
  for (;;) {
    const sandbox::Message message = child.receive();
    switch (message.kind) {
      case kTruth:
        to.truth(message.bytes.size() == 1 && message.bytes[0] != std::byte{0});
        break;
      case kShape: {
        std::vector<std::uint64_t> shape(message.bytes.size() / sizeof(std::uint64_t));
        if (!shape.empty()) std::memcpy(shape.data(), message.bytes.data(), shape.size() * sizeof(std::uint64_t));
        to.shape(shape);
        break;
      }
      case kTexts: {
        const std::string together = text_of(message.bytes);
        std::vector<std::string> texts;
        for (std::size_t begin = 0; begin < together.size(); begin += texts.back().size() + 1)
          texts.push_back(together.substr(begin, together.find('\0', begin) - begin));
        to.texts(texts);
        break;
      }
      case kTextPart:
        long_text += text_of(message.bytes);
        if (long_text.size() > kLargestText) child.refuse_answer();
        break;
      case kTextEnd:
        to.texts(std::span(&long_text, 1));
        long_text.clear();
        break;
      case kValues:
        to.values(message.bytes);
        break;
      case kEnd:
        return {};
      case kError:
        return printable(text_of(message.bytes));
      default:
        child.refuse_answer();
    }
  }
}

}  // namespace svnet::io::hdf5
