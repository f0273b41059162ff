#include "serve/form_data.h"

#include "serve/requests.h"

using namespace svnet::serve;

namespace {

const std::string kType = "multipart/form-data; boundary=XX";
const std::string kBody =
    "--XX\r\nContent-Disposition: form-data; name=\"image\"; filename=\"a;name=b.png\"\r\nContent-Type: "
    "image/png\r\n\r\n"
    "\x89PNG\r\n--X\r\n"
    "\r\n--XX\r\ncontent-disposition:form-data;name=grid\r\n\r\neven\r\n--XX--\r\n";

}  // namespace

TEST_CASE("a form has its parts, with names, and bytes as they came") {
  const auto parts = form_parts(kBody, kType);
  REQUIRE(parts.size() == 2);
  CHECK(parts[0].name == "image");
  CHECK(parts[0].contents == "\x89PNG\r\n--X\r\n");
  CHECK(parts[1].name == "grid");
  CHECK(parts[1].contents == "even");
  CHECK(form_parts(kBody, "Multipart/Form-Data; charset=x; Boundary=\"XX\"").size() == 2);
  CHECK(form_parts("--XX--", kType).empty());
}

TEST_CASE("a form that is cut off anywhere is refused") {
  for (std::size_t size = 0; size < kBody.size() - 3; ++size) {  // the last line end may be missing
    CAPTURE(size);
    CHECK_THAT(refusal_of([&] { form_parts(kBody.substr(0, size), kType); }), Catch::StartsWith("400 "));
  }
}

TEST_CASE("forms that are wrong are refused") {
  CHECK_THAT(refusal_of([] { form_parts(kBody, "multipart/form-data"); }), Catch::Contains("needs a boundary"));
  CHECK_THAT(refusal_of([] { form_parts(kBody, "multipart/form-data; boundary=" + std::string(71, 'a')); }),
             Catch::Contains("needs a boundary"));
  CHECK_THAT(refusal_of([] { form_parts("--XX\r\nA: b\r\n\r\nc\r\n--XX--", kType); }), Catch::Contains("has no name"));
  CHECK_THAT(refusal_of([] { form_parts("--XX\r\nA: b\r\n--XX\r\n\r\n\r\n--XX--", kType); }),
             Catch::Contains("has no headers"));
  std::string many;
  for (int i = 0; i < 33; ++i) many += "--XX\r\nContent-Disposition: form-data; name=a\r\n\r\n\r\n";
  CHECK_THAT(refusal_of([&] { form_parts(many + "--XX--", kType); }), Catch::Contains("more than 32 parts"));
}
