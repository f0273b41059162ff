#include "simulation/rendered_dataset.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/parallel.h"
#include "base/version.h"
#include "image/contact_sheet.h"
#include "io/files/atomic_file.h"
#include "io/files/fresh_folder.h"
#include "io/images/depth_file.h"
#include "io/images/image_file.h"
#include "io/views/camera_file.h"
#include "simulation/collected_pose.h"
#include "simulation/object_source.h"

namespace svnet {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr SheetLayout kSheet{.cell = 96, .gap = 2, .margin = 2, .text = 0, .font_size = 0.45};

/// The view from the side that shows the largest part of the object.
const Image& fullest_view(const CollectedPose& pose) {
  std::size_t best = 0;
  std::ptrdiff_t most = -1;
  for (std::size_t view = 0; view < pose.views.size(); ++view) {
    const auto& mask = pose.views[view].shot.mask;
    const auto pixels = static_cast<std::ptrdiff_t>(mask.size()) - std::count(mask.begin(), mask.end(), 0);
    if (pose.posed.views[view].phi_deg < 90 && pixels > most) most = pixels, best = view;
  }
  return pose.views[best].picture.rgb;
}

/// Writes the views into `folder` and everything else into `extra`. Returns the pose's entry of the manifest.
Json write_pose(const CollectedPose& pose, std::uint32_t attempts, Index size, const fs::path& folder,
                const fs::path& extra) {
  fs::create_directories(folder);
  fs::create_directories(extra);
  write_png(extra / "overview_background.png", pose.overview.background.rgb);
  write_depth_png(extra / "overview_background_depth.png", pose.overview.background.depth);
  write_png(extra / "overview.png", pose.overview.current.rgb);
  write_depth_png(extra / "overview_depth.png", pose.overview.current.depth);
  Json names = Json::array();
  for (std::size_t i = 0; i < pose.views.size(); ++i) {
    const CapturedView& view = pose.views[i];
    const CameraPose& from = pose.posed.views[i];
    const std::string name =
        std::to_string(std::lround(from.phi_deg)) + "_" + std::to_string(std::lround(from.theta_deg));
    write_png(folder / (name + ".png"), view.picture.rgb);
    write_depth_png(extra / (name + "_depth.png"), view.picture.depth);
    write_grey_png(extra / (name + "_mask.png"), view.shot.height, view.shot.width, view.shot.mask);
    names.push_back(name);
  }
  const LocalisedObject& object = pose.object;
  return Json{{"centre_m", {object.centre_m.x(), object.centre_m.y(), object.centre_m.z()}},
              {"length_m", object.length_m},
              {"width_m", object.width_m},
              {"height_m", object.height_m},
              {"radius_m", viewing_radius_m(view_camera(size), object.diagonal_m)},
              {"tries", attempts},
              {"views", names}};
}

/// What is kept of a pose until the end.
struct Entry {
  Json manifest;
  Image picture;        // for the contact sheet, perhaps
  std::string problem;  // why the pose is left out
};

/// The poses of all objects, which are numbered from 0: the poses of the first object, of the second, …
class RenderJob {
 public:
  RenderJob(const RenderOptions& options, const Messages& messages)
      : options_(options),
        messages_(messages),
        sources_(options.meshes.empty()
                     ? catalogue_sources(options.categories, options.objects)
                     : mesh_sources(options.meshes, options.categories, [&](const std::string& text) { say(text); })),
        entries_(sources_.size() * static_cast<std::size_t>(options.poses)),
        place_in_category_(sources_.size(), 0) {
    check(pose_count() < 0x10000, "there are ", pose_count(), " objects and poses, more than 65535; take fewer");
    for (std::size_t i = 1; i < sources_.size(); ++i)
      if (sources_[i].category == sources_[i - 1].category) place_in_category_[i] = place_in_category_[i - 1] + 1;
  }

  RenderSummary run() {
    FreshFolder folder(options_.output);
    check_meshes();
    render_poses(folder.path());
    const Index left_out =
        std::count_if(entries_.begin(), entries_.end(), [](const Entry& e) { return !e.problem.empty(); });
    check(left_out < pose_count(), "no pose was collected; the first, ", place_of(0).string(), ": ",
          entries_.front().problem);
    const Index pictures = write_summaries(folder.path());
    folder.keep();
    return {pictures, pose_count() - left_out, left_out};
  }

 private:
  void say(const std::string& line) const {
    if (messages_.line) messages_.line(line);
  }
  Index pose_count() const { return static_cast<Index>(entries_.size()); }
  std::size_t source_of(Index number) const { return static_cast<std::size_t>(number / options_.poses); }
  std::string pose_name(Index number) const { return std::to_string(number % options_.poses + 1); }
  fs::path place_of(Index number) const {
    const ObjectSource& source = sources_[source_of(number)];
    return fs::path(source.category) / source.object / pose_name(number);
  }

  /// Reads every mesh once, so that an unusable one is found before the work.
  void check_meshes() const {
    if (options_.meshes.empty()) return;
    Parallel::shared().for_chunks(static_cast<Index>(sources_.size()), 1, [&](Index i, Index, int) {
      mesh_of(sources_[static_cast<std::size_t>(i)], options_.metres_per_unit, options_.seed);
    });
  }

  void render_poses(const fs::path& folder) {
    Progress progress(messages_, "poses", pose_count());
    // Each thread renders a few poses between two reports. Each pose has its own random numbers.
    const Index block = 4 * Parallel::shared().threads();
    for (Index first = 0; first < pose_count(); first += block) {
      const Index count = std::min(block, pose_count() - first);
      Parallel::shared().for_chunks(count, 1, [&](Index i, Index, int) { render_pose(first + i, folder); });
      for (Index number = first; number < first + count; ++number)
        if (const Entry& entry = entries_[static_cast<std::size_t>(number)]; !entry.problem.empty())
          say(joined("left out: ", place_of(number).string(), ": ", entry.problem));
      progress.update(first + count);
    }
  }

  void render_pose(Index number, const fs::path& folder) {
    constexpr Index kSheetPictures = 15;  // of each category, so that the sheet fits a screen's width
    const Index pose = number % options_.poses;
    const ObjectSource& source = sources_[source_of(number)];
    const fs::path place = place_of(number);
    Entry& entry = entries_[static_cast<std::size_t>(number)];
    try {
      const Mesh mesh = mesh_of(source, options_.metres_per_unit, options_.seed);
      const PoseCollection collection =
          collect_pose(mesh, pose, options_.size, options_.seed, static_cast<std::uint32_t>(number));
      entry.problem = collection.problem;
      if (!collection.pose) return;
      entry.manifest =
          write_pose(*collection.pose, collection.attempts, options_.size, folder / place, folder / "_extra" / place);
      if (place_in_category_[source_of(number)] * options_.poses + pose < kSheetPictures)
        entry.picture = resized_to_fit(fullest_view(*collection.pose), kSheet.cell);
    } catch (const Error& error) {
      if (source.file.empty()) fail(place.string(), ": ", error.what());
      const std::string text = error.what();
      fail(text.starts_with(source.file.string()) ? text : source.file.string() + ": " + text);
    }
  }

  /// The manifest, the contact sheet and the cameras. Returns the number of pictures.
  Index write_summaries(const fs::path& folder) {
    Json manifest{{"program", joined("svnet-render ", kVersion)}, {"seed", options_.seed}, {"size_px", options_.size}};
    Index pictures = 0;
    std::vector<SheetLine> sheet;
    for (Index number = 0; number < pose_count(); ++number) {
      const ObjectSource& source = sources_[source_of(number)];
      Entry& entry = entries_[static_cast<std::size_t>(number)];
      if (!entry.problem.empty()) {
        manifest["left_out"][source.category][source.object][pose_name(number)] = std::move(entry.problem);
        continue;
      }
      pictures += static_cast<Index>(entry.manifest.at("views").size());
      manifest["poses"][source.category][source.object][pose_name(number)] = std::move(entry.manifest);
      if (sheet.empty() || sheet.back().label != source.category)
        sheet.push_back({.groups = std::vector<SheetGroup>(1), .label = source.category});
      if (!entry.picture.rgb.empty()) sheet.back().groups[0].cells.push_back({std::move(entry.picture)});
    }
    write_png(folder / "_extra" / "contact_sheet.png", contact_sheet(sheet, kSheet));
    write_atomically(folder / "manifest.json", manifest.dump(1) + "\n");
    write_atomically(folder / "_extra" / "overview_camera.json",
                     camera_json({overview_camera(), overview_camera_to_world()}));
    write_atomically(folder / "_extra" / "view_camera.json", camera_json({view_camera(options_.size), {}}));
    return pictures;
  }

  const RenderOptions& options_;
  const Messages& messages_;
  std::vector<ObjectSource> sources_;
  std::vector<Entry> entries_;
  std::vector<Index> place_in_category_;  // of each source, from 0
};

}  // namespace

RenderSummary render_dataset(const RenderOptions& options, const Messages& messages) {
  return RenderJob(options, messages).run();
}

}  // namespace svnet
