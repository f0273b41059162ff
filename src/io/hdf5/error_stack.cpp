#include "io/hdf5/error_stack.h"

#include "base/text.h"

namespace svnet::io::hdf5 {
namespace {

herr_t keep_first(unsigned number, const H5E_error2_t* error, void* text) {
  if (number == 0 && error->desc) *static_cast<std::string*>(text) = error->desc;
  return 0;
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
  std::string text;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &text);
  return text.empty() ? "the HDF5 library gives no reason" : printable(system_message(text));
}

}  // namespace svnet::io::hdf5
