// The first line is the Content-Type, the rest the body; its parts are the fields of a prediction.
#include "serve/form_data.h"

#include "fuzz_target.h"
#include "serve/prediction_request.h"

using namespace svnet;
using namespace svnet::fuzz;

SVNET_FUZZ_TARGET(form_data) {
  std::string_view body = text_of(input);
  const std::string type(body.substr(0, body.find('\n')));
  body.remove_prefix(std::min(body.size(), type.size() + 1));
  accept([&] {
    if (!serve::is_form_data(type)) return;
    serve::Fields fields;
    for (const serve::FormPart& part : serve::form_parts(body, type)) fields.emplace_back(part.name, part.contents);
    serve::prediction_request(fields, 64);
  });
}
