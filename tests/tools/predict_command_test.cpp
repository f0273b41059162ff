#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <sstream>

#include "frame/top_view.h"
#include "io/images/depth_file.h"
#include "io/images/image_file.h"
#include "predict/prediction_picture.h"
#include "predict/predictor.h"
#include "shell.h"
#include "small_model.h"
#include "view/pose_grid.h"

using namespace svnet;
using namespace svnet::io;
using namespace svnet::predict;
using namespace svnet::view;

namespace {

/// A folder with a model and an image, and the command run in it.
class Workplace {
 public:
  Workplace() {
    write_model(folder.path() / "model.safetensors", small_model());
    write_png(folder.path() / "top.png", small_image());
  }

  Ran run(const std::string& arguments) const { return run_shell(folder.path(), SVNET_PREDICT " " + arguments); }

  TemporaryFolder folder;
};

}  // namespace

TEST_CASE("svnet-predict prints the paper's grid, best first") {
  const Workplace place;
  const Predictor predictor(small_model());
  const std::vector<CameraPose> poses = paper_grid();
  const std::vector<float> scores = predictor.scores(predictor.embed(small_image()), poses);
  const std::vector<std::size_t> order = best_first(scores);

  const Ran table = place.run("model.safetensors --image top.png");
  CHECK(table.status == 0);
  CHECK(table.err.empty());
  CHECK(place.run("model.safetensors --image top.png --grid").out == table.out);
  std::istringstream lines(table.out);
  std::string theta, phi, score, rest;
  lines >> theta >> phi >> score;
  CHECK(theta + " " + phi + " " + score == "theta phi score");
  for (const std::size_t i : order) {
    REQUIRE(lines >> theta >> phi >> score);
    CHECK(std::stod(theta) == poses[i].theta_deg);
    CHECK(std::stod(phi) == poses[i].phi_deg);
    CHECK(std::stod(score) == Approx(scores[i]).margin(1e-6));
  }
  CHECK_FALSE(lines >> rest);

  const auto json = nlohmann::json::parse(place.run("model.safetensors --image top.png --json").out);
  REQUIRE(json.at("views").size() == order.size());
  CHECK(json.at("best") == json.at("views")[0]);
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    const auto& view = json.at("views")[rank];
    CHECK(view.at("theta_deg") == poses[order[rank]].theta_deg);
    CHECK(view.at("phi_deg") == poses[order[rank]].phi_deg);
    CHECK(view.at("score").get<double>() == Approx(scores[order[rank]]).margin(1e-6));
  }
}

TEST_CASE("svnet-predict chooses the best views that differ enough") {
  const Workplace place;
  const Predictor predictor(small_model());
  const Tensor features = predictor.embed(small_image());
  const std::vector<CameraPose> poses = paper_grid();
  const std::vector<float> scores = predictor.scores(features, poses);
  std::vector<std::size_t> chosen(3);
  REQUIRE(best_views(scores, poses, 50, chosen) == 3);

  const std::string call = "model.safetensors --image top.png --best 3 --min-angle 50";
  std::istringstream lines(place.run(call).out);
  std::string line;
  std::getline(lines, line);
  for (const std::size_t i : chosen) {
    double theta_deg = -1, phi_deg = -1, score = -1;
    REQUIRE(lines >> theta_deg >> phi_deg >> score);
    CHECK(CameraPose{theta_deg, phi_deg} == poses[i]);
  }
  CHECK_FALSE(lines >> line);

  const auto json = nlohmann::json::parse(place.run(call + " --json").out);
  REQUIRE(json.at("best_views").size() == 3);
  CHECK(json.at("best_views")[0] == json.at("best"));
  for (std::size_t i = 0; i < 3; ++i) CHECK(json.at("best_views")[i].at("theta_deg") == poses[chosen[i]].theta_deg);
  CHECK(json.at("views").size() == poses.size());
  CHECK(json.at("margin_over_top").get<double>() == Approx(scores[chosen[0]] - scores.back()).margin(1e-6));
  const auto alone = nlohmann::json::parse(place.run("model.safetensors --image top.png --json").out);
  CHECK(alone.at("best_views").size() == 1);

  const Ran none = place.run("model.safetensors --image top.png --best 0");
  CHECK(none.status == 2);
  const Ran wide = place.run("model.safetensors --image top.png --best 2 --min-angle 200");
  CHECK(wide.status == 1);
  CHECK_THAT(wide.err, Catch::Contains("the views are to differ by 200 degrees, expected 0 to 180"));
}

TEST_CASE("svnet-predict reads candidates from a file and draws them") {
  const Workplace place;
  place.folder.write("poses.csv", "theta,phi\n10,50\n200.5,70\n-90,0\n");
  const Ran ran = place.run("model.safetensors --image top.png --poses poses.csv --plot plot.png");
  CHECK(ran.status == 0);
  for (const char* part : {"10        50", "200.5        70", "-90         0"})
    CHECK_THAT(ran.out, Catch::Contains(part));
  const Predictor predictor(small_model());
  const std::vector<CameraPose> poses{{10, 50}, {200.5, 70}, {-90, 0}};
  const Image expected =
      prediction_picture(small_image(), nullptr, poses, predictor.scores(predictor.embed(small_image()), poses));
  CHECK(read_image(place.folder.path() / "plot.png").rgb == expected.rgb);
}

TEST_CASE("svnet-predict says what is wrong") {
  const Workplace place;
  place.folder.write("poses.csv", "theta,phi\n0,45\n0,95\n");
  const Ran range = place.run("model.safetensors --image top.png --poses poses.csv --plot plot.png");
  CHECK(range.status == 1);
  CHECK(range.out.empty());
  CHECK(range.err == "svnet-predict: poses.csv:3: phi 95 is outside [0, 90] degrees\n");
  CHECK_FALSE(std::filesystem::exists(place.folder.path() / "plot.png"));
  CHECK_THAT(place.run("none --image top.png").err, Catch::StartsWith("svnet-predict: none: cannot be read"));
  CHECK_THAT(place.run("top.png --image top.png").err, Catch::StartsWith("svnet-predict: top.png: "));
  CHECK_THAT(place.run("model.safetensors --image none.png").err, Catch::StartsWith("svnet-predict: none.png: "));
  CHECK(place.run("model.safetensors").status == 2);
  CHECK(place.run("model.safetensors --image top.png --grid --poses poses.csv").status == 2);
}

TEST_CASE("svnet-predict takes an image through a pipe and writes the plot to standard output alone") {
  const Workplace place;
  const Ran plain = place.run("model.safetensors --image top.png --plot plot.png");
  REQUIRE(plain.status == 0);
  const std::string piped = "cat top.png | " SVNET_PREDICT " model.safetensors --image /dev/stdin";
  CHECK(run_shell(place.folder.path(), piped).out == plain.out);
  const Ran image = place.run("model.safetensors --image top.png --plot /dev/stdout | cat");
  CHECK(image.status == 0);
  CHECK(image.out == file_contents(place.folder.path() / "plot.png"));
  CHECK(place.run("model.safetensors --image top.png --plot /dev/stdout > out.png").status == 0);
  CHECK(file_contents(place.folder.path() / "out.png") == file_contents(place.folder.path() / "plot.png"));
}

TEST_CASE("svnet-predict warns of an EXIF orientation, or obeys it") {
  const Workplace place;
  std::filesystem::copy_file(std::filesystem::path(SVNET_FIXTURES) / "pictures/turned.jpg",
                             place.folder.path() / "turned.jpg");
  const Ran ignored = place.run("model.safetensors --image turned.jpg");
  CHECK(ignored.err ==
        "turned.jpg: the EXIF orientation 6 is ignored; --exif-orientation obey turns the image as viewers do\n");
  const Ran obeyed = place.run("model.safetensors --image turned.jpg --exif-orientation obey");
  CHECK(obeyed.err.empty());
  CHECK(obeyed.out != ignored.out);
  CHECK(place.run("model.safetensors --image turned.jpg --exif-orientation maybe").status == 2);
}

TEST_CASE("svnet-predict takes angles that are out of range by rounding for the bound") {
  const Workplace place;
  place.folder.write("exact.csv", "theta,phi\n0,90\n");
  place.folder.write("rounded.csv", "\"theta\",\"phi\"\n+0,90.00000250447816\n");
  const Ran exact = place.run("model.safetensors --image top.png --poses exact.csv --json");
  const Ran rounded = place.run("model.safetensors --image top.png --poses rounded.csv --json");
  CHECK(rounded.status == 0);
  CHECK(rounded.out == exact.out);
}

TEST_CASE("svnet-predict takes the depth of the top view for a model that uses it") {
  const Workplace place;
  const std::filesystem::path folder = place.folder.path();
  const Model model = small_axis_model(frame::DepthChoice::heights);
  write_model(folder / "depth.safetensors", model);
  const frame::Shape shape = frame::wedge(1.3, 0.5, 70);
  write_png(folder / "wedge.png", frame::picture_of(shape));
  write_depth_png(folder / "wedge_depth.png", frame::depth_of(shape, [](double, double) { return 0.03; }));

  const Ran ran = place.run("depth.safetensors --image wedge.png --depth wedge_depth.png --json");
  CHECK(ran.status == 0);
  CHECK(ran.err.empty());
  const DepthImage depth = read_depth(folder / "wedge_depth.png");
  const Predictor predictor(model);
  const auto scores = predictor.scores(predictor.embed(frame::picture_of(shape), &depth), paper_grid());
  const auto best = nlohmann::json::parse(ran.out).at("best");
  const std::size_t expected = best_view(scores);
  CHECK(best.at("theta_deg") == paper_grid()[expected].theta_deg);
  CHECK(best.at("score").get<double>() == Approx(scores[expected]).margin(1e-6));

  const Ran missing = place.run("depth.safetensors --image wedge.png --plot plot.png");
  CHECK(missing.status == 1);
  CHECK(missing.out.empty());
  CHECK(missing.err ==
        "svnet-predict: depth.safetensors: was trained with depth; give the depth image of the top view by --depth\n");
  CHECK_FALSE(std::filesystem::exists(folder / "plot.png"));
  const Ran none = place.run("depth.safetensors --image wedge.png --depth none.png");
  CHECK(none.status == 1);
  CHECK_THAT(none.err, Catch::StartsWith("svnet-predict: none.png: "));
  const Ran colours = place.run("depth.safetensors --image wedge.png --depth wedge.png");
  CHECK(colours.status == 1);
  CHECK_THAT(colours.err, Catch::StartsWith("svnet-predict: wedge.png: "));
}

TEST_CASE("svnet-predict says that it ignores depth if the model does not use it") {
  const Workplace place;
  write_depth_png(place.folder.path() / "depth.png", {8, 8, std::vector<float>(64, 0.5f)});
  write_model(place.folder.path() / "axis.safetensors", small_axis_model());
  for (const std::string model : {"model.safetensors", "axis.safetensors"}) {
    const Ran plain = place.run(model + " --image top.png"),
              with = place.run(model + " --image top.png --depth depth.png");
    CHECK(plain.err.empty());
    CHECK(with.status == 0);
    CHECK(with.out == plain.out);
    CHECK(with.err == "--depth is ignored: the model was trained without depth\n");
  }
}

TEST_CASE("svnet-predict takes a folder of top images") {
  const Workplace place;
  std::filesystem::create_directory(place.folder.path() / "tops");
  for (const char* name : {"b10.png", "b9.png"}) write_png(place.folder.path() / "tops" / name, small_image());
  const auto one = nlohmann::json::parse(place.run("model.safetensors --image top.png --json").out);
  const Ran ran = place.run("model.safetensors --image tops --json --plot pictures --quiet");
  REQUIRE(ran.status == 0);
  const auto images = nlohmann::json::parse(ran.out).at("images");
  REQUIRE(images.size() == 2);
  CHECK(images[0].at("image") == "b9.png");
  CHECK(images[1].at("image") == "b10.png");
  CHECK(images[1].at("views") == one.at("views"));
  CHECK(read_image(place.folder.path() / "pictures/b9.png").width == 1232);

  std::filesystem::create_directory(place.folder.path() / "empty");
  const Ran empty = place.run("model.safetensors --image empty");
  CHECK(empty.status == 1);
  CHECK_THAT(empty.err, Catch::Contains("empty: holds no PNG, JPEG or WebP file, and no data set"));
}

TEST_CASE("svnet-predict chooses among the views of a data set, and shows the one that it chose") {
  const Workplace place;
  const auto pose = place.folder.path() / "data/mug/1/1";
  std::filesystem::create_directories(pose);
  for (const char* name : {"90_90.png", "45_0.png", "60_135.png"}) write_png(pose / name, small_image());
  const Ran ran = place.run("model.safetensors --image data --json --plot pictures --quiet");
  REQUIRE(ran.status == 0);
  const auto image = nlohmann::json::parse(ran.out).at("images").at(0);
  CHECK(image.at("image") == "mug/1/1/90_90.png");
  CHECK(image.at("views").size() == 3);
  CHECK(read_image(place.folder.path() / "pictures/mug_1_1_90_90.png").width == 1768);
  const Ran grid = place.run("model.safetensors --image data --json --grid --quiet");
  CHECK(nlohmann::json::parse(grid.out).at("images").at(0).at("views").size() == paper_grid().size());
}

TEST_CASE("svnet-predict ranks the next view after those taken") {
  const Workplace place;
  Model model = small_axis_model();
  set_small_next_head(model);
  write_model(place.folder.path() / "next.safetensors", model);
  const Image top = frame::picture_of(frame::letter_t(1.2, 33)), view = frame::picture_of(frame::wedge(1, 0.4, 10));
  write_png(place.folder.path() / "hammer.png", top);
  write_png(place.folder.path() / "view.png", view);
  const Predictor predictor(model);
  const std::vector<frame::TakenView> taken{{{45, 60}, frame::view_shape(view)}, {{90, 90}, frame::view_shape(top)}};
  std::vector<CameraPose> poses;
  for (const CameraPose& pose : paper_grid())
    if (is_apart(pose, taken, 20)) poses.push_back(pose);
  REQUIRE(poses.size() < paper_grid().size() - 2);
  const std::vector<float> scores = predictor.next_scores(predictor.embed(top), taken, poses);
  const std::string arguments =
      "next.safetensors --image hammer.png --taken 45,60=view.png --taken 90,90=hammer.png --min-angle 20";
  const Ran ran = place.run(arguments + " --json");
  INFO(ran.err);
  const auto json = nlohmann::json::parse(ran.out);
  CHECK_FALSE(json.contains("margin_over_top"));
  REQUIRE(json.at("views").size() == poses.size());
  const CameraPose& best = poses[best_view(scores)];
  CHECK(json.at("best").at("theta_deg") == best.theta_deg);
  CHECK(json.at("best").at("phi_deg") == best.phi_deg);
  CHECK(place.run(arguments + " --plot next.png").status == 0);

  const auto error = [&](const std::string& with) { return place.run(with).err; };
  CHECK_THAT(error("model.safetensors --image hammer.png --taken 45,60=view.png"),
             Catch::Contains("model.safetensors: does not know which view to take next"));
  CHECK_THAT(error("next.safetensors --image hammer.png --taken 45,60"),
             Catch::Contains("'45,60' is not THETA,PHI=FILE, such as 45,60=view.png"));
  CHECK_THAT(error("next.safetensors --image hammer.png --taken 45,95=view.png"), Catch::Contains("phi 95 is outside"));
  CHECK_THAT(error("next.safetensors --image hammer.png --taken 45,60=none.png"), Catch::Contains("none.png"));
  CHECK(place.run("next.safetensors --image hammer.png --taken 45,60=view.png --views 2").status == 2);
}
