#include "io/tensors/safetensors.h"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <set>
#include <system_error>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.h"
#include "base/text.h"
#include "io/files/atomic_file.h"
#include "io/files/file_format.h"
#include "io/tensors/safetensors_header.h"

namespace svnet::io {
namespace {

constexpr std::uint64_t kLengthBytes = 8;

[[noreturn]] void fail_to_read(const std::string& file, int error) {
  fail(file, ": cannot be read: ", std::generic_category().message(error));
}

void check_size(const std::string& file, std::size_t size) {
  check(size >= kLengthBytes, file, ": has only ", size, " bytes; is it a safetensors file?");
}

/// Throws Error if the contents are known to be something else. A header begins with a brace.
void check_not_another_format(const std::string& file, std::span<const std::byte> bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (text.size() > kLengthBytes && text[kLengthBytes] == '{') return;
  const std::string instead = recognised_instead(text);
  check(instead.empty(), file, ": is not a safetensors file", instead);
}

std::uint64_t little_endian(const std::byte* bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < kLengthBytes; ++i) value |= std::to_integer<std::uint64_t>(bytes[i]) << (8 * i);
  return value;
}

struct Descriptor {
  int number;
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
};

}  // namespace

class SafetensorsFile::Mapping {
 public:
  explicit Mapping(const std::string& file) {
    // Non-blocking, so that a pipe is refused rather than waited for.
    const Descriptor descriptor{::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};
    if (descriptor.number < 0) fail_to_read(file, errno);
    struct stat status {};
    if (::fstat(descriptor.number, &status) != 0) fail_to_read(file, errno);
    check(S_ISREG(status.st_mode), file, ": is not a regular file");
    const auto size = static_cast<std::size_t>(status.st_size);
    check_size(file, size);
    void* address = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor.number, 0);
    if (address == MAP_FAILED) fail_to_read(file, errno);
    bytes_ = {static_cast<const std::byte*>(address), size};
  }
  ~Mapping() { ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size()); }
  Mapping(const Mapping&) = delete;
  Mapping& operator=(const Mapping&) = delete;

  std::span<const std::byte> bytes() const { return bytes_; }

 private:
  std::span<const std::byte> bytes_;
};

SafetensorsFile::SafetensorsFile(const std::filesystem::path& path)
    : path_(path.string()), mapping_(std::make_unique<Mapping>(path_)) {
  parse(mapping_->bytes());
}

SafetensorsFile::SafetensorsFile(std::string name, std::span<const std::byte> contents) : path_(std::move(name)) {
  parse(contents);
}

void SafetensorsFile::parse(std::span<const std::byte> bytes) {
  check_size(path_, bytes.size());
  const std::uint64_t length = little_endian(bytes.data());
  if (length > bytes.size() - kLengthBytes) check_not_another_format(path_, bytes);
  check(length <= kLargestSafetensorsHeader, path_, ": is not a safetensors file: it declares a header of ", length,
        " bytes");
  check(length <= bytes.size() - kLengthBytes, path_, ": declares a header of ", length, " bytes in a file of ",
        bytes.size(), "; it is incomplete, or no safetensors file");
  const std::string_view json(reinterpret_cast<const char*>(bytes.data() + kLengthBytes), length);
  const std::span<const std::byte> data = bytes.subspan(kLengthBytes + length);
  SafetensorsHeader header = parse_safetensors_header(path_, json, data.size());
  metadata_ = std::move(header.metadata);
  for (SafetensorsEntry& entry : header.entries) {
    by_name_[entry.name] = tensors_.size();
    tensors_.push_back({std::move(entry.name), std::move(entry.dtype), std::move(entry.shape),
                        data.subspan(entry.begin, entry.end - entry.begin)});
  }
}

SafetensorsFile::~SafetensorsFile() = default;
SafetensorsFile::SafetensorsFile(SafetensorsFile&&) noexcept = default;
SafetensorsFile& SafetensorsFile::operator=(SafetensorsFile&&) noexcept = default;

const SafetensorsTensor* SafetensorsFile::find(const std::string& name) const {
  const auto found = by_name_.find(name);
  return found == by_name_.end() ? nullptr : &tensors_[found->second];
}

const SafetensorsTensor& SafetensorsFile::at(const std::string& name) const {
  if (const SafetensorsTensor* tensor = find(name)) return *tensor;
  std::vector<std::string> names;
  for (const SafetensorsTensor& tensor : tensors_) names.push_back(tensor.name);
  const std::string nearest = nearest_name(name, names);
  fail(path_, ": holds no tensor '", name, "'", nearest.empty() ? "" : ", did you mean '" + printable(nearest) + "'?");
}

void write_safetensors(const std::filesystem::path& path, std::span<const SafetensorsTensor> tensors,
                       const SafetensorsMetadata& metadata) {
  const std::string file = path.string();
  std::vector<std::pair<std::size_t, const SafetensorsTensor*>> order;
  for (const SafetensorsTensor& tensor : tensors)
    order.emplace_back(safetensors_dtype_rank(file, tensor.name, tensor.dtype), &tensor);
  std::sort(order.begin(), order.end(), [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first < b.first : a.second->name < b.second->name;
  });
  SafetensorsHeader header{{}, metadata};
  std::set<std::string> names{kSafetensorsMetadataKey};
  std::uint64_t position = 0;
  for (const auto& [rank, tensor] : order) {
    check(names.insert(tensor->name).second, file, ": tensor '", printable(tensor->name), "': the name is taken");
    SafetensorsEntry entry{tensor->name, tensor->dtype, tensor->shape, position, position + tensor->bytes.size()};
    const std::uint64_t size = safetensors_size(file, entry);
    check(size == tensor->bytes.size(), file, ": tensor '", printable(tensor->name), "': has ", tensor->bytes.size(),
          " bytes, its dtype ", tensor->dtype, " and shape need ", size);
    position = entry.end;
    header.entries.push_back(std::move(entry));
  }
  const std::string json = safetensors_header_text(file, header);
  check(json.size() <= kLargestSafetensorsHeader, file, ": header would take ", json.size(), " bytes, more than ",
        kLargestSafetensorsHeader);
  write_atomically(path, [&](const std::filesystem::path& temporary) {
    errno = 0;
    std::ofstream out(temporary, std::ios::binary);
    char length[kLengthBytes];
    for (std::size_t i = 0; i < kLengthBytes; ++i) length[i] = static_cast<char>(json.size() >> (8 * i));
    out.write(length, kLengthBytes).write(json.data(), static_cast<std::streamsize>(json.size()));
    for (const auto& [rank, tensor] : order)
      out.write(reinterpret_cast<const char*>(tensor->bytes.data()),
                static_cast<std::streamsize>(tensor->bytes.size()));
    out.flush();
    check(out.good(), file, ": cannot be written: ", std::generic_category().message(errno ? errno : EIO));
  });
}

}  // namespace svnet::io
