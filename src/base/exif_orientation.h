#pragma once
#include "base/enum_names.h"

namespace svnet {

/// What to do with the EXIF orientation of an image: take the pixels as they are stored, or turn them as viewers do.
enum class ExifOrientation { ignore, obey };

constexpr auto enum_table(ExifOrientation) {
  return std::to_array<EnumName<ExifOrientation>>(
      {{ExifOrientation::ignore, "ignore"}, {ExifOrientation::obey, "obey"}});
}

}  // namespace svnet
