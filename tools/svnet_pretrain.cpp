// svnet-pretrain: the weights of a backbone, trained from scratch to tell categories apart.
#include <cmath>

#include "base/text.h"
#include "command/command.h"
#include "io/files/atomic_file.h"
#include "io/models/backbone_file.h"
#include "io/views/dataset_folder.h"
#include "io/views/dataset_notes.h"
#include "train/pretraining.h"

namespace {

using namespace svnet;
using namespace svnet::command;
using svnet::train::Pretrained;
using svnet::train::PretrainingOptions;

/// "recognises 99.5 % of 2400 pictures of objects not trained on", the words of weights files that exist
std::string accuracy_text(const Pretrained& result) {
  if (result.validation_images == 0) return "no validation";
  return joined("recognises ", percent(result.validation_accuracy), " of ", result.validation_images,
                " pictures of objects not trained on");
}

std::string origin_text(const Pretrained& result, const PretrainingOptions& options) {
  return joined("svnet-pretrain on ", result.training_images, " pictures of ", result.categories.size(),
                " categories (", joined_with(", ", result.categories), "), ", options.epochs, " epochs, seed ",
                options.seed, "; ", accuracy_text(result));
}

}  // namespace

int main(int argc, char** argv) {
  Command command("svnet-pretrain",
                  "Trains a backbone from scratch to tell the categories of a dataset (category/object/pose/"
                  "PHI_THETA.png) apart, and writes its weights. The last objects of each category are not trained on; "
                  "the share of their images that is recognised says how well the backbone learnt.",
                  "svnet-pretrain --images runs/rendered --exclude comb,knife --output tiny_xception.safetensors");
  std::filesystem::path images, output;
  PretrainingOptions options;
  std::vector<std::string> names;
  for (const models::BackboneKind& kind : models::backbone_kinds()) names.push_back(kind.name);
  command.add("--images", images, "The dataset's folder").required().value_name("DIR");
  command.add("--output", output, "The file to write, *.safetensors").required().value_name("FILE");
  command.add("--backbone", options.backbone, "The network: " + joined_with(", ", names) + " (tiny_xception)")
      .value_name("NAME");
  command.add("--exclude", options.exclude, "Categories that take no part, with commas between them")
      .separated_by_commas();
  command
      .add("--validation-objects", options.validation_objects,
           "The last N objects of each category are not trained on (1)")
      .in_range(0, 1000000);
  command.add("--epochs", options.epochs, joined("Passes over the images (", options.epochs, ")")).in_range(1, 100000);
  command.add("--batch", options.batch_size, joined("Images in a step (", options.batch_size, ")")).in_range(2, 4096);
  command
      .add("--learning-rate", options.learning_rate,
           "The highest learning rate; it warms up and falls to 0 by half a cosine (0.002)")
      .positive();
  command.add("--weight-decay", options.weight_decay, "Decoupled weight decay of kernels (0.05)").non_negative();
  command.add("--seed", options.seed, "Seed of the weights and of the order and changes of the images (0)")
      .in_range(0, Index{1} << 53);
  std::string exif{name_of(ExifOrientation::ignore)};
  command
      .add("--exif-orientation", exif, "ignore: takes pixels as stored; obey: turns them as the EXIF orientation says")
      .one_of(names_of<ExifOrientation>())
      .shows_default();
  command.add_sandbox();
  return command.run(argc, argv, [&](Console& console) {
    options.inference = inference_options_from_environment();
    check(options.inference.precision != kernels::Precision::int8,
          "[SVNET_PRECISION] int8 is for trained backbones; choose f32 or bf16");
    if (output.extension() != ".safetensors") wrong_usage("--output: '", output.string(), "' must end in .safetensors");
    io::check_can_be_written(output);
    const ViewDataset dataset = io::read_view_dataset(images, *find_enum<ExifOrientation>(exif));
    for (const std::string& note : io::dataset_notes(dataset, Parallel::shared())) console.line(note);
    const Pretrained result = pretrain(dataset, options, console.messages());
    io::write_backbone(output, result.backbone, origin_text(result, options));
    console.result(joined(output.string(), ": ", result.backbone.kind().name, ", ", result.categories.size(),
                          " categories, ", result.training_images, " images; ", accuracy_text(result)));
  });
}
