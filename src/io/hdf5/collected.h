#pragma once
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include "base/index.h"
#include "io/hdf5/request.h"

namespace svnet::io::hdf5 {

/// What answers a request, checked: it may come from a process that an attacker took over. Throws Error, by `refuse`,
/// for what no file of `file_size` bytes can hold, and for an answer that is not complete.
class Collected : public Sink {
 public:
  Collected(std::string name, std::uint64_t file_size) : name_(std::move(name)), file_size_(file_size) {}

  void truth(bool value) override;
  void shape(std::span<const std::uint64_t> shape) override;
  void texts(std::span<const std::string> texts) override;
  void values(std::span<const std::byte>) override { refuse(); }
  std::span<std::byte> room() override;

  bool take_truth() const { return has_truth_ ? truth_ : (refuse(), false); }
  std::vector<Index> take_shape() { return has_shape_ ? std::move(shape_) : (refuse(), shape_); }
  /// As many as the shape says, if there is one.
  std::vector<std::string> take_texts();
  std::string take_text();  // the only one

 protected:
  [[noreturn]] void refuse() const;
  std::uint64_t count() const { return count_; }
  bool has_shape() const { return has_shape_; }

 private:
  std::string name_;
  std::uint64_t file_size_;
  std::vector<std::byte> room_{};  // of a file that is read here
  bool has_truth_ = false, truth_ = false, has_shape_ = false;
  std::vector<Index> shape_{};
  std::uint64_t count_ = 0, text_bytes_ = 0;  // of the shape; of all texts
  std::vector<std::string> texts_{};
};

/// With numbers.
template <class T>
class CollectedNumbers : public Collected {
 public:
  using Collected::Collected;

  void shape(std::span<const std::uint64_t> shape) override {
    Collected::shape(shape);
    numbers_.reserve(count());
  }
  void values(std::span<const std::byte> bytes) override {
    const std::size_t more = bytes.size() / sizeof(T);
    if (!has_shape() || bytes.size() % sizeof(T) != 0 || more > count() - numbers_.size()) refuse();
    // The bytes may lie in memory that the other process can still change: they are copied once, and checked later.
    if (reinterpret_cast<std::uintptr_t>(bytes.data()) % alignof(T) != 0) refuse();
    const T* first = reinterpret_cast<const T*>(bytes.data());
    numbers_.insert(numbers_.end(), first, first + more);
  }
  /// As many as the shape says.
  std::vector<T> take_numbers() { return numbers_.size() == count() ? std::move(numbers_) : (refuse(), numbers_); }
  T take_number() const { return numbers_.size() == 1 ? numbers_.front() : (refuse(), T{}); }  // the only one

 private:
  std::vector<T> numbers_{};
};

}  // namespace svnet::io::hdf5
