#pragma once
#include "base/error.h"
#include "frame/frame_choice.h"

namespace svnet::frame {

/// What a frame means, for people: "azimuths count from the object's own axis".
inline const char* words_of(FrameChoice frame) {
  switch (frame) {
    case FrameChoice::camera:
      return "azimuths count from the camera's, as the image was taken";
    case FrameChoice::axis:
      return "azimuths count from the object's own axis";
    case FrameChoice::turned:
      return "the top image is turned to each candidate camera";
    case FrameChoice::turned_axis:
      return "the top image is turned to each candidate camera, and the object's axis is known";
  }
  fail("[frame] there is no such frame");
}

}  // namespace svnet::frame
