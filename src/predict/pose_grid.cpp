#include "predict/pose_grid.h"

namespace svnet {

std::vector<Pose> paper_grid() {
  std::vector<Pose> poses;
  for (int phi_deg = 45; phi_deg <= 75; phi_deg += 15)
    for (int theta_deg = 0; theta_deg < 360; theta_deg += 45)
      if (theta_deg != 270) poses.push_back({static_cast<double>(theta_deg), static_cast<double>(phi_deg)});
  poses.push_back({90, 90});
  return poses;
}

}  // namespace svnet
