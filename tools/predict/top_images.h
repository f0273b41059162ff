#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "view/camera_pose.h"

namespace svnet {

/// A top image to predict for.
struct TopImage {
  std::string name;  ///< relative to the folder
  std::filesystem::path image;
  std::filesystem::path depth{};  ///< empty: none
  /// The views that were taken of the object, the top view among them, and their images. Empty: not known.
  std::vector<view::CameraPose> poses{};
  std::vector<std::filesystem::path> views{};
};

/// The top images of a folder. If it has subfolders, it is a data set (io/views/dataset_folder.h): the top view of each
/// pose, its depth image, and its other views. Otherwise all PNG, JPEG and WebP files in it, by name; their depth
/// images are the files of the same name in `depth`, ending in .png or .npy, if it is not empty. Throws Error that
/// names the folder if it has no image, and the file that is missing.
std::vector<TopImage> top_images(const std::filesystem::path& folder, const std::filesystem::path& depth);

}  // namespace svnet
