// Grids of poses for callers that have none.
#include "guard.h"
#include "view/pose_grid.h"

svnet_status svnet_grid(int32_t theta_steps, int32_t phi_steps, double lowest_phi_deg, double highest_phi_deg,
                        double* poses_deg, size_t capacity, size_t* count) {
  using namespace svnet;
  return guarded(SVNET_INVALID_ARGUMENT, [&] {
    check_given(count, "svnet_grid", "count");
    const view::GridSpec spec{theta_steps, phi_steps, lowest_phi_deg, highest_phi_deg};
    const auto size = static_cast<std::size_t>(view::grid_size(spec));
    if (poses_deg != nullptr) {
      check(capacity >= size, "[svnet_grid] the grid has ", size, " poses, the buffer has room for ", capacity);
      double* out = poses_deg;
      view::for_each_pose(spec, [&](const view::CameraPose& pose) {
        *out++ = pose.theta_deg;
        *out++ = pose.phi_deg;
      });
    }
    *count = size;
  });
}
