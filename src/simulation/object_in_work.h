#pragma once
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/index.h"
#include "simulation/mesh.h"
#include "simulation/resting.h"

namespace svnet::simulation {

/// A mesh and how it may lie on a table.
struct RestingMesh {
  Mesh mesh;
  std::vector<RestingPose> resting;
};

/// An object while its poses are rendered, by several threads: read at the first pose, whichever that is, and released
/// after the last.
class ObjectInWork {
 public:
  /// Makes it at the first call: make(lines) returns a RestingMesh and may add warnings to `lines`. Null if that threw
  /// Error, whose text is the problem then.
  template <class Make>
  std::shared_ptr<const RestingMesh> take(Make make) {
    const std::lock_guard lock(mutex_);
    if (!is_made_) {
      is_made_ = true;
      try {
        mesh_ = std::make_shared<const RestingMesh>(make(lines_));
      } catch (const Error& error) {
        problem_ = error.what();
      }
    }
    return mesh_;
  }

  /// To be called after each pose; after the last of `poses` the mesh is released.
  void count_pose(Index poses) {
    const std::lock_guard lock(mutex_);
    if (++rendered_ == poses) mesh_.reset();
  }

  // While no thread takes it:
  const std::string& problem() const { return problem_; }
  std::vector<std::string> take_lines() { return std::exchange(lines_, {}); }

 private:
  std::mutex mutex_;
  bool is_made_ = false;
  Index rendered_ = 0;
  std::shared_ptr<const RestingMesh> mesh_;
  std::string problem_;
  std::vector<std::string> lines_;
};

}  // namespace svnet::simulation
