// Mistakes of users: the command exits with 1, prints one line that says what, where and what to do, and
// leaves no file.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>
#include <limits>

#include "io/hdf5/hdf5_file.h"
#include "io/tensors/safetensors.h"
#include "workplace.h"

using namespace svnet;
using namespace svnet::io;
namespace fs = std::filesystem;

namespace {

struct Row {
  const char* name;
  /// Shell commands that make the bad input from the good one, in the workplace.
  const char* make;
  const char* command;
  const char* fragment;
};

#define PREDICT "svnet-predict model.safetensors --image "
#define PREDICT_WITH(model) "svnet-predict " model " --image top.png --plot plot.png"
#define PREDICT_POSES PREDICT "top.png --plot plot.png --poses bad.csv"
#define FEATURES "svnet-features --backbone tiny_xception --output out.h5 "
#define FEATURES_WITH(weights) FEATURES "--images data --weights " weights
#define FEATURES_OF(images) FEATURES "--weights weights/tiny_xception.h5 --images " images
#define PRETRAIN "svnet-pretrain --output out.safetensors "
#define SCORE "svnet-score --dataset data --problems 50 --output out.h5 --features "
#define TRAIN "svnet-train bad.yaml --output run"
#define SET(assignment) "svnet-train config.yaml --output run --set " assignment

const Row kRows[] = {
    // images
    {"missing image", "", PREDICT "none.png", "none.png: no such file"},
    {"a folder without images", "mkdir none", PREDICT "none", "none: holds no PNG, JPEG or WebP file, and no data set"},
    {"truncated JPEG", "head -c -40 $IMAGES/rgb.jpg >bad.jpg", PREDICT "bad.jpg",
     "bad.jpg: is a damaged or incomplete JPEG image"},
    {"truncated PNG", "head -c -40 top.png >bad.png", PREDICT "bad.png",
     "bad.png: is a damaged or incomplete PNG image"},
    {"0-byte PNG", ": >bad.png", PREDICT "bad.png", "bad.png: is empty"},
    {"text renamed to .png", "echo hello >bad.png", PREDICT "bad.png",
     "bad.png: is not a PNG, JPEG or WebP image, whatever its name says"},
    {"PNG header of 30,000 x 30,000 pixels",
     "{ printf '\\211PNG\\r\\n\\032\\n\\0\\0\\0\\015IHDR\\0\\0u0\\0\\0u0\\010\\002\\0\\0\\0\\351\\105\\157\\355'; "
     "tail -c +34 top.png; } >bad.png",
     PREDICT "bad.png", "bad.png: has 30000x30000 pixels, more than the 64 megapixels that are read"},
    {"JPEG header of 30,000 x 30,000 pixels",
     "printf '\\377\\330\\377\\300\\0\\021\\010u0u0\\003\\001\\021\\0\\002\\021\\001\\003\\021\\001"
     "\\377\\332\\0\\014\\003\\001\\0\\002\\0\\003\\0\\0\\077\\0' >bad.jpg",
     PREDICT "bad.jpg", "bad.jpg: has 30000x30000 pixels, more than the 64 megapixels"},
    {"animated WebP", "", PREDICT "$IMAGES/animated.webp", "animated.webp: is an animated WebP"},
    // models
    {"missing model", "", PREDICT_WITH("none.safetensors"), "none.safetensors: cannot be read"},
    {"model cut short", "head -c -100 model.safetensors >bad.safetensors", PREDICT_WITH("bad.safetensors"),
     "; it is incomplete"},
    {"model of 5 bytes", "head -c 5 model.safetensors >bad.safetensors", PREDICT_WITH("bad.safetensors"),
     "bad.safetensors: has only 5 bytes; is it a safetensors file?"},
    {"HDF5 as model", "", PREDICT_WITH("scores.h5"), "scores.h5: is not a safetensors file"},
    // lists of poses
    {"NaN angle", "printf 'theta,phi\\n0,45\\nnan,45\\n' >bad.csv", PREDICT_POSES,
     "bad.csv:3: theta nan is not finite"},
    {"elevation out of range", "printf 'theta,phi\\n0,95\\n' >bad.csv", PREDICT_POSES,
     "bad.csv:2: phi 95 is outside [0, 90] degrees"},
    {"poses without a header", "printf '0,45\\n' >bad.csv", PREDICT_POSES,
     "bad.csv:1: the header is '0,45', expected 'theta,phi'"},
    {"a pose with one angle", "printf 'theta,phi\\n0\\n' >bad.csv", PREDICT_POSES,
     "bad.csv:2: '0' has 1 columns, the header 2"},
    {"empty list of poses", "printf 'theta,phi\\n' >bad.csv", PREDICT_POSES, "bad.csv: holds no pose"},
    // weights
    {"missing weights", "", FEATURES_WITH("none.h5"), "none.h5: no such file"},
    {"HDF5 that holds no weights", "", FEATURES_WITH("scores.h5"), "scores.h5: holds no Keras weights"},
    {"text renamed to .h5", "echo hello >bad.h5", FEATURES_WITH("bad.h5"), "bad.h5: is not an HDF5 file"},
    {"weights that Git LFS did not fetch",
     "printf 'version https://git-lfs.github.com/spec/v1\noid sha256:4d\n' >bad.h5", FEATURES_WITH("bad.h5"),
     "bad.h5: is not an HDF5 file, but a Git LFS pointer; get the file itself by 'git lfs pull'"},
    {"weights that are a web page", "echo '<!DOCTYPE html><html>' >bad.h5", FEATURES_WITH("bad.h5"),
     "bad.h5: is not an HDF5 file, but a web page"},
    {"compressed weights", "gzip -c weights/tiny_xception.h5 >bad.h5", FEATURES_WITH("bad.h5"),
     "bad.h5: is not an HDF5 file, but compressed by gzip"},
    {"a .keras file", "printf 'PK\003\004' >bad.keras", FEATURES_WITH("bad.keras"),
     "bad.keras: is not an HDF5 file, but a zip archive; if it is a .keras file, take model.weights.h5 out of it"},
    {"a model that Git LFS did not fetch",
     "printf 'version https://git-lfs.github.com/spec/v1\noid sha256:4d\n' >bad.safetensors",
     PREDICT_WITH("bad.safetensors"), "bad.safetensors: is not a safetensors file, but a Git LFS pointer"},
    {"weights cut short", "head -c 200000 weights/tiny_xception.h5 >bad.h5", FEATURES_WITH("bad.h5"),
     "bad.h5: damaged or incomplete HDF5 file"},
    {"weights of another model", "", FEATURES_WITH("$FIXTURES/keras_legacy.h5"),
     "; these are weights of another model"},
    {"unknown backbone", "",
     "svnet-features --backbone mobilnet --weights weights/tiny_xception.h5 --images data --output out.h5",
     "there is no backbone 'mobilnet', did you mean 'mobilenet'?"},
    {"unknown layer", "", FEATURES_WITH("weights/tiny_xception.h5 --layer block2_ad"), "did you mean 'block2_add'?"},
    {"no weights, given or built in", "", "svnet-features --backbone mobilenet --images data --output out.h5",
     "no weights of mobilenet are built in; give a file by --weights"},
    {"weights that are a model", "", FEATURES_WITH("model.safetensors"),
     "model.safetensors: is a model, expected a weights"},
    // pretraining
    {"pretraining without data", "mkdir bad", PRETRAIN "--images bad", "bad: data set without categories"},
    {"pretraining on one category", "", PRETRAIN "--images data --exclude ball,cone,cube",
     "data: 1 categories to tell apart besides the excluded ones"},
    {"no object left to train on", "", PRETRAIN "--images data --validation-objects 2",
     "data: category 'ball' has 2 objects, and --validation-objects 2 leaves none of them to train on"},
    {"damaged image in pretraining", "cp -r data bad; head -c 90 top.png >bad/cone/1/1/45_0.png",
     PRETRAIN "--images bad", "bad/cone/1/1/45_0.png: is a damaged or incomplete PNG image"},
    {"full disk: weights", "", "ulimit -f 1; " PRETRAIN "--images data --quiet --epochs 1",
     "out.safetensors: cannot be written: File too large"},
    // configurations
    {"missing configuration", "", TRAIN, "bad.yaml: cannot open the configuration file"},
    {"broken YAML", "echo 'seed: [1' >bad.yaml", TRAIN, "bad.yaml:1: "},
    {"misspelt key", "sed 's/epochs/epoch/' config.yaml >bad.yaml", TRAIN,
     "bad.yaml:15: training.epoch: unknown key, did you mean 'epochs'?"},
    {"duplicate key", "{ cat config.yaml; echo 'seed: 4'; } >bad.yaml", TRAIN,
     "bad.yaml:20: key 'seed' is given twice, first on line 1"},
    {"wrong type", "sed 's/epochs: 2/epochs: many/' config.yaml >bad.yaml", TRAIN,
     "bad.yaml:15: training.epochs: 'many' is wrong, expected a whole number >= 1"},
    {"negative epochs", "sed 's/epochs: 2/epochs: -2/' config.yaml >bad.yaml", TRAIN,
     "bad.yaml:15: training.epochs: -2 is out of range, expected a whole number >= 1"},
    {"held-out category that does not exist", "sed 's/ring/rang/' config.yaml >bad.yaml", TRAIN,
     "dataset.held_out: the dataset has no category 'rang', did you mean 'ring'?"},
    {"too few categories to train on", "sed 's/\\[ring/[ring, cone, ball/' config.yaml >bad.yaml", TRAIN,
     "dataset.held_out: leaves 1 categories to train on"},
    {"unknown key by --set", "", SET("training.epoch=3"), "--set training.epoch: unknown key, did you mean 'epochs'?"},
    {"value out of range by --set", "", SET("sv_net.dropout=1"), "--set sv_net.dropout: 1 is out of range"},
    {"folder of weights without the backbone's", "mkdir bad", SET("weights.folder=bad --set scores.backbone=mobilenet"),
     "bad: no weights of mobilenet; put one of these files there: mobilenet.safetensors, "},
    // datasets
    {"missing dataset", "", SET("dataset.root=none"), "none: no such folder"},
    {"empty dataset", "mkdir bad", SET("dataset.root=bad"), "bad: data set without categories"},
    {"pose without top view", "cp -r data bad; rm bad/cone/1/1/90_90.png", FEATURES_OF("bad"),
     "bad/cone/1/1: pose without its top view"},
    {"view out of range", "cp -r data bad; cp top.png bad/cone/1/1/95_0.png", FEATURES_OF("bad"),
     "bad/cone/1/1/95_0.png: phi is 95, expected 0 to 90 degrees"},
    {"the same view twice", "cp -r data bad; cp $IMAGES/rgb.jpg bad/cone/1/1/45_0.jpg", FEATURES_OF("bad"),
     "bad/cone/1/1/45_0.png: the same view as 45_0.jpg; remove one of them"},
    {"damaged image in a dataset", "cp -r data bad; head -c 90 top.png >bad/cone/1/1/45_0.png", FEATURES_OF("bad"),
     "bad/cone/1/1/45_0.png: is a damaged or incomplete PNG image"},
    {"two damaged images, each for another thread",
     "cp -r data bad; for i in cone/1/1/45_0 ring/0/1/45_0; do head -c 90 top.png >bad/$i.png; done",
     "SVNET_THREADS=4 " FEATURES_OF("bad"), "bad/cone/1/1/45_0.png: is a damaged or incomplete PNG image"},
    // features and scores
    {"missing features", "", SCORE "none.h5", "none.h5: no such file"},
    {"features cut short", "head -c 3000 features.h5 >bad.h5", SCORE "bad.h5",
     "bad.h5: damaged or incomplete HDF5 file"},
    {"scores as features", "", SCORE "scores.h5", "scores.h5: attribute 'backbone': is missing"},
    {"features of other images", "cp -r data bad; cp top.png bad/cone/1/1/45_0.png",
     "svnet-score --dataset bad --problems 50 --output out.h5 --features features.h5",
     "features.h5: features of other images than those in bad; run svnet-features again"},
    {"excluded category that does not exist", "", SCORE "features.h5 --exclude ring,cub", "did you mean 'cube'?"},
    // evaluation
    {"a folder that is no run", "mkdir bad", "svnet-eval bad", "bad: is no run folder"},
    {"a run without a model", "mkdir bad; sed 's/: data/: ..\\/data/' config.yaml >bad/config.yaml", "svnet-eval bad",
     "bad: holds no trained model; run svnet-train first"},
    {"a model of another run",
     "mkdir bad; sed 's/: data/: ..\\/data/; s/: weights/: ..\\/weights/' config.yaml >bad/config.yaml; "
     "cp model.safetensors bad",
     "svnet-eval bad", "bad/model.safetensors: was trained with another configuration"},
    {"tables in the place of the configuration",
     "mkdir -p runs/bad; cp config.yaml bad.yaml; cp model.safetensors runs/bad", "svnet-eval bad.yaml --json bad.yaml",
     "bad.yaml: "},
    {"nothing to describe", "", "svnet-info none.h5", "none.h5: cannot be read"},
    {"an image to describe", "", "svnet-info top.png", "top.png: is not a safetensors file"},
    // outputs
    {"output into a folder that does not exist", "", PREDICT "top.png --plot none/plot.png",
     "none/plot.png: cannot be written: the folder none does not exist; create it first"},
    {"output below a file", "", PREDICT "top.png --plot top.png/plot.png", "top.png/plot.png: cannot be written: "},
    {"output onto a folder", "", PREDICT "top.png --plot data", "data: cannot be written: it is a folder"},
    {"output into a folder that takes none", "",
     "svnet-score --dataset data --problems 50 --features features.h5 --output /proc/out.h5",
     "/proc/out.h5: cannot be written: "},
    {"a file as run folder", "", "svnet-train config.yaml --output top.png",
     "top.png: is not a folder; give the name of one"},
    {"full disk: standard output", "", PREDICT "top.png --json >/dev/full",
     "cannot write to standard output, is the disk full?"},
    {"full disk: image", "", "ulimit -f 1; " PREDICT "top.png --plot plot.png",
     "plot.png: cannot be written: File too large"},
    {"full disk: features", "", "ulimit -f 1; " FEATURES_WITH("weights/tiny_xception.h5"),
     "out.h5: dataset 'features': cannot be written: File too large"},
    {"one category left", "", SCORE "features.h5 --exclude ring,cube,ball",
     "1 categories take part, at least 2 are needed; --exclude fewer"},
    {"more categories than there are", "", SCORE "features.h5 --min-categories 9",
     "--min-categories: 9, but 4 categories take part"},
    // outputs that would overwrite something
    {"scores over their features", "cp features.h5 bad.h5",
     "svnet-score --dataset data --problems 50 --features bad.h5 --output bad.h5",
     "bad.h5: cannot be written: the command needs this file for something else; give another name"},
    {"features over their weights", "cp weights/tiny_xception.h5 bad.h5",
     "svnet-features --backbone tiny_xception --weights bad.h5 --images data --output ./bad.h5",
     "bad.h5: cannot be written: the command needs this file"},
    {"features over an image", "cp -r data bad",
     "svnet-features --backbone tiny_xception --weights weights/tiny_xception.h5 --images bad --output "
     "bad/cone/1/1/45_0.png",
     "45_0.png: cannot be written: the command needs this file"},
    {"a plot over the model", "cp model.safetensors bad.safetensors",
     "svnet-predict bad.safetensors --image top.png --plot bad.safetensors",
     "bad.safetensors: cannot be written: the command needs this file"},
    {"an output over another", "echo '{\"width\":64,\"height\":64,\"fx\":60,\"fy\":60,\"cx\":32,\"cy\":32}' >bad.json",
     "svnet-views bad.json --centre 0 0 0 --diagonal 0.2 --csv out.csv --json out.csv",
     "out.csv: cannot be written: the command needs this file"},
    {"a run among its images", "cp -r data bad", "svnet-train config.yaml --output bad/run --set dataset.root=bad",
     "bad/run: lies in the data set "},
    {"a run over a configuration by hand", "mkdir bad; { echo '# mine'; cat config.yaml; } >bad/config.yaml",
     "svnet-train config.yaml --output bad", "bad/config.yaml: was not written by a run"},
    {"a run over results without a run", "mkdir bad; echo 1 >bad/metrics.csv", "svnet-train config.yaml --output bad",
     "bad/metrics.csv: a run would take its place"},
    {"full disk: scores", "", "ulimit -f 1; " SCORE "features.h5",
     "out.h5: dataset 'individual': cannot be written: File too large"},
    {"no folder for temporary files", "", "TMPDIR=/nonexistent svnet-train config.yaml --dry-run",
     "/nonexistent: is no folder for temporary files; set TMPDIR to one"},
    {"a dataset where one is to be made", "", "svnet-render --output data", "data: exists already"},
    // environment
    {"unknown instruction set", "", "SVNET_MAX_ISA=AVX22 " PREDICT "top.png", "this machine has no 'AVX22'"},
    {"no number of threads", "", "SVNET_THREADS=many " PREDICT "top.png",
     "[SVNET_THREADS] 'many' is not a whole number"},
    {"C interface: wrong pixel format", "", "c_interface_probe model.safetensors format",
     "[svnet_embed] there is no pixel format 5"},
    {"C interface: NaN angle", "", "c_interface_probe model.safetensors nan",
     "[predict] pose 1: phi nan is not finite"},
    {"C interface: rows that overlap", "", "c_interface_probe model.safetensors stride",
     "[svnet_embed] stride_bytes is 8, less than the 12 bytes of a row"},
    {"C interface: model cut short", "head -c -1 model.safetensors >bad.safetensors",
     "c_interface_probe bad.safetensors none", "bad.safetensors: "},
};

/// Runs a row and removes what it wrote.
void check_row(const Workplace& place, const Row& row) {
  INFO(row.name << ": " << row.command);
  const auto before = place.entries();
  const std::string names = "IMAGES=" FIXTURES "/pictures; FIXTURES=" FIXTURES "/io; ";
  if (*row.make != '\0') REQUIRE(place.run(names + row.make).status == 0);
  const auto made = place.entries();
  const Ran ran = place.run(names + row.command);
  INFO(ran.err);
  CHECK(ran.status == 1);
  CHECK(ran.out.empty());
  const std::vector<std::string> lines = lines_of(ran.err);
  REQUIRE(!lines.empty());
  CHECK_THAT(lines.back(), Catch::Contains(row.fragment));
  // One line of error; the lines of progress before it are not errors.
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    CHECK_THAT(lines[i], !Catch::StartsWith("svnet-"));
    CHECK_THAT(lines[i],
               Catch::Contains(" layers loaded") || Catch::Contains(" categories, ") || Catch::EndsWith(" s"));
  }
  CHECK_THAT(ran.err, !Catch::Contains("what():") && !Catch::Contains("filesystem error"));
  auto after = place.entries();
  for (const char* log : {"run", "run/log.txt", "bad/log.txt"})  // the log of the failed run contains the error
    if (made.count(log) == 0) after.erase(log);
  CHECK(after == made);
  for (const std::string& entry : place.entries())
    if (before.count(entry) == 0) fs::remove_all(place / entry);
}

/// The tensors of the good model, to be changed and written again.
struct OpenModel {
  explicit OpenModel(const Workplace& place) : file(place / "model.safetensors"), tensors(file.tensors()) {}
  SafetensorsFile file;
  std::vector<SafetensorsTensor> tensors;
};

void check_model(const Workplace& place, const char* name, const char* fragment) {
  check_row(place, {name, "cp changed.safetensors bad.safetensors", PREDICT_WITH("bad.safetensors"), fragment});
}

}  // namespace

TEST_CASE("bad input: every row prints one line of error, exits with 1 and leaves no file") {
  const Workplace place;
  for (const Row& row : kRows) check_row(place, row);
}

TEST_CASE("bad input: weights with values or layers in the wrong place") {
  const Workplace place;
  write_tiny_weights(place / "swapped.h5", true);
  check_row(place,
            {"two layers swapped", "", FEATURES_WITH("swapped.h5"),
             "is 'block2_sepconv2_bn' where the model has 'block2_sepconv1_bn'; the layers of the file are not in "
             "the order of the model"});
  // The first weight of a kernel, found by its bytes.
  std::string bytes = file_contents(place / "weights/tiny_xception.h5");
  const auto kernel =
      Hdf5File::open(place / "weights/tiny_xception.h5").read<float>("block1_conv1/block1_conv1/kernel").values;
  const std::string start(reinterpret_cast<const char*>(kernel.data()), 16);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  REQUIRE(bytes.find(start) != std::string::npos);
  std::memcpy(bytes.data() + bytes.find(start), &nan, sizeof nan);
  place.folder().write("nan.h5", bytes);
  check_row(place, {"NaN in weights", "", FEATURES_WITH("nan.h5"),
                    "nan.h5: dataset 'block1_conv1/block1_conv1/kernel': value 0 is not finite"});
}

TEST_CASE("bad input: models with wrong tensors") {
  const Workplace place;
  const auto write = [&](const OpenModel& model) {
    write_safetensors(place / "changed.safetensors", model.tensors, model.file.metadata());
  };
  {
    OpenModel model(place);
    model.tensors.erase(model.tensors.begin());
    write(model);
    check_model(place, "model without one of its tensors", "bad.safetensors: there is no tensor '");
  }
  {
    OpenModel model(place);
    std::vector<std::byte> values(model.tensors[3].bytes.begin(), model.tensors[3].bytes.end());
    const float nan = std::numeric_limits<float>::quiet_NaN();
    std::memcpy(values.data(), &nan, sizeof nan);
    model.tensors[3].bytes = values;
    write(model);
    check_model(place, "NaN in a model", "bad.safetensors: tensor '");
  }
  {
    OpenModel model(place);
    auto& tensor = *std::find_if(model.tensors.begin(), model.tensors.end(),
                                 [](const SafetensorsTensor& t) { return t.shape.size() == 4; });
    std::swap(tensor.shape[0], tensor.shape[3]);
    write(model);
    check_model(place, "model with a tensor of another shape", "is 24x3x3x3, expected 3x3x3x24");
  }
  {
    SafetensorsMetadata metadata = OpenModel(place).file.metadata();
    std::string& text = metadata.at("svnet");
    const auto at = text.find("\"format\":1");
    REQUIRE(at != std::string::npos);
    text.replace(at, 10, "\"format\":99");
    write_safetensors(place / "changed.safetensors", OpenModel(place).tensors, metadata);
    check_model(place, "model of a newer version", "format 99");
  }
  {
    // Two tensors of the same size at the same offset; the length of the header does not change.
    std::string bytes = file_contents(place / "model.safetensors");
    const std::string beta = "\"data_offsets\":[2592,2688]", gamma = "\"data_offsets\":[2688,2784]";
    REQUIRE(bytes.find(beta) != std::string::npos);
    bytes.replace(bytes.find(gamma), gamma.size(), beta);
    place.folder().write("changed.safetensors", bytes);
    check_model(place, "overlapping tensors",
                "bad.safetensors: tensor 'backbone/block1_conv1_bn/gamma': overlaps the tensor before it");
  }
}

// A disk that is really full, if the system lets a user mount one.
TEST_CASE("bad input: a full disk") {
  const Workplace place;
  if (place.run("unshare -rm true").status != 0) {
    WARN("skipped: no file system may be mounted here");
    return;
  }
  const std::string full =
      "mkdir disk; unshare -rm sh -c \"mount -t tmpfs -o size=8k none disk && head -c 4096 /dev/zero >disk/filling && ";
  for (const char* command :
       {FEATURES_WITH("weights/tiny_xception.h5"), SCORE "features.h5", PREDICT "top.png --plot out.h5"}) {
    std::string onto = command;
    onto.replace(onto.find("out.h5"), 6, "disk/out.h5");
    INFO(onto);
    const Ran ran =
        place.run(full + onto + "; status=\\$?; ls -A disk >&2; exit \\$status\"; status=$?; rmdir disk; exit $status");
    CHECK(ran.status == 1);
    CHECK_THAT(ran.err, Catch::Contains("disk/out.h5: ") && Catch::Contains("No space left on device") &&
                            Catch::EndsWith("\nfilling\n"));
    CHECK_THAT(ran.err, !Catch::Contains(".tmp"));
  }
}
