#include "serve/routes.h"

#include <nlohmann/json.hpp>

#include "frame/top_view.h"
#include "io/images/image_codecs.h"
#include "serve/requests.h"
#include "small_model.h"
#include "view/camera.h"
#include "view/pose_grid.h"

using namespace svnet;
using namespace svnet::serve;
using Json = nlohmann::json;

namespace {

const frame::Shape kHammer = frame::letter_t(1.2, 33);

Image hammer() { return frame::picture_of(kHammer, {.noise = 3}); }
std::string hammer_png() { return io::encoded_png("top", hammer()); }

DepthImage hammer_depth() {
  DepthImage depth = frame::depth_of(kHammer, [](double x, double) { return x < 0 ? 0.03 : 0.02; });
  for (float& z : depth.metres) z = std::round(1000 * z) / 1000;  // as a PNG stores it
  return depth;
}

std::string hammer_depth_png() {
  const DepthImage depth = hammer_depth();
  io::Grey16 grey{depth.height, depth.width, {}};
  for (const float z : depth.metres) grey.levels.push_back(static_cast<std::uint16_t>(std::lround(1000 * z)));
  return io::encoded_grey16_png("depth", grey);
}

std::string part(const std::string& name, const std::string& contents) {
  return "--XX\r\nContent-Disposition: form-data; name=\"" + name + "\"\r\n\r\n" + contents + "\r\n";
}

Request form(const std::string& parts) {
  return request_for("POST", "/v1/predict", parts + "--XX--\r\n", "multipart/form-data; boundary=XX");
}

/// The answers of a model in the frame `axis`.
class Served {
 public:
  explicit Served(frame::DepthChoice depth = frame::DepthChoice::none, const Limits& limits = {})
      : routes_(small_axis_model(depth), {}, limits, {.token = "", .hosts = {"localhost"}}) {}

  Response answer(const Request& request) { return routes_.answer(request); }
  Json json(const Request& request) {
    const Response response = answer(request);
    CAPTURE(response.body);
    CHECK(response.status == 200);
    return Json::parse(response.body);
  }
  /// "400 message" of a request that is refused.
  std::string refused(const Request& request) {
    const Response response = answer(request);
    CHECK(response.type == "application/json");
    return std::to_string(response.status) + " " + Json::parse(response.body).at("error").get<std::string>();
  }

 private:
  Routes routes_;
};

}  // namespace

TEST_CASE("a prediction has the scores of the predictor, best first, and the camera of the best") {
  Served served;
  const predict::Predictor predictor(small_axis_model());
  const auto poses = view::paper_grid();
  const auto scores = predictor.scores(predictor.embed(hammer()), poses);
  const auto order = predict::best_first(scores);
  Request request = request_for("POST", "/v1/predict", hammer_png());
  request.parameters = {{"radius_m", "0.5"}, {"centre_m", "0.4,0,0.05"}, {"frame", "paper"}};
  const Json json = served.json(request);
  REQUIRE(json.at("views").size() == poses.size());
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    const Json& view = json.at("views")[rank];
    CHECK(view.at("theta_deg") == poses[order[rank]].theta_deg);
    CHECK(view.at("phi_deg") == poses[order[rank]].phi_deg);
    CHECK(view.at("score").get<float>() == scores[order[rank]]);
  }
  const auto camera = view::look_at(poses[order[0]], 0.5, {0.4, 0, 0.05}, view::CameraFrame::paper);
  const Json& best = json.at("best").at("camera_pose");
  CHECK(best.at("frame") == "paper");
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      CHECK(best.at("camera_to_world")[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)].get<double>() ==
            Approx(camera.matrix()(row, column)).margin(1e-12));
  CHECK(best.at("x_m").get<double>() == Approx(camera.translation().x()));
  CHECK(json.at("top_view").at("trust") == 1);
  CHECK(json.at("notes").empty());

  Request same = request_for("GET", "/v1/camera-pose");
  same.parameters = request.parameters;
  same.parameters.emplace_back("theta_deg", Json(poses[order[0]].theta_deg).dump());
  same.parameters.emplace_back("phi_deg", Json(poses[order[0]].phi_deg).dump());
  CHECK(served.json(same) == best);
}

TEST_CASE("a form gives image, depth and fields") {
  Served served(frame::DepthChoice::heights);
  const predict::Predictor predictor(small_axis_model(frame::DepthChoice::heights));
  const DepthImage depth = hammer_depth();
  const std::vector<view::CameraPose> poses{{10, 50}, {200, 70}};
  const auto scores = predictor.scores(predictor.embed(hammer(), &depth), poses);
  const std::string files = part("image", hammer_png()) + part("depth", hammer_depth_png());
  const Json json = served.json(form(files + part("poses", "10,50;200,70")));
  const std::size_t best = predict::best_view(scores);
  CHECK(json.at("best").at("theta_deg") == poses[best].theta_deg);
  CHECK(json.at("best").at("score").get<float>() == scores[best]);

  CHECK_THAT(served.refused(form(part("image", hammer_png()))),
             Catch::StartsWith("422 the model was trained with depth"));
  CHECK_THAT(served.refused(form(part("image", hammer_png()) + part("depth", hammer_png()))),
             Catch::StartsWith("422 depth: "));
  CHECK_THAT(served.refused(form(files + part("image", "x"))),
             Catch::StartsWith("400 the part 'image' is there twice"));
  CHECK_THAT(served.refused(form(files + part("possess", "x"))), Catch::StartsWith("400 the field possess"));
  CHECK_THAT(served.refused(form(part("depth", hammer_depth_png()))), Catch::StartsWith("400 there is no image"));
  Request twice = form(files + part("grid", "even"));
  twice.parameters = {{"grid", "paper"}};
  CHECK(served.refused(twice) == "400 the field grid is there twice");
}

TEST_CASE("depth that a model does not use is noted") {
  const Json json = Served().json(form(part("image", hammer_png()) + part("depth", "anything")));
  CHECK(json.at("notes") == Json{"depth is ignored: the model was trained without depth"});
}

TEST_CASE("bodies that are no image have a status and a line") {
  Served served;
  const std::string png = hammer_png();
  CHECK_THAT(served.refused(request_for("POST", "/v1/predict", "GIF89a", "image/gif")),
             Catch::StartsWith("415 the image is not a PNG, JPEG or WebP file"));
  CHECK_THAT(served.refused(request_for("POST", "/v1/predict", png, "application/x-www-form-urlencoded")),
             Catch::StartsWith("415 the body is application/x-www-form-urlencoded"));
  CHECK_THAT(served.refused(request_for("POST", "/v1/predict", png.substr(0, png.size() / 2))),
             Catch::StartsWith("422 image: is a damaged or incomplete PNG image"));
  CHECK_THAT(served.refused(request_for("POST", "/v1/predict", "")), Catch::StartsWith("400 there is no image"));
  // The header of a PNG file of 100,000 x 100,000 pixels.
  std::string huge = io::encoded_png("top", small_image());
  huge.replace(16, 8, std::string("\0\1\x86\xa0\0\1\x86\xa0", 8));
  CHECK_THAT(served.refused(request_for("POST", "/v1/predict", huge)), Catch::StartsWith("422 image: "));
}

TEST_CASE("sizes of bodies") {
  Served served(frame::DepthChoice::none, {.body_bytes = 100});
  const auto with = [](const Fields& headers) {
    Request request = request_for("POST", "/v1/predict");
    request.headers = {{"host", "localhost"}};
    request.headers.insert(request.headers.end(), headers.begin(), headers.end());
    request.read_body = [](std::size_t) -> std::string {
      FAIL("the body was read");
      return "";
    };
    return request;
  };
  CHECK_THAT(served.refused(with({})), Catch::StartsWith("411 "));
  CHECK_THAT(served.refused(with({{"transfer-encoding", "chunked"}})), Catch::StartsWith("411 "));
  CHECK_THAT(served.refused(with({{"content-length", "101"}})), Catch::StartsWith("413 "));
  for (const char* wrong : {"", "-1", "1x", "99999999999999999999"})
    CHECK_THAT(served.refused(with({{"content-length", wrong}})), Catch::StartsWith("400 "));
  CHECK_THAT(served.refused(with({{"content-length", "5"}, {"content-length", "5"}})), Catch::StartsWith("400 "));
  CHECK_THAT(served.refused(with({{"content-length", "5"}, {"content-encoding", "gzip"}})), Catch::StartsWith("415 "));
}

TEST_CASE("paths and methods") {
  Served served;
  CHECK(served.json(request_for("GET", "/healthz")) == Json{{"status", "ok"}});
  const Json model = served.json(request_for("GET", "/v1/model"));
  CHECK(model.at("uses_depth") == false);
  CHECK(model.at("frame") == "axis");
  CHECK(model.at("fingerprint") == "small axis");
  CHECK(model.at("limits").at("poses") == 4096);
  CHECK(served.answer(request_for("GET", "/")).type == "text/html; charset=utf-8");
  CHECK(served.answer(request_for("HEAD", "/openapi.json")).status == 200);
  CHECK_THAT(served.refused(request_for("GET", "/none\r\n")), Catch::StartsWith("404 there is nothing at /none"));
  const Response put = served.answer(request_for("PUT", "/v1/predict"));
  CHECK(put.status == 405);
  CHECK(put.headers == Fields{{"Allow", "POST"}});
  CHECK(served.answer(request_for("POST", "/v1/model")).headers == Fields{{"Allow", "GET, HEAD"}});
  Request pose = request_for("GET", "/v1/camera-pose");
  pose.parameters = {{"phi_deg", "95"}};
  CHECK_THAT(served.refused(pose), Catch::StartsWith("400 phi 95 is outside"));
}
