// svnet-render: renders a dataset of views in simulation (simulation/rendered_dataset.h).
#include "base/text.h"
#include "command/command.h"
#include "simulation/rendered_dataset.h"

using namespace svnet;

int main(int argc, char** argv) {
  Command command("svnet-render",
                  "Collects views of household objects and tools in simulation, as a robot with an RGB-D camera would: "
                  "each object rests on a table, is localised in an overview, and is seen from the paper's viewpoints. "
                  "Writes CATEGORY/OBJECT/POSE/PHI_THETA.png, manifest.json, and under _extra/ a contact sheet, the "
                  "overviews, depth (16-bit PNG, millimetres) and masks. The same seed gives the same pictures.",
                  "svnet-render --output runs/rendered\n"
                  "svnet-render --output runs/tools --categories hammer,wrench,pliers --objects 3 --size 160\n"
                  "svnet-render --output runs/mine --meshes meshes --unit 0.001");
  RenderOptions options;
  command.add("--output", options.output, "The folder to make").required();
  command
      .add("--categories", options.categories,
           "Some categories, with commas between them (all " + std::to_string(catalogue_names().size()) + ": " +
               joined_with(", ", catalogue_names()) + ")")
      .separated_by_commas();
  command.add("--objects", options.objects, "Objects of each category (5; further ones are mixtures of the first 5)")
      .in_range(1, 999);
  command.add("--poses", options.poses, "Poses of each object (3)").in_range(1, 99);
  command.add("--size", options.size, "Height and width of the pictures in pixels (224)").in_range(32, 2048);
  command.add("--seed", options.seed, "Seed of poses, tables, lights, noise and missing views (1)")
      .in_range(0, Index{1} << 53);
  const Argument meshes = command.add(
      "--meshes", options.meshes, "Your own objects instead: a folder with CATEGORY/NAME.obj (or .ply, .stl, .glb)");
  command.add("--unit", options.metres_per_unit, "Metres per unit of the meshes (1); objects may be 1 mm to 1 m long")
      .positive()
      .needs(meshes);
  return command.run(argc, argv, [&](Console& console) {
    const RenderSummary made = render_dataset(options, console.messages());
    console.result(joined(made.pictures, " pictures of ", made.poses, " poses in ", options.output.string(),
                          made.left_out > 0 ? joined("; ", made.left_out, " left out, as manifest.json tells") : ""));
  });
}
