#include "io/files/file_hash.h"

#include <catch2/catch.hpp>

#include "base/error.h"
#include "base/sha256.h"
#include "temporary_folder.h"

using namespace svnet;
using namespace svnet::io;
using Catch::Contains;

TEST_CASE("the hash of a file is the hash of its bytes") {
  const TemporaryFolder folder;
  CHECK(file_sha256(folder.write("empty", "")) == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  CHECK(file_sha256(folder.write("abc", "abc")) == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  const std::string large((std::size_t{1} << 20) * 2 + 17, '\xff');
  CHECK(file_sha256(folder.write("large", large)) == Sha256().update(large).hex());
  CHECK_THROWS_WITH(file_sha256(folder.path() / "none"), Contains("none: cannot be read: No such file or directory"));
  CHECK_THROWS_WITH(file_sha256(folder.path()), Contains("cannot be read: it is a folder"));
}
