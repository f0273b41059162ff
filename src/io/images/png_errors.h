#pragma once
#include <csetjmp>
#include <cstdio>

#include <png.h>

namespace svnet::io {

/// Where libpng returns to after an error, and what it said. A function that calls setjmp(back) has no local objects
/// with destructors, because longjmp would skip those.
struct PngErrors {
  std::jmp_buf back;
  char message[200] = "";

  /// For libpng, whose pointer for errors is this object.
  [[noreturn]] static void return_from(png_structp png, png_const_charp text) {
    auto* errors = static_cast<PngErrors*>(png_get_error_ptr(png));
    std::snprintf(errors->message, sizeof errors->message, "%s", text);
    std::longjmp(errors->back, 1);
  }
  /// Most warnings are about colour profiles.
  static void ignore(png_structp, png_const_charp) {}
};

}  // namespace svnet::io
