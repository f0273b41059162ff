// svnet-info: what a file of svnet's contains, or what svnet runs on.
#include <cblas.h>

#include "base/cpu.h"
#include "base/parallel.h"
#include "base/text.h"
#include "base/version.h"
#include "command/command.h"
#include "train/describe.h"

int main(int argc, char** argv) {
  using namespace svnet;
  Command command("svnet-info",
                  "Says what a weights, features, scores, checkpoint or model file contains; without a file: version, "
                  "CPU, instruction sets, the kernels chosen, threads.",
                  "svnet-info runs/eth80/scores.h5");
  std::filesystem::path file;
  command.app().add_option("FILE", file, "A file (.h5, .safetensors)");
  return command.run(argc, argv, [&](Console& console) {
    if (!file.empty()) return console.result(description_of(file));
    const std::vector<std::string> sets = instruction_sets();
    console.result(joined(
        "svnet ", kVersion, "\ncpu: ", cpu_name(), "\ninstruction sets, best first: ", joined_with(", ", sets),
        "\nkernels: ", sets.front(), " (SVNET_MAX_ISA forces a lower one)",
        "\nmatrix products of OpenBLAS: ", openblas_get_corename(), "\nthreads: ", Parallel::shared().threads()));
  });
}
