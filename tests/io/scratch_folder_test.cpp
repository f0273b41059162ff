#include "io/files/scratch_folder.h"

#include <catch2/catch.hpp>
#include <fstream>

using namespace svnet;
namespace fs = std::filesystem;

TEST_CASE("a scratch folder is new, and goes with all that is in it") {
  fs::path path;
  {
    const io::ScratchFolder folder("svnet-scratch-test"), other("svnet-scratch-test");
    path = folder.path();
    CHECK(path != other.path());
    CHECK(path.filename().string().starts_with("svnet-scratch-test-"));
    CHECK(fs::is_empty(path));
    fs::create_directories(path / "deeper");
    std::ofstream(path / "deeper/file") << "text";
    CHECK(fs::exists(path / "deeper/file"));
  }
  CHECK_FALSE(fs::exists(path));
}
