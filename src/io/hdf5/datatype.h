#pragma once
#include <string>

#include <hdf5.h>

namespace svnet::hdf5 {

enum class Kind { real, signed_integer, unsigned_integer, fixed_text, variable_text, other };

/// What the elements of a dataset or attribute are.
struct ElementType {
  Kind kind;
  std::size_t size;  // in the file, in bytes
  std::string name;  // for messages: "float32", "string", "compound", …
};

/// `type` of a file. Numbers are those that NumPy has (either byte order); other widths and layouts are Kind::other.
ElementType element_type(hid_t type);

}  // namespace svnet::hdf5
