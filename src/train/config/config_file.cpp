#include "train/config/config_file.h"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <map>
#include <new>

#include "base/error.h"
#include "base/text.h"
#include "train/config/config_table.h"
#include "train/config/preset.h"
#include "train/config/strict_yaml.h"

namespace svnet::train {
namespace {

using std::filesystem::path;

/// "scores" of "scores.layer", "" of "seed".
std::string section_of(const std::string& name) {
  const auto dot = name.rfind('.');
  return dot == std::string::npos ? "" : name.substr(0, dot);
}

std::string last_part(const std::string& name) { return name.substr(name.rfind('.') + 1); }

/// Applies values to a configuration, and remembers where each key was set, for errors that concern several keys.
class ConfigReader {
 public:
  ConfigReader(Config& config, std::string source) : keys_(bound_keys(config)), source_(std::move(source)) {}

  /// `value` is a mapping of keys and sections, or the value of one key.
  void read(const YamlValue& value, const path& folder) {
    const auto key = std::find_if(keys_.begin(), keys_.end(), [&](const auto& k) { return k.name == value.key; });
    if (key != keys_.end()) {
      key->read(value, folder);
      where_[key->name] = value.where();
    } else if (value.kind == YamlValue::Kind::mapping && is_section(value.key)) {
      for (const auto& item : value.items) read(item, folder);
    } else if (is_section(value.key)) {
      check(value.kind == YamlValue::Kind::null, value.where(),
            value.key.empty() ? ": expected lines of the form 'key: value'"
                              : ": is a section, expected its keys below it");
    } else {
      fail_unknown(value);
    }
  }

  std::string where(const std::string& key) const {
    const auto at = where_.find(key);
    return at == where_.end() ? source_ + ": " + key : at->second;
  }

 private:
  bool is_section(const std::string& name) const {
    return name.empty() ||
           std::any_of(keys_.begin(), keys_.end(), [&](const auto& k) { return section_of(k.name) == name; });
  }

  [[noreturn]] void fail_unknown(const YamlValue& value) const {
    const std::string start = value.where() + ": unknown key";
    const bool known_section = is_section(section_of(value.key));
    const std::string section = known_section ? section_of(value.key) : "";
    const std::string name = last_part(known_section ? value.key : section_of(value.key));
    std::vector<std::string> neighbours;
    for (const auto& key : keys_) {
      const std::string parent = section_of(key.name);
      if (!section.empty() && parent != section) continue;
      const std::string neighbour = parent == section ? last_part(key.name) : parent;
      if (neighbours.empty() || neighbours.back() != neighbour) neighbours.push_back(neighbour);
    }
    if (nearest_name(name, neighbours).empty())
      for (const auto& key : keys_)
        if (last_part(key.name) == last_part(value.key)) fail(start, ", did you mean '", key.name, "'?");
    fail(start, suggestion(name, neighbours));
  }

  std::vector<BoundKey> keys_;
  std::string source_;
  std::map<std::string, std::string> where_;
};

/// What concerns more than one key.
void check_together(const Config& c, const ConfigReader& reader) {
  check(!c.dataset.root.empty(), reader.where("dataset.root"), ": required, name the folder of the images");
  const auto& s = c.scores;
  check(s.min_samples > 0 || s.problems > 0 || s.target_error > 0, reader.where("scores.min_samples"),
        ": no rule says when to stop, set scores.min_samples, scores.problems or scores.target_error above 0");
  check(s.max_categories == 0 || s.max_categories >= s.min_categories, reader.where("scores.max_categories"), ": ",
        s.max_categories, " is less than scores.min_categories ", s.min_categories);
  check(c.sv_net.depth == frame::DepthChoice::none || frame::has_axis(c.sv_net.frame), reader.where("sv_net.depth"),
        ": only the frames axis and turned_axis read depth; set sv_net.frame to one of them");
  check(c.sv_net.next_view == NextViewChoice::none || c.sv_net.frame != frame::FrameChoice::camera,
        reader.where("sv_net.next_view"),
        ": models of the frame camera do not learn which view to take next; set sv_net.frame to another one, such as "
        "axis");
  check(s.max_objects == 0 || s.max_objects >= s.min_objects, reader.where("scores.max_objects"), ": ", s.max_objects,
        " is less than scores.min_objects ", s.min_objects);
}

std::string written(Config config, bool documented, const path& folder) {
  std::string yaml, section;
  Config defaults;
  const std::vector<BoundKey> keys = bound_keys(config), default_keys = bound_keys(defaults);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const BoundKey& key = keys[i];
    if (section_of(key.name) != section) {
      section = section_of(key.name);
      yaml += "\n" + section + ":\n";
    }
    const std::string indent = section.empty() ? "" : "  ";
    if (documented) {
      const bool required = key.accepts.ends_with("required");
      yaml += indent + "# " + key.help + " [" + key.accepts;
      yaml += required ? "]\n" : "; default: " + default_keys[i].write({}) + "]\n";
    }
    yaml += indent + last_part(key.name) + ": " + key.write(folder) + "\n";
  }
  return yaml;
}

/// `named` relative to `folder` if it lies below one of the two folders above `folder`; else as it is. Links are
/// followed: a relative path must lead to the same place.
path movable(const path& named, const path& folder) {
  if (named.empty()) return named;
  const path there = std::filesystem::weakly_canonical(named), here = std::filesystem::weakly_canonical(folder);
  const path relative = there.lexically_relative(here);
  const auto ups = std::count(relative.begin(), relative.end(), path(".."));
  const bool near = ups < 2 || (ups == 2 && here.parent_path().parent_path() != here.root_path());
  return !relative.empty() && near ? relative : named;
}

}  // namespace

Config parse_config(const std::string& text, const std::string& source, const path& folder,
                    std::span<const std::string> overrides) {
  Config config;
  ConfigReader reader(config, source);
  const YamlValue file = parse_yaml(text, source);
  std::vector<YamlValue> given;
  for (const auto& assignment : overrides) given.push_back(parse_override(assignment));
  // The preset first, since it sets other keys.
  for (const auto& values : {file.items, given})
    for (const YamlValue& value : values)
      if (value.key == "preset") reader.read(value, folder);
  config = config_of(config.preset);
  reader.read(file, std::filesystem::absolute(folder));
  for (const YamlValue& value : given) reader.read(value, std::filesystem::current_path());
  check_together(config, reader);
  if (config.evaluation.pipelines.empty())
    for (const std::string& backbone : scored_backbones(config.scores))
      config.evaluation.pipelines.push_back(joined(backbone, "_", name_of(config.scores.clustering)));
  return config;
}

Config read_config(const path& file, std::span<const std::string> overrides) {
  check(!std::filesystem::is_directory(file), file.string(), ": is a folder, expected a configuration file");
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream && errno == ENOMEM) throw std::bad_alloc();
  check(stream.is_open(), file.string(), ": cannot open the configuration file, check its name");
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  check(!stream.bad(), file.string(), ": cannot read the configuration file");
  return parse_config(text, file.string(), std::filesystem::absolute(file).parent_path(), overrides);
}

std::string to_yaml(const Config& config, const path& folder) {
  Config written_config = config;
  if (!folder.empty())
    for (path* named : {&written_config.dataset.root, &written_config.weights.folder}) *named = movable(*named, folder);
  return written(written_config, false, {});
}

std::string documented_yaml(const Config& config, const path& folder) { return written(config, true, folder); }

std::vector<ConfigKey> config_keys() {
  Config config;
  std::vector<ConfigKey> keys;
  for (const auto& key : bound_keys(config))
    keys.push_back({key.name, key.stage, key.help, key.accepts, key.write({})});
  return keys;
}

}  // namespace svnet::train
