#include "io/hdf5/convert.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <cstring>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/text.h"
#include "io/hdf5/datatype.h"

namespace svnet::io::hdf5 {
namespace {

/// Values per block: of 8 bytes they fit in a room.
std::uint64_t block_values(Sink& sink) { return sink.room().size() / 8; }

template <class T>
hid_t memory_type() {
  if constexpr (std::is_same_v<T, float>) return H5T_NATIVE_FLOAT;
  if constexpr (std::is_same_v<T, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::is_same_v<T, std::int64_t>) return H5T_NATIVE_INT64;
  if constexpr (std::is_same_v<T, std::uint64_t>) return H5T_NATIVE_UINT64;
}

template <class T>
void read_as(const File& file, const Source& source, Sink& sink) {
  source.read_blocks(block_values(sink), [&](std::uint64_t count, const Reader& read) {
    const std::span<std::byte> room = sink.room();
    const std::uint64_t bytes = count * sizeof(T);
    std::vector<std::byte> larger(bytes > room.size() ? bytes : 0);
    const std::span<std::byte> values = larger.empty() ? room.first(bytes) : std::span(larger);
    file.done(read(memory_type<T>(), H5P_DEFAULT, values.data()), source.where, "cannot be read");
    sink.values(values);
  });
}

/// bfloat16 is the upper half of float32.
template <class T>
void read_opaque_bfloat16(const File& file, const Source& source, Sink& sink) {
  source.read_blocks(block_values(sink), [&](std::uint64_t count, const Reader& read) {
    std::vector<unsigned char> bytes(2 * count);
    file.done(read(source.type, H5P_DEFAULT, bytes.data()), source.where, "cannot be read");
    std::vector<T> values(count);
    for (std::uint64_t i = 0; i < count; ++i)
      values[i] = std::bit_cast<float>(std::uint32_t{bytes[2 * i]} << 16 | std::uint32_t{bytes[2 * i + 1]} << 24);
    sink.values(std::as_bytes(std::span(values)));
  });
}

/// Reads integers of the other sign. Throws Error for a value that does not fit (the HDF5 library would clip it).
template <class To>
void read_other_sign(const File& file, const Source& source, Sink& sink) {
  using From = std::conditional_t<std::is_signed_v<To>, std::uint64_t, std::int64_t>;
  source.read_blocks(block_values(sink), [&](std::uint64_t count, const Reader& read) {
    std::vector<From> values(count);
    file.done(read(memory_type<From>(), H5P_DEFAULT, values.data()), source.where, "cannot be read");
    for (const From value : values)
      if (!std::in_range<To>(value)) file.fail_at(source.where, "holds ", value, ", which is out of range");
    sink.values(std::as_bytes(std::span(values)));
  });
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

/// Passes strings on in their order, and checks them.
class CheckedTexts {
 public:
  CheckedTexts(const File& file, const std::string& where, Sink& sink) : file_(file), where_(where), sink_(sink) {}
  ~CheckedTexts() = default;
  CheckedTexts(const CheckedTexts&) = delete;
  CheckedTexts& operator=(const CheckedTexts&) = delete;

  void add(std::string text) {
    if (text.size() > kLargestText)
      file_.fail_at(where_, "string ", count_, " has ", text.size(), " bytes, more than the limit of ", kLargestText);
    if (!is_plain_utf8(text)) file_.fail_at(where_, "string ", count_, " is not UTF-8");
    ++count_;
    bytes_ += text.size();
    texts_.push_back(std::move(text));
    constexpr std::size_t kBatchBytes = std::size_t{1} << 18, kBatch = 4096;
    if (bytes_ > kBatchBytes || texts_.size() == kBatch) flush();
  }
  void flush() {
    sink_.texts(texts_);
    texts_.clear();
    bytes_ = 0;
  }

 private:
  const File& file_;
  const std::string& where_;
  Sink& sink_;
  std::vector<std::string> texts_{};
  std::uint64_t count_ = 0, bytes_ = 0;
};

void read_fixed_texts(const File& file, const Source& source, CheckedTexts& texts) {
  const std::size_t size = H5Tget_size(source.type);
  const Handle memory(H5Tcopy(source.type), H5Tclose);
  file.done(memory.id(), source.where, "its type cannot be read");
  const H5T_str_t padding = H5Tget_strpad(source.type);
  constexpr std::size_t kBlockBytes = std::size_t{1} << 20;
  source.read_blocks(std::max<std::size_t>(kBlockBytes / size, 1), [&](std::uint64_t count, const Reader& read) {
    std::vector<char> bytes(count * size);
    file.done(read(memory.id(), H5P_DEFAULT, bytes.data()), source.where, "cannot be read");
    for (std::uint64_t i = 0; i < count; ++i) texts.add(unpadded(bytes.data() + i * size, size, padding));
  });
}

/// The memory that strings may take together: many rows of a file can share one string.
struct Budget {
  std::uint64_t left;
  bool is_exceeded = false;

  static void* allocate(std::size_t size, void* budget) {
    auto& own = *static_cast<Budget*>(budget);
    own.is_exceeded = own.is_exceeded || size > own.left;
    if (own.is_exceeded) return nullptr;
    own.left -= size;
    return std::malloc(size);
  }
  static void release(void* memory, void*) { std::free(memory); }
};

/// Strings as the library gives them, which it and this object free.
struct Pointers {
  explicit Pointers(std::uint64_t count) : texts(count, nullptr) {}
  ~Pointers() {
    for (char* text : texts) std::free(text);
  }
  Pointers(const Pointers&) = delete;
  Pointers& operator=(const Pointers&) = delete;
  std::vector<char*> texts;
};

void read_variable_texts(const File& file, const Source& source, CheckedTexts& texts) {
  const Handle memory(H5Tcopy(H5T_C_S1), H5Tclose), transfer(H5Pcreate(H5P_DATASET_XFER), H5Pclose);
  H5Tset_size(memory.id(), H5T_VARIABLE);
  H5Tset_cset(memory.id(), H5Tget_cset(source.type));
  Budget budget{file.size + source.count};  // each has a NUL
  H5Pset_vlen_mem_manager(transfer.id(), Budget::allocate, &budget, Budget::release, nullptr);
  std::uint64_t bytes = 0;
  constexpr std::uint64_t kBlock = 4096;
  source.read_blocks(kBlock, [&](std::uint64_t count, const Reader& read) {
    Pointers pointers(count);
    const herr_t done = read(memory.id(), transfer.id(), pointers.texts.data());
    for (const char* text : pointers.texts) bytes += done >= 0 && text != nullptr ? std::strlen(text) : 0;
    if (budget.is_exceeded || bytes > file.size)
      file.fail_at(source.where, "its strings are longer than the file; many share one");
    file.done(done, source.where, "cannot be read");
    for (const char* text : pointers.texts) texts.add(text != nullptr ? text : "");
  });
}

}  // namespace

template <class T>
void read_numbers(const File& file, const Source& source, Sink& sink) {
  const ElementType element = element_type(source.type);
  const bool integer = element.kind == Kind::signed_integer || element.kind == Kind::unsigned_integer;
  if constexpr (std::is_floating_point_v<T>) {
    const bool accepted =
        element.kind == Kind::real || element.kind == Kind::opaque_bfloat16 || (integer && std::is_same_v<T, double>);
    if (!accepted) file.fail_at(source.where, "holds values of type ", element.name, ", not floats");
    if (element.kind == Kind::opaque_bfloat16) return read_opaque_bfloat16<T>(file, source, sink);
    read_as<T>(file, source, sink);
  } else {
    if (!integer) file.fail_at(source.where, "holds values of type ", element.name, ", not integers");
    if ((element.kind == Kind::signed_integer) == std::is_signed_v<T>) return read_as<T>(file, source, sink);
    read_other_sign<T>(file, source, sink);
  }
}

template void read_numbers<float>(const File&, const Source&, Sink&);
template void read_numbers<double>(const File&, const Source&, Sink&);
template void read_numbers<std::int64_t>(const File&, const Source&, Sink&);
template void read_numbers<std::uint64_t>(const File&, const Source&, Sink&);

void read_texts(const File& file, const Source& source, Sink& sink) {
  if (source.count == 0) return;
  const ElementType element = element_type(source.type);
  if (element.kind != Kind::fixed_text && element.kind != Kind::variable_text)
    file.fail_at(source.where, "holds values of type ", element.name, ", not strings");
  CheckedTexts texts(file, source.where, sink);
  if (element.kind == Kind::fixed_text) {
    read_fixed_texts(file, source, texts);
  } else {
    read_variable_texts(file, source, texts);
  }
  texts.flush();
}

}  // namespace svnet::io::hdf5
