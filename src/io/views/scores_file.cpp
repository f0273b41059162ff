#include "io/views/scores_file.h"

#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/sha256.h"
#include "base/text.h"
#include "io/files/atomic_file.h"
#include "io/hdf5/hdf5_file.h"

namespace svnet::io {
namespace {

constexpr std::pair<const char*, std::string ScoresOrigin::*> kTextAttributes[] = {
    {"sampler", &ScoresOrigin::sampler},
    {"clustering", &ScoresOrigin::clustering},
    {"metric", &ScoresOrigin::metric},
    {"input_fingerprint", &ScoresOrigin::input_fingerprint},
};

struct Column {
  const char* name;
  std::vector<double> Scores::*values;
  double smallest, largest;
};
constexpr Column kColumns[] = {
    {"individual", &Scores::individual, 0, 1},
    {"global", &Scores::global, 0, 1},
    {"scaled", &Scores::scaled, 0, 1},
    {"standard_error", &Scores::standard_error, 0, std::numeric_limits<double>::max()},
    {"rank_stability", &Scores::rank_stability, -1, 1},
};

void read_origin(const Hdf5File& file, ScoresOrigin& origin) {
  origin.problems = file.number_attribute<std::int64_t>("", "problems");
  check(origin.problems >= 0, file.name(), ": attribute 'problems': is ", origin.problems, ", expected a count");
  origin.seed = file.number_attribute<std::uint64_t>("", "seed");
  for (const auto& [name, member] : kTextAttributes) origin.*member = file.text_attribute("", name);
}

/// The values of a dataset with one dimension.
template <class T>
std::vector<T> read_column(const Hdf5File& file, const std::string& dataset) {
  Hdf5Array<T> array = file.read<T>(dataset);
  check(array.shape.size() == 1, file.name(), ": dataset '", dataset, "': has ", array.shape.size(),
        " dimensions, expected 1");
  return std::move(array.values);
}

void check_length(const std::string& file, const char* dataset, std::size_t length, std::size_t expected) {
  check(length == expected, file, ": dataset '", dataset, "': has ", length, " rows, 'paths' has ", expected);
}

void check_scores(const std::string& file, const Scores& scores) {
  const std::size_t rows = scores.paths.size();
  check(rows > 0, file, ": dataset 'paths': is empty");
  check_length(file, "count", scores.count.size(), rows);
  // Rounding may move a mean of values in [0, 1] out of the range.
  constexpr double kRounding = 1e-9;
  for (const auto& [name, member, smallest, largest] : kColumns) {
    const std::vector<double>& values = scores.*member;
    check_length(file, name, values.size(), rows);
    for (std::size_t row = 0; row < rows; ++row)
      check(std::isnan(values[row]) || (values[row] >= smallest - kRounding && values[row] <= largest + kRounding),
            file, ": dataset '", name, "': row ", row, " (", printable(scores.paths[row]), ") is ", values[row],
            ", out of range");
  }
  for (std::size_t row = 0; row < rows; ++row)
    check(scores.count[row] <= static_cast<std::uint64_t>(scores.problems), file, ": dataset 'count': row ", row, " (",
          printable(scores.paths[row]), ") was in ", scores.count[row], " of ", scores.problems, " problems");
  for (std::size_t row = 0; row < rows; ++row)
    check(scores.count[row] == 0 || !std::isnan(scores.global[row]), file, ": dataset 'global': row ", row, " (",
          scores.paths[row], ") has no score although it was in ", scores.count[row], " problems");
}

/// A checksum of the whole snapshot. Without it, a few changed bits would change every score unnoticed.
std::string checksum(const ScoresSnapshot& snapshot) {
  Sha256 hash;
  hash.update_field(snapshot.input_fingerprint).update_field(joined(snapshot.problems, " ", snapshot.views));
  return hash.update(snapshot.sums.data(), snapshot.sums.size() * sizeof snapshot.sums[0]).hex();
}

}  // namespace

Scores read_scores(const std::filesystem::path& path) {
  const Hdf5File file = Hdf5File::open(path);
  Scores scores;
  read_origin(file, scores);
  for (const auto& column : kColumns) scores.*column.values = read_column<double>(file, column.name);
  scores.count = read_column<std::uint64_t>(file, "count");
  scores.paths = read_column<std::string>(file, "paths");
  check_scores(file.name(), scores);
  return scores;
}

void write_scores(const std::filesystem::path& path, const Scores& scores) {
  check_scores(path.string(), scores);
  const std::vector<Index> shape{static_cast<Index>(scores.paths.size())};
  write_atomically(path, [&](const std::filesystem::path& temporary) {
    Hdf5File file = Hdf5File::create(temporary, path.string());
    file.write_number_attribute<std::int64_t>("", "problems", scores.problems);
    file.write_number_attribute<std::uint64_t>("", "seed", scores.seed);
    for (const auto& [name, member] : kTextAttributes) file.write_text_attribute("", name, scores.*member);
    for (const auto& column : kColumns) file.write<double>(column.name, shape, scores.*column.values);
    file.write<std::uint64_t>("count", shape, scores.count);
    file.write<std::string>("paths", shape, scores.paths);
    file.close();
  });
}

ScoresSnapshot read_scores_snapshot(const std::filesystem::path& path) {
  const Hdf5File file = Hdf5File::open(path);
  ScoresSnapshot snapshot{.input_fingerprint = file.text_attribute("", "input_fingerprint"),
                          .problems = file.number_attribute<std::int64_t>("", "problems")};
  Hdf5Array<std::uint64_t> sums = file.read<std::uint64_t>("sums");
  check(sums.shape.size() == 2, file.name(), ": dataset 'sums': has ", sums.shape.size(), " dimensions, expected 2");
  check(snapshot.problems >= 0, file.name(), ": attribute 'problems': is ", snapshot.problems, ", expected a count");
  snapshot.views = sums.shape[0];
  snapshot.sums = std::move(sums.values);
  check(file.text_attribute("", "checksum") == checksum(snapshot), file.name(),
        ": is damaged, its checksum is another; delete it and start anew");
  return snapshot;
}

void write_scores_snapshot(const std::filesystem::path& path, const ScoresSnapshot& snapshot) {
  write_atomically(path, [&](const std::filesystem::path& temporary) {
    Hdf5File file = Hdf5File::create(temporary, path.string());
    file.write_text_attribute("", "input_fingerprint", snapshot.input_fingerprint);
    file.write_number_attribute<std::int64_t>("", "problems", snapshot.problems);
    file.write_text_attribute("", "checksum", checksum(snapshot));
    const auto numbers = snapshot.views == 0 ? 0 : static_cast<Index>(snapshot.sums.size()) / snapshot.views;
    file.write<std::uint64_t>("sums", {snapshot.views, numbers}, snapshot.sums);
    file.close();
  });
}

}  // namespace svnet::io
