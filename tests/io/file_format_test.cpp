#include "io/files/file_format.h"

#include <catch2/catch.hpp>

#include "io/files/file_lock.h"
#include "io/files/whole_file.h"
#include "temporary_folder.h"

using namespace svnet;
using namespace svnet::io;
using Catch::Contains;
using namespace std::string_view_literals;

TEST_CASE("files that are something else are recognised") {
  for (const auto& [start, meaning] : {
           std::pair{"version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\n"sv, "Git LFS pointer"},
           {"\n<!DOCTYPE HTML>\n<html>"sv, "web page"},
           {"\xef\xbb\xbf<html lang=en>"sv, "web page"},
           {"<?xml version='1.0'?><Error>"sv, "XML"},
           {"\x1f\x8b\x08\0"sv, "gzip"},
           {"PK\x03\x04\x14\0"sv, "take model.weights.h5 out"},
           {"\x89HDF\r\n\x1a\n"sv, "an HDF5 file"},
           {"PK\x03\x04\x14\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\x07\0\0\0arr.npyDATA"sv, "NumPy arrays"},
           {"PK\x03\x04\0\0\x08\x08\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\x0a\0\x08\0w/data.pkl12345678"sv, "PyTorch"},
           {"PK\x03\x04\0\0\x08\x08\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\x11\0\0\0w/.format_version1234"sv, "PyTorch"},
           {"PK\x03\x04\0\0\x08\x08\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\x0b\0\0\0config.json1234"sv, "a zip archive"},
           {"\0\0\0\x18"
            "ftypheic"sv,
            "HEIC"},
           {"\xff\xfev\0 \0"sv, "UTF-16"},
           {"\x80\x02}q"sv, "Python pickle"},
           {"\x40\0\0\0\0\0\0\0{\"a\":"sv, "safetensors"},
           {"\x02\0\0\0\0\0\0\0{}"sv, "safetensors"},
           {""sv, "empty"},
       }) {
    INFO(meaning);
    CHECK_THAT(recognised_instead(start), Catch::StartsWith(", but ") && Contains(meaning));
  }
  CHECK(recognised_instead("hello\n"sv).empty());
  CHECK(recognised_instead("a longer text"sv).empty());
  CHECK(recognised_instead("\x02\0\0\0\0\0\0\0{1}"sv).empty());  // as safetensors begin, but not JSON
  CHECK(recognised_instead("\xef\xbb\xbf \t\n"sv).empty());
  CHECK(recognised_instead(std::filesystem::path("no such file")).empty());
}

TEST_CASE("what is no file cannot be read as a whole") {
  const TemporaryFolder folder;
  CHECK(whole_file(folder.write("a", "x\0y"sv)) == "x\0y"sv);
  CHECK(whole_file(folder.write("empty", "")).empty());
  CHECK_THROWS_WITH(whole_file(folder.path()), folder.path().string() + ": is not a regular file");
  const std::string missing = (folder.path() / "missing").string();
  CHECK_THROWS_WITH(whole_file(missing), missing + ": cannot be read: No such file or directory");
}

TEST_CASE("a lock has one holder, and its file keeps its contents") {
  const TemporaryFolder folder;
  const auto path = folder.write("log.txt", "a line\n");
  {
    const FileLock first(path), second(path);
    CHECK(first.held());
    CHECK_FALSE(second.held());
  }
  CHECK(FileLock(path).held());
  CHECK(file_contents(path) == "a line\n");
  CHECK_THROWS_WITH(FileLock(folder.path() / "none" / "log.txt"), Contains("log.txt: cannot be opened: No such file"));
}
