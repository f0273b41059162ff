#include "io/hdf5/convert.h"

#include <algorithm>
#include <bit>
#include <type_traits>
#include <utility>

#include "base/text.h"
#include "io/hdf5/datatype.h"
#include "io/hdf5/global_heap.h"

namespace svnet::io::hdf5 {
namespace {

template <class T>
hid_t memory_type() {
  if constexpr (std::is_same_v<T, float>) return H5T_NATIVE_FLOAT;
  if constexpr (std::is_same_v<T, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::is_same_v<T, std::int64_t>) return H5T_NATIVE_INT64;
  if constexpr (std::is_same_v<T, std::uint64_t>) return H5T_NATIVE_UINT64;
}

template <class T>
std::vector<T> read_as(const File& file, const std::string& where, std::uint64_t count, const Reader& read) {
  std::vector<T> values(count);
  if (count > 0) file.done(read(memory_type<T>(), values.data()), where, "cannot be read");
  return values;
}

/// bfloat16 is the upper half of float32.
template <class T>
std::vector<T> read_opaque_bfloat16(const File& file, const std::string& where, hid_t type, std::uint64_t count,
                                    const Reader& read) {
  std::vector<unsigned char> bytes(2 * count);
  if (count > 0) file.done(read(type, bytes.data()), where, "cannot be read");
  std::vector<T> values(count);
  for (std::uint64_t i = 0; i < count; ++i)
    values[i] = std::bit_cast<float>(std::uint32_t{bytes[2 * i]} << 16 | std::uint32_t{bytes[2 * i + 1]} << 24);
  return values;
}

/// Converts between signed and unsigned integers. Throws Error for a value that does not fit (the HDF5 library would
/// clip it).
template <class To, class From>
std::vector<To> changed_sign(const File& file, const std::string& where, const std::vector<From>& values) {
  for (const From value : values)
    if (!std::in_range<To>(value)) file.fail_at(where, "holds ", value, ", which is out of range");
  return {values.begin(), values.end()};
}

/// A string of fixed length without its padding.
std::string unpadded(const char* text, std::size_t size, H5T_str_t padding) {
  std::string result(text, size);
  if (padding == H5T_STR_SPACEPAD) {
    result.erase(result.find_last_not_of(' ') + 1);
  } else {
    result.resize(std::min(result.find('\0'), size));
  }
  return result;
}

std::vector<std::string> fixed_texts(const File& file, const std::string& where, hid_t type, std::uint64_t count,
                                     const Reader& read) {
  const std::size_t size = H5Tget_size(type);
  if (size == 0 || count > kLargestBytes / size) file.fail_at(where, "declares more than ", kLargestBytes, " bytes");
  std::vector<char> bytes(count * size);
  const Handle memory(H5Tcopy(type), H5Tclose);
  file.done(memory.id(), where, "its type cannot be read");
  file.done(read(memory.id(), bytes.data()), where, "cannot be read");
  std::vector<std::string> texts(count);
  for (std::uint64_t i = 0; i < count; ++i) texts[i] = unpadded(bytes.data() + i * size, size, H5Tget_strpad(type));
  return texts;
}

std::vector<std::string> variable_texts(const File& file, const std::string& where, std::uint64_t count,
                                        const Reader& read) {
  std::vector<TextReference> references(count);
  const Handle memory = text_reference_type();
  file.done(read(memory.id(), references.data()), where, "cannot be read");
  GlobalHeap heap(file);
  std::vector<std::string> texts;
  texts.reserve(count);
  for (const TextReference& reference : references) texts.push_back(heap.text(reference, where));
  return texts;
}

}  // namespace

template <class T>
std::vector<T> read_numbers(const File& file, const std::string& where, hid_t type, std::uint64_t count,
                            const Reader& read) {
  const ElementType element = element_type(type);
  const bool integer = element.kind == Kind::signed_integer || element.kind == Kind::unsigned_integer;
  if constexpr (std::is_floating_point_v<T>) {
    if (element.kind == Kind::opaque_bfloat16) return read_opaque_bfloat16<T>(file, where, type, count, read);
    const bool accepted = element.kind == Kind::real || (integer && std::is_same_v<T, double>);
    if (!accepted) file.fail_at(where, "holds values of type ", element.name, ", not floats");
    return read_as<T>(file, where, count, read);
  } else {
    if (!integer) file.fail_at(where, "holds values of type ", element.name, ", not integers");
    using Other = std::conditional_t<std::is_signed_v<T>, std::uint64_t, std::int64_t>;
    if ((element.kind == Kind::signed_integer) == std::is_signed_v<T>) return read_as<T>(file, where, count, read);
    return changed_sign<T>(file, where, read_as<Other>(file, where, count, read));
  }
}

template std::vector<float> read_numbers(const File&, const std::string&, hid_t, std::uint64_t, const Reader&);
template std::vector<double> read_numbers(const File&, const std::string&, hid_t, std::uint64_t, const Reader&);
template std::vector<std::int64_t> read_numbers(const File&, const std::string&, hid_t, std::uint64_t, const Reader&);
template std::vector<std::uint64_t> read_numbers(const File&, const std::string&, hid_t, std::uint64_t, const Reader&);

std::vector<std::string> read_texts(const File& file, const std::string& where, hid_t type, std::uint64_t count,
                                    const Reader& read) {
  if (count == 0) return {};
  const ElementType element = element_type(type);
  if (element.kind != Kind::fixed_text && element.kind != Kind::variable_text)
    file.fail_at(where, "holds values of type ", element.name, ", not strings");
  std::vector<std::string> texts = element.kind == Kind::fixed_text ? fixed_texts(file, where, type, count, read)
                                                                    : variable_texts(file, where, count, read);
  for (std::size_t i = 0; i < texts.size(); ++i)
    if (!is_plain_utf8(texts[i])) file.fail_at(where, "string ", i, " is not UTF-8");
  return texts;
}

}  // namespace svnet::io::hdf5
