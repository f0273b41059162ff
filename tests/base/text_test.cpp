#include "base/text.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "base/split.h"

using namespace svnet;

TEST_CASE("nearest_name finds the name that was meant, or nothing if no name is near") {
  const std::vector<std::string> names{"epochs", "batch_size", "learning_rate"};
  CHECK(nearest_name("epoch", names) == "epochs");
  CHECK(nearest_name("learning-rate", names) == "learning_rate");
  CHECK(nearest_name("colour", names).empty());
  CHECK(suggestion("batchsize", names) == ", did you mean 'batch_size'?");
  CHECK(suggestion("colour", names) == "; known: epochs, batch_size, learning_rate");
}

TEST_CASE("natural order compares runs of digits by value") {
  std::vector<std::string> names{"10", "2", "a10b", "a2b", "a", "1", "02", "a2", ""};
  std::sort(names.begin(), names.end(), natural_less);
  CHECK(names == std::vector<std::string>{"", "1", "02", "2", "10", "a", "a2", "a2b", "a10b"});
}

TEST_CASE("a text is split at separators, and parts may be empty") {
  using Parts = std::vector<std::string>;
  CHECK(split("a,bc,,d", ',') == Parts{"a", "bc", "", "d"});
  CHECK(split("a,", ',') == Parts{"a", ""});
  CHECK(split("", ',') == Parts{""});
  CHECK(split("a b", ',') == Parts{"a b"});
}
