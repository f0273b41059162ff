// svnet_collection_stages [CATEGORY...]: where the processor time of a simulated collection goes, on one thread, and
// how near its rays come to Embree's own speed. One pose of an object of each category (all), as svnet-render makes it;
// the rays of every fifth view are recorded and cast again by Embree alone, one by one and in packets of 16.
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <embree3/rtcore.h>

#include "base/cpu.h"
#include "base/error.h"
#include "io/files/fresh_folder.h"
#include "io/images/depth_file.h"
#include "io/images/image_codecs.h"
#include "localise/localise.h"
#include "simulation/catalogue.h"
#include "simulation/collection.h"

using namespace svnet;
using namespace svnet::simulation;

namespace {

using Rays = std::vector<Caster::Cast>;

constexpr std::size_t kPacket = 16;

/// Processor time of the process. Other programs on the machine change it little.
double processor_s() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}
double seconds_since(double start) { return processor_s() - start; }

/// Seconds by stage, in the order of first use.
class Stages {
 public:
  template <class Work>
  auto time(const std::string& stage, Work work) {
    const double start = processor_s();
    auto result = work();
    seconds_.try_emplace(stage, std::pair(seconds_.size(), 0.0)).first->second.second += seconds_since(start);
    return result;
  }
  void print(double poses) const {
    double sum = 0;
    for (const auto& [stage, value] : seconds_) sum += value.second;
    for (std::size_t place = 0; place < seconds_.size(); ++place)
      for (const auto& [stage, value] : seconds_)
        if (value.first == place)
          std::printf("| %s | %.1f | %.1f %% |\n", stage.c_str(), 1e3 * value.second / poses, 100 * value.second / sum);
    std::printf("| all | %.1f | |\n", 1e3 * sum / poses);
  }

 private:
  std::map<std::string, std::pair<std::size_t, double>> seconds_;
};

/// Embree's scene of the object, built as the renderer builds it.
class Alone {
 public:
  explicit Alone(const PosedObject& posed) : device_(rtcNewDevice("threads=1,user_threads=0")) {
    scene_ = rtcNewScene(device_);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    const Mesh& mesh = *posed.mesh;
    auto* points = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, mesh.points.size()));
    auto* corners = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, mesh.triangles.size()));
    check(points != nullptr && corners != nullptr, "Embree has no memory");
    for (const Vec3& local : mesh.points)
      for (const double x : (posed.object_to_world * local.cast<double>()).eval()) *points++ = static_cast<float>(x);
    for (const Mesh::Triangle& triangle : mesh.triangles)
      for (const std::uint32_t corner : triangle.corner) *corners++ = corner;
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  ~Alone() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  Alone(const Alone&) = delete;
  Alone& operator=(const Alone&) = delete;

  /// Seconds for the rays one by one.
  double cast_singly(const Rays& rays) const {
    std::vector<RTCRayHit> queries(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i) {
      RTCRayHit& query = queries[i] = {};
      const Caster::Cast& ray = rays[i];
      query.ray.org_x = ray.origin.x(), query.ray.org_y = ray.origin.y(), query.ray.org_z = ray.origin.z();
      query.ray.dir_x = ray.direction.x(), query.ray.dir_y = ray.direction.y(), query.ray.dir_z = ray.direction.z();
      query.ray.tnear = ray.near, query.ray.tfar = ray.far, query.ray.mask = ~0u;
      query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    }
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    const double start = processor_s();
    for (std::size_t i = 0; i < rays.size(); ++i)
      if (rays[i].any)
        rtcOccluded1(scene_, &context, &queries[i].ray);
      else
        rtcIntersect1(scene_, &context, &queries[i]);
    return seconds_since(start);
  }

  /// Seconds for the rays in packets, those of one kind that follow each other.
  double cast_in_packets(const Rays& rays) const {
    struct Packet {
      RTCRayHit16 query;
      alignas(64) int valid[kPacket];
      bool any;
    };
    std::vector<Packet> packets;
    for (std::size_t first = 0, count = 0; first < rays.size(); first += count) {
      for (count = 1; count < kPacket && first + count < rays.size() && rays[first + count].any == rays[first].any;)
        ++count;
      Packet& packet = packets.emplace_back();
      packet.any = rays[first].any;
      for (std::size_t k = 0; k < kPacket; ++k) {
        const Caster::Cast& ray = rays[first + std::min(k, count - 1)];
        RTCRay16& to = packet.query.ray;
        to.org_x[k] = ray.origin.x(), to.org_y[k] = ray.origin.y(), to.org_z[k] = ray.origin.z();
        to.dir_x[k] = ray.direction.x(), to.dir_y[k] = ray.direction.y(), to.dir_z[k] = ray.direction.z();
        to.tnear[k] = ray.near, to.tfar[k] = ray.far, to.time[k] = 0, to.mask[k] = ~0u, to.id[k] = to.flags[k] = 0;
        packet.query.hit.geomID[k] = packet.query.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
        packet.valid[k] = k < count ? -1 : 0;
      }
    }
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    const double start = processor_s();
    for (Packet& packet : packets)
      if (packet.any)
        rtcOccluded16(packet.valid, scene_, &context, &packet.query.ray);
      else
        rtcIntersect16(packet.valid, scene_, &context, &packet.query);
    return seconds_since(start);
  }

 private:
  RTCDevice device_;
  RTCScene scene_ = nullptr;
};

struct Totals {
  Stages stages;
  double poses = 0;
  // Of the recorded views: their rays, and the seconds of the renderer and of Embree alone.
  double rays = 0, recorded_s = 0, singly_s = 0, packets_s = 0;
};

void collect(const Mesh& mesh, const std::vector<RestingPose>& resting, std::uint32_t number, io::FreshFolder& folder,
             Totals& totals) {
  constexpr std::uint64_t kSeed = 1009;
  constexpr Index kSize = 224;
  constexpr std::size_t kRecorded = 5;  // the rays of every fifth view
  Stages& stages = totals.stages;
  const PosedObject posed = pose_object(mesh, resting, 0, kSeed, number);
  const std::unique_ptr<Scene> made = stages.time(
      "trees of triangles", [&] { return std::make_unique<Scene>(&mesh, posed.object_to_world, posed.setting); });
  Scene& scene = *made;
  const Scene empty(nullptr, posed.object_to_world, posed.setting);
  const auto overview_shot = [&](const Scene& seen, std::uint32_t image) {
    return seen.shoot(overview_camera(), overview_camera_to_world(), {kSeed, number << 16 | image}, 2);
  };
  const auto sensed = [&](const Shot& shot, std::uint32_t image) {
    return stages.time("sensor", [&] { return sensor_image(shot, {kSeed, number << 16 | image}); });
  };
  const auto save = [&](const std::string& name, const RgbdImage& image) {
    const std::string rgb =
        stages.time("PNG of colours", [&] { return io::encoded_png(name, image.rgb, io::PngContent::photograph); });
    const std::string depth = stages.time("PNG of depth", [&] { return io::encoded_depth_png(name, image.depth); });
    stages.time("writing", [&] { return folder.add(name + ".png", rgb), folder.add(name + "_depth.png", depth), 0; });
  };
  const std::string place = std::to_string(number) + "/";
  const RgbdImage background =
      sensed(stages.time("rendering: empty tables", [&] { return overview_shot(empty, 0xfffe); }), 0xfffe);
  const RgbdImage current =
      sensed(stages.time("rendering: overviews", [&] { return overview_shot(scene, 0xfffd); }), 0xfffd);
  const localise::LocalisedObject object = stages.time("localisation", [&] {
    return localise::locate(overview_camera(), overview_camera_to_world(), {background.rgb, background.depth},
                            {current.rgb, current.depth});
  });
  save(place + "overview_background", background);
  save(place + "overview", current);
  const view::Intrinsics camera = view_camera(kSize);
  Rays rays;
  for (std::size_t view = 0; view < posed.views.size(); ++view) {
    const Eigen::Isometry3d from = look_at(posed.views[view], viewing_radius_m(camera, object.diagonal_m),
                                           object.centre_m, view::CameraFrame::optical);
    const auto image = static_cast<std::uint32_t>(view);
    const auto shoot = [&] { return scene.shoot(camera, from, {kSeed, number << 16 | image}, 4); };
    const Shot shot = stages.time("rendering: views", shoot);
    save(place + std::to_string(view), sensed(shot, image));
    const std::string mask =
        stages.time("PNG of masks", [&] { return io::encoded_grey_png(place, shot.height, shot.width, shot.mask); });
    stages.time("writing", [&] { return folder.add(place + std::to_string(view) + "_mask.png", mask), 0; });
    if (view % kRecorded != 0) continue;
    const double start = processor_s();  // the same shot again, with its rays
    shoot();
    totals.recorded_s += seconds_since(start);
    scene.caster()->record(&rays);
    shoot();
    scene.caster()->record(nullptr);
  }
  const Alone alone(posed);
  totals.rays += static_cast<double>(rays.size());
  totals.singly_s += alone.cast_singly(rays);
  totals.packets_s += alone.cast_in_packets(rays);
  ++totals.poses;
}

}  // namespace

int main(int argc, char** argv) try {
  cap_from_environment();
  std::vector<std::string> categories(argv + 1, argv + argc);
  if (categories.empty()) categories = catalogue_names();
  Totals totals;
  const auto output = std::filesystem::temp_directory_path() / "svnet_collection_stages";
  io::FreshFolder folder(output);
  for (std::uint32_t number = 0; number < categories.size(); ++number) {
    const Mesh mesh = totals.stages.time("meshes", [&] { return catalogue_object(categories[number], 0, 1); });
    const auto resting = totals.stages.time("resting poses", [&] { return resting_poses(mesh); });
    collect(mesh, resting, number, folder, totals);
  }
  totals.stages.time("syncing", [&] { return folder.keep(), 0; });
  std::filesystem::remove_all(output);
  std::printf("%.0f poses, each with an object of its own\n| stage | ms per pose | share |\n| --- | --- | --- |\n",
              totals.poses);
  totals.stages.print(totals.poses);
  std::printf(
      "\n%.2f million rays of recorded views. Million rays a second:\n| Embree alone, one by one | %.1f |\n"
      "| Embree alone, packets of 16 | %.1f |\n| the renderer, all its work | %.1f |\n",
      1e-6 * totals.rays, 1e-6 * totals.rays / totals.singly_s, 1e-6 * totals.rays / totals.packets_s,
      1e-6 * totals.rays / totals.recorded_s);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
