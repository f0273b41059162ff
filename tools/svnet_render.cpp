// svnet-render: a collection of views in simulation, as a robot with an RGB-D camera would make it.
#include <algorithm>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "base/parallel.h"
#include "base/text.h"
#include "base/version.h"
#include "command/command.h"
#include "command/number_check.h"
#include "io/files/atomic_file.h"
#include "io/files/fresh_folder.h"
#include "io/images/depth_file.h"
#include "io/images/image_file.h"
#include "io/views/camera_file.h"
#include "render/sources.h"
#include "simulation/catalogue.h"
#include "simulation/collection.h"
#include "simulation/picture_table.h"

namespace {

using namespace svnet;
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr Index kSheetCell_px = 96;  // of the contact sheet

struct Options {
  fs::path output, meshes;
  std::vector<std::string> categories;
  Index objects = kDesigns, poses = 3, size = 224;
  std::uint64_t seed = 1;
  std::optional<double> metres_per_unit;  // none: by the size of each mesh
};

/// Whether the object reaches the border of the picture.
bool is_cut_off(const Shot& shot) {
  const auto object_at = [&](Index y, Index x) { return shot.mask[static_cast<std::size_t>(y * shot.width + x)] != 0; };
  for (Index x = 0; x < shot.width; ++x)
    if (object_at(0, x) || object_at(shot.height - 1, x)) return true;
  for (Index y = 0; y < shot.height; ++y)
    if (object_at(y, 0) || object_at(y, shot.width - 1)) return true;
  return false;
}

/// One try at a pose.
struct Collected {
  PosedObject posed;
  Overview overview;
  LocalisedObject object;
  std::vector<TakenView> views;
};

/// A mesh and how it may lie.
struct RestingMesh {
  Mesh mesh;
  std::vector<RestingPose> resting;
};

/// An object while its poses are collected: made for the first of them, which may be any, and let go after the last.
class ObjectInWork {
 public:
  /// Makes it once. None where that throws Error, whose text is the problem then.
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

  /// After each pose; after the last of `poses` the mesh is let go.
  void count_pose(Index poses) {
    const std::lock_guard lock(mutex_);
    if (++collected_ == poses) mesh_.reset();
  }

  /// While nobody takes it.
  const std::string& problem() const { return problem_; }
  std::vector<std::string> take_lines() { return std::exchange(lines_, {}); }

 private:
  std::mutex mutex_;
  bool is_made_ = false;
  Index collected_ = 0;
  std::shared_ptr<const RestingMesh> mesh_;
  std::string problem_;
  std::vector<std::string> lines_;
};

/// Lays the object down, finds it and takes its views. Throws Error where it is not found, or not all of it.
Collected try_to_collect(const RestingMesh& object, Index pose, Index size, std::uint64_t seed, std::uint32_t number) {
  const PosedObject posed = pose_object(object.mesh, object.resting, pose, seed, number);
  const Scene scene(&object.mesh, posed.object_to_world, posed.setting);
  const Overview overview = take_overview(posed, scene, seed, number);
  Collected result{
      posed,
      overview,
      localise(overview_camera(), overview_camera_to_world(), {overview.background.rgb, overview.background.depth},
               {overview.current.rgb, overview.current.depth}),
      {}};
  for (std::size_t view = 0; view < posed.views.size(); ++view) {
    result.views.push_back(take_view(posed, scene, result.object, size, seed, number, view));
    check(!is_cut_off(result.views.back().shot), "the object is cut off in a view");
    result.views.back().shot.radiance = {};  // the picture is taken
  }
  return result;
}

/// The view, from the side, that shows most of the object.
const Image& fullest_view(const Collected& pose) {
  std::size_t best = 0;
  std::ptrdiff_t most = -1;
  for (std::size_t view = 0; view < pose.views.size(); ++view) {
    const auto& mask = pose.views[view].shot.mask;
    const auto pixels = static_cast<std::ptrdiff_t>(mask.size()) - std::count(mask.begin(), mask.end(), 0);
    if (pose.posed.views[view].phi_deg < 90 && pixels > most) most = pixels, best = view;
  }
  return pose.views[best].picture.rgb;
}

/// What is kept of a pose: the manifest's entry, and a picture for the contact sheet. Or why there is none.
struct Entry {
  Json manifest;
  Image picture;
  std::string problem;
};

/// Collects a pose, again under another light and elsewhere where it fails, as a robot's keeper would: its views into
/// `folder`, the rest into `extra`. After some failures it leaves the pose out, so that one that the camera cannot see
/// does not cost the others.
Entry collect(const RestingMesh& object, Index pose, const Options& options, std::uint32_t number,
              const fs::path& folder, const fs::path& extra) {
  constexpr std::uint32_t kTries = 16;
  std::optional<Collected> found;
  std::uint32_t tries = 0;
  while (!found) {
    try {
      found = try_to_collect(object, pose, options.size, options.seed * 1009 + tries++, number);
    } catch (const Error& error) {
      if (tries == kTries) return {{}, {}, joined("not collected in ", kTries, " tries: ", error.what())};
    }
  }
  fs::create_directories(folder);
  fs::create_directories(extra);
  write_png(extra / "overview_background.png", found->overview.background.rgb);
  write_depth_png(extra / "overview_background_depth.png", found->overview.background.depth);
  write_png(extra / "overview.png", found->overview.current.rgb);
  write_depth_png(extra / "overview_depth.png", found->overview.current.depth);
  Json names = Json::array();
  for (std::size_t view = 0; view < found->views.size(); ++view) {
    const TakenView& taken = found->views[view];
    const Pose& from = found->posed.views[view];
    const std::string name =
        std::to_string(std::lround(from.phi_deg)) + "_" + std::to_string(std::lround(from.theta_deg));
    write_png(folder / (name + ".png"), taken.picture.rgb);
    write_depth_png(extra / (name + "_depth.png"), taken.picture.depth);
    write_grey_png(extra / (name + "_mask.png"), taken.shot.height, taken.shot.width, taken.shot.mask);
    names.push_back(name);
  }
  const LocalisedObject& place = found->object;
  return {Json{{"centre_m", {place.centre_m.x(), place.centre_m.y(), place.centre_m.z()}},
               {"length_m", place.length_m},
               {"width_m", place.width_m},
               {"height_m", place.height_m},
               {"radius_m", viewing_radius_m(view_camera(options.size), place.diagonal_m)},
               {"tries", tries},
               {"views", names}},
          resized_to_fit(fullest_view(*found), kSheetCell_px),
          {}};
}

/// The object of a source. Throws Error that begins with its file's name.
RestingMesh object_of(const Source& source, const Options& options, std::vector<std::string>& lines) {
  try {
    RestingMesh object{
        mesh_of(source, options.metres_per_unit, options.seed, [&](const std::string& line) { lines.push_back(line); }),
        {}};
    object.resting = resting_poses(object.mesh);
    return object;
  } catch (const Error& error) {
    const std::string text = error.what(), file = source.file.string();
    fail(text.starts_with(file) ? text : file + ": " + text);
  }
}

/// "; 2 of 12 objects left out (mug/a, mug/b)", or nothing.
std::string left_out_text(const std::vector<Source>& sources, std::vector<ObjectInWork>& objects) {
  constexpr std::size_t kNamed = 10;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < sources.size(); ++i)
    if (!objects[i].problem().empty()) names.push_back(sources[i].category + "/" + sources[i].object);
  if (names.empty()) return "";
  const std::size_t count = names.size();
  if (count > kNamed) names.resize(kNamed), names.emplace_back("...");
  return joined("; ", count, " of ", sources.size(), " objects left out (", joined_with(", ", names), ")");
}

void render(const Options& options, Console& console) {
  constexpr Index kSheetPictures = 15;  // of each category, so that the sheet fits a screen's width
  const std::vector<Source> sources =
      options.meshes.empty()
          ? catalogue_sources(options.categories, options.objects)
          : mesh_sources(options.meshes, options.categories, [&](const std::string& line) { console.line(line); });
  const auto total = static_cast<Index>(sources.size()) * options.poses;
  check(total < 0x10000, "there are ", total, " objects and poses, more than 65535; take fewer");
  FreshFolder folder(options.output);
  std::vector<Index> place_in_category(sources.size(), 0);
  for (std::size_t i = 1; i < sources.size(); ++i)
    if (sources[i].category == sources[i - 1].category) place_in_category[i] = place_in_category[i - 1] + 1;
  const auto place_of = [&](Index number) {
    const Source& source = sources[static_cast<std::size_t>(number / options.poses)];
    return fs::path(source.category) / source.object / std::to_string(number % options.poses + 1);
  };
  const auto object_number = [&](Index number) { return static_cast<std::size_t>(number / options.poses); };
  std::vector<Entry> entries(static_cast<std::size_t>(total));
  std::vector<ObjectInWork> objects(sources.size());
  Progress progress(console.messages(), "poses", total);
  // A few poses of each thread between two reports. Each is a piece of work of its own, with its own random numbers.
  const Index block = 4 * Parallel::shared().threads();
  for (Index first = 0; first < total; first += block) {
    const Index count = std::min(block, total - first);
    Parallel::shared().for_chunks(count, 1, [&](Index begin, Index, int) {
      const Index number = first + begin, pose = number % options.poses;
      const Source& source = sources[object_number(number)];
      const fs::path where = place_of(number);
      ObjectInWork& in_work = objects[object_number(number)];
      auto object = in_work.take([&](std::vector<std::string>& lines) { return object_of(source, options, lines); });
      Entry& entry = entries[static_cast<std::size_t>(number)];
      if (object == nullptr) return;
      entry = collect(*object, pose, options, static_cast<std::uint32_t>(number), folder.path() / where,
                      folder.path() / "_extra" / where);
      if (place_in_category[object_number(number)] * options.poses + pose >= kSheetPictures) entry.picture = {};
      object.reset();
      in_work.count_pose(options.poses);
    });
    for (Index number = first; number < first + count; ++number) {
      ObjectInWork& object = objects[object_number(number)];
      Entry& entry = entries[static_cast<std::size_t>(number)];
      for (const std::string& line : object.take_lines()) console.line(line);
      if (!object.problem().empty()) {
        entry.problem = object.problem();
        if (number % options.poses == 0 && sources.size() > 1) console.line("left out: " + entry.problem);
      } else if (!entry.problem.empty()) {
        console.line(joined("left out: ", place_of(number).string(), ": ", entry.problem));
      }
    }
    progress.update(first + count);
  }
  const auto left_out =
      std::count_if(entries.begin(), entries.end(), [](const Entry& e) { return !e.problem.empty(); });
  const auto poses_left_out =
      left_out - options.poses * std::count_if(objects.begin(), objects.end(),
                                               [](const ObjectInWork& object) { return !object.problem().empty(); });
  const std::string objects_left_out = left_out_text(sources, objects);
  if (left_out == total) {
    const std::string& problem = entries.front().problem;
    if (!objects.front().problem().empty())
      fail(problem, sources.size() > 1 ? joined("; none of the ", sources.size(), " objects was collected") : "");
    fail("no pose was collected; the first, ", place_of(0).string(), ": ", problem);
  }

  Json manifest{{"program", joined("svnet-render ", kVersion)}, {"seed", options.seed}, {"size_px", options.size}};
  Index pictures = 0;
  std::vector<PictureRow> sheet;
  for (Index number = 0; number < total; ++number) {
    const Source& source = sources[static_cast<std::size_t>(number / options.poses)];
    Entry& entry = entries[static_cast<std::size_t>(number)];
    const std::string pose = std::to_string(number % options.poses + 1);
    if (!entry.problem.empty()) {
      manifest["left_out"][source.category][source.object][pose] = std::move(entry.problem);
      continue;
    }
    pictures += static_cast<Index>(entry.manifest.at("views").size());
    manifest["poses"][source.category][source.object][pose] = std::move(entry.manifest);
    if (sheet.empty() || sheet.back().label != source.category) sheet.push_back({source.category, {}});
    if (!entry.picture.rgb.empty()) sheet.back().pictures.push_back(std::move(entry.picture));
  }
  write_png(folder.path() / "_extra" / "contact_sheet.png", picture_table(sheet, kSheetCell_px));
  write_atomically(folder.path() / "manifest.json", manifest.dump(1) + "\n");
  write_atomically(folder.path() / "_extra" / "overview_camera.json",
                   camera_json({overview_camera(), overview_camera_to_world()}));
  write_atomically(folder.path() / "_extra" / "view_camera.json", camera_json({view_camera(options.size), {}}));
  folder.keep();
  console.result(joined(pictures, " pictures of ", total - left_out, " poses in ", options.output.string(),
                        objects_left_out, poses_left_out > 0 ? joined("; ", poses_left_out, " left out") : "",
                        left_out > 0 ? ", as manifest.json tells" : ""));
}

}  // namespace

int main(int argc, char** argv) {
  Command command("svnet-render",
                  "Collects views of household objects and tools in simulation, as a robot with an RGB-D camera would: "
                  "each object rests on a table, is localised in an overview, and is seen from the paper's viewpoints. "
                  "Writes CATEGORY/OBJECT/POSE/PHI_THETA.png, manifest.json, and under _extra/ a contact sheet, the "
                  "overviews, depth (16-bit PNG, millimetres) and masks. The same seed gives the same pictures.",
                  "svnet-render --output runs/rendered\n"
                  "svnet-render --output runs/tools --categories hammer,wrench,pliers --objects 3 --size 160\n"
                  "svnet-render --output runs/mine --meshes meshes --unit 0.001");
  Options options;
  std::string categories;
  CLI::App& app = command.app();
  app.add_option("--output", options.output, "The folder to make")->required();
  app.add_option("--categories", options.categories,
                 "Some categories, with commas between them (all " + std::to_string(catalogue_names().size()) + ": " +
                     joined_with(", ", catalogue_names()) + ")")
      ->delimiter(',');
  app.add_option("--objects", options.objects, "Objects of each category (5; further ones are mixtures of the first 5)")
      ->check(CLI::Range(1, 999));
  app.add_option("--poses", options.poses, "Poses of each object (3)")->check(CLI::Range(1, 99));
  app.add_option("--size", options.size, "Height and width of the pictures in pixels (224)")
      ->check(CLI::Range(32, 2048));
  app.add_option("--seed", options.seed, "Seed of poses, tables, lights, noise and missing views (1)")
      ->check(CLI::Range(Index{0}, Index{1} << 53));
  auto* meshes = app.add_option("--meshes", options.meshes,
                                "Your own objects instead: a folder with CATEGORY/NAME.obj (or .ply, .stl, .glb, "
                                ".gltf), or CATEGORY/NAME/ with a mesh in it. A mesh that cannot be used is left out "
                                "and named; the exit status is 1 only if no object is collected");
  app.add_option("--unit", options.metres_per_unit,
                 "Metres per unit of all meshes; objects may be 1 mm to 1 m long (default: metres; centimetres or "
                 "millimetres for a mesh that only makes sense so, in a line of its own)")
      ->check(positive_number())
      ->needs(meshes);
  return command.run(argc, argv, [&](Console& console) { render(options, console); });
}
