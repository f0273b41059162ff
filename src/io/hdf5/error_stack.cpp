#include "io/hdf5/error_stack.h"

#include "base/text.h"

namespace svnet::io::hdf5 {
namespace {

struct Reason {
  std::string text{};
  bool is_memory = false;
};

herr_t keep_first(unsigned number, const H5E_error2_t* error, void* to) {
  auto& kept = *static_cast<Reason*>(to);
  if (error->maj_num == H5E_RESOURCE || error->min_num == H5E_NOSPACE || error->min_num == H5E_CANTALLOC)
    kept.is_memory = true;
  if (number != 0 || error->desc == nullptr) return 0;
  try {
    kept.text = error->desc;
    return 0;
  } catch (...) {
    return -1;
  }
}

/// "No space left on device" of "file write failed: …, errno = 28, error message = 'No space left on device', …"; any
/// other text unchanged.
std::string system_message(const std::string& text) {
  const std::string start = "error message = '";
  const auto begin = text.find(start);
  const auto end = begin == std::string::npos ? begin : text.find('\'', begin + start.size());
  return end == std::string::npos ? text : text.substr(begin + start.size(), end - begin - start.size());
}

}  // namespace

std::string reason() {
  Reason kept;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &kept);
  if (kept.text.empty()) kept.text = "the HDF5 library gives no reason";
  return (kept.is_memory ? "out of memory: " : "") + printable(system_message(kept.text));
}

}  // namespace svnet::io::hdf5
