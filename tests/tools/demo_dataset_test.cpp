#include <catch2/catch.hpp>
#include <cstdlib>
#include <map>

#include <sys/wait.h>

#include "io/image_file.h"
#include "temporary_folder.h"

using namespace svnet;

namespace {

int make(const std::string& arguments) {
  return WEXITSTATUS(std::system((DEMO_DATA " --quiet --size 16 --objects 1 " + arguments + " >/dev/null").c_str()));
}

std::map<std::string, std::string> contents(const std::filesystem::path& root) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root))
    if (entry.is_regular_file()) files[entry.path().lexically_relative(root)] = file_contents(entry.path());
  return files;
}

}  // namespace

TEST_CASE("the demonstration's pictures are whole poses, the same for any number of threads") {
  const TemporaryFolder folder;
  const std::string one = folder.path() / "one", three = folder.path() / "three", other = folder.path() / "other";
  REQUIRE(make("--threads 1 --output " + one) == 0);
  REQUIRE(make("--threads 3 --output " + three + "/") == 0);
  REQUIRE(make("--seed 2 --output " + other) == 0);
  const auto files = contents(one);
  CHECK(files.size() == 8 * 1 * 2 * 22);
  for (const char* name : {"mug/1/1/90_90.png", "mug/1/2/45_315.png", "plate/1/1/75_0.png"})
    CHECK(files.count(name) == 1);
  CHECK(files.count("mug/1/1/45_270.png") == 0);  // the robot's base would be seen
  CHECK(contents(three) == files);
  CHECK(contents(other) != files);
  const Image image = read_image(one + "/mug/1/1/90_90.png");
  CHECK(image.height == 16);
  CHECK(image.width == 16);
  // The table at the edges, something else in the middle.
  const auto pixel = [&](Index y, Index x) { return image.rgb.data() + 3 * (y * 16 + x); };
  CHECK(std::equal(pixel(0, 0), pixel(0, 0) + 3, pixel(15, 0)));
  CHECK_FALSE(std::equal(pixel(0, 0), pixel(0, 0) + 3, pixel(8, 8)));

  CHECK(make("--output " + one + " 2>" + other + "/message") == 1);
  CHECK(file_contents(other + "/message") ==
        "svnet-demo-data: " + one + ": exists already, remove it or choose another folder\n");
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    CHECK(entry.path().extension() != ".partial");
}
