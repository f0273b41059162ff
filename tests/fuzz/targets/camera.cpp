#include "io/views/camera_file.h"
#include "memory_file.h"

using namespace svnet;
using namespace svnet::fuzz;

SVNET_FUZZ_TARGET(camera) {
  accept([&] {
    const io::CameraFile camera = io::read_camera(MemoryFile(input).path());
    if (!view::intrinsics_problem(camera.intrinsics).empty()) report("intrinsics that are not valid");
    const std::string text = io::camera_json(camera);
    io::read_camera(MemoryFile({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}).path());
  });
}
