// svnet-info: what a file of svnet's contains, what svnet runs on, or how it runs a network.
#include <cblas.h>

#include "base/cpu.h"
#include "base/parallel.h"
#include "base/text.h"
#include "base/version.h"
#include "command/command.h"
#include "info/describe.h"
#include "info/plan_text.h"

namespace svnet {
using namespace command;

namespace {

std::string machine_text() {
  const std::vector<std::string> sets = instruction_sets();
  return joined("svnet ", kVersion, "\ncpu: ", cpu_name(), "\ninstruction sets, best first: ", joined_with(", ", sets),
                "\nkernels: ", sets.front(), " (SVNET_MAX_ISA forces a lower one)",
                "\nmatrix products of OpenBLAS: ", openblas_get_corename(), " (OPENBLAS_CORETYPE chooses others)",
                "\nthreads: ", Parallel::shared().threads());
}

}  // namespace
}  // namespace svnet

int main(int argc, char** argv) {
  using namespace svnet;
  Command command("svnet-info",
                  "Says what a weights, features, scores, checkpoint or model file contains; without a file: version, "
                  "CPU, instruction sets, the kernels chosen, threads. With --plan: how a backbone, or the networks of "
                  "a model file, run here, step by step.",
                  "svnet-info runs/eth80/scores.h5\nsvnet-info --plan vgg19 --batch 8\n"
                  "svnet-info runs/eth80/model.safetensors --plan");
  std::string what, layer;
  bool plan = false, tensors = false;
  Index batch = 1;
  command.add("FILE", what, "A file (.h5, .safetensors); with --plan, a model file or a backbone's name");
  const Argument asked = command.add_flag("--plan", plan, "Print the steps of the compiled network, timed");
  command.add("--batch", batch, "Images that run together (default 1)").needs(asked).in_range(1, 1024);
  command.add("--layer", layer, "The backbone's layer to stop at (default: the pooled one)").needs(asked);
  command.add_precision(true).needs(asked);
  command.add_flag("--tensors", tensors, "Lists the tensors of a model file too").excludes(asked);
  command.add_sandbox();
  return command.run(argc, argv, [&](Console& console) {
    if (what.empty()) {
      if (plan) wrong_usage("--plan takes a model file or the name of a backbone");
      return console.result(machine_text());
    }
    if (!plan) return console.result(description_of(what, tensors));
    const InferenceOptions options = inference_options_from_environment(command.precision());
    const std::filesystem::path file = what;
    if (std::filesystem::exists(file) || file.has_extension() || file.has_parent_path()) {
      if (!layer.empty()) wrong_usage("--layer is for backbones, a model file has its own");
      return console.result(model_plan(file, batch, options));
    }
    console.result(backbone_plan(what, layer, batch, options));
  });
}
