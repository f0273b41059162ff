#include "serve/guard.h"

#include "serve/requests.h"

using namespace svnet::serve;

namespace {

std::string answer_to(const Guard& guard, const std::string& path, const Fields& headers) {
  Request request = request_for("GET", path);
  request.headers = headers;
  return refusal_of([&] { guard.check_request(request); });
}

}  // namespace

TEST_CASE("on this machine only its own names are answered") {
  const Guard guard{.token = "", .hosts = loopback_hosts("Box.local")};
  for (const char* host : {"localhost", "LOCALHOST:1", "127.0.0.1:8080", "[::1]:8080", "box.local"})
    CHECK(answer_to(guard, "/v1/model", {{"host", host}}) == "");
  for (const char* host : {"evil.example", "localhost.evil.example", "127.0.0.1.evil.example:80", "", "[::2]", "["}) {
    CAPTURE(host);
    CHECK_THAT(answer_to(guard, "/", {{"host", host}}), Catch::StartsWith("421 "));
  }
  CHECK_THAT(answer_to(guard, "/", {}), Catch::StartsWith("400 "));
  CHECK_THAT(answer_to(guard, "/", {{"host", "localhost"}, {"host", "localhost"}}), Catch::StartsWith("400 "));
}

TEST_CASE("pages of other sites may not ask") {
  const Guard guard{.token = "", .hosts = loopback_hosts("127.0.0.1")};
  const auto asked_by = [&](const Fields& more) {
    Fields headers{{"host", "localhost:8080"}};
    headers.insert(headers.end(), more.begin(), more.end());
    return answer_to(guard, "/v1/predict", headers);
  };
  CHECK(asked_by({{"origin", "http://localhost:8080"}, {"sec-fetch-site", "same-origin"}}) == "");
  CHECK(asked_by({{"sec-fetch-site", "none"}}) == "");
  for (const char* origin : {"http://evil.example", "null", "http://localhost:9090", "http://localhost"})
    CHECK_THAT(asked_by({{"origin", origin}}), Catch::StartsWith("403 "));
  CHECK_THAT(asked_by({{"sec-fetch-site", "cross-site"}}), Catch::StartsWith("403 "));
  CHECK_THAT(asked_by({{"sec-fetch-site", "same-site"}}), Catch::StartsWith("403 "));
}

TEST_CASE("a token opens /v1/, and the page needs none") {
  const std::string token(32, 'k');
  const Guard guard{.token = token, .hosts = {}};
  const auto asked_with = [&](const char* path, const std::string& authorization) {
    return answer_to(guard, path, {{"host", "robot.example"}, {"authorization", authorization}});
  };
  CHECK(asked_with("/v1/model", "Bearer " + token) == "");
  for (const std::string& wrong :
       std::vector<std::string>{"", "Bearer ", "Bearer " + token + "k", "Basic " + token, "bearer", token})
    CHECK_THAT(asked_with("/v1/model", wrong), Catch::StartsWith("401 "));
  CHECK(asked_with("/", "") == "");
  CHECK(asked_with("/healthz", "") == "");
}
