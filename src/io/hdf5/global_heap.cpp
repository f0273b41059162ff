#include "io/hdf5/global_heap.h"

#include <algorithm>
#include <cstring>
#include <mutex>

#include "io/hdf5/bytes.h"

namespace svnet::io::hdf5 {
namespace {

constexpr std::uint64_t kHeader = 16;  // of a collection: signature, version, 3 reserved, 8 size
constexpr std::uint64_t kObject = 16;  // of an object: 2 number, 2 references, 4 reserved, 8 size

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

const GlobalHeap::Collection& GlobalHeap::collection(std::uint64_t address, const std::string& where) {
  if (const auto known = collections_.find(address); known != collections_.end()) return known->second;
  const std::string refusal = file_.name + ": " + where + ": its strings are not where it says; the file is damaged";
  const std::vector<char> start = file_.bytes(address, kHeader, where);
  Bytes header(start, refusal);
  if (std::memcmp(header.take(8).data(), "GCOL\1", 5) != 0) header.refuse();
  const std::uint64_t size = header.number(8);
  if (size > collections_left_)
    file_.fail_at(where, "its strings lie in collections that overlap; the file is damaged");
  collections_left_ -= size;
  Collection collection;
  collection.bytes = file_.bytes(address, size, where);
  Bytes left(collection.bytes, refusal);
  left.skip(kHeader);
  while (left.size() >= kObject) {
    const auto number = static_cast<std::uint32_t>(left.number(2));
    if (number == 0) break;  // free space, always last
    left.skip(6);
    const std::uint64_t length = left.number(8);
    collection.objects[number] = left.take(length);
    left.skip(std::min((8 - length % 8) % 8, left.size()));
  }
  return collections_[address] = std::move(collection);  // moving keeps the bytes where they are
}

std::string GlobalHeap::text(const TextReference& reference, const std::string& where) {
  const std::string refusal = file_.name + ": " + where + ": its strings are not where it says; the file is damaged";
  Bytes bytes({reinterpret_cast<const char*>(reference.data()), reference.size()}, refusal);
  const std::uint64_t length = bytes.number(4), address = bytes.number(8);
  const auto number = static_cast<std::uint32_t>(bytes.number(4));
  if (length == 0) return {};
  const Collection& found = collection(address, where);
  const auto object = found.objects.find(number);
  if (object == found.objects.end() || length > object->second.size()) bytes.refuse();
  if (length > text_left_) file_.fail_at(where, "its strings are longer than the file; many share one");
  text_left_ -= length;
  const std::span<const char> text = object->second.first(length);
  return std::string(text.begin(), std::find(text.begin(), text.end(), '\0'));
}

}  // namespace svnet::io::hdf5
