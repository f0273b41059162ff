#include "io/views/features_file.h"

#include <map>

#include "base/error.h"
#include "base/finite.h"
#include "base/text.h"
#include "io/files/atomic_file.h"
#include "io/hdf5/hdf5_file.h"

namespace svnet::io {
namespace {

/// Attributes and the members they fill.
constexpr std::pair<const char*, std::string FeaturesOrigin::*> kAttributes[] = {
    {"backbone", &FeaturesOrigin::backbone},
    {"output", &FeaturesOrigin::output},
    {"preprocessing", &FeaturesOrigin::preprocessing},
    {"weights_sha256", &FeaturesOrigin::weights_sha256},
    {"dataset_fingerprint", &FeaturesOrigin::dataset_fingerprint},
    {"input_fingerprint", &FeaturesOrigin::input_fingerprint},
};

/// Whether the file is of a program that names no paths.
bool has_labels_only(const Hdf5File& file) { return !file.has("paths") && file.has("labels"); }

void read_origin(const Hdf5File& file, FeaturesOrigin& origin) {
  for (const auto& [name, member] : kAttributes)
    if (!has_labels_only(file) || file.has_attribute("", name)) origin.*member = file.text_attribute("", name);
}

/// The number of each path's first folder, in order of appearance; empty if a path has no folder.
std::vector<std::int64_t> labels_of(const std::vector<std::string>& paths) {
  std::vector<std::int64_t> labels;
  std::map<std::string, std::int64_t> numbers;
  for (const std::string& path : paths) {
    const std::size_t end = path.find('/');
    if (end == std::string::npos) return {};
    labels.push_back(numbers.emplace(path.substr(0, end), static_cast<std::int64_t>(numbers.size())).first->second);
  }
  return labels;
}

/// A row for messages.
std::string row_name(const Features& features, std::size_t row) {
  return features.paths.empty() ? joined(row) : joined(row, " (", printable(features.paths[row]), ")");
}

std::vector<Index> checked_shape(const Hdf5File& file, const std::string& dataset, const std::vector<Index>& shape,
                                 std::size_t rank) {
  check(shape.size() == rank, file.name(), ": dataset '", dataset, "': has ", shape.size(), " dimensions, expected ",
        rank);
  return shape;
}

void check_features(const std::string& file, const Features& features) {
  check(features.count > 0 && features.dimension > 0, file, ": dataset 'features': is empty, ", features.count, "x",
        features.dimension);
  check(static_cast<Index>(features.values.size()) == features.count * features.dimension, file,
        ": dataset 'features': holds ", features.values.size(), " values for ", features.count, "x",
        features.dimension);
  check(static_cast<Index>(features.theta_phi_deg.size()) == features.count, file, ": dataset 'th_ph': has ",
        features.theta_phi_deg.size(), " rows, 'features' has ", features.count);
  const bool has_paths = features.labels.empty() || !features.paths.empty();
  const std::size_t names = has_paths ? features.paths.size() : features.labels.size();
  check(static_cast<Index>(names) == features.count, file, ": dataset '", has_paths ? "paths" : "labels", "': has ",
        names, " rows, 'features' has ", features.count);
  if (const auto bad = first_not_finite(features.values)) {
    const std::size_t row = *bad / static_cast<std::size_t>(features.dimension);
    fail(file, ": dataset 'features': row ", row_name(features, row), " has a value that is not finite");
  }
  for (std::size_t row = 0; row < features.theta_phi_deg.size(); ++row)
    check(!first_not_finite(features.theta_phi_deg[row]), file, ": dataset 'th_ph': row ", row_name(features, row),
          " has an angle that is not finite");
}

}  // namespace

FeaturesOrigin read_features_origin(const std::filesystem::path& path) {
  FeaturesOrigin origin;
  read_origin(Hdf5File::open(path), origin);
  return origin;
}

Features read_features(const std::filesystem::path& path) {
  const Hdf5File file = Hdf5File::open(path);
  Features features;
  read_origin(file, features);
  const std::vector<Index> shape = checked_shape(file, "features", file.shape("features"), 2);
  features.count = shape[0];
  features.dimension = shape[1];
  features.values = file.read<float>("features").values;
  const Hdf5Array<double> angles = file.read<double>("th_ph");
  check(checked_shape(file, "th_ph", angles.shape, 2)[1] == 2, file.name(), ": dataset 'th_ph': has ", angles.shape[1],
        " columns, expected 2");
  for (std::size_t i = 0; i < angles.values.size(); i += 2)
    features.theta_phi_deg.push_back({angles.values[i], angles.values[i + 1]});
  if (has_labels_only(file)) {
    Hdf5Array<std::int64_t> labels = file.read<std::int64_t>("labels");
    checked_shape(file, "labels", labels.shape, 1);
    features.labels = std::move(labels.values);
  } else {
    Hdf5Array<std::string> paths = file.read<std::string>("paths");
    checked_shape(file, "paths", paths.shape, 1);
    features.paths = std::move(paths.values);
  }
  check_features(file.name(), features);
  return features;
}

void write_features(const std::filesystem::path& path, const Features& features) {
  check_features(path.string(), features);
  std::vector<double> angles;
  for (const auto& [theta, phi] : features.theta_phi_deg) angles.insert(angles.end(), {theta, phi});
  write_atomically(path, [&](const std::filesystem::path& temporary) {
    Hdf5File file = Hdf5File::create(temporary, path.string());
    for (const auto& [name, member] : kAttributes) file.write_text_attribute("", name, features.*member);
    file.write<float>("features", {features.count, features.dimension}, features.values);
    file.write<double>("th_ph", {features.count, 2}, angles);
    file.write<std::string>("paths", {features.count}, features.paths);
    if (const std::vector<std::int64_t> labels = labels_of(features.paths); !labels.empty())
      file.write<std::int64_t>("labels", {features.count}, labels);
    file.close();
  });
}

}  // namespace svnet::io
