#include "serve/static_files.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "base/version.h"

using namespace svnet::serve;

TEST_CASE("the page's files are part of the program") {
  REQUIRE(static_file("/") != nullptr);
  CHECK(static_file("/")->type == "text/html; charset=utf-8");
  CHECK(static_file("/")->contents.starts_with("<!DOCTYPE html>"));
  CHECK(static_file("/page/page.js")->type == "text/javascript; charset=utf-8");
  for (const char* path : {"", "/page", "/page/", "/page/none.js", "/page/../openapi.json", "/index.html"})
    CHECK(static_file(path) == nullptr);
}

TEST_CASE("every file that the page loads is there, and none of another server") {
  for (const StaticFile& file : static_files()) {
    const std::string text(file.contents);
    CAPTURE(file.path);
    CHECK_FALSE(text.empty());
    for (std::size_t at = 0; (at = text.find("\"/page/", at)) != std::string::npos; ++at)
      CHECK(static_file(text.substr(at + 1, text.find('"', at + 1) - at - 1)) != nullptr);
    for (std::size_t at = 0; (at = text.find("from \"./", at)) != std::string::npos; ++at)
      CHECK(static_file("/page/" + text.substr(at + 8, text.find('"', at + 8) - at - 8)) != nullptr);
    if (file.path != "/page/icon.svg") CHECK(text.find("http://") == std::string::npos);
    CHECK(text.find("https://") == std::string::npos);
  }
}

TEST_CASE("the description of the interface is of this version") {
  const auto json = nlohmann::json::parse(static_file("/openapi.json")->contents);
  CHECK(json.at("openapi") == "3.1.0");
  CHECK(json.at("info").at("version") == svnet::kVersion);
}
