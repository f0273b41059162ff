// svnet-crossval, and svnet-train, svnet-eval and svnet-info for models in the object's own frame.
#include <catch2/catch.hpp>

#include "bar_place.h"

using namespace svnet;
using Catch::Contains;

namespace {

const std::string kCrossval = "svnet-crossval config.yaml --threads 1 --output run ";

}  // namespace

TEST_CASE("svnet-crossval prints its table, writes crossval.json, and a second run reuses everything") {
  const BarPlace place;
  const std::string text = place.output_of(kCrossval + "--folds 3 --quiet");
  for (const char* part : {"Cross-validation over categories", "svnet", "opt_ind", "tiny_xception_ward",
                           "SV-net minus another selector", "Within poses: Spearman", "run/crossval.json"})
    CHECK_THAT(text, Contains(part));
  const std::string json = file_contents(place.folder.path() / "run/crossval.json");
  CHECK(nlohmann::json::parse(json).at("folds").size() == 3);
  const auto held_out = place.json("run/evaluation.json").at("tables").at("held_out").at("tiny_xception_ward");
  CHECK(held_out.at("svnet").at("fm").at("mean") ==
        nlohmann::json::parse(json).at("pipelines").at("tiny_xception_ward").at("svnet").at("fm").at("mean"));
  CHECK_THAT(text, Contains("run/views.png"));
  CHECK(std::filesystem::exists(place.folder.path() / "run/views.png"));
  CHECK(file_contents(place.folder.path() / "run/config.yaml").find("frame: axis") != std::string::npos);

  const Ran again = place.run(kCrossval + "--folds 3");
  CHECK(again.status == 0);
  CHECK_THAT(again.err, Contains("SV-net: reused"));
  CHECK_THAT(again.err, !Contains("ridge regression"));
  CHECK(again.out == text);
  CHECK(file_contents(place.folder.path() / "run/crossval.json") == json);
}

TEST_CASE("svnet-crossval takes folds by name, and varies keys") {
  const BarPlace place;
  place.output_of(kCrossval + "--fold awl,bar --fold rod --quiet");
  const auto folds = place.json("run/crossval.json").at("folds");
  REQUIRE(folds.size() == 3);
  CHECK(folds[0].at("held_out") == std::vector<std::string>{"awl", "bar"});
  CHECK(folds[2].at("held_out") == std::vector<std::string>{"cue", "fid", "peg"});

  place.output_of(kCrossval + "--each-choice-of 2 --quiet");
  CHECK(place.json("run/crossval.json").at("folds").size() == 15);
  CHECK(place.run(kCrossval + "--each-choice-of 2 --folds 3").status == 2);

  place.output_of(kCrossval +
                  "--folds 2 --quiet --sweep sv_net.depth=none,heights --sweep scores.clustering=ward,kmeans");
  const auto tried = place.json("run/crossval.json").at("tried");
  REQUIRE(tried.size() == 4);
  CHECK(tried[0].at("settings") == "sv_net.depth=none, scores.clustering=ward");
  CHECK(tried[3].at("settings") == "sv_net.depth=heights, scores.clustering=kmeans");
  CHECK(tried[0].at("within_pose") != tried[1].at("within_pose"));
  CHECK_THAT(place.output_of("svnet-info run/fold-1/model.safetensors"), Contains("heights"));

  place.output_of(kCrossval + "--folds 2 --quiet --repeats 2");
  CHECK(place.json("run/crossval.json").at("tried")[1].at("settings") == "repeat 2");
}

TEST_CASE("svnet-crossval says what is wrong before it works") {
  const BarPlace place;
  CHECK_THAT(place.output_of("svnet-crossval --help"), Contains("--folds") && Contains("--sweep KEY=A,B"));
  const auto error_of = [&](const std::string& command) { return place.error_of(command); };
  CHECK_THAT(error_of(kCrossval + "--quiet --fold awl,bra"),
             Contains("--fold") && Contains("'bra'") && Contains("'bar'"));
  CHECK_THAT(error_of(kCrossval + "--quiet --fold awl,bar --fold bar"), Contains("'bar' is named twice"));
  CHECK_THAT(error_of(kCrossval + "--quiet --folds 1"), Contains("6 categories cannot be split into 1 folds"));
  CHECK_THAT(error_of(kCrossval + "--quiet --folds 3 --sweep scores.rounds"),
             Contains("--sweep: 'scores.rounds' is not of the form key=value,value"));
  CHECK_THAT(error_of(kCrossval + "--quiet --folds 3 --sweep scores.rounds="), Contains("is not of the form"));
  CHECK_THAT(error_of(kCrossval + "--quiet --folds 3 --sweep scores.round=0,1"),
             Contains("scores.round: unknown key, did you mean 'rounds'?"));
  CHECK_THAT(error_of(kCrossval + "--quiet --folds 3 --sweep scores.rounds=0,x"),
             Contains("scores.rounds: 'x' is wrong"));
  CHECK_THAT(error_of(kCrossval + "--quiet --folds 3 --sweep scores.backbone=tiny_xception,tiny_xceptoin"),
             Contains("tiny_xceptoin"));
  CHECK_THAT(error_of(kCrossval + "--quiet --folds 3 --sweep dataset.root=data,data2"),
             Contains("dataset: its keys cannot vary within a run folder"));
  CHECK_THAT(error_of(kCrossval + "--quiet --folds 3 --set dataset.held_out=[rod]"),
             Contains("holds categories out of every fold"));
  CHECK_THAT(error_of("svnet-crossval none.yaml --output run"), Contains("none.yaml: cannot open"));
  CHECK_THAT(error_of("svnet-crossval config.yaml --output data/run"), Contains("lies in the data set"));
  CHECK(place.run(kCrossval + "--folds 3 --fold awl").status == 2);
  CHECK(place.run("svnet-crossval config.yaml").status == 2);
  place.folder.write("other/scores.h5", "somebody's");
  CHECK_THAT(error_of("svnet-crossval config.yaml --output other"),
             Contains("other/scores.h5: a run would take its place"));
  place.folder.write("third/crossval.json", "somebody's");
  CHECK_THAT(error_of("svnet-crossval config.yaml --output third"),
             Contains("third/crossval.json: a run would take its place"));
  CHECK(file_contents(place.folder.path() / "third/crossval.json") == "somebody's");
}

TEST_CASE("svnet-crossval names the depth image that is missing") {
  const BarPlace place;
  std::filesystem::remove(place.folder.path() / "data/_extra/cue/1/1/90_90_depth.png");
  const Ran ran = place.run(kCrossval + "--quiet --folds 3 --set sv_net.depth=heights");
  CHECK(ran.status == 1);
  CHECK_THAT(ran.err, Contains("data/_extra/cue/1/1/90_90_depth.png: no such file; sv_net.depth: heights needs"));
}

TEST_CASE("svnet-train and svnet-eval work in the object's own frame, with the rules beside SV-net") {
  const BarPlace place;
  place.output_of(
      "svnet-train config.yaml --output run --threads 1 --quiet --set sv_net.depth=heights --set "
      "dataset.held_out=[peg,rod]");
  const std::string text =
      place.output_of("svnet-eval run --threads 1 --quiet --selectors broadside,phi_map,svnet,rand");
  CHECK_THAT(text, Contains("broadside") && Contains("phi_map") && Contains("SV-net minus another selector"));
  const auto json = place.json("run/evaluation.json");
  const auto& held_out = json.at("tables").at("held_out").at("tiny_xception_ward");
  std::vector<std::string> selectors;
  for (const auto& [name, metrics] : held_out.items()) selectors.push_back(name);
  CHECK(selectors == std::vector<std::string>{"broadside", "phi_map", "rand", "svnet"});
  const auto& difference = json.at("differences").at("held_out").at("tiny_xception_ward").at("svnet-rand").at("fm");
  CHECK(difference.at("mean").get<double>() == Approx(held_out.at("svnet").at("fm").at("mean").get<double>() -
                                                      held_out.at("rand").at("fm").at("mean").get<double>())
                                                   .margin(1e-9));
  CHECK(difference.at("low").is_null());  // two categories say nothing about others

  const std::string info = place.output_of("svnet-info run/model.safetensors");
  CHECK_THAT(info, Contains("its depth image") && Contains("axis") && Contains("heights") &&
                       Contains("ridge regression") && Contains("standard deviations") &&
                       !Contains("head/ridge/kernel"));
  CHECK_THAT(place.output_of("svnet-info run/model.safetensors --tensors"),
             Contains("trained on") && Contains("head/ridge/kernel"));
  CHECK_THAT(place.output_of("svnet-info run/model.safetensors --plan"), Contains("SV-net") && Contains("ridge"));
}
