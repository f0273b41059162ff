// svnet-features: features of every image of a dataset.
#include "base/text.h"
#include "chosen_backbone.h"
#include "command/command.h"
#include "io/files/atomic_file.h"
#include "io/files/snapshot_path.h"
#include "io/views/dataset_folder.h"
#include "io/views/dataset_notes.h"
#include "mpi/mpi_communicator.h"
#include "train/calibration.h"
#include "train/feature_extraction.h"

namespace svnet {
using namespace command;
using io::KerasLoadReport;
using train::BackboneWithOrigin;

namespace {

/// ", 2 not used (dense, dense_1)"; names at most five.
std::string unused_text(std::vector<std::string> names) {
  constexpr std::size_t kMostNames = 5;
  if (names.empty()) return {};
  const std::size_t count = names.size();
  if (count > kMostNames) names.resize(kMostNames);
  return joined(", ", count, " not used (", printable(joined_with(", ", names)), count > kMostNames ? ", …)" : ")");
}

std::vector<std::filesystem::path> images_of(const ViewDataset& dataset) {
  std::vector<std::filesystem::path> files;
  for (const View& view : dataset.views) files.push_back(dataset.root / view.path);
  return files;
}

int run(int argc, char** argv, Communicator& communicator) {
  Command command(
      "svnet-features",
      "Writes the features of every image of a dataset (category/object/pose/PHI_THETA.png) to an HDF5 file.",
      "svnet-features --backbone mobilenet_v2 --weights mobilenet_v2.h5 --images photos --output features.h5\n"
      "mpirun -n 8 svnet-features --threads 1 --backbone mobilenet_v2 --weights mobilenet_v2.h5 --images photos "
      "--output features.h5");
  std::string backbone, layer, exif{name_of(ExifOrientation::ignore)};
  std::filesystem::path weights, images, output;
  add_backbone_options(command, backbone, weights, "The network").required();
  command.add("--images", images, "The dataset's folder").required().value_name("DIR");
  command.add("--output", output, "The file to write").required().value_name("FILE");
  command.add("--layer", layer, "The layer whose output is taken, flattened (default: the pooled one)")
      .value_name("NAME");
  command
      .add("--exif-orientation", exif, "ignore: takes pixels as stored; obey: turns them as the EXIF orientation says")
      .one_of(names_of<ExifOrientation>())
      .shows_default();
  command.add_precision(true);
  Index calibration = train::kCalibrationImages;
  command
      .add("--calibration", calibration,
           "With --precision int8: images of the dataset that ranges of activations are taken from, evenly spaced")
      .in_range(1, 1000000)
      .shows_default();
  command.add_sandbox();
  return command.run(
      argc, argv,
      [&](Console& console) {
        if (communicator.is_root()) io::check_can_be_written(output, {weights});
        KerasLoadReport report;
        const InferenceOptions options = inference_options_from_environment(command.precision());
        const bool is_int8 = options.precision == kernels::Precision::int8;
        BackboneWithOrigin source =
            chosen_backbone(backbone, layer, weights, report, is_int8 ? InferenceOptions{} : options);
        if (!weights.empty())
          console.line(
              joined(weights.string(), ": ", report.loaded.size(), " layers loaded", unused_text(report.unused)));
        const ViewDataset dataset = io::read_view_dataset(images, *find_enum<ExifOrientation>(exif));
        if (communicator.is_root())
          for (const std::string& note : io::dataset_notes(dataset, Parallel::shared())) console.line(note);
        if (communicator.is_root()) io::check_can_be_written(output, images_of(dataset));
        if (is_int8) source = train::calibrated(source, dataset, calibration, console.messages());
        const FeaturesOrigin origin = features_origin(source, io::fingerprint(dataset, Parallel::shared()));
        const Features features = train::extract_features(source.backbone, dataset, origin, console.messages(),
                                                          communicator, io::snapshot_path(output));
        if (communicator.is_root()) train::write_made_features(output, features);
        console.result(joined(output.string(), ": ", features.count, " x ", features.dimension));
      },
      communicator);
}

}  // namespace
}  // namespace svnet

int main(int argc, char** argv) { return svnet::main_with_communicator(argc, argv, "svnet-features", svnet::run); }
