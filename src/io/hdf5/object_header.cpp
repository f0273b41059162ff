#include "io/hdf5/object_header.h"

#include <vector>

#include "io/hdf5/bytes.h"

namespace svnet::io::hdf5 {
namespace {

constexpr std::uint64_t kPrefix = 16;  // of a header: version, reserved, 2 messages, 4 references, 4 size, 4 padding
constexpr std::uint64_t kMessage = 8;  // of a message: 2 type, 2 size, flags, 3 reserved
constexpr unsigned kShared = 2;        // flag of messages that lie elsewhere

enum MessageType : std::uint64_t {
  kDataspace = 1,
  kDatatype = 3,
  kOldFillValue = 4,
  kFillValue = 5,
  kLayout = 8,
  kFilters = 11,
  kAttribute = 12,
  kContinuation = 16,
};

std::uint64_t padded(std::uint64_t size) { return (size + 7) / 8 * 8; }

/// The number of values of a dataspace, kLargestBytes + 1 if there are more.
std::uint64_t dataspace_count(Bytes& message) {
  const std::uint64_t version = message.number(1), rank = message.number(1), flags = message.number(1);
  const std::uint64_t type = message.number(1);
  if (version == 1) message.skip(4);
  std::uint64_t count = version == 2 && type == 2 ? 0 : 1;
  for (std::uint64_t i = 0; i < rank; ++i) {
    const std::uint64_t extent = message.number(8);
    count = extent > 0 && count > kLargestBytes / extent ? kLargestBytes + 1 : count * extent;
  }
  if (flags & 1) message.skip(8 * rank);
  return count;
}

std::uint64_t checked_datatype(Bytes& message, int depth = 0);

/// The members of an enumeration: base type, names that end with NUL, values.
void check_members(Bytes& message, std::uint64_t version, std::uint64_t members, std::uint64_t value_size, int depth) {
  if (checked_datatype(message, depth) != value_size) message.refuse();
  for (std::uint64_t i = 0; i < members; ++i) {
    std::uint64_t length = 1;
    while (message.number(1) != 0) ++length;
    if (version < 3) message.skip(padded(length) - length);
  }
  message.skip(members * value_size);
}

/// Skips a type and gives the size of its values. Compound types are refused: nothing that is read here has them, and
/// they are the hardest to decode.
std::uint64_t checked_datatype(Bytes& message, int depth) {
  enum { integer, real, time, text, bits, opaque, compound, reference, enumeration, sequence, array };
  const std::uint64_t first = message.number(1), version = first >> 4, flags = message.number(3);
  const std::uint64_t size = message.number(4);
  constexpr int kDeepest = 4;
  if (depth == kDeepest) message.refuse();
  const std::uint64_t type_class = first & 15;
  if (type_class == integer || type_class == bits) {
    message.skip(4);
  } else if (type_class == real) {
    message.skip(12);
  } else if (type_class == time) {
    message.skip(2);
  } else if (type_class == opaque) {
    message.skip(flags & 255);
  } else if (type_class == enumeration) {
    check_members(message, version, flags & 65535, size, depth + 1);
  } else if (type_class == sequence) {
    checked_datatype(message, depth + 1);
  } else if (type_class == array) {
    const std::uint64_t rank = message.number(1);
    message.skip(version >= 3 ? 4 * rank : 3 + 8 * rank);
    checked_datatype(message, depth + 1);
  } else if (type_class != text && type_class != reference) {
    message.refuse();
  }
  return size;
}

void check_attribute(Bytes message) {
  const std::uint64_t version = message.number(1), flags = message.number(1);
  const std::uint64_t name = message.number(2), type = message.number(2), space = message.number(2);
  if (version >= 2 && flags != 0) return;  // type or dataspace lie elsewhere
  if (version < 2 && flags != 0) message.refuse();
  if (version == 3) message.skip(1);
  const bool pads = version == 1;
  message.skip(pads ? padded(name) : name);
  Bytes datatype = message.part(pads ? padded(type) : type);
  const std::uint64_t element = checked_datatype(datatype);
  Bytes dataspace = message.part(pads ? padded(space) : space);
  const std::uint64_t count = dataspace_count(dataspace);
  if (element > 0 && count > kLargestBytes / element) message.refuse();
  message.skip(count * element);
}

void check_fill_value(Bytes message) {
  const std::uint64_t version = message.number(1), flags = message.number(1);
  if (version >= 3) {
    if (flags & 0x20) message.skip(message.number(4));
    return;
  }
  message.skip(1);
  const bool defined = message.number(1) != 0;
  if (version == 1 || defined) message.skip(message.number(4));
}

void check_layout(Bytes message) {
  if (message.number(1) != 3) return;
  switch (message.number(1)) {
    case 0:
      message.skip(message.number(2));
      break;
    case 1:
      message.skip(16);
      break;
    case 2: {
      const std::uint64_t rank = message.number(1);
      message.skip(8 + 4 * rank);
      break;
    }
    default:
      break;
  }
}

void check_filters(Bytes message) {
  const std::uint64_t version = message.number(1), filters = message.number(1);
  if (version == 1) message.skip(6);
  for (std::uint64_t i = 0; i < filters; ++i) {
    const std::uint64_t filter = message.number(2);
    const std::uint64_t name = version == 1 || filter >= 256 ? message.number(2) : 0;
    message.skip(2);
    const std::uint64_t values = message.number(2);
    message.skip((version == 1 ? padded(name) : name) + 4 * values + (version == 1 && values % 2 == 1 ? 4 : 0));
  }
}

void check_message(std::uint64_t type, std::uint64_t flags, Bytes message) {
  const bool shared = (flags & kShared) != 0;
  switch (type) {
    case kDataspace:
      if (!shared) dataspace_count(message);
      break;
    case kDatatype:
      if (!shared) checked_datatype(message);
      break;
    case kOldFillValue:
      if (shared) message.refuse();
      message.skip(message.number(4));
      break;
    case kFillValue:
      if (shared) message.refuse();
      check_fill_value(message);
      break;
    case kLayout:
      check_layout(message);
      break;
    case kFilters:
      if (shared) message.refuse();
      check_filters(message);
      break;
    case kAttribute:
      if (shared) message.refuse();
      check_attribute(message);
      break;
    default:
      break;
  }
}

}  // namespace

void check_object_header(const File& file, std::uint64_t address, const std::string& where) {
  const std::string refusal =
      file.name + ": " + where + ": its header is damaged, or holds a compound type, which is not supported";
  const std::vector<char> start = file.bytes(address, kPrefix, where);
  Bytes prefix(start, refusal);
  if (prefix.number(1) != 1) return;  // version 2 begins with a signature
  prefix.skip(7);
  struct Block {
    std::uint64_t address, size;
  };
  std::vector<Block> blocks{{address + kPrefix, prefix.number(4)}};
  constexpr std::size_t kMostBlocks = 1000;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const std::vector<char> block = file.bytes(blocks[i].address, blocks[i].size, where);
    Bytes messages(block, refusal);
    while (messages.size() >= kMessage) {
      const std::uint64_t type = messages.number(2), size = messages.number(2), flags = messages.number(1);
      messages.skip(3);
      Bytes message = messages.part(size);
      if (type == kContinuation) {
        if (blocks.size() == kMostBlocks) message.refuse();
        const std::uint64_t next = message.number(8);
        blocks.push_back({next, message.number(8)});
      } else {
        check_message(type, flags, message);
      }
    }
  }
}

}  // namespace svnet::io::hdf5
