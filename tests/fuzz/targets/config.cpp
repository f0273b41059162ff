#include "fuzz_target.h"
#include "train/config/config_file.h"

using namespace svnet;
using namespace svnet::fuzz;

SVNET_FUZZ_TARGET(config) {
  accept([&] {
    const train::Config config = train::parse_config(std::string(text_of(input)), "input", "/nowhere");
    // What was read is written as text that reads back, and is then written as the same text.
    const std::string text = train::to_yaml(config);
    std::string again;
    try {
      again = train::to_yaml(train::parse_config(text, "written", "/nowhere"));
    } catch (const Error& error) {
      report(std::string("a written configuration is refused: ") + error.what());
    }
    if (again != text) report("a configuration that changes when it is written and read");
  });
}
