#pragma once
#include <string>

#include <hdf5.h>

namespace svnet::io::hdf5 {

enum class Kind {
  real,
  opaque_bfloat16,  // 2 bytes of no type, little endian: what h5py makes of ml_dtypes' bfloat16
  signed_integer,
  unsigned_integer,
  fixed_text,
  variable_text,
  other
};

/// The type of the elements of a dataset or attribute.
struct ElementType {
  Kind kind;
  std::size_t size;  // in the file, in bytes
  std::string name;  // for messages: "float32", "string", "compound", …
};

/// Describes a type of a file. Numbers have the layouts that NumPy knows, or that of bfloat16, in either byte order;
/// all others are Kind::other.
ElementType element_type(hid_t type);

}  // namespace svnet::io::hdf5
