#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>

#include "base/error.h"
#include "base/sha256.h"
#include "temporary_folder.h"
#include "train/config/config_file.h"
#include "train/config/config_table.h"
#include "train/config/fingerprint.h"
#include "train/config/pipeline_name.h"
#include "train/config/strict_yaml.h"

using namespace svnet;
using namespace svnet::models;
using namespace svnet::semantics;
using namespace svnet::train;

namespace {

const std::string kBase = "dataset: {root: data}\nscores: {problems: 10}\n";  // the shortest valid one

Config parse(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return parse_config(text, "c.yaml", "/work/configs", overrides);
}

/// The error message of reading `text`; empty if it succeeds.
std::string error_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    parse(text, overrides);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

std::string error_of_override(const std::string& assignment) { return error_of(kBase, {assignment}); }

}  // namespace

TEST_CASE("a configuration is read over the defaults") {
  const Config c = parse(R"(
seed: 7
dataset:
  root: ../views
  held_out: [comb, 'tooth brush', 12]
scores:
  clustering: kmeans
  min_samples: 2e5
  singletons: skip
  target_error: 1e-3
sv_net: {layer: block5_pool, angles: sphere, orientations: all, dropout: 0}
weights:
evaluation:
  pipelines:
    - mobilenet_v2_ward
    - xception_single
  nmi: geometric
)");
  CHECK(c.seed == 7);
  CHECK(c.dataset.root == "/work/views");
  CHECK(c.dataset.held_out == std::vector<std::string>{"comb", "tooth brush", "12"});
  CHECK(c.weights.folder.empty());
  CHECK(c.scores.clustering == Clustering::kmeans);
  CHECK(c.scores.min_samples == 200000);
  CHECK(c.scores.singletons == Singletons::skip);
  CHECK(c.scores.target_error == 0.001);
  CHECK(c.sv_net.layer == "block5_pool");
  CHECK(c.sv_net.angles == AngleEncoding::sphere);
  CHECK(c.sv_net.orientations == Orientations::all);
  CHECK(c.sv_net.dropout == 0);
  CHECK(c.evaluation.pipelines == std::vector<std::string>{"mobilenet_v2_ward", "xception_single"});
  CHECK(c.evaluation.nmi == NmiAverage::geometric);
  CHECK(c.sv_net.backbone == "vgg19");
  CHECK(c.training.batch_size == 32);
  CHECK(c.training.learning_rate == 1e-3);
}

TEST_CASE("every error of a key names file, line and key") {
  const auto at_line_3 = [](const std::string& line) { return error_of(kBase + line + "\n"); };
  CHECK(at_line_3("sede: 1") == "c.yaml:3: sede: unknown key, did you mean 'seed'?");
  CHECK(at_line_3("colours: 1") ==
        "c.yaml:3: colours: unknown key; known: preset, seed, dataset, weights, scores, sv_net, training, evaluation");
  CHECK(at_line_3("training:\n  epoch: 1") == "c.yaml:4: training.epoch: unknown key, did you mean 'epochs'?");
  CHECK(at_line_3("sv_net:\n  optimizer: adam") ==
        "c.yaml:4: sv_net.optimizer: unknown key, did you mean 'training.optimizer'?");
  CHECK(at_line_3("evaluation: {seeds: []}") ==
        "c.yaml:3: evaluation.seeds: unknown key; known: problems, pipelines, selectors, views, fusion, nmi");
  CHECK(at_line_3("seed: 1\nseed: 2") == "c.yaml:4: key 'seed' is given twice, first on line 3");
  CHECK(at_line_3("training:\n  epochs: 1\n  epochs: 1") ==
        "c.yaml:5: key 'training.epochs' is given twice, first on line 4");
  CHECK(at_line_3("dataset: {root: x}") == "c.yaml:3: key 'dataset' is given twice, first on line 1");
  CHECK(at_line_3("seed: many") == "c.yaml:3: seed: 'many' is wrong, expected a whole number >= 0");
  CHECK(at_line_3("seed: 1.5") == "c.yaml:3: seed: '1.5' is wrong, expected a whole number >= 0");
  CHECK(at_line_3("seed: 0x10") == "c.yaml:3: seed: '0x10' is wrong, expected a whole number >= 0");
  CHECK(at_line_3("seed: '5'") == "c.yaml:3: seed: '5' in quotes is text, expected a whole number >= 0");
  CHECK(at_line_3("seed: [1]") == "c.yaml:3: seed: a list is given, expected a whole number >= 0");
  CHECK(at_line_3("seed:") == "c.yaml:3: seed: no value is given, expected a whole number >= 0");
  CHECK(at_line_3("seed: -1") == "c.yaml:3: seed: -1 is out of range, expected a whole number >= 0");
  CHECK(at_line_3("training: {batch_size: 1}") ==
        "c.yaml:3: training.batch_size: 1 is out of range, expected a whole number >= 2");
  CHECK(at_line_3("training:\n\n  learning_rate: 0") ==
        "c.yaml:5: training.learning_rate: 0 is out of range, expected a number > 0");
  CHECK(at_line_3("training: {learning_rate: .nan}") ==
        "c.yaml:3: training.learning_rate: '.nan' is wrong, expected a number > 0");
  CHECK(at_line_3("training: {learning_rate: inf}") ==
        "c.yaml:3: training.learning_rate: inf is out of range, expected a number > 0");
  CHECK(at_line_3("training: {learning_rate: '0.1'}") ==
        "c.yaml:3: training.learning_rate: '0.1' in quotes is text, expected a number > 0");
  CHECK(at_line_3("training: {learning_rate: [0.1]}") ==
        "c.yaml:3: training.learning_rate: a list is given, expected a number > 0");
  CHECK(at_line_3("training: {step_factor: 1.5}") ==
        "c.yaml:3: training.step_factor: 1.5 is out of range, expected a number > 0 and <= 1");
  CHECK(at_line_3("seed: 1e300") == "c.yaml:3: seed: '1e300' is wrong, expected a whole number >= 0");
  CHECK(at_line_3("seed: 2e15.5") == "c.yaml:3: seed: '2e15.5' is wrong, expected a whole number >= 0");
  CHECK(at_line_3("seed: 9007199254740994.0") ==
        "c.yaml:3: seed: '9007199254740994.0' is wrong, expected a whole number >= 0");
  CHECK(at_line_3("evaluation: {views: 9}") ==
        "c.yaml:3: evaluation.views: 9 is out of range, expected a whole number >= 1 and <= 8");
  CHECK(at_line_3("colours: {red: 1}") ==
        "c.yaml:3: colours: unknown key; known: preset, seed, dataset, weights, scores, sv_net, training, evaluation");
  CHECK(at_line_3("sv_net: {dropout: 1}") ==
        "c.yaml:3: sv_net.dropout: 1 is out of range, expected a number >= 0 and < 1");
  CHECK(at_line_3("training: {optimizer: adm}") ==
        "c.yaml:3: training.optimizer: unknown value 'adm', expected one of adam, sgd; did you mean 'adam'?");
  CHECK(at_line_3("evaluation: {nmi: maximum}") ==
        "c.yaml:3: evaluation.nmi: unknown value 'maximum', expected one of arithmetic, geometric");
  CHECK(at_line_3("sv_net: {layer: }") == "c.yaml:3: sv_net.layer: no value is given, expected text (\"\" for none)");
  CHECK(at_line_3("sv_net: {layer: {a: b}}") ==
        "c.yaml:3: sv_net.layer: a mapping is given, expected text (\"\" for none)");
  CHECK(at_line_3("training: 5") == "c.yaml:3: training: is a section, expected its keys below it");
  CHECK(at_line_3("evaluation:\n  pipelines: [xception_ward, ward]") ==
        "c.yaml:4: evaluation.pipelines[1]: 'ward' is not BACKBONE_CLUSTERING, as in mobilenet_v2_ward; clusterings: "
        "ward, average, complete, single, kmeans");
  CHECK(at_line_3("evaluation: {pipelines: [_ward]}") ==
        "c.yaml:3: evaluation.pipelines[0]: '_ward' is not BACKBONE_CLUSTERING, as in mobilenet_v2_ward; clusterings: "
        "ward, average, complete, single, kmeans");
  CHECK(at_line_3("evaluation: {pipelines: [xception_wrad]}") ==
        "c.yaml:3: evaluation.pipelines[0]: xception_wrad: unknown value 'wrad', expected one of ward, average, "
        "complete, single, "
        "kmeans; did you mean 'ward'?");
  CHECK(error_of("scores: {problems: 1}\ndataset:\n  root: d\n  held_out: car") ==
        "c.yaml:4: dataset.held_out: 'car' is wrong, expected a list, as in [first, second]");
  CHECK(error_of("scores: {problems: 1}\ndataset:\n  root: d\n  held_out: [car, '']") ==
        "c.yaml:4: dataset.held_out[1]: the name is empty");
  CHECK(error_of("scores: {problems: 1}\ndataset:\n  root: d\n  held_out: [car,\n    dog, car]") ==
        "c.yaml:5: dataset.held_out[2]: 'car' is listed twice");
}

TEST_CASE("a range of numbers is said by the ends that it has") {
  CHECK(described(NumberRange{}, true) == "a whole number");
  CHECK(described(NumberRange{.min = 2}, true) == "a whole number >= 2");
  CHECK(described(NumberRange{.max = 0.5}, false) == "a number <= 0.5");
  CHECK(described(NumberRange{.min = 0, .max = 1, .min_open = true, .max_open = true}, false) ==
        "a number > 0 and < 1");
}

TEST_CASE("rules about several keys are checked after all keys are read") {
  CHECK(error_of("scores: {problems: 1}") == "c.yaml: dataset.root: required, name the folder of the images");
  CHECK(error_of("scores: {problems: 1}\ndataset: {root: ''}") ==
        "c.yaml:2: dataset.root: required, name the folder of the images");
  CHECK(error_of("dataset: {root: d}") ==
        "c.yaml: scores.min_samples: no rule says when to stop, set scores.min_samples, scores.problems or "
        "scores.target_error above 0");
  CHECK(error_of_override("scores.max_categories=2") ==
        "--set scores.max_categories: 2 is less than scores.min_categories 3");
  CHECK(error_of("dataset: {root: d}\nscores:\n  problems: 1\n  min_objects: 4\n  max_objects: 3") ==
        "c.yaml:5: scores.max_objects: 3 is less than scores.min_objects 4");
  CHECK(parse("dataset: {root: d}", {"scores.target_error=0.01"}).scores.target_error == 0.01);
  const std::string next_view =
      "sv_net.next_view: models of the frame camera do not learn which view to take next; set sv_net.frame to another "
      "one, such as axis";
  CHECK(error_of(kBase + "sv_net: {next_view: ridge}") == "c.yaml:3: " + next_view);
  CHECK(error_of_override("sv_net.next_view=ridge") == "--set " + next_view);
  CHECK(parse(kBase, {"sv_net.next_view=ridge", "sv_net.frame=turned"}).sv_net.next_view == NextViewChoice::ridge);
}

TEST_CASE("wrong YAML is refused with its line") {
  CHECK(error_of("seed: 1\ndataset: {root: [}\n") == "c.yaml:2: illegal flow end (column 18)");
  CHECK(error_of("seed: 1\n\tdataset: 3\n").starts_with("c.yaml:2: "));
  CHECK(error_of("seed: 1\n'open") == "c.yaml:2: illegal EOF in scalar (column 6)");
  CHECK(error_of("seed: 1\nweights: {folder: \"open}\n") == "c.yaml:2: illegal EOF in scalar (column 25)");
  CHECK(error_of("seed: 1\n\"open\\").starts_with("c.yaml:2: "));
  CHECK(error_of("seed: 1\ndataset: [car\n") == "c.yaml:2: end of sequence flow not found (column 1)");
  CHECK(error_of("") == "c.yaml: dataset.root: required, name the folder of the images");
  CHECK(error_of("- a\n") == "c.yaml:1: expected lines of the form 'key: value'");
  CHECK(error_of("text") == "c.yaml:1: expected lines of the form 'key: value'");
  CHECK(error_of("seed: &x 1\n") == "c.yaml:1: anchors ('&x') are not allowed here, write the value out");
  CHECK(error_of("\nseed: *x\n").starts_with("c.yaml:2: "));
  CHECK(error_of("seed: !!int 5\n") == "c.yaml:1: tags ('tag:yaml.org,2002:int') are not allowed here");
  CHECK(error_of("seed: 5\n---\nseed: 6\n") == "c.yaml: only one YAML document is allowed, remove what follows '---'");
  CHECK(error_of("[a, b]: 5\n") == "c.yaml:1: a key must be a name");
  CHECK(error_of("scores.layer: x\n") ==
        "c.yaml:1: key 'scores.layer' has a dot: write what follows the dot indented on a line of its own, below "
        "'NAME:'");
  CHECK(error_of(std::string(100000, '[')).starts_with("c.yaml:1: "));
  CHECK(error_of(kBase + std::string("seed: \0", 7)).starts_with("c.yaml:3: "));
}

TEST_CASE("overrides are applied in order and their errors say --set") {
  const Config c = parse(kBase, {"training.epochs=3", "training.epochs=4", "sv_net.layer=", "scores.layer=a=b",
                                 "dataset.held_out=[car, dog]", "training.optimizer=sgd"});
  CHECK(c.training.epochs == 4);
  CHECK(c.sv_net.layer.empty());
  CHECK(c.scores.layer == "a=b");
  CHECK(c.dataset.held_out == std::vector<std::string>{"car", "dog"});
  CHECK(c.training.optimizer == OptimizerKind::sgd);

  CHECK(error_of_override("epochs=3") == "--set epochs: unknown key, did you mean 'training.epochs'?");
  CHECK(error_of_override("train.epochs=3") == "--set train.epochs: unknown key, did you mean 'training.epochs'?");
  CHECK(error_of_override("training.epoch=3") == "--set training.epoch: unknown key, did you mean 'epochs'?");
  CHECK(error_of_override("training.epochs=0") ==
        "--set training.epochs: 0 is out of range, expected a whole number >= 1");
  CHECK(error_of_override("training.epochs=") ==
        "--set training.epochs: '' in quotes is text, expected a whole number >= 1");
  CHECK(error_of_override("training=3") == "--set training: is a section, expected its keys below it");
  CHECK(error_of_override("dataset.held_out=[car") ==
        "--set dataset.held_out: end of sequence flow not found (column 1)");
  CHECK(error_of_override("dataset.held_out=[a, a]") == "--set dataset.held_out[1]: 'a' is listed twice");
  CHECK(error_of_override("dataset.root=a\xc2\xa0"
                          "b") == "--set dataset.root: a no-break space (U+00A0) (column 2); YAML takes spaces only");
  CHECK(error_of_override("training.epochs") == "--set training.epochs: expected key=value");
  CHECK(error_of_override("=3") == "--set =3: expected key=value");
}

TEST_CASE("relative paths are the file's, and those of overrides the working directory's") {
  const TemporaryFolder folder;
  const auto file =
      folder.write("configs/c.yaml", "dataset: {root: ../views/}\nweights: {folder: /w}\nscores: {problems: 1}\n");
  const Config c = read_config(file);
  CHECK(c.dataset.root == folder.path() / "views");
  CHECK(c.weights.folder == "/w");
  const std::vector<std::string> overrides{"dataset.root=views", "weights.folder="};
  CHECK(read_config(file, overrides).dataset.root == std::filesystem::current_path() / "views");
  CHECK(read_config(file, overrides).weights.folder.empty());
  CHECK_THROWS_WITH(read_config(folder.path() / "no.yaml"),
                    (folder.path() / "no.yaml").string() + ": cannot open the configuration file, check its name");
  CHECK_THROWS_WITH(read_config(folder.path()),
                    folder.path().string() + ": is a folder, expected a configuration file");
}

TEST_CASE("the resolved configuration reads back equal, whatever its values") {
  const Config c = parse(
      kBase, {"dataset.root='/data/a b: \"c\" #1'", "dataset.held_out=['true', '12', 'null', '- x', \"a\\tb\", 'ü']",
              "training.learning_rate=0.1", "training.momentum=0.30000000000000004", "scores.singletons=skip",
              "scores.layer='~'", "seed=9223372036854775807", "weights.folder='/a\\b\x7f'"});
  const std::string yaml = to_yaml(c);
  const Config again = parse_config(yaml, "resolved", "/elsewhere");
  CHECK(to_yaml(again) == yaml);
  CHECK(again.dataset.root == c.dataset.root);
  CHECK(again.weights.folder == "/a\\b\x7f");
  CHECK(again.dataset.held_out == std::vector<std::string>{"true", "12", "null", "- x", "a\tb", "ü"});
  CHECK(again.training.momentum == 0.30000000000000004);
  CHECK(again.scores.layer == "~");
  CHECK(again.seed == 9223372036854775807);
  CHECK(again.scores.singletons == Singletons::skip);
}

TEST_CASE("the configuration of a run has relative paths to what lies near its folder") {
  const TemporaryFolder folder;
  const std::filesystem::path run = folder.path() / "runs" / "a";
  std::filesystem::create_directories(run);
  Config c = parse(kBase, {});
  const auto written = [&](const std::filesystem::path& root) {
    c.dataset.root = root;
    return to_yaml(c, run);
  };
  CHECK_THAT(written(folder.path() / "data"), Catch::Contains("root: ../../data\n"));
  CHECK_THAT(written(folder.path() / "runs" / "views"), Catch::Contains("root: ../views\n"));
  CHECK_THAT(written(run / "views"), Catch::Contains("root: views\n"));
  CHECK_THAT(written("/elsewhere/data"), Catch::Contains("root: /elsewhere/data\n"));
  // Through a link the data lie elsewhere.
  std::filesystem::create_symlink("/usr", folder.path() / "link");
  CHECK_THAT(written(folder.path() / "link"), Catch::Contains("root: " + (folder.path() / "link").string() + "\n"));
  CHECK(parse_config(written(folder.path() / "data"), "config.yaml", run).dataset.root == folder.path() / "data");
  // A folder right below the root has all of the disk within two steps.
  c.dataset.root = "/elsewhere/data";
  CHECK_THAT(to_yaml(c, "/nowhere/run"), Catch::Contains("root: /elsewhere/data\n"));
  CHECK_THAT(to_yaml(c, "/nowhere"), Catch::Contains("root: ../elsewhere/data\n"));
  // A folder that is not given stays so.
  CHECK_THAT(written(run), Catch::Contains("weights:\n  folder: \"\"\n"));
  CHECK_THAT(documented_yaml(c, run), Catch::Contains("  folder: \"\"\n"));
  // A relative path to nothing is no path from the run's folder.
  CHECK_THAT(written("missing/data"), Catch::Contains("root: missing/data\n"));
}

TEST_CASE("a key is found by its name") {
  Config c = parse(kBase);
  CHECK(bound_key(c, "scores.problems").write({}) == "10");
  CHECK_THROWS_WITH(bound_key(c, "scores.problem"), "[config] there is no key 'scores.problem'");
}

TEST_CASE("the evaluation uses the pipeline of the scores if none is named") {
  CHECK(parse("dataset: {root: data}\nscores: {backbone: mobilenet, clustering: single, problems: 1}\n")
            .evaluation.pipelines == std::vector<std::string>{"mobilenet_single"});
}

TEST_CASE("every key can be overridden by its own written value, and its default is accepted") {
  for (const auto& key : config_keys()) {
    INFO(key.name);
    CHECK_FALSE(key.help.empty());
    const std::string error = error_of(kBase, {key.name + "=" + key.default_value});
    // The two keys without a valid default.
    if (key.name == "dataset.root")
      CHECK(error == "--set dataset.root: required, name the folder of the images");
    else
      CHECK(error == (key.name == "scores.problems"
                          ? "c.yaml: scores.min_samples: no rule says when to stop, set "
                            "scores.min_samples, scores.problems or scores.target_error above 0"
                          : ""));
  }
}

namespace {

/// A valid value of the key that is not its default, as an override.
std::string another_value(const ConfigKey& key) {
  if (key.accepts.starts_with("a whole number")) return std::to_string(std::stoll(key.default_value) + 5);
  if (key.accepts.starts_with("a number")) return "0.5";
  if (key.accepts.starts_with("one of")) return key.accepts.substr(key.accepts.rfind(' ') + 1);
  if (key.accepts.starts_with("a list")) return "[other_kmeans]";
  return "other";
}

/// The fingerprints of scores, model and evaluation, from features of given fingerprints.
std::array<std::string, 3> fingerprints(const Config& config, const std::string& of_views = "views",
                                        const std::string& of_top_views = "top views") {
  const std::string scores = scores_fingerprint(of_views, config);
  const std::string model = model_fingerprint(of_top_views, scores, config);
  return {scores, model, stage_fingerprint(Stage::evaluation, std::array{scores, model}, config)};
}

}  // namespace

TEST_CASE("a key changes the fingerprint of its stage, those of later stages, and none of earlier ones") {
  const std::string pipelines = "evaluation.pipelines=[xception_ward]";
  for (const ConfigKey& key : config_keys()) {
    INFO(key.name << ", of stage " << name_of(key.stage));
    if (key.name == "preset") continue;  // it sets keys of all stages
    const std::string value = another_value(key);
    REQUIRE(value != key.default_value);
    const bool needs_axis = key.name == "sv_net.depth" || key.name == "sv_net.next_view";
    const std::string frame = needs_axis ? "sv_net.frame=axis" : "sv_net.frame=camera";
    const auto before = fingerprints(parse(kBase, {pipelines, frame}));
    const auto after = fingerprints(parse(kBase, {pipelines, frame, key.name + "=" + value}));
    const Stage stages[] = {Stage::scores, Stage::model, Stage::evaluation};
    for (std::size_t i = 0; i < 3; ++i) {
      INFO("fingerprint of " << name_of(stages[i]));
      // Keys of the features count through the fingerprints of the features, which stay as they are here.
      CHECK((after[i] != before[i]) == (key.stage != Stage::features && key.stage <= stages[i]));
    }
  }
}

TEST_CASE("a key that came later leaves fingerprints as they were while it has its default") {
  const Config config = parse(kBase);
  Sha256 before;
  before.update_field("scores 2").update_field("views");
  std::map<std::string, std::string> values;
  Config copy = config;
  for (const BoundKey& key : bound_keys(copy))
    if (key.stage == Stage::scores && key.name != "scores.rounds") values[key.name] = key.write({});
  for (const auto& [name, value] : values) before.update_field(name).update_field(value);
  CHECK(scores_fingerprint("views", config) == before.hex());
  CHECK(scores_fingerprint("views", parse(kBase, {"scores.rounds=0"})) == before.hex());
  CHECK(scores_fingerprint("views", parse(kBase, {"scores.rounds=1"})) != before.hex());
}

TEST_CASE("fingerprints change with every bit of the weights, and with every scores file of a mean") {
  const Config c = parse(kBase);
  const std::set<std::string> different{scores_fingerprint("views", c),
                                        scores_fingerprint("views", {0.5, 0.5}, c),
                                        scores_fingerprint("other", {0.5, 0.5}, c),
                                        scores_fingerprint("views", {0.5, std::nextafter(0.5, 1)}, c),
                                        mean_scores_fingerprint(std::array<std::string, 2>{"a", "b"}, c),
                                        mean_scores_fingerprint(std::array<std::string, 2>{"b", "a"}, c),
                                        mean_scores_fingerprint(std::array<std::string, 1>{"a"}, c)};
  CHECK(different.size() == 7);
}

TEST_CASE("the pipelines of several backbones are the default ones") {
  const Config c = parse(kBase, {"scores.backbones=[mobilenet, xception]", "scores.layer=block14_sepconv2_act",
                                 "scores.clustering=kmeans"});
  CHECK(c.evaluation.pipelines == std::vector<std::string>{"mobilenet_kmeans", "xception_kmeans"});
  CHECK(scored_layer(c.scores, "mobilenet").empty());
  CHECK(scored_layer(c.scores, "xception") == "block14_sepconv2_act");
}

TEST_CASE("fingerprints change with those of the features, and with every name of an enum") {
  const Config c = parse(kBase);
  const auto before = fingerprints(c), views = fingerprints(c, "others"),
             top_views = fingerprints(c, "views", "others");
  for (std::size_t i = 0; i < 3; ++i) CHECK(views[i] != before[i]);
  CHECK(top_views[0] == before[0]);
  CHECK(top_views[1] != before[1]);
  std::set<std::string> different;
  for (const std::string& name : names_of<Clustering>())
    different.insert(fingerprints(parse(kBase, {"scores.clustering=" + name}))[0]);
  CHECK(different.size() == 5);
  // Lists are told apart from their items.
  CHECK(fingerprints(parse(kBase, {"dataset.held_out=[a, b]"}))[0] !=
        fingerprints(parse(kBase, {"dataset.held_out=['a, b']"}))[0]);
}

TEST_CASE("configs/paper.yaml documents every key with the paper's values") {
  const std::filesystem::path folder = std::filesystem::path(SVNET_SOURCE_DIR) / "configs";
  const Config c = read_config(folder / "paper.yaml");
  const std::string text = file_contents(folder / "paper.yaml"), documented = documented_yaml(c, folder);
  // The file is a heading and then documented_yaml(): this test prints what to write.
  CAPTURE(documented);
  CHECK(text.ends_with("\n\n" + documented));
  CHECK(c.dataset.held_out == std::vector<std::string>{"comb", "hammer", "knife", "toothbrush", "wrench"});
  CHECK(c.scores.min_samples == 200000);
  CHECK(c.sv_net.width == 4096);
  CHECK(c.evaluation.problems == 10000);
  CHECK(c.evaluation.nmi == NmiAverage::geometric);
}

TEST_CASE("the other configurations of the project are valid") {
  const std::filesystem::path folder = std::filesystem::path(SVNET_SOURCE_DIR) / "configs";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) CHECK_NOTHROW(read_config(entry.path()));
}

TEST_CASE("a pipeline's name is a backbone and a clustering after the last underscore") {
  const PipelineName name = parse_pipeline("mobilenet_v2_kmeans", "");
  CHECK(name.backbone == "mobilenet_v2");
  CHECK(name.clustering == Clustering::kmeans);
  CHECK(name_of(name.clustering) == std::string("kmeans"));
  CHECK(enum_from_name<Clustering>("clustering", "single") == Clustering::single);
  CHECK_THROWS_WITH(enum_from_name<Clustering>("clustering", "wards"),
                    "clustering: 'wards' is none of ward, average, complete, single, kmeans; did you mean 'ward'?");
}

TEST_CASE("a tab or a no-break space is named, with its place") {
  CHECK(error_of("dataset:\n\troot: d\n") == "c.yaml:2: a tab in the indentation (column 1); YAML takes spaces only");
  CHECK(error_of("dataset:\n  root: d\n \theld_out: [a]\n") ==
        "c.yaml:3: a tab in the indentation (column 2); YAML takes spaces only");
  CHECK(error_of("dataset:\n  held_out:\n\t- mug\n") ==
        "c.yaml:3: a tab in the indentation (column 1); YAML takes spaces only");
  CHECK(error_of("dataset:\n  root:\xc2\xa0photos\n") ==
        "c.yaml:2: a no-break space (U+00A0) (column 8); YAML takes spaces only");
  CHECK(error_of("dataset:\n\xc2\xa0 root: d\n") ==
        "c.yaml:2: a no-break space (U+00A0) (column 1); YAML takes spaces only");
  // Where they do no harm: in quotes, in comments, in brackets, on empty lines.
  const Config c = parse(
      "scores: {problems: 1} #\xc2\xa0\ttext\n\t\n\t# comment\n\t\r\ndataset:\n"
      "  root: 'a\xc2\xa0\tb'\n  held_out: [car,\n\tdog]\n\t");
  CHECK(c.dataset.held_out == std::vector<std::string>{"car", "dog"});
}

TEST_CASE("a no-break space is found after everything that may look like a quote or a comment, and not in them") {
  // The blank of a list's item that follows `before`, which is in the same list.
  const auto error_after = [](const std::string& before) {
    return error_of(kBase + "evaluation: {selectors: [" + before +
                    ", a\xc2\xa0"
                    "b]}\n");
  };
  for (const std::string before : {"it's", "a\"b", "a#b", "'a'", "\"a\"", "\"a\\\"b\"", "'it''s'", "\"a\\\\\""}) {
    INFO(before);
    CHECK_THAT(error_after(before), Catch::StartsWith("c.yaml:3: a no-break space (U+00A0) (column "));
  }
  CHECK(error_of(kBase + "sv_net: {layer: a}\xc2\xa0\n") ==
        "c.yaml:3: a no-break space (U+00A0) (column 19); YAML takes spaces only");
  CHECK(error_of(kBase + "sv_net:\n  layer: a]\n\tbackbone: b\n") ==
        "c.yaml:5: a tab in the indentation (column 1); YAML takes spaces only");
  const auto layer = [](const std::string& quoted) {
    return parse(kBase + "sv_net: {\"layer\":" + quoted + "}\n").sv_net.layer;
  };
  CHECK(layer(" 'a\xc2\xa0"
              "b'") ==
        "a\xc2\xa0"
        "b");
  CHECK(layer(" \"a\\\"\xc2\xa0\"") == "a\"\xc2\xa0");
  CHECK(parse(kBase + "evaluation: {selectors: ['\xc2\xa0','\xe3\x80\x80']}\n").evaluation.selectors.size() == 2);
  // A text in quotes may go on in the next line, after tabs too.
  CHECK(parse(kBase + "sv_net:\n  layer: \"a\n\tb\"\n").sv_net.layer == "a b");
  CHECK(parse(kBase + "sv_net:\n  layer: \"a\\\n\tb\"\n").sv_net.layer == "ab");
}

TEST_CASE("a preset sets other keys first, wherever it stands, and keys that are given come after it") {
  const Config best = parse(kBase + "preset: best\n");
  CHECK(best.preset == Preset::best);
  CHECK(best.sv_net.frame == frame::FrameChoice::axis);
  CHECK(to_yaml(parse("preset: best\n" + kBase)) == to_yaml(best));
  CHECK(parse(kBase, {"preset=best"}).sv_net.frame == frame::FrameChoice::axis);
  CHECK(parse(kBase, {"sv_net.frame=camera", "preset=best"}).sv_net.frame == frame::FrameChoice::camera);
  CHECK(parse("sv_net: {frame: camera}\npreset: best\n" + kBase).sv_net.frame == frame::FrameChoice::camera);
  CHECK(parse(kBase + "preset: turns\n").training.augmentation == TopViewAugmentation::turns);
  CHECK(parse(kBase + "preset: turns\n", {"preset=best"}).training.augmentation == TopViewAugmentation::none);
  CHECK(parse(kBase + "sv_net: {width: 9}\n", {"preset=turns"}).sv_net.width == 9);
  Config paper = parse(kBase), explicitly = parse(kBase + "preset: paper\n");
  CHECK(to_yaml(paper) == to_yaml(explicitly));
}

TEST_CASE("an unknown preset is refused with its place and the nearest one") {
  CHECK(error_of(kBase + "preset: bests\n") ==
        "c.yaml:3: preset: unknown value 'bests', expected one of paper, turns, best; did you mean 'best'?");
  CHECK(error_of_override("preset=turn") ==
        "--set preset: unknown value 'turn', expected one of paper, turns, best; did you mean 'turns'?");
  CHECK(error_of_override("preset=") == error_of_override("preset=''"));
  CHECK_FALSE(error_of(kBase + "preset: [best]\n").empty());
}

TEST_CASE("the resolved configuration of every preset reads back equal") {
  for (const std::string& preset : names_of<Preset>()) {
    INFO(preset);
    const Config c = parse(kBase, {"preset=" + preset, "scores.rounds=3", "scores.backbones=[mobilenet, xception]"});
    const std::string yaml = to_yaml(c);
    const Config again = parse_config(yaml, "resolved", "/elsewhere");
    CHECK(to_yaml(again) == yaml);
    CHECK(again.preset == c.preset);
    CHECK(again.sv_net.frame == c.sv_net.frame);
    CHECK(again.scores.rounds == 3);
    CHECK(fingerprints(again) == fingerprints(c));
  }
}

TEST_CASE("depth is of the frames with an axis only") {
  const std::string problem = ": only the frames axis and turned_axis read depth; set sv_net.frame to one of them";
  CHECK(error_of(kBase + "sv_net:\n  depth: heights\n  frame: turned\n") == "c.yaml:4: sv_net.depth" + problem);
  const Config both = parse(kBase, {"sv_net.frame=turned_axis", "sv_net.depth=heights"});
  CHECK(both.sv_net.frame == frame::FrameChoice::turned_axis);
  CHECK(parse_config(to_yaml(both), "resolved", "/elsewhere").sv_net.frame == frame::FrameChoice::turned_axis);
  CHECK(parse(kBase, {"sv_net.frame=turned"}).sv_net.frame == frame::FrameChoice::turned);
  CHECK(error_of_override("sv_net.frame=turn") ==
        "--set sv_net.frame: unknown value 'turn', expected one of camera, axis, turned, turned_axis; did you mean "
        "'turned'?");
  CHECK(error_of_override("sv_net.depth=heights") == "--set sv_net.depth" + problem);
  CHECK(error_of(kBase + "sv_net:\n  depth: heights\n") == "c.yaml:4: sv_net.depth" + problem);
  CHECK(error_of(kBase + "preset: best\nsv_net:\n  depth: heights\n  frame: camera\n") ==
        "c.yaml:5: sv_net.depth" + problem);
  CHECK(parse(kBase, {"preset=best", "sv_net.depth=heights"}).sv_net.depth == frame::DepthChoice::heights);
}

TEST_CASE("the frame and its depth change the model, and the camera's models keep their fingerprints") {
  const auto camera = fingerprints(parse(kBase)), axis = fingerprints(parse(kBase, {"sv_net.frame=axis"})),
             depth = fingerprints(parse(kBase, {"sv_net.frame=axis", "sv_net.depth=heights"}));
  CHECK(axis[0] == camera[0]);
  CHECK(axis[1] != camera[1]);
  CHECK(depth[1] != axis[1]);
  CHECK(fingerprints(parse(kBase, {"sv_net.frame=camera", "sv_net.depth=none"})) == camera);
}

TEST_CASE("the EXIF orientation is ignored unless the configuration says to obey it") {
  CHECK(parse(kBase).dataset.exif_orientation == ExifOrientation::ignore);
  CHECK(parse(kBase, {"dataset.exif_orientation=obey"}).dataset.exif_orientation == ExifOrientation::obey);
}
