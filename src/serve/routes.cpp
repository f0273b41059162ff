#include "serve/routes.h"

#include <nlohmann/json.hpp>

#include "base/text.h"
#include "serve/form_data.h"
#include "serve/model_summary.h"
#include "serve/prediction.h"
#include "serve/refusal.h"
#include "serve/static_files.h"

namespace svnet::serve {
namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

Response json_response(std::string text) { return {.body = std::move(text)}; }

/// The files and fields of a request for a prediction.
struct Inputs {
  std::string_view image, depth;
  Fields fields;
};

/// `body` must outlive the result.
Inputs inputs_of(const Request& request, std::string_view body, const std::string& type) {
  Inputs inputs{.image = body, .depth = {}, .fields = request.parameters};
  if (!is_form_data(type)) return inputs;
  inputs.image = {};
  for (const FormPart& part : form_parts(body, type)) {
    if (part.name != "image" && part.name != "depth") {
      inputs.fields.emplace_back(part.name, part.contents);
      continue;
    }
    std::string_view& file = part.name == "image" ? inputs.image : inputs.depth;
    expect(file.empty(), 400, "the part '", part.name, "' is there twice");
    file = part.contents;
  }
  return inputs;
}

/// The Content-Type of a body that may hold an image. Throws Refusal 415 for another one.
std::string body_type(const Request& request) {
  std::string type = request.header("content-type").value_or("application/octet-stream");
  const std::string kind = lower_case(type.substr(0, type.find_first_of("; ")));
  expect(kind == "multipart/form-data" || kind.starts_with("image/") || kind == "application/octet-stream", 415,
         "the body is ", printable(kind),
         "; send an image (Content-Type: image/png, image/jpeg or image/webp) or a form "
         "(multipart/form-data) with the part 'image'");
  return type;
}

Clock::time_point after(double seconds) {
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

Response camera_pose_response(const Request& request) {
  FieldValues fields(request.parameters);
  const view::CameraPose pose{fields.number("theta_deg", 0), fields.number("phi_deg", 90)};
  const std::string problem = pose_problem(pose);
  expect(problem.empty(), 400, problem);
  const CameraPlace place = camera_place(fields);
  fields.check_all_taken();
  return json_response(text_of(camera_pose_json(pose, place)));
}

}  // namespace

Routes::Routes(const Model& model, const InferenceOptions& options, const Limits& limits, Guard guard)
    : limits_(limits),
      guard_(std::move(guard)),
      predictor_(model, options),
      model_json_(text_of(model_json(model, limits))),
      bodies_(kBodies * limits.body_bytes, 0),
      predictions_(static_cast<std::uint64_t>(limits.parallel), limits.waiting) {}

Response Routes::answer(const Request& request) try {
  guard_.check_request(request);
  return routed(request);
} catch (const Refusal& refusal) {
  return error_response(refusal.status(), refusal.what());
} catch (const Error& error) {
  return error_response(422, error.what());
} catch (const std::bad_alloc&) {
  return error_response(503, "there is not enough memory for this request");
} catch (const std::exception&) {
  return error_response(500, "the server failed; its log may say why");
}

Response Routes::routed(const Request& request) {
  const bool is_prediction = request.path == "/v1/predict";
  const StaticFile* file = static_file(request.path);
  const bool is_known = is_prediction || file != nullptr || request.path == "/healthz" || request.path == "/v1/model" ||
                        request.path == "/v1/camera-pose";
  expect(is_known, 404, "there is nothing at ", printable(request.path.substr(0, 80)),
         "; /openapi.json says what there is");
  const bool is_read = request.method == "GET" || request.method == "HEAD";
  if (is_prediction ? request.method != "POST" : !is_read) {
    Response response = error_response(405, joined(request.path, " takes ", is_prediction ? "POST" : "GET", " only"));
    response.headers.emplace_back("Allow", is_prediction ? "POST" : "GET, HEAD");
    return response;
  }
  if (is_prediction) return predicted(request);
  if (file != nullptr) return {.type = file->type, .body = std::string(file->contents)};
  if (request.path == "/v1/model") return json_response(model_json_);
  if (request.path == "/v1/camera-pose") return camera_pose_response(request);
  return json_response("{\"status\": \"ok\"}\n");
}

Response Routes::predicted(const Request& request) {
  const std::size_t bytes = body_size(request, limits_.body_bytes);
  const std::string type = body_type(request);
  const Turnstile::Turn place = bodies_.enter(Clock::now(), bytes);
  const std::string body = request.read_body(bytes);
  const Inputs inputs = inputs_of(request, body, type);
  expect(!inputs.image.empty(), 400, "there is no image: send it as the body, or as the part 'image' of a form");
  const PredictionRequest wanted = prediction_request(inputs.fields, limits_.poses);
  const Turnstile::Turn turn = predictions_.enter(after(limits_.seconds));
  return json_response(text_of(prediction_json(predictor_, wanted, inputs.image, inputs.depth)));
}

}  // namespace svnet::serve
