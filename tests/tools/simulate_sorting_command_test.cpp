#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "io/images/image_file.h"
#include "shell.h"
#include "simulate_sorting/collection.h"
#include "small_dataset.h"
#include "small_model.h"

using namespace svnet;
namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

/// A folder with a dataset "views" of 4 categories with 2 objects each, a model that was trained on one of them, and
/// one that was trained on two; and the command run in it.
class Workplace {
 public:
  Workplace() {
    write_small_dataset(folder.path() / "views");
    Model model = small_model();
    model.trained_on = {.categories = {"ring", "rook"}, .objects = 4, .top_views = 4};
    io::write_model(folder.path() / "model.safetensors", model);
    model.trained_on.categories = {"ring", "cone"};
    io::write_model(folder.path() / "wide.safetensors", model);
  }

  Ran run(const std::string& arguments) const {
    return run_shell(folder.path(), SVNET_SIMULATE_SORTING " " + arguments);
  }

  TemporaryFolder folder;
};

const std::string kTables = " views --objects 6 --tables 30";

std::vector<std::string> names_of_rows(const Json& json) {
  std::vector<std::string> names;
  for (const Json& row : json.at("selectors")) names.push_back(row.at("name"));
  return names;
}

}  // namespace

TEST_CASE("svnet-simulate-sorting compares rules without a model, and says so") {
  const Workplace place;
  const Ran ran = place.run(kTables + " --json rows.json --picture table.png");
  INFO(ran.err);
  REQUIRE(ran.status == 0);
  CHECK_THAT(ran.err, Catch::Contains("without --model there are no rows of SV-net: give a model of svnet-train\n"));
  CHECK_THAT(ran.out, Catch::StartsWith("30 tables of 6 objects, from 4 categories; means of a table\nviews "));
  const Json json = Json::parse(file_contents(place.folder.path() / "rows.json"));
  REQUIRE(names_of_rows(json) == std::vector<std::string>{"top", "rand", "broadside", "opt"});
  for (const Json& row : json.at("selectors"))
    CHECK_THAT(ran.out, Catch::Contains("\n" + row.at("name").get<std::string>() + " "));
  CHECK(json.at("model").is_null());
  CHECK(json.at("groups") == "categories of the table");
  CHECK(json.at("move_time").at("start_s") == 1.5);
  CHECK(json.at("move_time").at("speed_deg_per_s") == 60);
  REQUIRE(json.at("tables").size() == 30);
  for (std::size_t s = 0; s < 4; ++s) {
    const Json& row = json.at("selectors")[s];
    double wrong = 0, fewer = 0;
    for (const Json& table : json.at("tables")) {
      CHECK(table.at("categories").size() == 3);
      const double count = table.at("wrong_objects").at(row.at("name").get<std::string>());
      wrong += count / 30;
      fewer += (table.at("wrong_objects").at("top").get<double>() - count) / 30;
    }
    CHECK(row.at("wrong_objects") == Approx(wrong));
    CHECK(row.at("wrong_share") == Approx(wrong / 6));
    CHECK(row.at("fewer_wrong_than_top").at("mean") == Approx(fewer).margin(1e-12));
    CHECK(row.at("fewer_wrong_than_top").at("low").get<double>() <= fewer + 1e-12);
  }
  CHECK(json.at("selectors")[3].at("wrong_objects") < json.at("selectors")[0].at("wrong_objects"));
  CHECK(json.at("selectors")[0].at("moves") == 0);
  const Image picture = io::read_image(place.folder.path() / "table.png");
  CHECK(picture.width > 6 * 112);
  CHECK(picture.height > 4 * 112);
}

TEST_CASE("svnet-simulate-sorting has the same result for a seed and any number of threads") {
  const Workplace place;
  const std::string options = kTables + " --model model.safetensors --quiet --json - --seed ";
  const Ran one = place.run(options + "5 --threads 1");
  REQUIRE(one.status == 0);
  CHECK(place.run(options + "5 --threads 3").out == one.out);
  CHECK(place.run(options + "6 --threads 1").out != one.out);
}

TEST_CASE("svnet-simulate-sorting leaves out what the model was trained on") {
  const Workplace place;
  const Ran ran = place.run(kTables + " --model model.safetensors --json -");
  REQUIRE(ran.status == 0);
  CHECK_THAT(ran.err, Catch::Contains("left out, since the model was trained on them: ring\n"));
  const Json json = Json::parse(ran.out);
  CHECK(json.at("categories") == Json({"ball", "cone", "cube"}));
  CHECK(names_of_rows(json) ==
        std::vector<std::string>{"top", "rand", "broadside", "svnet", "top_svnet", "move_50", "svnet_2", "opt"});
  CHECK(json.at("selectors")[4].at("views") == 2);
  CHECK(json.at("selectors")[4].at("moves") == json.at("selectors")[3].at("moves"));

  const Ran few = place.run(kTables + " --quiet --model wide.safetensors --json few.json");
  CHECK(few.status == 1);
  CHECK(few.err ==
        "svnet-simulate-sorting: a table has objects of at least 3 categories, and the data set has 2 that the model "
        "was not trained on; give a data set or --categories with others\n");
  CHECK_FALSE(fs::exists(place.folder.path() / "few.json"));
}

TEST_CASE("svnet-simulate-sorting takes some categories, and a number of bins") {
  const Workplace place;
  const Json some = Json::parse(place.run(kTables + " --categories ring,ball,cube --groups 4 --json -").out);
  CHECK(some.at("categories") == Json({"ball", "cube", "ring"}));
  CHECK(some.at("groups") == 4);
  CHECK(Json::parse(place.run(kTables + " --groups auto --json -").out).at("groups") == "auto");
}

TEST_CASE("svnet-simulate-sorting says what is wrong") {
  const Workplace place;
  const auto refused = [&](const std::string& arguments, int status) {
    const Ran ran = place.run("--quiet " + arguments);
    CHECK(ran.status == status);
    CHECK(ran.out.empty());
    return ran.err;
  };
  const std::string name = "svnet-simulate-sorting: ";
  for (const char* groups : {"0", "13", "many"})
    CHECK_THAT(refused("views --groups " + std::string(groups), 2),
               Catch::Contains("is neither a whole number from 1 to --objects, 12, nor auto"));
  CHECK(refused("views", 1) ==
        name + "no table has 12 objects: with 3 to 4 categories, and at least 2 objects of each, it has 6 to 8\n");
  CHECK_THAT(refused("views --objects 6 --categories ring,ball,cub", 1), Catch::Contains("did you mean 'cube'?"));
  CHECK(refused("views --objects 6 --categories ring,ball", 1) ==
        name + "a table has objects of at least 3 categories, and there are 2: ball, ring\n");
  CHECK_THAT(refused("none", 1), Catch::StartsWith(name + "none: "));
  CHECK_THAT(refused("views --model none.safetensors", 1), Catch::StartsWith(name + "none.safetensors: "));
  CHECK(refused("views --backbone vgg16", 1) == name + "no weights of vgg16 are built in; give a file by --weights\n");
  CHECK(refused("views --json - --picture /dev/stdout", 1) ==
        name + "only one of --json and --picture can go to standard output\n");
  CHECK_THAT(refused("views --model model.safetensors --json model.safetensors", 1),
             Catch::Contains("model.safetensors: cannot be written"));
  CHECK_FALSE(refused("views --tables 0", 2).empty());
  if (!can_render()) CHECK_THAT(refused("--tables 5", 2), Catch::Contains("DATASET is required"));
}

TEST_CASE("svnet-simulate-sorting renders a collection by itself", "[slow]") {
  if (!can_render()) return;
  const Workplace place;
  fs::create_directories(place.folder.path() / "tmp");
  const std::string command =
      "TMPDIR=tmp " SVNET_SIMULATE_SORTING
      " --quiet --tables 5 --objects 6 --categories mug,hammer,key --picture table.png --json -";
  const Ran ran = run_shell(place.folder.path(), command);
  INFO(ran.err);
  REQUIRE(ran.status == 0);
  const Json json = Json::parse(ran.out);
  CHECK(json.at("dataset") == "rendered");
  CHECK(json.at("categories") == Json({"hammer", "key", "mug"}));
  CHECK(io::read_image(place.folder.path() / "table.png").width > 6 * 112);
  CHECK(fs::is_empty(place.folder.path() / "tmp"));
}
