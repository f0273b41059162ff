#pragma once
#include <Eigen/Geometry>

#include "simulation/render/rays.h"
#include "simulation/setting.h"
#include "view/camera.h"

// The arithmetic of many rays at once, in the widest vectors of the machine. Each kernel has the bits of the same
// formulas for one ray after another, on every instruction set.
namespace svnet::simulation {

/// Rays through pixels (x, y) of a camera with this rotation to the world, of one of the samples of a pixel. Sample 0
/// goes through the centre; the others go through random places of the pixel's quarters, by a word of each pixel.
struct CameraRays {
  Rows3 direction;
  Row<float> length;  // of the ray's vector with z = 1 in the camera's frame
};
void make_camera_rays(const view::Intrinsics&, const Eigen::Matrix3f& rotation, std::size_t count,
                      const Row<std::uint32_t>& x, const Row<std::uint32_t>& y, std::uint32_t sample,
                      const Row<std::uint32_t>& word, CameraRays&);

/// distance[i]: to the table along the ray, infinite if it is not beyond near[i].
void find_table(std::size_t count, const Rows3& origin, const Rows3& direction, const Row<float>& near,
                Row<float>& distance);

/// meets[i]: whether the ray enters the box before far[i], 1 or 0.
void test_box(std::size_t count, const Eigen::AlignedBox3f&, const Rows3& origin, const Rows3& direction,
              const Row<float>& far, Row<float>& meets);

/// Four numbers in [0, 1) of each ray from four random words, each in another of `samples` equal parts for each sample
/// of a pixel (a Latin hypercube, with strides that are coprime to powers of two), which takes most of the noise out of
/// shadows. `shift` has a random byte for each number; `samples` is a power of two.
void stratify(std::size_t count, std::uint32_t sample, std::uint32_t samples, const Row<std::uint32_t>& shift,
              const Row<std::uint32_t> (&words)[4], Row<float> (&numbers)[4]);

/// Where rays met a surface.
struct Surfaces {
  Rows3 point, normal, geometric, colour;
  Row<float> clear;
};

/// Points of the table along rays, with its normals.
void place_on_table(std::size_t count, const Rows3& origin, const Rows3& direction, const Row<float>& distance,
                    Surfaces&);

/// A lamp as rays need it.
struct LampPlace {
  explicit LampPlace(const Lamp&);
  Vec3 place_m, irradiance;
  Vec3 towards;        // from the origin, of length 1
  Vec3 across, along;  // axes of its disc
  float radius_m;
};

/// Two rays of each surface: to a place on a lamp, and into the room. lit[i], open[i]: 1 if there is light unless a
/// triangle hides it, 0 if the surface is turned away.
struct LightRays {
  Rows3 start;
  Rows3 to_lamp, to_room;
  Row<float> lamp_distance, facing, lit, open;
};
/// numbers: of stratify; sine and cosine: of 2π numbers[1] in the lamp's disc, and of 2π numbers[3] around the normal.
struct Angles {
  Row<float> lamp_sine, lamp_cosine, room_sine, room_cosine;
};
void make_light_rays(std::size_t count, const Surfaces&, const LampPlace&, const Row<float> (&numbers)[4],
                     const Angles&, LightRays&);

/// Light that arrives at surfaces, and what leaves them without mirroring.
struct Shading {
  Rows3 arriving, scattered;
  Row<float> cosine, edge,
      seen;             // towards where the ray came from; Fresnel's rest; the open share of the mirrored room
  Row<float> shadowed;  // 1 if the lamp or the room is hidden, even in part
};
/// One of the lamps lights each sample.
void shade(std::size_t count, const Surfaces&, const Rows3& direction, const LightRays&, const LampPlace&,
           const Setting&, const Vec3& table_mean, Shading&);

/// Normals and places of surfaces of an object: see finish_object_surfaces.
struct Corners {
  Rows3 a, b, c, normal_a, normal_b, normal_c;
  Row<float> u, v;
};
/// Turns the normals of triangles into the world and towards the rays. local: the points in the object's frame.
void finish_object_surfaces(std::size_t count, const Corners&, const Eigen::Matrix3f& to_world_rotation,
                            const Eigen::Matrix4f& to_local, const Rows3& origin, const Rows3& direction,
                            const Row<float>& distance, Surfaces&, Rows3& local);

}  // namespace svnet::simulation
