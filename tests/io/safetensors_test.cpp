#include "io/tensors/safetensors.h"

#include <array>
#include <catch2/catch.hpp>
#include <cstring>

#include "base/error.h"
#include "base/random.h"
#include "temporary_folder.h"

using namespace svnet;
using namespace svnet::io;
using Catch::Contains;

namespace {

using Shape = std::vector<Index>;
const std::string kPython = SVNET_FIXTURES "/io/python.safetensors";

template <class T>
std::vector<T> values(const SafetensorsTensor& tensor) {
  std::vector<T> result(tensor.bytes.size() / sizeof(T));
  if (!result.empty()) std::memcpy(result.data(), tensor.bytes.data(), tensor.bytes.size());
  return result;
}

template <class T>
std::span<const std::byte> bytes(const std::vector<T>& data) {
  return std::as_bytes(std::span(data));
}

std::string file_of(const std::string& json, const std::string& data, std::uint64_t length) {
  std::string file;
  for (int i = 0; i < 8; ++i) file += static_cast<char>(length >> (8 * i));
  return file + json + data;
}
std::string file_of(const std::string& json, const std::string& data = "") { return file_of(json, data, json.size()); }

std::string message_for(const std::string& contents) {
  const TemporaryFolder folder;
  const auto path = folder.write("t.safetensors", contents);
  try {
    SafetensorsFile file(path);
  } catch (const Error& error) {
    const std::string message = error.what();
    if (message.rfind(path.string() + ": ", 0) != 0 || message.find('\n') != std::string::npos)
      FAIL("not one line that names the file: " << message);
    return message.substr(path.string().size() + 2);
  }
  return "no error";
}

}  // namespace

TEST_CASE("a file of the Python package is read") {
  const SafetensorsFile file(kPython);
  CHECK(file.tensors().size() == 7);
  CHECK(file.metadata() == SafetensorsMetadata{{"note", "θ\t\"\\/"}});
  CHECK(file.at("weight").dtype == "F32");
  CHECK(file.at("weight").shape == Shape{2, 3});
  CHECK(values<float>(file.at("weight")) == std::vector<float>{0, 1, 2, 3, 4, 5});
  CHECK(values<double>(file.at("bias")) == std::vector<double>{0.5, -0.5});
  CHECK(file.at("half").dtype == "F16");
  CHECK(values<std::uint16_t>(file.at("half")) == std::vector<std::uint16_t>{0x3c00, 0x4000, 0x4200});
  CHECK(file.at("step").shape.empty());
  CHECK(values<std::uint64_t>(file.at("step")) == std::vector<std::uint64_t>{7});
  CHECK(file.at("none").shape == Shape{0, 4});
  CHECK(file.at("none").bytes.empty());
  CHECK(file.at("mask").dtype == "BOOL");
  CHECK(values<std::int64_t>(file.at("é \"quoted\"\n")) == std::vector<std::int64_t>{-1});
  CHECK(file.find("missing") == nullptr);
  CHECK_THROWS_WITH(file.at("weights"), kPython + ": holds no tensor 'weights', did you mean 'weight'?");
  CHECK_THROWS_WITH(file.at("gradients"), kPython + ": holds no tensor 'gradients'");
}

TEST_CASE("the bytes written are those of the Python package") {
  const TemporaryFolder folder;
  const SafetensorsFile python(kPython);
  std::vector<SafetensorsTensor> tensors = python.tensors();
  std::reverse(tensors.begin(), tensors.end());
  const auto path = folder.path() / "copy.safetensors";
  write_safetensors(path, tensors, python.metadata());
  CHECK(file_contents(path) == file_contents(kPython));
}

TEST_CASE("tensors written are read, aligned for their dtype") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.safetensors";
  const std::vector<std::uint16_t> odd{1, 2, 3};
  const std::vector<double> wide{0.25, -1};
  const std::vector<std::uint8_t> flags{1};
  const std::vector<SafetensorsTensor> tensors{
      {"flags", "U8", {1}, bytes(flags)}, {"odd", "BF16", {3}, bytes(odd)}, {"wide", "F64", {2, 1}, bytes(wide)}};
  write_safetensors(path, tensors, {{"b", "2"}, {"a", ""}});
  SafetensorsFile opened(path);
  const SafetensorsFile file = std::move(opened);
  CHECK(file.metadata() == SafetensorsMetadata{{"a", ""}, {"b", "2"}});
  REQUIRE(file.tensors().size() == 3);
  CHECK(file.tensors()[0].name == "wide");
  CHECK(file.tensors()[1].name == "odd");
  CHECK(values<double>(file.at("wide")) == wide);
  CHECK(values<std::uint16_t>(file.at("odd")) == odd);
  CHECK(reinterpret_cast<std::uintptr_t>(file.at("wide").bytes.data()) % 8 == 0);

  write_safetensors(path, {});
  CHECK(file_contents(path) == file_of("{}      "));
  CHECK(SafetensorsFile(path).tensors().empty());
  CHECK(values<double>(file.at("wide")) == wide);  // the replaced file stays mapped
}

TEST_CASE("a header without padding is read") {
  CHECK(message_for(file_of(R"({"a":{"shape":[1],"dtype":"U8","data_offsets":[0,1]}})", "x")) == "no error");
}

TEST_CASE("tensors that cannot be read again are not written") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "w.safetensors";
  const std::vector<float> two{1, 2};
  const auto message = [&](const std::vector<SafetensorsTensor>& tensors, const SafetensorsMetadata& metadata = {}) {
    try {
      write_safetensors(path, tensors, metadata);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  const SafetensorsTensor good{"a", "F32", {2}, bytes(two)};
  CHECK_THAT(message({good, good}), Contains("w.safetensors: tensor 'a': the name is taken"));
  CHECK_THAT(message({{"__metadata__", "F32", {2}, bytes(two)}}), Contains("'__metadata__': the name is taken"));
  CHECK_THAT(message({{"a", "F32", {3}, bytes(two)}}),
             Contains("tensor 'a': has 8 bytes, its dtype F32 and shape need 12"));
  CHECK_THAT(message({{"a", "F31", {2}, bytes(two)}}), Contains("tensor 'a': dtype 'F31' is not supported"));
  CHECK_THAT(message({{"a", "F32", {-2}, bytes(two)}}), Contains("tensor 'a': has a negative dimension, -2"));
  CHECK_THAT(message({{"\xff", "F32", {2}, bytes(two)}}), Contains("must be UTF-8"));
  CHECK_THAT(message({good}, {{"a", "\xff"}}), Contains("w.safetensors: the names of its tensors and its metadata"));
  CHECK_FALSE(std::filesystem::exists(path));
  CHECK_THROWS_WITH(write_safetensors(folder.path() / "no" / "a", std::span(&good, 1)), Contains("does not exist"));
}

TEST_CASE("files that are not safetensors are refused") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH(SafetensorsFile(folder.path() / "none"), Contains("none: cannot be read: No such file"));
  CHECK_THROWS_WITH(SafetensorsFile(folder.path()), Contains("is not a regular file"));
  CHECK(message_for("") == "has only 0 bytes; is it a safetensors file?");
  CHECK(message_for("1234567") == "has only 7 bytes; is it a safetensors file?");
  CHECK_THAT(message_for(std::string(8, '\xff')), Contains("declares a header of 18446744073709551615 bytes"));
  CHECK_THAT(message_for(file_of("{}", "", 3)), Contains("declares a header of 3 bytes in a file of 10"));
  CHECK_THAT(message_for(file_of("{}", "", UINT64_MAX)), Contains("declares a header of 18446744073709551615 bytes"));
  CHECK_THAT(message_for(file_of("")), Contains("header is not a JSON object"));
  CHECK_THAT(message_for(file_of(" {}")), Contains("header is not a JSON object"));
  CHECK_THAT(message_for(file_of("[]")), Contains("header is not a JSON object"));
  CHECK_THAT(message_for(file_of("{} x")), Contains("header is not JSON (at its byte 4)"));
  CHECK_THAT(message_for(file_of("{\"\xff\":1}")), Contains("header is not JSON"));
  CHECK(message_for(file_of(R"({"a":{"b":{"c":{"d":{}}}}})")) == "tensor 'a': its entry in the header has no dtype");
  CHECK(message_for(file_of(R"({"a":{"b":{"c":{"d":{"e":{}}}}}})")) == "header is nested too deeply");
  CHECK(message_for("\x89HDF\r\n\x1a\n" + std::string(8, '\0')) == "is not a safetensors file, but an HDF5 file");
  CHECK_THAT(message_for(file_of("{\"a\":" + std::string(100'000, '['))), Contains("header is nested too deeply"));
}

TEST_CASE("a header of more than 100 MB is refused") {
  const TemporaryFolder folder;
  const auto path = folder.write("large.safetensors", file_of("{}", "", 100'000'001));
  std::filesystem::resize_file(path, 100'001'000);  // sparse
  CHECK_THROWS_WITH(SafetensorsFile(path), Contains("declares a header of 100000001 bytes"));
}

TEST_CASE("headers that do not describe the data are refused by tensor") {
  const auto entry = [](const std::string& name, const std::string& dtype, const std::string& shape,
                        const std::string& offsets) {
    return "\"" + name + "\":{\"dtype\":\"" + dtype + "\",\"shape\":" + shape + ",\"data_offsets\":" + offsets + "}";
  };
  const auto message = [&](const std::string& inside, std::size_t data = 8) {
    return message_for(file_of("{" + inside + "}", std::string(data, 'x')));
  };
  const std::string a = entry("a", "F32", "[1]", "[0,4]"), b = entry("b", "F32", "[1]", "[4,8]");
  CHECK(message(a + "," + b) == "no error");
  CHECK_THAT(message(a + "," + a, 4), Contains("header has 'a' twice"));
  CHECK_THAT(message("\"a\":{\"dtype\":\"U8\",\"dtype\":\"U8\",\"shape\":[],\"data_offsets\":[0,1]}", 1),
             Contains("header has 'dtype' twice"));
  CHECK(message(a, 8) == "4 bytes at the end belong to no tensor");
  CHECK_THAT(message(a + "," + b, 7), Contains("tensor 'b': ends at byte 8 of the data, the file has 7"));
  CHECK(message(b) == "tensor 'b': 4 bytes before it belong to no tensor");
  CHECK(message(a + "," + entry("b", "F32", "[1]", "[2,6]"), 6) == "tensor 'b': overlaps the tensor before it");
  CHECK(message(a + "," + entry("b", "F32", "[1]", "[0,4]"), 4) == "tensor 'b': overlaps the tensor before it");
  CHECK_THAT(message(entry("a", "F32", "[3]", "[0,8]")),
             Contains("tensor 'a': has 8 bytes, its dtype F32 and shape need 12"));
  CHECK_THAT(message(entry("a", "F32", "[4611686018427387904,4611686018427387904]", "[0,8]")),
             Contains("tensor 'a': its shape is too large"));
  CHECK_THAT(message(entry("a", "F32", "[9223372036854775808]", "[0,8]")),
             Contains("shape holds something that is not a size"));
  CHECK_THAT(message(entry("a", "F32", "[-2]", "[0,8]")),
             Contains("tensor 'a': shape holds something that is not a size"));
  CHECK_THAT(message(entry("a", "F32", "[2.0]", "[0,8]")), Contains("shape holds something that is not a size"));
  CHECK_THAT(message(entry("a", "F32", "2", "[0,8]")), Contains("tensor 'a': shape is not a list"));
  CHECK_THAT(message(entry("a", "F32", "[2]", "[8,0]")), Contains("data_offsets are not a begin and an end"));
  CHECK_THAT(message(entry("a", "F32", "[2]", "[0,8,8]")), Contains("data_offsets are not a begin and an end"));
  CHECK_THAT(message(entry("a", "F33", "[2]", "[0,8]")), Contains("tensor 'a': dtype 'F33' is not supported"));
  CHECK_THAT(message("\"a\":1"), Contains("tensor 'a': its entry in the header is not an object"));
  CHECK_THAT(message("\"a\":{\"dtype\":\"U8\",\"shape\":[8]}"),
             Contains("tensor 'a': its entry in the header has no data_offsets"));
  CHECK_THAT(message("\"a\":{\"dtype\":1,\"shape\":[8],\"data_offsets\":[0,8]}"),
             Contains("tensor 'a': dtype is not a string"));
  CHECK_THAT(message("\"a\":{\"dtype\":\"U8\",\"shape\":[8],\"data_offsets\":[0,8],\"x\":0}"),
             Contains("has keys beside"));
  CHECK_THAT(message("\"__metadata__\":1,\"a\":1"), Contains("'__metadata__' in the header is not an object"));
  CHECK_THAT(message("\"__metadata__\":{\"n\":1},\"a\":1"), Contains("metadata 'n' is not a string"));
}

TEST_CASE("damaged safetensors files are read or refused") {
  const std::string good = file_contents(kPython);
  const auto size = static_cast<std::uint32_t>(good.size());
  RandomStream random(7, Stream::shuffle);
  int refused = 0;
  for (int i = 0; i < 2000; ++i) {
    std::string damaged = good;
    if (i % 4 == 0) {
      damaged.resize(random.below(size));
    } else {
      for (std::uint32_t change = 0, changes = 1 + random.below(4); change < changes; ++change)
        damaged[random.below(size)] ^= static_cast<char>(1 + random.below(255));
    }
    refused += message_for(damaged) != "no error";
  }
  CHECK(refused > 1500);
}
