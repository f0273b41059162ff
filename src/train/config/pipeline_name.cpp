#include "train/config/pipeline_name.h"

#include "base/error.h"
#include "base/text.h"
#include "train/config/strict_yaml.h"

namespace svnet::train {
using semantics::Clustering;

PipelineName parse_pipeline(const std::string& name, const std::string& where) {
  const auto at = name.rfind('_');
  check(at != std::string::npos && at > 0, where, ": '", name,
        "' is not BACKBONE_CLUSTERING, as in mobilenet_v2_ward; clusterings: ",
        joined_with(", ", names_of<Clustering>()));
  const std::string clustering = name.substr(at + 1);
  check_choice(where + ": " + name, clustering, names_of<Clustering>());
  return {name.substr(0, at), *find_enum<Clustering>(clustering)};
}

}  // namespace svnet::train
