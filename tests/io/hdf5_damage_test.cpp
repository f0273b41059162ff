// Damaged files: a reader succeeds or throws Error, whatever the damage.
#include <catch2/catch.hpp>
#include <functional>

#include "base/error.h"
#include "base/random.h"
#include "io/hdf5/hdf5_file.h"
#include "io/keras/keras_weights.h"
#include "io/views/features_file.h"
#include "io/views/scores_file.h"
#include "temporary_folder.h"

using namespace svnet;
using namespace svnet::io;

// On damage the HDF5 library leaks what it had decoded, and it allocates as much memory as a file says.
extern "C" const char* __lsan_default_suppressions() { return "leak:libhdf5"; }
extern "C" const char* __asan_default_options() { return "allocator_may_return_null=1"; }

namespace {

void read_all_of_h5py(const std::filesystem::path& path) {
  const Hdf5File file = Hdf5File::open(path);
  for (const std::string& name : file.members("")) {
    for (const auto& read :
         std::vector<std::function<void()>>{[&] { file.read<double>(name); }, [&] { file.read<std::string>(name); }}) {
      try {
        read();
      } catch (const Error&) {
      }
    }
  }
  for (const char* name : {"text", "bytes", "one", "list", "empty"}) file.text_list_attribute("", name);
}

void read_all_weights(const std::filesystem::path& path) {
  const KerasWeightsFile file(path);
  for (const auto& layer : file.layers())
    for (const auto& array : layer.arrays) file.values(array);
}

/// Returns how many of `tries` damaged copies of `bytes` are refused. Every third is cut; the others have one to four
/// changed bytes.
int refused_copies(const std::string& bytes, int tries, std::uint64_t seed,
                   const std::function<void(const std::filesystem::path&)>& read) {
  const TemporaryFolder folder;
  RandomStream random(seed, Stream::shuffle);
  const auto size = static_cast<std::uint32_t>(bytes.size());
  int refused = 0;
  for (int i = 0; i < tries; ++i) {
    std::string damaged = bytes;
    if (i % 3 == 0) {
      damaged.resize(random.below(size));
    } else {
      for (std::uint32_t change = 0, changes = 1 + random.below(4); change < changes; ++change)
        damaged[random.below(size)] ^= static_cast<char>(1 + random.below(255));
    }
    const auto path = folder.write("damaged.h5", damaged);
    try {
      read(path);
    } catch (const Error& error) {
      ++refused;
      const std::string message = error.what();
      if (message.rfind(path.string() + ": ", 0) != 0 || message.find('\n') != std::string::npos) FAIL(message);
    }
  }
  return refused;
}

}  // namespace

TEST_CASE("damaged HDF5 files are read or refused", "[slow]") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "good.h5";
  const std::string fixtures = SVNET_FIXTURES "/io/";
  SECTION("features") {
    Features features;
    features.count = 3;
    features.dimension = 4;
    features.values.assign(12, 0.5f);
    features.theta_phi_deg.assign(3, {45, 90});
    features.paths = {"a", "b", "c"};
    write_features(path, features);
    CHECK(refused_copies(file_contents(path), 600, 1, [](const auto& file) { read_features(file); }) > 200);
  }
  SECTION("scores") {
    Scores scores;
    scores.individual = scores.global = scores.scaled = scores.standard_error = scores.rank_stability = {0.5, 0.25};
    scores.problems = 3;
    scores.count = {1, 2};
    scores.paths = {"a", "b"};
    write_scores(path, scores);
    CHECK(refused_copies(file_contents(path), 600, 2, [](const auto& file) { read_scores(file); }) > 200);
  }
  SECTION("Keras' legacy weights") {
    CHECK(refused_copies(file_contents(fixtures + "keras_legacy.h5"), 600, 3,
                         [](const auto& file) { read_all_weights(file); }) > 200);
  }
  SECTION("Keras 3 weights") {
    CHECK(refused_copies(file_contents(fixtures + "keras3_nested.weights.h5"), 600, 4,
                         [](const auto& file) { read_all_weights(file); }) > 200);
  }
  SECTION("byte strings, split attributes") {
    CHECK(refused_copies(file_contents(fixtures + "keras2_split.h5"), 600, 5,
                         [](const auto& file) { read_all_weights(file); }) > 200);
  }
  SECTION("filters and all types") {
    CHECK(refused_copies(file_contents(fixtures + "h5py.h5"), 600, 6, read_all_of_h5py) > 200);
  }
}
