#pragma once
#include <functional>
#include <string>

#include "predict/predictor.h"
#include "serve/guard.h"
#include "serve/limits.h"
#include "serve/message.h"
#include "serve/turnstile.h"

namespace svnet::serve {

/// What the server answers: the page, /healthz, /openapi.json, /v1/model, /v1/camera-pose and /v1/predict. Thread-safe.
class Routes {
 public:
  Routes(const Model& model, const InferenceOptions&, const Limits&, Guard);

  /// The answer, with a status for every Error. Reads the body only if it is allowed and there is room for it.
  Response answer(const Request&);

 private:
  Response routed(const Request&);
  Response predicted(const Request&);

  Limits limits_;
  Guard guard_;
  predict::Predictor predictor_;
  std::string model_json_;
  Turnstile bodies_;       // bytes of bodies in memory
  Turnstile predictions_;  // predictions at the same time
};

}  // namespace svnet::serve
