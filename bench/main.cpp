// Runs the benchmarks that are linked in, with the instruction set that SVNET_MAX_ISA allows.
#include <exception>
#include <iostream>

#include <benchmark/benchmark.h>

#include "base/cpu.h"

int main(int argc, char** argv) {
  try {
    svnet::cap_from_environment();
  } catch (const std::exception& error) {
    std::cerr << "error: " << error.what() << "\n";
    return 1;
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
