#include "simulation/render/caster.h"

#include <algorithm>

#include <embree3/rtcore.h>

#include "base/error.h"

namespace svnet::simulation {
namespace {

static_assert(Caster::kNone == RTC_INVALID_GEOMETRY_ID);

constexpr std::size_t kPacket = 16;

/// Embree's device: one for the process, which builds on the calling thread alone, so that a tree does not depend on
/// how threads were scheduled.
RTCDevice device() {
  static const RTCDevice kDevice = [] {
    const RTCDevice created = rtcNewDevice("threads=1,user_threads=0");
    check(created != nullptr, "[render] Embree cannot be used: error ", static_cast<int>(rtcGetDeviceError(nullptr)));
    return created;
  }();
  return kDevice;
}

/// Embree's flag for coherent rays is not worth its price: it saves 1 % of a collection, and finds the other one of two
/// triangles that lie in one place.
RTCIntersectContext scattered_rays() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  return context;
}

/// Which of a packet's `count` rays there are: -1, else 0.
struct alignas(64) Valid {
  int at[kPacket];
  explicit Valid(std::size_t count) {
    for (std::size_t k = 0; k < kPacket; ++k) at[k] = k < count ? -1 : 0;
  }
};

/// Fills a packet with the rays picked[first], …; `near` and `far` are functions of a ray's index.
template <class Near, class Far>
std::size_t fill(RTCRay16& packet, const Picked& picked, std::size_t first, const Rows3& origin, const Rows3& direction,
                 Near near, Far far) {
  const std::size_t count = std::min(kPacket, picked.count - first);
  for (std::size_t k = 0; k < kPacket; ++k) {
    const std::size_t i = picked.at[first + std::min(k, count - 1)];
    packet.org_x[k] = origin.x[i], packet.org_y[k] = origin.y[i], packet.org_z[k] = origin.z[i];
    packet.dir_x[k] = direction.x[i], packet.dir_y[k] = direction.y[i], packet.dir_z[k] = direction.z[i];
    packet.tnear[k] = near(i);
    packet.tfar[k] = far(i);
    packet.time[k] = 0;
    packet.mask[k] = ~0u;
    packet.id[k] = packet.flags[k] = 0;
  }
  return count;
}

void add_to(std::vector<Caster::Cast>& rays, const RTCRay16& packet, std::size_t count, bool any) {
  for (std::size_t k = 0; k < count; ++k)
    rays.push_back({Vec3(packet.org_x[k], packet.org_y[k], packet.org_z[k]),
                    Vec3(packet.dir_x[k], packet.dir_y[k], packet.dir_z[k]), packet.tnear[k], packet.tfar[k], any});
}

}  // namespace

struct Caster::Tree {
  RTCScene scene = nullptr;
  ~Tree() {
    if (scene != nullptr) rtcReleaseScene(scene);
  }
};

Caster::Caster(const Mesh& mesh, const std::vector<Vec3>& placed) : mesh_(mesh), tree_(std::make_unique<Tree>()) {
  tree_->scene = rtcNewScene(device());
  rtcSetSceneFlags(tree_->scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(tree_->scene, RTC_BUILD_QUALITY_MEDIUM);
  const RTCGeometry geometry = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                             3 * sizeof(float), placed.size()));
  auto* corners = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), mesh.triangles.size()));
  check(points != nullptr && corners != nullptr, "[render] Embree has no memory for ", mesh.triangles.size(),
        " triangles");
  for (std::size_t i = 0; i < placed.size(); ++i) std::copy(placed[i].data(), placed[i].data() + 3, points + 3 * i);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    std::copy(mesh.triangles[i].corner.begin(), mesh.triangles[i].corner.end(), corners + 3 * i);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(tree_->scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(tree_->scene);
  const RTCError error = rtcGetDeviceError(device());
  check(error == RTC_ERROR_NONE, "[render] Embree cannot build the scene of ", mesh.triangles.size(),
        " triangles: error ", static_cast<int>(error));
}

Caster::~Caster() = default;

void Caster::nearest(const Picked& picked, const Rows3& origin, const Rows3& direction, const Row<float>& near,
                     Hits& hits) const {
  RTCIntersectContext context = scattered_rays();
  RTCRayHit16 query;
  for (std::size_t first = 0; first < picked.count; first += kPacket) {
    const std::size_t count = fill(
        query.ray, picked, first, origin, direction, [&](std::size_t i) { return near[i]; },
        [&](std::size_t i) { return hits.distance[i]; });
    if (recorded_ != nullptr) add_to(*recorded_, query.ray, count, false);
    std::fill_n(query.hit.geomID, kPacket, kNone);
    std::fill_n(query.hit.instID[0], kPacket, kNone);
    const Valid valid(count);
    rtcIntersect16(valid.at, tree_->scene, &context, &query);
    for (std::size_t k = 0; k < count; ++k) {
      if (query.hit.geomID[k] == kNone) continue;
      const std::size_t i = picked.at[first + k];
      hits.distance[i] = query.ray.tfar[k], hits.triangle[i] = query.hit.primID[k];
      hits.u[i] = query.hit.u[k], hits.v[i] = query.hit.v[k];
    }
  }
}

void Caster::close_hidden(const Picked& picked, const Rows3& origin, const Rows3& direction, const Row<float>& far,
                          Row<float>& open) const {
  RTCIntersectContext context = scattered_rays();
  RTCRay16 packet;
  for (std::size_t first = 0; first < picked.count; first += kPacket) {
    const std::size_t count = fill(
        packet, picked, first, origin, direction, [](std::size_t) { return 0.0f; },
        [&](std::size_t i) { return far[i]; });
    if (recorded_ != nullptr) add_to(*recorded_, packet, count, true);
    const Valid valid(count);
    rtcOccluded16(valid.at, tree_->scene, &context, &packet);
    for (std::size_t k = 0; k < count; ++k)
      if (packet.tfar[k] < 0) open[picked.at[first + k]] = 0;
  }
}

float Caster::passage(const Vec3& origin, const Vec3& direction, float far) const {
  RTCIntersectContext context = scattered_rays();
  float share = 1, near = 0;
  for (int surfaces = 0; surfaces < 16 && share > 0; ++surfaces) {
    RTCRayHit query{};
    query.ray.org_x = origin.x(), query.ray.org_y = origin.y(), query.ray.org_z = origin.z();
    query.ray.dir_x = direction.x(), query.ray.dir_y = direction.y(), query.ray.dir_z = direction.z();
    query.ray.tnear = near;
    query.ray.tfar = far;
    query.ray.mask = ~0u;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    if (recorded_ != nullptr) recorded_->push_back({origin, direction, near, far, false});
    rtcIntersect1(tree_->scene, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) break;
    share *= mesh_.materials[static_cast<std::size_t>(mesh_.triangles[query.hit.primID].material)].clear;
    near = query.ray.tfar + 1e-4f;
  }
  return share;
}

}  // namespace svnet::simulation
