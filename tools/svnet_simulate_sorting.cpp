// svnet-simulate-sorting: a robot that sorts objects into bins, in simulation.
#include "base/text.h"
#include "chosen_backbone.h"
#include "command/command.h"
#include "io/files/atomic_file.h"
#include "io/files/scratch_folder.h"
#include "io/images/image_file.h"
#include "io/views/composed_name.h"
#include "io/views/dataset_folder.h"
#include "io/views/dataset_notes.h"
#include "simulate_sorting/collection.h"
#include "simulate_sorting/table_picture.h"
#include "sorting/view_selectors.h"
#include "train/dataset_rows.h"

namespace {

using namespace svnet;
using namespace svnet::command;
using sorting::GroupRule;
namespace fs = std::filesystem;

struct Arguments {
  fs::path dataset{}, model{}, weights{}, json{}, picture{};
  std::vector<std::string> categories{};
  std::string groups{}, backbone = "tiny_xception";
  sorting::SimulationOptions options{};
};

GroupRule group_rule(const std::string& text, Index objects) {
  if (text.empty()) return {GroupRule::Kind::categories, 0};
  if (text == "auto") return {GroupRule::Kind::estimated, 0};
  Index count = 0;
  if (!parse_number(text, count) || count < 1 || count > objects)
    wrong_usage("--groups: '", printable(text), "' is neither a whole number from 1 to --objects, ", objects,
                ", nor auto");
  return {GroupRule::Kind::fixed, count};
}

/// The categories that tables may have: those asked for, all if there are none, less those that the model knows.
ViewDataset tables_dataset(const ViewDataset& all, const std::vector<std::string>& wanted,
                           const std::vector<std::string>& known, Console& console) {
  std::vector<bool> used = wanted.empty() ? std::vector<bool>(all.categories.size(), true)
                                          : train::named_categories(all, wanted, "--categories");
  std::vector<std::string> left_out;
  for (const std::string& name : known) {
    const auto at = std::ranges::find(all.categories, io::composed_name(name));
    const auto category = static_cast<std::size_t>(at - all.categories.begin());
    if (at == all.categories.end() || !used[category]) continue;
    used[category] = false;
    left_out.push_back(*at);
  }
  if (!left_out.empty())
    console.line("left out, since the model was trained on them: " + printable(joined_with(", ", left_out)));
  const auto count = std::ranges::count(used, true);
  check(left_out.empty() || count >= sorting::kFewestCategories, "a table has objects of at least ",
        sorting::kFewestCategories, " categories, and the data set has ", count,
        " that the model was not trained on; give a data set or --categories with others");
  return with_categories(all, used);
}

void check_outputs(const Arguments& a) {
  std::vector<fs::path> others{a.model, a.weights};
  for (const fs::path& output : {a.json, a.picture}) {
    if (output.empty()) continue;
    io::check_can_be_written(output, others, io::Streams::allowed);
    others.push_back(output);
  }
  check(!io::is_standard_output(a.json) || !io::is_standard_output(a.picture),
        "only one of --json and --picture can go to standard output");
}

std::vector<std::size_t> pictured_selectors(const std::vector<train::Selector>& selectors, bool has_model) {
  const auto chosen = std::ranges::find(selectors, std::string(has_model ? "svnet" : "opt"), &train::Selector::name);
  return {0, static_cast<std::size_t>(chosen - selectors.begin())};
}

void simulate_sorting(const Arguments& a, const InferenceOptions& inference, Console& console) {
  check_outputs(a);
  std::optional<predict::Predictor> predictor;
  std::vector<std::string> known;
  if (a.model.empty()) {
    console.line("without --model there are no rows of SV-net: give a model of svnet-train");
  } else {
    const Model model = io::read_model(a.model);
    known = model.trained_on.categories;
    predictor.emplace(model, inference);
    if (known.empty() && a.categories.empty())
      console.line(a.model.string() + ": does not say what it was trained on; name other categories by --categories");
  }
  io::KerasLoadReport loaded;
  const train::BackboneWithOrigin source = chosen_backbone(a.backbone, "", a.weights, loaded, inference);

  std::optional<io::ScratchFolder> scratch;
  fs::path folder = a.dataset;
  if (folder.empty()) {
    folder = scratch.emplace("svnet-simulate-sorting").path() / "views";
    render_collection(folder, a.categories, known, a.options.seed, console.messages());
  }
  Parallel& parallel = Parallel::shared();
  const ViewDataset dataset = tables_dataset(io::read_view_dataset(folder), a.categories, known, console);
  for (const std::string& note : io::dataset_notes(dataset, parallel)) console.line(note);
  (void)sorting::Tables(dataset, a.options.objects);  // throws before the work
  const Features features = train::extract_features(source.backbone, dataset, train::features_origin(source, ""),
                                                    console.messages(), SingleProcess::shared());
  const std::vector<double> predicted =
      predictor ? sorting::predicted_scores(dataset, *predictor, console.messages(), parallel) : std::vector<double>();
  const std::vector<train::Selector> selectors =
      sorting::view_selectors(dataset, features.values, predicted, a.options.seed, console.messages(), parallel);
  const std::vector<sorting::SortedTable> tables =
      sorting::simulate(dataset, features.values, selectors, a.options, console.messages(), parallel);
  const std::vector<sorting::SelectorSummary> summaries = sorting::summaries(tables, a.options.seed);
  const SimulationReport report{.dataset = dataset,
                                .selectors = selectors,
                                .tables = tables,
                                .summaries = summaries,
                                .options = a.options,
                                .dataset_name = a.dataset.empty() ? "rendered" : a.dataset.string(),
                                .model = a.model.string(),
                                .backbone = a.backbone,
                                .weights_sha256 = source.weights};

  // Everything is made before the first file is written.
  std::optional<Image> picture;
  if (!a.picture.empty()) picture = table_picture(report, pictured_selectors(selectors, predictor.has_value()));
  if (!a.json.empty()) io::write_atomically(a.json, simulation_json(report));
  if (picture) io::write_png(a.picture, *picture);
  if (!io::is_standard_output(a.json) && !io::is_standard_output(a.picture)) console.result(simulation_text(report));
}

}  // namespace

int main(int argc, char** argv) {
  Command command(
      "svnet-simulate-sorting",
      "Simulates a robot that sorts the objects of a table into bins: it sees each object from above, moves its camera "
      "to the view that a selector chooses, groups the objects by features of these views (Ward), and puts each group "
      "into a bin. Prints for each selector, as means over random tables: objects in wrong bins, moves of the camera, "
      "seconds, and how many objects fewer are wrong than with the top view alone, with a 95 % interval over tables. "
      "An object is right if its category has the most objects in its bin, and no other bin has more objects of this "
      "category. A move takes 1.5 s and its angle at 60 degrees per second; the way between objects is not counted. "
      "Selectors: top; rand; broadside, phi 45 across the object's axis; svnet and svnet_2, one and two views that the "
      "model chooses; top_svnet, the top view and that of svnet; move_50, that of svnet for the objects that gain most "
      "by it, half of them; opt, the best view by its semantic score, which needs "
      "all views and their categories: a limit.",
      "svnet-simulate-sorting\n"
      "svnet-simulate-sorting photos --model runs/mine/model.safetensors --picture table.png\n"
      "svnet-simulate-sorting photos --backbone mobilenet_v2 --weights mobilenet_v2.h5 --objects 10 --json -");
  Arguments a;
  const Argument dataset = command.add(
      "DATASET", a.dataset,
      can_render() ? "A folder of views, CATEGORY/OBJECT/POSE/PHI_THETA.png (default: a small collection is "
                     "rendered, of 6 categories)"
                   : "A folder of views, CATEGORY/OBJECT/POSE/PHI_THETA.png");
  if (!can_render()) dataset.required();
  command
      .add("--model", a.model,
           "A model of svnet-train that chooses views. Categories that it was trained on are left out of the tables")
      .value_name("FILE");
  command.add("--tables", a.options.tables, "How many tables").in_range(1, 1'000'000).shows_default();
  command
      .add("--objects", a.options.objects, "Objects on a table, of 3 to 5 categories, and at least 2 of each category")
      .in_range(1, 1000)
      .shows_default();
  command.add("--categories", a.categories, "The only categories, with commas between them (default: all)")
      .separated_by_commas();
  command
      .add("--groups", a.groups,
           "The number of bins, or auto: it is estimated from how far the objects are apart (default: the number of "
           "categories on the table)")
      .value_name("K|auto");
  add_backbone_options(command, a.backbone, a.weights, "The network that sees the views").shows_default();
  command.add("--seed", a.options.seed, "Seed of tables, random views and intervals").shows_default();
  command
      .add("--json", a.json,
           "Writes JSON: the rules, the row of each selector, and every table with its categories and wrong objects. "
           "With -, or /dev/stdout, the JSON is printed instead of the rows")
      .value_name("FILE");
  command
      .add("--picture", a.picture,
           "Writes a PNG image of the first table: the objects from above, and the bins by top and by svnet (opt "
           "without a model), with the chosen views. Frames have the colours of categories; wrong objects have a "
           "cross")
      .value_name("FILE");
  command.add_precision();
  command.add_sandbox();
  return command.run(argc, argv, [&](Console& console) {
    if (a.json == "-") a.json = "/dev/stdout";
    a.options.groups = group_rule(a.groups, a.options.objects);
    simulate_sorting(a, inference_options_from_environment(command.precision()), console);
  });
}
