#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/index.h"

namespace svnet::io {
namespace hdf5 {
struct OpenFile;  // private to this folder
}

/// Values in row-major order; an empty shape is a single value.
template <class T>
struct Hdf5Array {
  std::vector<Index> shape;
  std::vector<T> values;
};

/// An HDF5 file that is read, or one that is written. Objects are named by their path from the root, "a/b/c"; "" is the
/// root group.
///
/// Throws Error that names the file, the object and the HDF5 library's reason if anything fails; the library itself
/// prints nothing. Only hard links are followed. Refused are damaged files, external and virtual datasets, filters
/// other than gzip and shuffle, sizes that the file cannot hold, and text that is not UTF-8 without NUL.
///
/// The library is not safe against files made to attack it. So a file is read in a child process, which can do nothing
/// but read it (sandbox/child.h), unless sandbox::mode() was `off` when it was opened; what it says is checked.
///
/// Not thread-safe: only one thread at a time may use a file. A file that is written cannot be read before close().
/// It holds no time stamps: the same calls give the same bytes. Its metadata have checksums (HDF5 1.8 format).
class Hdf5File {
 public:
  static Hdf5File open(const std::filesystem::path& path);
  /// Replaces the file at `path`. Errors call it `name_in_messages` if given, else `path`.
  static Hdf5File create(const std::filesystem::path& path, const std::string& name_in_messages = {});
  /// Closes the file. Only close() reports a failed write.
  ~Hdf5File();
  Hdf5File(Hdf5File&&) noexcept;
  Hdf5File& operator=(Hdf5File&&) noexcept;

  /// Throws Error if anything could not be written. No other function may be called afterwards.
  void close();

  /// The file as errors call it.
  const std::string& name() const;

  bool has(const std::string& object) const;
  bool is_group(const std::string& object) const;
  /// The names in a group, in natural order.
  std::vector<std::string> members(const std::string& group) const;

  std::vector<Index> shape(const std::string& dataset) const;
  /// T: float (from bfloat16, float16, 32 and 64), double (from any float or integer), std::int64_t and std::uint64_t
  /// (from integers that fit), std::string (from strings of fixed or variable length).
  template <class T>
  Hdf5Array<T> read(const std::string& dataset) const;

  bool has_attribute(const std::string& object, const std::string& name) const;
  /// A single string.
  std::string text_attribute(const std::string& object, const std::string& name) const;
  /// A list of strings; an empty list may be of any type, as h5py writes it.
  std::vector<std::string> text_list_attribute(const std::string& object, const std::string& name) const;
  /// A single number, T: double, std::int64_t or std::uint64_t, as `read` converts them.
  template <class T>
  T number_attribute(const std::string& object, const std::string& name) const;

  /// Creates the group and its parents. `write` creates the parents of a dataset too.
  void create_group(const std::string& group);
  /// T: float, double, std::int64_t, std::uint64_t, std::string (variable length, UTF-8, as h5py writes them). Requires
  /// that the dataset is new and that `values` has as many elements as the shape.
  template <class T>
  void write(const std::string& dataset, const std::vector<Index>& shape, std::span<const T> values);

  /// Requires that the object exists and has no attribute of that name.
  void write_text_attribute(const std::string& object, const std::string& name, const std::string& value);
  void write_text_list_attribute(const std::string& object, const std::string& name,
                                 std::span<const std::string> values);
  /// T: double, std::int64_t, std::uint64_t.
  template <class T>
  void write_number_attribute(const std::string& object, const std::string& name, T value);

 private:
  explicit Hdf5File(std::unique_ptr<hdf5::OpenFile> state);
  std::unique_ptr<hdf5::OpenFile> state_;
};

}  // namespace svnet::io
