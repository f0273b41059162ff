#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "view/camera_pose.h"

namespace svnet {

/// A view that was taken, as --taken names it.
struct TakenPicture {
  view::CameraPose pose;
  std::filesystem::path picture;
};

/// Reads "45,60=view.png": theta and phi in degrees, and the picture. Throws Error that quotes the text.
TakenPicture taken_picture(const std::string& text);

}  // namespace svnet
