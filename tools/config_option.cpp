#include "config_option.h"

#include "train/config/config_table.h"

namespace svnet {
using namespace command;
using train::YamlValue;

Argument add_config_option(Command& command, train::Config& config, const std::string& option, const std::string& key) {
  const train::BoundKey bound = bound_key(config, key);
  const auto set = [option, read = bound.read](const std::string& text) {
    YamlValue value;
    value.kind = YamlValue::Kind::scalar;
    value.place = option;
    value.text = text;
    read(value, std::filesystem::current_path());
  };
  return command.add_callback(option, set, bound.help).value_name(bound.value_name).shows_default(bound.write({}));
}

}  // namespace svnet
