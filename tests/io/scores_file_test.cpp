#include "io/views/scores_file.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <limits>

#include "base/error.h"
#include "io/files/snapshot_path.h"
#include "io/hdf5/hdf5_file.h"
#include "temporary_folder.h"

using namespace svnet;
using namespace svnet::io;
using Catch::Contains;

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

Scores example() {
  Scores scores;
  scores.problems = 30'000'000'000;
  scores.seed = UINT64_MAX;
  scores.sampler = "uniform: categories 3 to 8";
  scores.clustering = "ward";
  scores.metric = "fm";
  scores.input_fingerprint = "ef56";
  scores.individual = {0.25, 1, kNone};
  scores.global = {0.5, 0, kNone};
  scores.scaled = {0, 1, kNone};
  scores.count = {12, 30'000'000'000, 0};
  scores.standard_error = {0.01, 0, kNone};
  scores.rank_stability = {-0.5, -0.5, kNone};
  scores.paths = {"a", "b", "c"};
  return scores;
}

}  // namespace

TEST_CASE("scores are read as they were written, views without a score too") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "scores.h5";
  write_scores(path, example());
  const Scores scores = read_scores(path), expected = example();
  for (const auto member :
       {&Scores::individual, &Scores::global, &Scores::scaled, &Scores::standard_error, &Scores::rank_stability}) {
    const std::vector<double>&values = scores.*member, &right = expected.*member;
    REQUIRE(values.size() == 3);
    CHECK(values[0] == right[0]);
    CHECK(values[1] == right[1]);
    CHECK(std::isnan(values[2]));
  }
  CHECK(scores.count == expected.count);
  CHECK(scores.paths == expected.paths);
  CHECK(scores.problems == 30'000'000'000);
  CHECK(scores.seed == UINT64_MAX);
  CHECK(scores.sampler == "uniform: categories 3 to 8");
  CHECK(scores.clustering == "ward");
  CHECK(scores.metric == "fm");
  CHECK(scores.input_fingerprint == "ef56");
  CHECK(Hdf5File::open(path).members("") == std::vector<std::string>{"count", "global", "individual", "paths",
                                                                     "rank_stability", "scaled", "standard_error"});
}

TEST_CASE("impossible scores are refused, written or read") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "s.h5";
  const auto message = [&](auto change) {
    Scores scores = example();
    change(scores);
    try {
      write_scores(path, scores);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  CHECK_THAT(message([](Scores& s) { s.global[1] = 1.5; }),
             Contains("s.h5: dataset 'global': row 1 (b) is 1.5, out of range"));
  CHECK_THAT(message([](Scores& s) { s.individual[0] = -0.5; }), Contains("'individual': row 0 (a) is -0.5"));
  CHECK_THAT(message([](Scores& s) { s.scaled[0] = std::numeric_limits<double>::infinity(); }),
             Contains("'scaled': row 0 (a) is inf"));
  CHECK_THAT(message([](Scores& s) { s.standard_error[2] = -1; }), Contains("'standard_error': row 2 (c) is -1"));
  CHECK_THAT(message([](Scores& s) { s.rank_stability[1] = -1.5; }), Contains("'rank_stability': row 1 (b) is -1.5"));
  CHECK_THAT(message([](Scores& s) { s.global[0] = kNone; }),
             Contains("'global': row 0 (a) has no score although it was in 12 problems"));
  CHECK_THAT(message([](Scores& s) { s.count[0] = 30'000'000'001; }),
             Contains("'count': row 0 (a) was in 30000000001 of 30000000000 problems"));
  CHECK_THAT(message([](Scores& s) { s.count.pop_back(); }), Contains("'count': has 2 rows, 'paths' has 3"));
  CHECK_THAT(message([](Scores& s) { s = Scores(); }), Contains("'paths': is empty"));
  CHECK(message([](Scores& s) { s.individual[0] = kNone; }) == "no error");

  Hdf5File file = Hdf5File::create(path);
  file.write_number_attribute<std::int64_t>("", "problems", -1);
  file.close();
  CHECK_THROWS_WITH(read_scores(path), Contains("s.h5: attribute 'problems': is -1, expected a count"));
}

TEST_CASE("a snapshot of scores is read as it was written, and other files are refused") {
  const TemporaryFolder folder;
  const auto path = snapshot_path(folder.path() / "scores.h5");
  CHECK(path.filename() == "scores.h5.snapshot");
  write_scores_snapshot(path, {"ab12", 123456789012345, 2, {1, 2, 3, UINT64_MAX, 5, 6}});
  const ScoresSnapshot snapshot = read_scores_snapshot(path);
  CHECK(snapshot.input_fingerprint == "ab12");
  CHECK(snapshot.problems == 123456789012345);
  CHECK(snapshot.views == 2);
  CHECK(snapshot.sums == std::vector<std::uint64_t>{1, 2, 3, UINT64_MAX, 5, 6});
  CHECK(Hdf5File::open(path).has("sums"));
  {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    const std::string bytes = file_contents(path);
    const std::size_t at = bytes.find(std::string(8, '\xff') + std::string("\5\0\0\0\0\0\0\0", 8));
    REQUIRE(at != std::string::npos);
    file.seekp(static_cast<std::streamoff>(at));
    file.put('\xfe');
  }
  CHECK_THROWS_WITH(read_scores_snapshot(path), Contains("scores.h5.snapshot: is damaged, its checksum is another"));
  CHECK(Hdf5File::open(path).has("sums"));
  write_scores(path, example());
  CHECK(!Hdf5File::open(path).has("sums"));
  CHECK_THROWS_WITH(read_scores_snapshot(path), Contains("scores.h5.snapshot") && Contains("'sums'"));
}
