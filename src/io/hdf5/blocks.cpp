#include "io/hdf5/blocks.h"

#include <algorithm>

namespace svnet::io::hdf5 {
namespace {

bool is_chunked(hid_t dataset) {
  const Handle creation(H5Dget_create_plist(dataset), H5Pclose);
  return H5Pget_layout(creation.id()) == H5D_CHUNKED;
}

/// Goes through an array in row-major order. Each step is one index of the first dimensions, a range of the next one,
/// and all of those after it.
class Slabs {
 public:
  Slabs(const std::vector<Index>& shape, std::uint64_t most)
      : shape_(shape.begin(), shape.end()), start_(shape.size(), 0), size_(shape.begin(), shape.end()) {
    while (cut_ + 1 < shape_.size() && behind(cut_) > most) ++cut_;
    std::fill(size_.begin(), size_.begin() + static_cast<std::ptrdiff_t>(cut_), 1);
    longest_ = std::max<std::uint64_t>(most / behind(cut_), 1);
    size_[cut_] = std::min<hsize_t>(longest_, shape_[cut_]);
  }

  const hsize_t* start() const { return start_.data(); }
  const hsize_t* size() const { return size_.data(); }
  std::uint64_t count() const { return size_[cut_] * behind(cut_); }

  /// False at the end.
  bool next() {
    start_[cut_] += size_[cut_];
    for (std::size_t i = cut_; start_[i] == shape_[i]; --i) {
      if (i == 0) return false;
      start_[i] = 0;
      ++start_[i - 1];
    }
    size_[cut_] = std::min<hsize_t>(longest_, shape_[cut_] - start_[cut_]);
    return true;
  }

 private:
  /// The values behind one index of a dimension.
  std::uint64_t behind(std::size_t dimension) const {
    std::uint64_t count = 1;
    for (std::size_t i = dimension + 1; i < shape_.size(); ++i) count *= shape_[i];
    return count;
  }

  std::vector<hsize_t> shape_, start_, size_;
  std::size_t cut_ = 0;
  std::uint64_t longest_ = 1;
};

}  // namespace

void read_dataset_blocks(const File& file, hid_t dataset, const Extent& extent, const std::string& where,
                         std::uint64_t most, const TakeBlock& take) {
  if (extent.count == 0) return;
  if (extent.count <= most || is_chunked(dataset)) {
    take(extent.count, [&](hid_t type, hid_t transfer, void* values) {
      return H5Dread(dataset, type, H5S_ALL, H5S_ALL, transfer, values);
    });
    return;
  }
  const Handle space(H5Dget_space(dataset), H5Sclose);
  file.done(space.id(), where, "its shape cannot be read");
  Slabs slabs(extent.shape, most);
  do {
    const hsize_t count = slabs.count();
    const Handle memory(H5Screate_simple(1, &count, nullptr), H5Sclose);
    const bool chosen =
        H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, slabs.start(), nullptr, slabs.size(), nullptr) >= 0;
    file.done(chosen ? memory.id() : -1, where, "cannot be read");
    take(count, [&](hid_t type, hid_t transfer, void* values) {
      return H5Dread(dataset, type, memory.id(), space.id(), transfer, values);
    });
  } while (slabs.next());
}

}  // namespace svnet::io::hdf5
