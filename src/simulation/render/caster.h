#pragma once
#include <memory>
#include <vector>

#include "simulation/render/rays.h"

namespace svnet::simulation {

/// Rays against the triangles of a mesh, by Embree. Thread-safe, and the number of threads does not change a bit of
/// what it finds.
class Caster {
 public:
  /// `points`: those of the mesh, in the world. Throws Error if Embree has no memory for them.
  Caster(const Mesh&, const std::vector<Vec3>& points);
  ~Caster();
  Caster(const Caster&) = delete;
  Caster& operator=(const Caster&) = delete;

  struct Hits {
    Row<float> distance, u, v;
    Row<std::uint32_t> triangle;  // kNone: none
  };
  static constexpr std::uint32_t kNone = ~0u;

  /// Finds the nearest triangle of the picked rays between near[i] and hits.distance[i], and sets their hits. The hits
  /// of a ray that meets none stay as they are.
  void nearest(const Picked&, const Rows3& origin, const Rows3& direction, const Row<float>& near, Hits&) const;

  /// Sets open[i] to 0 for the picked rays that meet a triangle between 0 and far[i].
  void close_hidden(const Picked&, const Rows3& origin, const Rows3& direction, const Row<float>& far,
                    Row<float>& open) const;

  /// A ray as it was cast: towards any triangle between near and far, or the nearest one.
  struct Cast {
    Vec3 origin, direction;
    float near, far;
    bool any;
  };
  /// For benchmarks, on one thread: adds every ray that is cast from now on. Null: none.
  void record(std::vector<Cast>* rays) { recorded_ = rays; }

  /// The share of light that passes the materials between 0 and `far` along a ray, of at most 16 surfaces.
  float passage(const Vec3& origin, const Vec3& direction, float far) const;

 private:
  struct Tree;
  const Mesh& mesh_;
  std::unique_ptr<Tree> tree_;
  std::vector<Cast>* recorded_ = nullptr;
};

}  // namespace svnet::simulation
