#pragma once
#include <span>

#include "base/index.h"
#include "view/camera_pose.h"

namespace svnet::sorting {

/// How long a move of the camera takes: start_s + angle / speed, by the angle between the two viewing directions.
struct MoveTime {
  double start_s = 1.5;         ///< to plan, start, stop and take a picture
  double speed_deg_per_s = 60;  ///< around the object
};

/// What the camera does for some objects.
struct CameraWork {
  Index moves = 0;
  double seconds = 0;

  CameraWork& operator+=(const CameraWork& other) {
    moves += other.moves;
    seconds += other.seconds;
    return *this;
  }
};

/// The work for one object: the camera begins above it, and sees it from these poses in turn. To stay is no move. The
/// way to the next object is not counted: every selector needs it.
CameraWork camera_work(std::span<const view::CameraPose> poses, const MoveTime& time);

}  // namespace svnet::sorting
