#pragma once
#include <filesystem>

#include "base/text.h"

namespace svnet::io {

/// Whether a name ends as those of image files do: .png, .jpg, .jpeg or .webp, in upper or lower case.
inline bool is_image_name(const std::filesystem::path& name) {
  const std::string extension = lower_case(name.extension().native());
  return extension == ".png" || extension == ".jpg" || extension == ".jpeg" || extension == ".webp";
}

}  // namespace svnet::io
