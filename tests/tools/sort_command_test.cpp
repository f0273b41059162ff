#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "io/images/image_file.h"
#include "shell.h"
#include "sort/objects.h"

using namespace svnet;
using namespace svnet::io;
namespace fs = std::filesystem;

namespace {

enum class Kind { disc, stripes, plain };

/// A picture of 80x80 pixels; `variant` moves and shades it a little.
Image picture_of(Kind kind, int variant) {
  constexpr int kSide = 80;
  Image image{kSide, kSide, {}};
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const bool inside = kind == Kind::disc      ? std::hypot(x - 40 - variant, y - 40) < 22
                          : kind == Kind::stripes ? (x + variant) / 6 % 2 == 0
                                                  : false;
      const int shade = 4 * variant;
      for (const int level : {inside ? 220 - shade : 60, inside ? 40 : 60, inside ? 30 + shade : 70})
        image.rgb.push_back(static_cast<std::uint8_t>(level));
    }
  return image;
}

/// A folder of objects, and the command run beside it. objects/ has three discs, three pictures with stripes, and an
/// object plain/ with two pictures.
class Workplace {
 public:
  Workplace() {
    fs::create_directories(folder.path() / "objects/plain/deeper");
    for (const int i : {1, 2, 10}) {
      write_png(folder.path() / "objects" / ("disc" + std::to_string(i) + ".png"), picture_of(Kind::disc, i % 5));
      write_png(folder.path() / "objects" / ("stripes" + std::to_string(i) + ".PNG"), picture_of(Kind::stripes, i % 5));
    }
    write_png(folder.path() / "objects/plain/a.png", picture_of(Kind::plain, 0));
    write_png(folder.path() / "objects/plain/deeper/b.png", picture_of(Kind::plain, 1));
    folder.write("objects/notes.txt", "no picture");
    fs::create_directories(folder.path() / "objects/_extra");
    folder.write("objects/_extra/c.png", "ignored");
  }

  Ran run(const std::string& arguments) const { return run_shell(folder.path(), SVNET_SORT " --quiet " + arguments); }
  fs::path operator/(const std::string& name) const { return folder.path() / name; }

  TemporaryFolder folder;
};

constexpr const char* kGroups =
    "1: disc1.png, disc2.png, disc10.png\n"
    "2: plain\n"
    "3: stripes1.PNG, stripes2.PNG, stripes10.PNG\n";

}  // namespace

TEST_CASE("svnet-sort puts the objects of a folder into groups") {
  const Workplace place;
  const Ran ran = place.run("objects --groups 3");
  CHECK(ran.status == 0);
  CHECK(ran.err.empty());
  CHECK(ran.out == kGroups);
  CHECK(place.run("objects").out == kGroups);  // estimates 3
  for (const char* linkage : {"ward", "average", "complete", "single"})
    CHECK(place.run(std::string("objects/ --groups 3 --linkage ") + linkage).out == kGroups);
  CHECK(place.run("objects --groups 1").out ==
        "1: disc1.png, disc2.png, disc10.png, plain, stripes1.PNG, stripes2.PNG, stripes10.PNG\n");
}

TEST_CASE("svnet-sort takes pictures and folders one by one") {
  const Workplace place;
  const Ran ran = place.run("objects/stripes1.PNG objects/plain objects/stripes2.PNG --groups 2");
  CHECK(ran.status == 0);
  CHECK(ran.out == "1: objects/stripes1.PNG, objects/stripes2.PNG\n2: objects/plain\n");
  CHECK(place.run("objects/disc1.png").out == "1: objects/disc1.png\n");
  CHECK(place.run("objects/disc1.png objects/disc1.png").out == "1: objects/disc1.png, objects/disc1.png\n");
  CHECK(place.run("objects/disc1.png objects/stripes1.PNG").out == "1: objects/disc1.png\n2: objects/stripes1.PNG\n");
}

TEST_CASE("svnet-sort writes JSON into a file, or instead of the lines") {
  const Workplace place;
  REQUIRE(place.run("objects --json groups.json").out == kGroups);
  const std::string text = file_contents(place / "groups.json");
  for (const char* standard_output : {"-", "/dev/stdout"})
    CHECK(place.run(std::string("objects --json ") + standard_output).out == text);
  const auto json = nlohmann::json::parse(text);
  CHECK(json.at("count") == 3);
  CHECK(json.at("estimated") == true);
  CHECK(json.at("backbone") == "tiny_xception");
  CHECK(json.at("linkage") == "ward");
  CHECK(json.at("fusion") == "mean");
  REQUIRE(json.at("groups").size() == 3);
  CHECK(json.at("groups")[1] == nlohmann::json{{"group", 2}, {"objects", {"plain"}}});
  REQUIRE(json.at("objects").size() == 7);
  CHECK(json.at("objects")[3] == nlohmann::json{{"name", "plain"},
                                                {"group", 2},
                                                {"pictures", {"objects/plain/a.png", "objects/plain/deeper/b.png"}}});
  REQUIRE(json.at("dendrogram").size() == 6);
  CHECK(json.at("dendrogram")[5][3] == 7);
  CHECK(json.at("cut_height").get<double>() > json.at("dendrogram")[3][2].get<double>());
  CHECK(json.at("cut_height").get<double>() < json.at("dendrogram")[4][2].get<double>());
  CHECK(nlohmann::json::parse(place.run("objects --groups 2 --json -").out).at("estimated") == false);
}

TEST_CASE("svnet-sort averages the pictures of an object, or takes them in order") {
  const Workplace place;
  const Ran refused = place.run("objects --fusion concatenate");
  CHECK(refused.status == 1);
  CHECK(refused.out.empty());
  CHECK(refused.err ==
        "svnet-sort: plain: has 2 pictures, disc1.png has 1; --fusion concatenate needs as many of every object, "
        "--fusion mean takes any number\n");
  for (const char* name : {"a", "b", "c"}) fs::create_directories(place / "pairs" / name);
  for (const char* name : {"a", "b"}) {
    write_png(place / "pairs" / name / "1.png", picture_of(Kind::disc, 1));
    write_png(place / "pairs" / name / "2.png", picture_of(Kind::stripes, 1));
  }
  write_png(place / "pairs/c/1.png", picture_of(Kind::stripes, 1));
  write_png(place / "pairs/c/2.png", picture_of(Kind::disc, 1));
  CHECK(place.run("pairs --fusion concatenate").out == "1: a, b\n2: c\n");
  CHECK(place.run("pairs --fusion mean").out == "1: a, b, c\n");  // the same pictures in another order
}

TEST_CASE("svnet-sort draws the groups and the dendrogram") {
  const Workplace place;
  CHECK(place.run("objects --sheet sheet.png --dendrogram tree.png").out == kGroups);
  const Image sheet = read_image(place / "sheet.png"), tree = read_image(place / "tree.png");
  const auto has_colour = [](const Image& image, int red, int green, int blue) {
    for (std::size_t i = 0; i < image.rgb.size(); i += 3)
      if (image.rgb[i] == red && image.rgb[i + 1] == green && image.rgb[i + 2] == blue) return true;
    return false;
  };
  for (const Image* image : {&sheet, &tree}) {
    CHECK(has_colour(*image, 63, 144, 218));  // the first group
    CHECK(has_colour(*image, 189, 31, 1));    // the third one
    CHECK_FALSE(has_colour(*image, 131, 45, 182));
  }
  CHECK(has_colour(tree, 214, 39, 40));  // the cut
  CHECK(place.run("objects --sheet /dev/stdout | cmp - sheet.png").status == 0);
  for (const char* few : {"objects/disc1.png", "objects/disc1.png objects/disc1.png"}) {
    CHECK(place.run(std::string(few) + " --sheet few.png --dendrogram few-tree.png").status == 0);
    CHECK(read_image(place / "few-tree.png").height > 60);
  }
}

TEST_CASE("svnet-sort says which picture it cannot read, and writes nothing") {
  const Workplace place;
  place.folder.write("objects/broken.png", "not a picture");
  const Ran ran = place.run("objects --json groups.json --sheet sheet.png --dendrogram tree.png");
  CHECK(ran.status == 1);
  CHECK(ran.out.empty());
  CHECK(ran.err ==
        "svnet-sort: objects/broken.png: is not a PNG, JPEG or WebP image, whatever its name says; repair the picture, "
        "or leave it out\n");
  for (const char* file : {"groups.json", "sheet.png", "tree.png"}) CHECK_FALSE(fs::exists(place / file));
  CHECK_THAT(place.run("none.png objects/disc1.png").err, Catch::Equals("svnet-sort: none.png: no such file\n"));

  fs::create_directories(place / "empty/folder");
  const Ran empty = place.run("empty");
  CHECK(empty.status == 1);
  CHECK(empty.err ==
        "svnet-sort: empty: holds no PNG, JPEG or WebP file, and no folder with such files; each picture and each "
        "folder of pictures is an object\n");
  CHECK(place.run("objects/disc1.png empty").err == "svnet-sort: empty: holds no PNG, JPEG or WebP file\n");
}

TEST_CASE("svnet-sort says what is wrong with its options") {
  const Workplace place;
  for (const char* groups : {"0", "-1", "many", "2.5", "''"}) {
    const Ran ran = place.run(std::string("objects --groups ") + groups);
    CHECK(ran.status == 2);
    CHECK_THAT(ran.err, Catch::Contains("--groups: '") &&
                            Catch::Contains("is neither a whole number from 1 nor auto; see svnet-sort --help"));
  }
  const Ran many = place.run("objects --groups 8");
  CHECK(many.status == 1);
  CHECK(many.err == "svnet-sort: cannot make 8 groups of 7 objects; give --groups 1 to 7, or auto\n");
  CHECK(place.run("").status == 2);
  CHECK(place.run("objects --linkage wards").status == 2);
  CHECK(place.run("objects --fusion sum").status == 2);
  CHECK(place.run("objects --backbone vgg16").err ==
        "svnet-sort: no weights of vgg16 are built in; give a file by --weights\n");
  CHECK_THAT(place.run("objects --backbone vgg61").err, Catch::Contains("vgg16"));
  CHECK(place.run("objects --json - --sheet /dev/stdout").err ==
        "svnet-sort: only one of --json, --sheet and --dendrogram can go to standard output\n");
  CHECK_THAT(place.run("objects --sheet objects/disc1.png").err,
             Catch::StartsWith("svnet-sort: objects/disc1.png: cannot be written: the command needs this file"));
  CHECK_THAT(place.run("objects --sheet both.png --dendrogram both.png").err,
             Catch::StartsWith("svnet-sort: both.png: cannot be written: the command needs this file"));
  CHECK_FALSE(fs::exists(place / "both.png"));
}

TEST_CASE("svnet-sort warns of an EXIF orientation, or obeys it") {
  const Workplace place;
  fs::copy_file(fs::path(SVNET_FIXTURES) / "pictures/turned.jpg", place / "turned.jpg");
  const std::string program = SVNET_SORT " turned.jpg objects/disc1.png";
  const Ran ignored = run_shell(place.folder.path(), program);
  CHECK_THAT(ignored.err, Catch::Contains("the EXIF orientation of 1 picture is ignored; --exif-orientation obey turns "
                                          "them as viewers do\n"));
  const Ran obeyed = run_shell(place.folder.path(), program + " --exif-orientation obey");
  CHECK_THAT(obeyed.err, !Catch::Contains("EXIF"));
}
