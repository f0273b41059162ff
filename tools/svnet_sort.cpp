// svnet-sort: puts objects into groups of like objects, by one or more pictures of each.
#include "base/text.h"
#include "chosen_backbone.h"
#include "command/command.h"
#include "image/contact_sheet.h"
#include "image/oriented.h"
#include "io/files/atomic_file.h"
#include "io/images/image_file.h"
#include "io/images/image_name.h"
#include "semantics/view_fusion.h"
#include "sort/dendrogram_picture.h"
#include "sort/groups_text.h"

namespace {

using namespace svnet;
using namespace svnet::command;
using semantics::Linkage;
using semantics::ViewFusion;
namespace fs = std::filesystem;

struct Arguments {
  std::vector<fs::path> objects{};
  std::string groups = "auto", backbone = "tiny_xception";
  fs::path weights{}, json{}, sheet{}, dendrogram{};
  std::string linkage{name_of(Linkage::ward)}, fusion{name_of(ViewFusion::mean)};
  std::string exif{name_of(ExifOrientation::ignore)};
};

/// Empty: it is to be estimated.
std::optional<Index> wanted_groups(const std::string& text) {
  if (text == "auto") return {};
  Index groups = 0;
  if (!parse_number(text, groups) || groups < 1)
    wrong_usage("--groups: '", printable(text), "' is neither a whole number from 1 nor auto");
  return groups;
}

/// Throws Error that names the file and says what to do.
io::StoredImage read_picture(const fs::path& file) {
  try {
    return io::read_stored_image(file);
  } catch (const Error& error) {
    fail(error.what(), fs::exists(file) ? "; repair the picture, or leave it out" : "");
  }
}

/// Features of the pictures of all objects, one object after the other, and the pictures as small images if they are
/// wanted.
struct PictureFeatures {
  std::vector<float> features;
  std::vector<Index> pictures;  // of each object
  std::vector<Image> thumbnails;
};

/// Reads and embeds every picture once.
class PictureReader {
 public:
  PictureReader(const models::Backbone& backbone, bool obeys_exif, bool keeps_thumbnails)
      : backbone_(backbone), obeys_exif_(obeys_exif), keeps_thumbnails_(keeps_thumbnails) {}

  PictureFeatures read(const std::vector<SortedObject>& objects, Console& console) {
    PictureFeatures result;
    std::vector<fs::path> files;
    for (const SortedObject& object : objects) {
      files.insert(files.end(), object.pictures.begin(), object.pictures.end());
      result.pictures.push_back(static_cast<Index>(object.pictures.size()));
    }
    std::vector<char> is_turned(files.size(), 0);
    result.thumbnails.resize(keeps_thumbnails_ ? files.size() : 0);
    const models::Preprocessing& how = backbone_.preprocessing();
    constexpr Index kBatch = 16;
    const auto prepared = [&](Index begin, Index end, Parallel& parallel) {
      Tensor batch = Tensor::empty({end - begin, how.height, how.width, 3});
      parallel.for_chunks(end - begin, 1, [&](Index i, Index, int) {
        const auto file = static_cast<std::size_t>(begin + i);
        io::StoredImage stored = read_picture(files[file]);
        is_turned[file] = stored.exif_orientation != 1;
        const Image image =
            obeys_exif_ ? oriented(std::move(stored.image), stored.exif_orientation) : std::move(stored.image);
        prepare(how, image, batch.data<float>() + i * how.size());
        if (keeps_thumbnails_) result.thumbnails[file] = resized_to_fit(image, kThumbnail_px);
      });
      return batch;
    };
    result.features =
        train::extracted({.network = backbone_.kind().name,
                          .count = static_cast<Index>(files.size()),
                          .dimension = backbone_.dimension(),
                          .batch = kBatch,
                          .memory = [&](Index pictures) { return backbone_.network().arena_size(pictures); },
                          .prepared = prepared,
                          .run = [&](const Tensor& batch) { return backbone_.features(batch); },
                          .name = [&](Index file) { return files[static_cast<std::size_t>(file)].string(); }},
                         console.messages(), SingleProcess::shared());
    const auto turned = std::ranges::count(is_turned, 1);
    if (turned > 0 && !obeys_exif_)
      console.line(joined("the EXIF orientation of ", turned, turned == 1 ? " picture" : " pictures",
                          " is ignored; --exif-orientation obey turns them as viewers do"));
    return result;
  }

 private:
  const models::Backbone& backbone_;
  bool obeys_exif_, keeps_thumbnails_;
};

/// Before the work, so that no output takes the place of a picture or of another output.
void check_outputs(const Arguments& a, const std::vector<SortedObject>& objects) {
  std::vector<fs::path> others{a.weights};
  for (const SortedObject& object : objects)
    others.insert(others.end(), object.pictures.begin(), object.pictures.end());
  Index on_standard_output = 0;
  for (const fs::path& output : {a.json, a.sheet, a.dendrogram}) {
    if (output.empty()) continue;
    io::check_can_be_written(output, others, io::Streams::allowed);
    others.push_back(output);
    on_standard_output += io::is_standard_output(output);
  }
  check(on_standard_output <= 1, "only one of --json, --sheet and --dendrogram can go to standard output");
}

std::vector<ObjectLook> looks_of(const std::vector<SortedObject>& objects, const PictureFeatures& pictures) {
  std::vector<ObjectLook> looks;
  std::size_t first = 0;
  for (const SortedObject& object : objects) {
    const fs::path name = object.name;
    const std::span of_object = std::span(pictures.thumbnails).subspan(first, object.pictures.size());
    const fs::path shown = io::is_image_name(name) ? name.stem() : name.filename();
    looks.push_back({shown.empty() ? object.name : shown.string(), object_thumbnail(of_object)});
    first += object.pictures.size();
  }
  return looks;
}

void check_views_for(ViewFusion fusion, const std::vector<SortedObject>& objects) {
  for (const SortedObject& object : objects)
    check(fusion == ViewFusion::mean || object.pictures.size() == objects[0].pictures.size(), object.name, ": has ",
          object.pictures.size(), object.pictures.size() == 1 ? " picture" : " pictures", ", ", objects[0].name,
          " has ", objects[0].pictures.size(),
          "; --fusion concatenate needs as many of every object, --fusion mean takes any number");
}

void sort_objects(const Arguments& a, const std::optional<Index>& wanted, const InferenceOptions& options,
                  Console& console) {
  const std::vector<SortedObject> objects = sorted_objects(a.objects);
  const auto count = static_cast<Index>(objects.size());
  const ViewFusion fusion = *find_enum<ViewFusion>(a.fusion);
  check_outputs(a, objects);
  check_groups(wanted, count);
  check_views_for(fusion, objects);
  io::KerasLoadReport report;
  const train::BackboneWithOrigin source = chosen_backbone(a.backbone, "", a.weights, report, options);
  const bool draws = !a.sheet.empty() || !a.dendrogram.empty();
  const PictureFeatures pictures =
      PictureReader(source.backbone, a.exif == name_of(ExifOrientation::obey), draws).read(objects, console);
  const std::vector<float> features =
      semantics::fused_views(fusion, pictures.features, source.backbone.dimension(), pictures.pictures);
  const Grouping grouping = grouped(features, count, semantics::linkage_named(a.linkage), wanted);

  // Everything is made before the first file is written.
  std::optional<Image> sheet, dendrogram;
  if (draws) {
    const std::vector<ObjectLook> looks = looks_of(objects, pictures);
    if (!a.sheet.empty()) sheet = groups_sheet(grouping, looks);
    if (!a.dendrogram.empty()) dendrogram = dendrogram_picture(grouping, looks);
  }
  if (!a.json.empty())
    io::write_atomically(a.json, groups_json(grouping, objects,
                                             {.estimated = !wanted,
                                              .backbone = a.backbone,
                                              .weights_sha256 = source.weights,
                                              .linkage = a.linkage,
                                              .fusion = a.fusion}));
  if (sheet) io::write_png(a.sheet, *sheet);
  if (dendrogram) io::write_png(a.dendrogram, *dendrogram);
  for (const fs::path& output : {a.json, a.sheet, a.dendrogram})
    if (io::is_standard_output(output)) return;
  console.result(groups_text(grouping, objects));
}

}  // namespace

int main(int argc, char** argv) {
  Command command(
      "svnet-sort",
      "Puts objects into groups of like objects, by pictures of them. Prints a line per group: its number and the "
      "names "
      "of its objects. A picture is an object; a folder with several pictures of one object, from other sides, is an "
      "object too. If there is a single folder, what is in it is sorted: each picture and each folder is an object.",
      "svnet-sort photos/ --sheet groups.png --dendrogram tree.png\n"
      "svnet-sort mug1.jpg mug2.jpg shoe.jpg --groups 2 --json -\n"
      "svnet-sort photos/ --backbone mobilenet_v2 --weights mobilenet_v2.h5 --groups 5");
  Arguments a;
  command.add("PICTURES", a.objects, "PNG, JPEG or WebP files, and folders of such files. Or one folder of objects")
      .required();
  command
      .add("--groups", a.groups,
           "The number of groups, or auto: it is estimated from how far the objects are apart. The estimate is often "
           "off by one; --dendrogram shows where to cut instead")
      .value_name("K|auto")
      .shows_default();
  add_backbone_options(command, a.backbone, a.weights, "The network that sees the pictures",
                       ". Weights of ImageNet know more kinds of objects")
      .shows_default();
  command.add("--linkage", a.linkage, "How the distance of two groups is measured; groups that are nearest are joined")
      .one_of(names_of<Linkage>())
      .shows_default();
  command
      .add("--fusion", a.fusion,
           "What becomes of several pictures of an object. mean: the average of their features; concatenate: all of "
           "them in order, for objects that were all seen from the same sides")
      .one_of(names_of<ViewFusion>())
      .shows_default();
  command
      .add("--exif-orientation", a.exif,
           "ignore: takes pixels as stored; obey: turns them as the EXIF orientation says")
      .one_of(names_of<ExifOrientation>())
      .shows_default();
  command
      .add(
          "--json", a.json,
          "Writes JSON: count, groups with their objects, objects with their group and pictures, and the dendrogram in "
          "SciPy's form. With -, or /dev/stdout, the JSON is printed instead of the lines")
      .value_name("FILE");
  command.add("--sheet", a.sheet, "Writes a PNG image: the objects of each group in a frame").value_name("FILE");
  command
      .add("--dendrogram", a.dendrogram,
           "Writes a PNG image: which objects and groups are alike, how far they are apart, and where they were cut")
      .value_name("FILE");
  command.add_precision();
  command.add_sandbox();
  return command.run(argc, argv, [&](Console& console) {
    if (a.json == "-") a.json = "/dev/stdout";
    sort_objects(a, wanted_groups(a.groups), inference_options_from_environment(command.precision()), console);
  });
}
