#include <catch2/catch.hpp>

#include "io/views/dataset_folder.h"
#include "temporary_folder.h"

using namespace svnet;
using namespace svnet::io;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

/// Checks that reading a good dataset with the file or folder `extra` fails with "<path of extra>: <reason>".
void check_refused(const fs::path& extra, const std::string& reason, bool as_folder = false) {
  const TemporaryFolder folder;
  folder.write("mug/1/1/90_90.png", "");
  folder.write("mug/1/1/45_90.png", "");
  REQUIRE_NOTHROW(read_view_dataset(folder.path()));
  if (as_folder)
    fs::create_directories(folder.path() / extra);
  else
    folder.write(extra, "");
  CHECK_THROWS_WITH(read_view_dataset(folder.path()), (folder.path() / extra).string() + ": " + reason);
}

constexpr const char* kName =
    "the name of a view must be PHI_THETA.png, .jpg, .jpeg or .webp, such as 45_90.png: two whole numbers of degrees "
    "with '_' between them";
constexpr const char* kNotAView =
    "not a view; a pose holds files named PHI_THETA.png, .jpg, .jpeg or .webp, such as 45_90.png (names that begin "
    "with "
    "'_' or '.' are ignored)";

}  // namespace

TEST_CASE("a file that is not a view is named") {
  for (const char* name : {"45-90.png", "45_.png", "a_90.png", "45_90_1.png", "45.5_90.png", "-45_90.png", "+45_90.png",
                           "45 _90.png", "top.png", "00045_90.png"}) {
    CAPTURE(name);
    check_refused(fs::path("mug/1/1") / name, kName);
  }
  check_refused("mug/1/1/45_0.gif", kNotAView);
  check_refused("mug/1/1/notes.txt", kNotAView);
  check_refused("mug/1/1/45_0.png", kNotAView, true);
}

TEST_CASE("angles out of range are named") {
  check_refused("mug/1/1/91_0.png", "phi is 91, expected 0 to 90 degrees (PHI_THETA)");
  check_refused("mug/1/1/45_360.png", "theta is 360, expected 0 to 359 degrees (PHI_THETA)");
}

TEST_CASE("a view that is there twice is named") {
  check_refused("mug/1/1/90_90.webp", "the same view as 90_90.png; remove one of them");
  check_refused("mug/1/1/45_90.png.jpg", kName);
  const TemporaryFolder folder;
  folder.write("mug/1/1/045_90.png", "");
  const fs::path later = folder.write("mug/1/1/45_90.png", "");
  CHECK_THROWS_WITH(read_view_dataset(folder.path()),
                    later.string() + ": the same view as 045_90.png; remove one of them");
}

TEST_CASE("stray files among folders are named") {
  check_refused("mug/readme.txt",
                "stray file; a category holds folders only, an object each (names that begin with '_' or '.' are "
                "ignored)");
  check_refused("mug/1/90_90.png",
                "stray file; an object holds folders only, a pose each (names that begin with '_' or '.' are ignored)");
}

TEST_CASE("empty folders are named") {
  check_refused("bowl",
                "a category without folders; expected an object in each (category/object/pose/PHI_THETA.png, .jpg, "
                ".jpeg or .webp, such as 45_90.png)",
                true);
  check_refused("mug/2",
                "an object without folders; expected a pose in each (category/object/pose/PHI_THETA.png, .jpg, .jpeg "
                "or .webp, such as 45_90.png)",
                true);
  check_refused("mug/1/2", "pose without views; expected PHI_THETA.png, .jpg, .jpeg or .webp, such as 45_90.png", true);
}

TEST_CASE("a pose without its top view is named") {
  const TemporaryFolder folder;
  folder.write("mug/1/1/45_90.png", "");
  folder.write("mug/1/1/90_0.png", "");
  CHECK_THROWS_WITH(
      read_view_dataset(folder.path()),
      (folder.path() / "mug/1/1").string() + ": pose without its top view; expected 90_90.png, .jpg, .jpeg or .webp");
}

TEST_CASE("a root that is not a dataset says what a dataset is") {
  const TemporaryFolder folder;
  const std::string expected =
      "folders category/object/pose with views PHI_THETA.png, .jpg, .jpeg or .webp, such as "
      "45_90.png";
  const fs::path missing = folder.path() / "none";
  CHECK_THROWS_WITH(read_view_dataset(missing),
                    missing.string() + ": no such folder; expected a data set (" + expected + ")");
  CHECK_THROWS_WITH(read_view_dataset(folder.path()),
                    folder.path().string() + ": data set without categories; expected " + expected);
  const fs::path file = folder.write("file", "");
  CHECK_THROWS_WITH(read_view_dataset(file),
                    file.string() + ": is not a folder; expected a data set (" + expected + ")");
}

TEST_CASE("a broken link is named") {
  const TemporaryFolder folder;
  folder.write("mug/1/1/90_90.png", "");
  const fs::path link = folder.path() / "bowl";
  fs::create_symlink(folder.path() / "none", link);
  CHECK_THROWS_WITH(read_view_dataset(folder.path()),
                    link.string() + ": neither a file nor a folder; expected a category's folder");
}

TEST_CASE("a name that is not UTF-8 is refused: no file could list the view") {
  const TemporaryFolder folder;
  folder.write("mug/1/1/90_90.png", "");
  const fs::path bad = folder.path() / "b\xff";
  fs::create_directory(bad);
  CHECK_THROWS_WITH(read_view_dataset(folder.path()), Contains(": its name is not UTF-8; rename it"));
}
