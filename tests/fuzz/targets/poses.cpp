#include "io/views/pose_list_file.h"
#include "memory_file.h"
#include "view/camera_pose.h"

using namespace svnet;
using namespace svnet::fuzz;

SVNET_FUZZ_TARGET(poses) {
  accept([&] {
    for (const view::CameraPose& pose : io::read_pose_list(MemoryFile(input).path()))
      if (!view::pose_problem(pose).empty()) report("a pose that is out of range");
  });
}
