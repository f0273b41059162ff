#include "io/events/event_file.h"

#include <bit>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <protozero/pbf_writer.hpp>
#include <system_error>

#include "base/error.h"
#include "base/crc32c.h"
#include "io/images/image_codecs.h"

namespace svnet::io {
namespace fs = std::filesystem;
using protozero::pbf_writer;

namespace {

constexpr const char* kPrefix = "events.out.tfevents.";

static_assert(std::endian::native == std::endian::little, "records are little-endian");

template <class Number>
void append(std::string& to, Number number) {
  char bytes[sizeof number];
  std::memcpy(bytes, &number, sizeof number);
  to.append(bytes, sizeof number);
}

/// As TensorFlow stores checksums (lib/hash/crc32c.h).
std::uint32_t masked_checksum(std::string_view bytes) { return std::rotr(crc32c(bytes), 15) + 0xA282EAD8U; }

std::string record(std::string_view event) {
  std::string record;
  append(record, static_cast<std::uint64_t>(event.size()));
  append(record, masked_checksum(record));
  record += event;
  append(record, masked_checksum(event));
  return record;
}

double now_seconds() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

// Numbers of fields in event.proto and summary.proto.
enum Event { kWallTime = 1, kStep = 2, kFileVersion = 3, kSummary = 5 };
constexpr int kSummaryValue = 1;
enum Value { kTag = 1, kSimpleValue = 2, kImage = 4 };
enum ImageField { kHeight = 1, kWidth = 2, kColourspace = 3, kEncoded = 4 };

/// An event with one value, whose fields but the tag `write` adds.
template <class Write>
std::string event_of(std::string_view tag, Index step, const Write& write) {
  std::string event;
  pbf_writer writer(event);
  writer.add_double(kWallTime, now_seconds());
  writer.add_int64(kStep, step);
  pbf_writer summary(writer, kSummary);
  pbf_writer value(summary, kSummaryValue);
  value.add_string(kTag, tag.data(), tag.size());
  write(value);
  return event;
}

void remove_files(const fs::path& folder, const std::string& writer) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(kPrefix) && name.ends_with("." + writer)) fs::remove(entry.path());
  }
}

}  // namespace

EventFile::EventFile(const fs::path& folder, const std::string& writer)
    : path_(folder / joined(kPrefix, static_cast<std::int64_t>(now_seconds()), ".", writer)) {
  remove_files(folder, writer);
  file_.reset(std::fopen(path_.c_str(), "wb"));
  check(file_ != nullptr, path_.string(), ": cannot be written: ", std::generic_category().message(errno));
  std::string event;
  pbf_writer first(event);
  first.add_double(kWallTime, now_seconds());
  first.add_string(kFileVersion, "brain.Event:2");
  add(event);
}

void EventFile::add_scalar(std::string_view tag, Index step, double value) {
  add(event_of(tag, step, [&](pbf_writer& to) { to.add_float(kSimpleValue, static_cast<float>(value)); }));
}

void EventFile::add_image(std::string_view tag, Index step, const Image& image) {
  const std::string png = encoded_png(path_.string(), image);
  add(event_of(tag, step, [&](pbf_writer& to) {
    pbf_writer fields(to, kImage);
    fields.add_int32(kHeight, static_cast<std::int32_t>(image.height));
    fields.add_int32(kWidth, static_cast<std::int32_t>(image.width));
    fields.add_int32(kColourspace, 3);  // RGB
    fields.add_bytes(kEncoded, png);
  }));
}

void EventFile::add(std::string_view event) {
  const std::string bytes = record(event);
  const bool written =
      std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) == bytes.size() && std::fflush(file_.get()) == 0;
  check(written, path_.string(), ": cannot be written: ", std::generic_category().message(errno));
}

}  // namespace svnet::io
