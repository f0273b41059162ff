// Lines "key=value", as --set takes them.
#include "fuzz_target.h"
#include "train/config/config_file.h"

using namespace svnet;
using namespace svnet::fuzz;

SVNET_FUZZ_TARGET(override) {
  accept([&] {
    std::vector<std::string> overrides{""};
    for (const char c : text_of(input))
      if (c == '\n')
        overrides.emplace_back();
      else
        overrides.back() += c;
    train::parse_config("", "input", "/nowhere", overrides);
  });
}
