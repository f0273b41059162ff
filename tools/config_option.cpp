#include "config_option.h"

#include "base/error.h"
#include "train/config/config_table.h"

namespace svnet {

CLI::Option* add_config_option(CLI::App& app, Config& config, const std::string& option, const std::string& key) {
  const BoundKey bound = bound_key(config, key);
  const auto set = [option, read = bound.read](const std::string& text) {
    YamlValue value;
    value.kind = YamlValue::Kind::scalar;
    value.place = option;
    value.text = text;
    try {
      read(value, std::filesystem::current_path());
    } catch (const Error& error) {
      throw CLI::ValidationError(error.what());
    }
  };
  return app.add_option_function<std::string>(option, set, bound.help)
      ->type_name(bound.value_name)
      ->default_str(bound.write({}));
}

}  // namespace svnet
