#include "io/hdf5/datatype.h"

#include <array>

#include "base/error.h"
#include "io/hdf5/handle.h"

namespace svnet::io::hdf5 {
namespace {

/// Whether the type is a float of 16 bits, in either byte order, with a sign, `exponent_bits` and the rest mantissa.
/// HDF5 1.10 has no names for them.
bool is_small_float(hid_t type, std::size_t exponent_bits) {
  const std::size_t mantissa_bits = 15 - exponent_bits;
  const Handle small(H5Tcopy(H5T_IEEE_F32LE), H5Tclose);
  H5Tset_fields(small.id(), 15, mantissa_bits, exponent_bits, 0, mantissa_bits);
  H5Tset_size(small.id(), 2);
  H5Tset_ebias(small.id(), (std::size_t{1} << (exponent_bits - 1)) - 1);
  if (H5Tequal(type, small.id()) > 0) return true;
  H5Tset_order(small.id(), H5T_ORDER_BE);
  return H5Tequal(type, small.id()) > 0;
}

/// IEEE 754 binary16, as h5py stores NumPy's float16.
bool is_float16(hid_t type) { return is_small_float(type, 5); }
bool is_bfloat16(hid_t type) { return is_small_float(type, 8); }

bool is_ieee_float(hid_t type, std::size_t size) {
  if (size == 2) return is_float16(type);
  if (size == 4) return H5Tequal(type, H5T_IEEE_F32LE) > 0 || H5Tequal(type, H5T_IEEE_F32BE) > 0;
  return size == 8 && (H5Tequal(type, H5T_IEEE_F64LE) > 0 || H5Tequal(type, H5T_IEEE_F64BE) > 0);
}

bool is_whole_integer(hid_t type, std::size_t size) {
  return (size == 1 || size == 2 || size == 4 || size == 8) && H5Tget_precision(type) == 8 * size &&
         H5Tget_offset(type) == 0;
}

std::string class_name(H5T_class_t type_class) {
  switch (type_class) {
    case H5T_INTEGER:
      return "integer of unusual layout";
    case H5T_FLOAT:
      return "float of unusual layout";
    case H5T_BITFIELD:
      return "bit field";
    case H5T_OPAQUE:
      return "opaque";
    case H5T_COMPOUND:
      return "compound";
    case H5T_REFERENCE:
      return "reference";
    case H5T_ENUM:
      return "enumeration";
    case H5T_VLEN:
      return "variable-length sequence";
    case H5T_ARRAY:
      return "array";
    default:
      return "unknown type";
  }
}

}  // namespace

ElementType element_type(hid_t type) {
  const H5T_class_t type_class = H5Tget_class(type);
  const std::size_t size = H5Tget_size(type);
  if (type_class == H5T_FLOAT && size == 2 && is_bfloat16(type)) return {Kind::real, size, "bfloat16"};
  if (type_class == H5T_OPAQUE && size == 2) return {Kind::opaque_bfloat16, size, "opaque of 2 bytes"};
  if (type_class == H5T_FLOAT && is_ieee_float(type, size)) return {Kind::real, size, joined("float", 8 * size)};
  if (type_class == H5T_INTEGER && is_whole_integer(type, size)) {
    if (H5Tget_sign(type) == H5T_SGN_NONE) return {Kind::unsigned_integer, size, joined("uint", 8 * size)};
    return {Kind::signed_integer, size, joined("int", 8 * size)};
  }
  if (type_class == H5T_STRING)
    return {H5Tis_variable_str(type) > 0 ? Kind::variable_text : Kind::fixed_text, size, "string"};
  return {Kind::other, size, class_name(type_class)};
}

}  // namespace svnet::io::hdf5
