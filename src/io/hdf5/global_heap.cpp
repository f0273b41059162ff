#include "global_heap.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <mutex>
#include <system_error>

#include <unistd.h>

namespace svnet::hdf5 {
namespace {

constexpr std::uint64_t kHeader = 16;  // of a collection: signature, version, 3 reserved, 8 size
constexpr std::uint64_t kObject = 16;  // of an object: 2 number, 2 references, 4 reserved, 8 size

template <class Byte>
std::uint64_t little_endian(const Byte* bytes, int size) {
  std::uint64_t value = 0;
  for (int i = 0; i < size; ++i) value |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[i])) << (8 * i);
  return value;
}

/// A conversion that leaves the bytes as they lie in the file.
herr_t keep_reference(hid_t from, hid_t to, H5T_cdata_t* conversion, std::size_t, std::size_t, std::size_t, void*,
                      void*, hid_t) {
  if (conversion->command != H5T_CONV_INIT) return 0;
  conversion->need_bkg = H5T_BKG_NO;
  const bool ours = H5Tis_variable_str(from) > 0 && H5Tget_size(from) == sizeof(TextReference) &&
                    H5Tget_size(to) == sizeof(TextReference);
  return ours ? 0 : -1;
}

Handle opaque_type() { return Handle(H5Tcreate(H5T_OPAQUE, sizeof(TextReference)), H5Tclose); }

}  // namespace

Handle text_reference_type() {
  static std::once_flag once;
  std::call_once(once, [] {
    const Handle text(H5Tcopy(H5T_C_S1), H5Tclose), raw = opaque_type();
    H5Tset_size(text.id(), H5T_VARIABLE);
    H5Tregister(H5T_PERS_SOFT, "svnet text reference", text.id(), raw.id(), keep_reference);
  });
  return opaque_type();
}

GlobalHeap::GlobalHeap(const File& file) : file_(file), text_left_(file.size) {
  const Handle creation(H5Fget_create_plist(file.file.id()), H5Pclose);
  hsize_t user_block = 0;
  std::size_t address_size = 0, length_size = 0;
  void* handle = nullptr;
  if (H5Pget_userblock(creation.id(), &user_block) < 0 ||
      H5Pget_sizes(creation.id(), &address_size, &length_size) < 0 ||
      H5Fget_vfd_handle(file.file.id(), H5P_DEFAULT, &handle) < 0 || !handle)
    fail(file.name, ": its strings cannot be read: ", reason());
  check(address_size == 8 && length_size == 8, file.name, ": has addresses of ", address_size, " and lengths of ",
        length_size, " bytes, only 8 are supported");
  base_ = user_block;
  descriptor_ = *static_cast<const int*>(handle);
}

std::vector<char> GlobalHeap::read_bytes(std::uint64_t address, std::uint64_t size, const std::string& where) const {
  if (address > file_.size || base_ > file_.size - address || size > file_.size - address - base_)
    file_.fail_at(where, "its strings lie outside the file; the file is damaged");
  std::vector<char> bytes(size);
  for (std::uint64_t done = 0; done < size;) {
    const ssize_t got =
        ::pread(descriptor_, bytes.data() + done, size - done, static_cast<off_t>(base_ + address + done));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0)
      file_.fail_at(where, "cannot be read: ", got < 0 ? std::generic_category().message(errno) : "the file ends");
    done += static_cast<std::uint64_t>(got);
  }
  return bytes;
}

const GlobalHeap::Collection& GlobalHeap::collection(std::uint64_t address, const std::string& where) {
  if (const auto known = collections_.find(address); known != collections_.end()) return known->second;
  const std::vector<char> header = read_bytes(address, kHeader, where);
  if (std::memcmp(header.data(), "GCOL\1", 5) != 0)
    file_.fail_at(where, "its strings are not where it says; the file is damaged");
  Collection collection;
  collection.bytes = read_bytes(address, std::max(little_endian(header.data() + 8, 8), kHeader), where);
  const std::span<const char> all(collection.bytes);
  for (std::uint64_t at = kHeader; all.size() - at >= kObject;) {
    const auto number = static_cast<std::uint32_t>(little_endian(all.data() + at, 2));
    if (number == 0) break;  // free space, always last
    const std::uint64_t size = little_endian(all.data() + at + 8, 8);
    if (size > all.size() - at - kObject) file_.fail_at(where, "its strings overlap others; the file is damaged");
    collection.objects[number] = all.subspan(at + kObject, size);
    at = std::min<std::uint64_t>(at + kObject + (size + 7) / 8 * 8, all.size());
  }
  return collections_[address] = std::move(collection);  // moving keeps the bytes where they are
}

std::string GlobalHeap::text(const TextReference& reference, const std::string& where) {
  const std::uint64_t length = little_endian(reference.data(), 4);
  if (length == 0) return {};
  const Collection& found = collection(little_endian(reference.data() + 4, 8), where);
  const auto object = found.objects.find(static_cast<std::uint32_t>(little_endian(reference.data() + 12, 4)));
  if (object == found.objects.end() || length > object->second.size())
    file_.fail_at(where, "its strings are not where it says; the file is damaged");
  if (length > text_left_) file_.fail_at(where, "its strings are longer than the file; many share one");
  text_left_ -= length;
  const std::span<const char> bytes = object->second.first(length);
  return std::string(bytes.begin(), std::find(bytes.begin(), bytes.end(), '\0'));
}

}  // namespace svnet::hdf5
