#include "mesh_textures.h"

#include "base/error.h"
#include "base/text.h"
#include "io/images/texture_image.h"

namespace svnet::simulation {

std::optional<int> MeshTextures::file(const std::string& reference) {
  const auto [known, is_new] = by_reference_.try_emplace(reference);
  if (!is_new) return known->second;
  const auto path = files_.find("texture", reference);
  if (!path) {
    files_.warn("texture '" + printable(reference) + "' is missing; the object is rendered without it");
    return std::nullopt;
  }
  const auto [same, is_unread] = by_path_.try_emplace(path->string());
  if (is_unread) {
    try {
      const std::string contents = files_.contents(*path);
      check(!contents.empty(), path->string(), ": is empty, expected an image (PNG, JPEG or WebP)");
      same->second = draft_.add(io::decode_texture(
          path->string(), {reinterpret_cast<const std::uint8_t*>(contents.data()), contents.size()}));
    } catch (const Error& error) {
      fail(files_.name(), ": texture ", error.what());
    }
  }
  return known->second = same->second;
}

int MeshTextures::embedded(const std::string& reference, io::Bytes contents) {
  const auto [known, is_new] = by_reference_.try_emplace(reference);
  if (is_new)
    known->second =
        draft_.add(io::decode_texture(files_.name() + ": texture '" + printable(reference) + "'", contents));
  return *known->second;
}

}  // namespace svnet::simulation
