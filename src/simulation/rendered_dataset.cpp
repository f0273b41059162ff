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
#include "io/images/image_codecs.h"
#include "io/images/image_file.h"
#include "io/views/camera_file.h"
#include "simulation/collected_pose.h"
#include "simulation/object_in_work.h"
#include "simulation/object_source.h"

namespace svnet::simulation {
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
  return pose.views[best].image.rgb;
}

/// Writes the views into `place` of the folder and everything else into `place` of its _extra. Returns the pose's entry
/// of the manifest.
Json write_pose(const CollectedPose& pose, std::uint32_t attempts, Index size, io::FreshFolder& folder,
                const fs::path& place) {
  const fs::path extra = "_extra" / place;
  const auto add_image = [&](const fs::path& path, const Image& image) {
    folder.add(path, io::encoded_png(path.string(), image, io::PngContent::photograph));
  };
  const auto add_depth = [&](const fs::path& path, const DepthImage& depth) {
    folder.add(path, io::encoded_depth_png(path.string(), depth));
  };
  add_image(extra / "overview_background.png", pose.overview.background.rgb);
  add_depth(extra / "overview_background_depth.png", pose.overview.background.depth);
  add_image(extra / "overview.png", pose.overview.current.rgb);
  add_depth(extra / "overview_depth.png", pose.overview.current.depth);
  Json names = Json::array();
  for (std::size_t i = 0; i < pose.views.size(); ++i) {
    const CapturedView& view = pose.views[i];
    const view::CameraPose& from = pose.posed.views[i];
    const std::string name =
        std::to_string(std::lround(from.phi_deg)) + "_" + std::to_string(std::lround(from.theta_deg));
    add_image(place / (name + ".png"), view.image.rgb);
    add_depth(extra / (name + "_depth.png"), view.image.depth);
    const fs::path mask = extra / (name + "_mask.png");
    folder.add(mask, io::encoded_grey_png(mask.string(), view.shot.height, view.shot.width, view.shot.mask));
    names.push_back(name);
  }
  const localise::LocalisedObject& object = pose.object;
  return Json{{"centre_m", {object.centre_m.x(), object.centre_m.y(), object.centre_m.z()}},
              {"length_m", object.length_m},
              {"width_m", object.width_m},
              {"height_m", object.height_m},
              {"radius_m", viewing_radius_m(view_camera(size), object.diagonal_m)},
              {"tries", attempts},
              {"views", names}};
}

/// What is kept of a pose until the end.
struct Entry {  // NOLINT(bugprone-exception-escape): of Json, whose move does not throw
  Json manifest;
  Image image;          // for the contact sheet, perhaps
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
        objects_(sources_.size()),
        entries_(sources_.size() * static_cast<std::size_t>(options.poses)),
        place_in_category_(sources_.size(), 0) {
    check(pose_count() < 0x10000, "there are ", pose_count(), " objects and poses, more than 65535; take fewer");
    for (std::size_t i = 1; i < sources_.size(); ++i)
      if (sources_[i].category == sources_[i - 1].category) place_in_category_[i] = place_in_category_[i - 1] + 1;
  }

  RenderSummary run() {
    io::FreshFolder folder(options_.output);
    render_poses(folder);
    const Index left_out =
        std::count_if(entries_.begin(), entries_.end(), [](const Entry& e) { return !e.problem.empty(); });
    if (left_out == pose_count()) fail_empty();
    std::vector<std::string> objects_left_out;
    for (std::size_t i = 0; i < sources_.size(); ++i)
      if (!objects_[i].problem().empty()) objects_left_out.push_back(sources_[i].category + "/" + sources_[i].object);
    const Index poses = pose_count() - left_out, of_objects = static_cast<Index>(objects_left_out.size());
    const Index images = write_summaries(folder.path());
    folder.keep();
    return {images, poses, left_out - options_.poses * of_objects, static_cast<Index>(sources_.size()),
            std::move(objects_left_out)};
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

  /// Throws Error that says why nothing was collected.
  [[noreturn]] void fail_empty() const {
    const std::string& problem = entries_.front().problem;
    if (objects_.front().problem().empty())
      fail("no pose was collected; the first, ", place_of(0).string(), ": ", problem);
    const bool are_more = sources_.size() > 1;
    fail(objects_.front().problem(),
         are_more ? joined("; none of the ", sources_.size(), " objects was collected") : "");
  }

  /// The object of a source. Throws Error that begins with its file's name.
  RestingMesh object_of(const ObjectSource& source, std::vector<std::string>& lines) const {
    try {
      RestingMesh object{mesh_of(source, options_.metres_per_unit, options_.seed,
                                 [&](const std::string& text) { lines.push_back(text); }),
                         {}};
      constexpr std::size_t kExactPoints = 4096;  // scans have many more, and their hulls take minutes
      object.resting = source.file.empty() ? resting_poses(object.mesh) : resting_poses(object.mesh, kExactPoints);
      return object;
    } catch (const Error& error) {
      const std::string text = error.what(), file = source.file.string();
      fail(text.starts_with(file) ? text : file + ": " + text);
    }
  }

  void render_poses(io::FreshFolder& folder) {
    Progress progress(messages_, "poses", pose_count());
    // Each thread renders a few poses between two reports, and more once it is known that they take less than seconds:
    // threads that are done with a block wait for the others. A block is at most twice the last one and 16 times the
    // first: poses of objects that cannot be read take no time. Each pose has its own random numbers.
    constexpr double kReport_s = 10;
    const Index least = 4 * Parallel::shared().threads();
    for (Index first = 0, count = 0; first < pose_count(); first += count) {
      const double pace = static_cast<double>(first) / std::max(progress.seconds(), 1e-3);
      const Index most = std::clamp(2 * count, least, 16 * least);
      count = std::min(std::clamp(static_cast<Index>(kReport_s * pace), least, most), pose_count() - first);
      Parallel::shared().for_chunks(count, 1, [&](Index i, Index, int) { render_pose(first + i, folder); });
      for (Index number = first; number < first + count; ++number) report_pose(number);
      progress.update(first + count);
    }
  }

  void render_pose(Index number, io::FreshFolder& folder) {
    constexpr Index kSheetImages = 15;  // of each category, so that the sheet fits a screen's width
    const Index pose = number % options_.poses;
    const ObjectSource& source = sources_[source_of(number)];
    const fs::path place = place_of(number);
    Entry& entry = entries_[static_cast<std::size_t>(number)];
    ObjectInWork& in_work = objects_[source_of(number)];
    auto object = in_work.take([&](std::vector<std::string>& lines) { return object_of(source, lines); });
    if (object == nullptr) return;
    const PoseCollection collection =
        collect_pose(*object, pose, options_.size, options_.seed, static_cast<std::uint32_t>(number));
    object.reset();
    in_work.count_pose(options_.poses);
    entry.problem = collection.problem;
    if (!collection.pose) return;
    entry.manifest = write_pose(*collection.pose, collection.attempts, options_.size, folder, place);
    if (place_in_category_[source_of(number)] * options_.poses + pose < kSheetImages)
      entry.image = resized_to_fit(fullest_view(*collection.pose), kSheet.cell);
  }

  /// Says what its object lacks, and why it is left out.
  void report_pose(Index number) {
    ObjectInWork& object = objects_[source_of(number)];
    Entry& entry = entries_[static_cast<std::size_t>(number)];
    for (const std::string& line : object.take_lines()) say(line);
    if (!object.problem().empty()) {
      const ObjectSource& source = sources_[source_of(number)];
      // The manifest knows no paths of this machine.
      entry.problem = source.file.lexically_relative(source.collection).string() +
                      object.problem().substr(source.file.string().size());
      if (number % options_.poses == 0 && sources_.size() > 1) say("left out: " + object.problem());
    } else if (!entry.problem.empty()) {
      say(joined("left out: ", place_of(number).string(), ": ", entry.problem));
    }
  }

  /// The manifest, the contact sheet and the cameras. Returns the number of images.
  Index write_summaries(const fs::path& folder) {
    Json manifest{{"program", joined("svnet-render ", kVersion)}, {"seed", options_.seed}, {"size_px", options_.size}};
    Index images = 0;
    std::vector<SheetLine> sheet;
    for (Index number = 0; number < pose_count(); ++number) {
      const ObjectSource& source = sources_[source_of(number)];
      Entry& entry = entries_[static_cast<std::size_t>(number)];
      if (!entry.problem.empty()) {
        manifest["left_out"][source.category][source.object][pose_name(number)] = std::move(entry.problem);
        continue;
      }
      images += static_cast<Index>(entry.manifest.at("views").size());
      manifest["poses"][source.category][source.object][pose_name(number)] = std::move(entry.manifest);
      if (sheet.empty() || sheet.back().label != source.category)
        sheet.push_back({.groups = std::vector<SheetGroup>(1), .label = source.category});
      if (!entry.image.rgb.empty()) sheet.back().groups[0].cells.push_back({std::move(entry.image)});
    }
    io::write_png(folder / "_extra" / "contact_sheet.png", contact_sheet(sheet, kSheet));
    // Messages may quote bytes of a mesh file that are not UTF-8.
    io::write_atomically(folder / "manifest.json", manifest.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
    io::write_atomically(folder / "_extra" / "overview_camera.json",
                         io::camera_json({overview_camera(), overview_camera_to_world()}));
    io::write_atomically(folder / "_extra" / "view_camera.json", io::camera_json({view_camera(options_.size), {}}));
    return images;
  }

  const RenderOptions& options_;
  const Messages& messages_;
  std::vector<ObjectSource> sources_;
  std::vector<ObjectInWork> objects_;  // of each source
  std::vector<Entry> entries_;
  std::vector<Index> place_in_category_;  // of each source, from 0
};

}  // namespace

RenderSummary render_dataset(const RenderOptions& options, const Messages& messages) {
  return RenderJob(options, messages).run();
}

}  // namespace svnet::simulation
