#include "io/hdf5/collected.h"

#include <algorithm>

#include "base/error.h"
#include "base/text.h"
#include "io/hdf5/limits.h"

namespace svnet::io::hdf5 {
namespace {

constexpr std::size_t kMostDimensions = 32;  // of HDF5

}  // namespace

void Collected::refuse() const {
  fail(name_, ": the HDF5 library gave an answer that makes no sense; the file is damaged or was made to attack");
}

void Collected::truth(bool value) {
  if (has_truth_) refuse();
  has_truth_ = true;
  truth_ = value;
}

void Collected::shape(std::span<const std::uint64_t> shape) {
  if (has_shape_ || shape.size() > kMostDimensions) refuse();
  has_shape_ = true;
  const bool is_empty = std::find(shape.begin(), shape.end(), 0u) != shape.end();
  std::uint64_t count = 1;
  for (const std::uint64_t extent : shape) {
    if (extent > kLargestBytes || (!is_empty && count > largest_decoded(file_size_) / extent)) refuse();
    count *= is_empty ? 1 : extent;
    shape_.push_back(static_cast<Index>(extent));
  }
  count_ = is_empty ? 0 : count;
}

void Collected::texts(std::span<const std::string> texts) {
  for (const std::string& text : texts) {
    text_bytes_ += text.size() + 1;
    if (text_bytes_ > largest_decoded(file_size_)) refuse();
    if (has_shape_ && (texts_.size() == count_ || !is_plain_utf8(text))) refuse();
    texts_.push_back(text);
  }
}

std::span<std::byte> Collected::room() {
  room_.resize(std::size_t{1} << 20);
  return room_;
}

std::vector<std::string> Collected::take_texts() {
  if (has_shape_ && texts_.size() != count_) refuse();
  return std::move(texts_);
}

std::string Collected::take_text() {
  if (texts_.size() != 1) refuse();
  return std::move(texts_.front());
}

}  // namespace svnet::io::hdf5
