// JPEG, PNG and WebP, with their EXIF orientation.
#include "fuzz_target.h"
#include "image/oriented.h"
#include "io/images/image_codecs.h"
#include "io/images/image_file.h"

using namespace svnet;
using namespace svnet::fuzz;

SVNET_FUZZ_TARGET(picture) {
  const int orientation = io::exif_orientation(input);
  if (orientation < 1 || orientation > 8) report("an EXIF orientation that is none");
  accept([&] {
    io::StoredImage stored = io::decode_stored_image("input", input);
    if (stored.image.rgb.size() != static_cast<std::size_t>(3 * stored.image.height * stored.image.width))
      report("pixels are missing");
    oriented(std::move(stored.image), stored.exif_orientation);
  });
}
