#include "io/hdf5/hdf5_file.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "io/files/file_hash.h"
#include "sandbox/mode.h"
#include "temporary_folder.h"

using namespace svnet;
using namespace svnet::io;
using Catch::Contains;

namespace {

const std::string kH5py = SVNET_FIXTURES "/io/h5py.h5";
using Texts = std::vector<std::string>;
using Shape = std::vector<Index>;

template <class T>
void write(Hdf5File& file, const std::string& name, const Shape& shape, const std::vector<T>& values) {
  file.write<T>(name, shape, values);
}

void write_everything(const std::filesystem::path& path) {
  Hdf5File file = Hdf5File::create(path);
  write<float>(file, "group/inner/floats", {2, 3}, {1, -2, 0.5f, 1e30f, -0.0f, 6});
  write<double>(file, "doubles", {1}, {0.1});
  write<std::int64_t>(file, "group/integers", {2}, {-1, std::numeric_limits<std::int64_t>::max()});
  write<std::uint64_t>(file, "counts", {}, {std::numeric_limits<std::uint64_t>::max()});
  write<std::string>(file, "group/texts", {3}, {"90_90.png", "", "é中"});
  write<float>(file, "empty", {0, 4}, {});
  file.create_group("group/other");
  file.write_text_attribute("", "text", "θ");
  file.write_text_list_attribute("group", "list", Texts{"a", "bc"});
  file.write_text_list_attribute("group", "none", Texts{});
  file.write_number_attribute<double>("doubles", "unit", 2.5);
  file.write_number_attribute<std::uint64_t>("", "seed", 1ull << 63);
  file.write_number_attribute<std::int64_t>("", "problems", -3);
  file.close();
}

}  // namespace

TEST_CASE("values written to an HDF5 file are read back") {
  const TemporaryFolder folder;
  write_everything(folder.path() / "all.h5");
  const Hdf5File file = Hdf5File::open(folder.path() / "all.h5");
  const auto floats = file.read<float>("group/inner/floats");
  CHECK(floats.shape == Shape{2, 3});
  CHECK(floats.values == std::vector<float>{1, -2, 0.5f, 1e30f, -0.0f, 6});
  CHECK(std::signbit(floats.values[4]));
  CHECK(file.read<double>("doubles").values == std::vector<double>{0.1});
  CHECK(file.read<std::int64_t>("group/integers").values == std::vector<std::int64_t>{-1, INT64_MAX});
  CHECK(file.read<std::uint64_t>("counts").shape.empty());
  CHECK(file.read<std::uint64_t>("counts").values == std::vector<std::uint64_t>{UINT64_MAX});
  CHECK(file.read<std::string>("group/texts").values == Texts{"90_90.png", "", "é中"});
  CHECK(file.read<float>("empty").shape == Shape{0, 4});
  CHECK(file.shape("group/inner/floats") == Shape{2, 3});
  CHECK(file.text_attribute("", "text") == "θ");
  CHECK(file.text_list_attribute("group", "list") == Texts{"a", "bc"});
  CHECK(file.text_list_attribute("group", "none").empty());
  CHECK(file.number_attribute<double>("doubles", "unit") == 2.5);
  CHECK(file.number_attribute<std::uint64_t>("", "seed") == 1ull << 63);
  CHECK(file.number_attribute<std::int64_t>("", "problems") == -3);
  CHECK(file.members("group") == Texts{"inner", "integers", "other", "texts"});
  CHECK(file.has("group/inner"));
  CHECK(file.is_group("group/inner"));
  CHECK(file.is_group(""));
  CHECK_FALSE(file.is_group("doubles"));
  CHECK_FALSE(file.has("group/missing"));
  CHECK_FALSE(file.has("doubles/below"));
  CHECK(file.has_attribute("", "seed"));
  CHECK_FALSE(file.has_attribute("group", "seed"));
}

TEST_CASE("the same writes give the same HDF5 bytes") {
  const TemporaryFolder folder;
  write_everything(folder.path() / "a.h5");
  write_everything(folder.path() / "b.h5");
  CHECK(file_contents(folder.path() / "a.h5") == file_contents(folder.path() / "b.h5"));
  CHECK(file_sha256(folder.path() / "a.h5") == file_sha256(folder.path() / "b.h5"));
}

TEST_CASE("members are in natural order") {
  const TemporaryFolder folder;
  Hdf5File file = Hdf5File::create(folder.path() / "a.h5");
  for (const char* name : {"10", "2", "1"}) file.create_group(name);
  CHECK(file.members("") == Texts{"1", "2", "10"});
}

TEST_CASE("values that h5py wrote are read") {
  const Hdf5File file = Hdf5File::open(kH5py);
  const auto packed = file.read<float>("packed");  // gzip and shuffle; the last chunk is partial
  CHECK(packed.shape == Shape{100, 20});
  for (std::size_t i = 0; i < 2000; ++i) REQUIRE(packed.values[i] == static_cast<float>(i));
  CHECK(file.read<float>("float16").values == std::vector<float>{1, -0.5f, 0x1p-24f, 65504});
  CHECK(file.read<double>("scalar").shape.empty());
  CHECK(file.read<double>("scalar").values == std::vector<double>{2.5});
  CHECK(file.read<std::int64_t>("int8").values == std::vector<std::int64_t>{-128, 127});
  CHECK(file.read<std::int64_t>("uint16").values == std::vector<std::int64_t>{0, 65535});
  CHECK(file.read<std::uint64_t>("uint16").values == std::vector<std::uint64_t>{0, 65535});
  CHECK(file.read<std::int64_t>("int64").values == std::vector<std::int64_t>{-1, std::int64_t{1} << 62});
  CHECK(file.read<std::uint64_t>("uint64").values == std::vector<std::uint64_t>{0, UINT64_MAX});
  CHECK(file.read<double>("int8").values == std::vector<double>{-128, 127});
  CHECK(file.number_attribute<std::int64_t>("", "number") == 7);
  CHECK(file.number_attribute<double>("", "number") == 7);
}

TEST_CASE("strings that h5py wrote are read") {
  const Hdf5File file = Hdf5File::open(kH5py);
  CHECK(file.read<std::string>("variable").values == Texts{"comb/1/1/90_90.png", "", "é中👋"});
  CHECK(file.read<std::string>("fixed").values == Texts{"ab", "", "abcd"});
  CHECK(file.read<std::string>("space_padded").values == Texts{"a b", "abcd"});
  CHECK(file.text_attribute("", "text") == "θ");
  CHECK(file.text_attribute("", "bytes") == "plain");
  CHECK(file.text_attribute("", "one") == "single");
  CHECK(file.text_list_attribute("", "list") == Texts{"a", "bc"});
  CHECK(file.text_list_attribute("", "empty").empty());
  CHECK(file.text_list_attribute("", "nothing").empty());
}

TEST_CASE("a file is read the same without the sandbox") {
  const Hdf5File in_sandbox = Hdf5File::open(kH5py);
  sandbox::set_mode(sandbox::Mode::off);
  const Hdf5File here = Hdf5File::open(kH5py);
  sandbox::set_mode(sandbox::Mode::on);
  CHECK(here.members("") == in_sandbox.members(""));
  for (const char* name : {"packed", "float16", "scalar"})
    CHECK(here.read<float>(name).values == in_sandbox.read<float>(name).values);
  for (const char* name : {"int8", "uint16", "int64"})
    CHECK(here.read<std::int64_t>(name).values == in_sandbox.read<std::int64_t>(name).values);
  for (const char* name : {"variable", "fixed", "space_padded"})
    CHECK(here.read<std::string>(name).values == in_sandbox.read<std::string>(name).values);
  CHECK_THROWS_WITH(here.read<float>("int8"), kH5py + ": dataset 'int8': holds values of type int8, not floats");
}

TEST_CASE("large datasets arrive whole, whatever their shape") {
  const TemporaryFolder folder;
  const std::vector<Shape> shapes{{1'500'001},    {3, 500'001},          {500'001, 3},
                                  {7, 3, 71'429}, {2, 2, 2, 2, 100'003}, {1, 1, 1'000'003}};
  for (const Shape& shape : shapes) {
    std::size_t count = 1;
    for (const Index extent : shape) count *= static_cast<std::size_t>(extent);
    std::vector<double> values(count);
    for (std::size_t i = 0; i < count; ++i) values[i] = static_cast<double>(i);
    Hdf5File file = Hdf5File::create(folder.path() / "large.h5");
    file.write<double>("x", shape, values);
    file.close();
    const auto read = Hdf5File::open(folder.path() / "large.h5").read<double>("x");
    CHECK(read.shape == shape);
    CHECK((read.values == values));
  }
  const std::string long_text(3'000'000, 'x');
  Hdf5File file = Hdf5File::create(folder.path() / "texts.h5");
  file.write<std::string>("x", {3}, Texts{"a", long_text, "b"});
  file.close();
  CHECK((Hdf5File::open(folder.path() / "texts.h5").read<std::string>("x").values == Texts{"a", long_text, "b"}));
}

TEST_CASE("values of another type are refused, numbers out of range too") {
  const Hdf5File file = Hdf5File::open(kH5py);
  CHECK_THROWS_WITH(file.read<float>("int8"), kH5py + ": dataset 'int8': holds values of type int8, not floats");
  CHECK_THROWS_WITH(file.read<double>("variable"), Contains("'variable': holds values of type string, not floats"));
  CHECK_THROWS_WITH(file.read<std::int64_t>("scalar"), Contains("holds values of type float64, not integers"));
  CHECK_THROWS_WITH(file.read<std::int64_t>("bool"), Contains("holds values of type enumeration, not integers"));
  CHECK_THROWS_WITH(file.read<std::string>("int8"), Contains("holds values of type int8, not strings"));
  CHECK_THROWS_WITH(file.read<std::uint64_t>("int64"), Contains("'int64': holds -1, which is out of range"));
  CHECK_THROWS_WITH(file.read<std::int64_t>("uint64"), Contains("holds 18446744073709551615, which is out of range"));
  CHECK_THROWS_WITH(file.text_attribute("", "number"), Contains("attribute 'number': holds values of type int64"));
  CHECK_THROWS_WITH(file.text_attribute("", "list"), Contains("attribute 'list': holds 2 values, expected one"));
  CHECK_THROWS_WITH(file.number_attribute<double>("", "empty"), Contains("holds 0 values, expected one"));
}

TEST_CASE("missing objects are named") {
  const Hdf5File file = Hdf5File::open(kH5py);
  CHECK_THROWS_WITH(file.read<float>("a/b"), kH5py + ": 'a/b': is missing");
  CHECK_THROWS_WITH(file.read<float>("packed/b"), kH5py + ": 'packed/b': is missing");
  CHECK_THROWS_WITH(file.read<float>(""), kH5py + ": its root: is not a dataset");
  CHECK_THROWS_WITH(file.members("packed"), kH5py + ": 'packed': is not a group");
  CHECK_THROWS_WITH(file.text_attribute("packed", "x"), kH5py + ": attribute 'x' of 'packed': is missing");
}

TEST_CASE("files that are not HDF5 are refused") {
  const TemporaryFolder folder;
  const std::string missing = (folder.path() / "missing.h5").string();
  CHECK_THROWS_WITH(Hdf5File::open(missing), missing + ": no such file");
  CHECK_THROWS_WITH(Hdf5File::open(folder.path()),
                    folder.path().string() + ": is a folder, such as TensorFlow's SavedModel; expected an HDF5 file");
  for (const char* contents : {"", "PK\3\4 something else"})
    CHECK_THROWS_WITH(Hdf5File::open(folder.write("other.h5", contents)), Contains("other.h5: is not an HDF5 file"));
}

TEST_CASE("a truncated HDF5 file is refused") {
  const TemporaryFolder folder;
  const std::string whole = file_contents(kH5py);
  const auto path = folder.write("cut.h5", whole.substr(0, whole.size() / 2));
  CHECK_THROWS_WITH(Hdf5File::open(path),
                    Contains("cut.h5: damaged or incomplete HDF5 file: ") && Contains("truncated file"));
}

TEST_CASE("text that is not plain UTF-8 is not written") {
  const TemporaryFolder folder;
  Hdf5File file = Hdf5File::create(folder.path() / "a.h5", "the file");
  const Texts bad{"\xff",  "\xc3",         "\xc0\x80",         "\xed\xa0\x80", "\xe0\x80\x80", "\xf4\x90\x80\x80",
                  "a\x80", "\xf0\x80\x80", "\xf5\x80\x80\x80", "\xc3(",        "\xe4\xb8",     std::string("a\0b", 3)};
  for (const std::string& text : bad) {
    CAPTURE(text);
    CHECK_THROWS_WITH(file.write_text_attribute("", "x", text),
                      Contains("the file: attribute 'x'") && Contains("UTF-8"));
    CHECK_THROWS_WITH(file.write<std::string>("d", {1}, std::span(&text, 1)), Contains("the file: dataset 'd'"));
  }
  for (const char* text : {"\x7f", "\xc2\x80", "\xdf\xbf", "\xe0\xa0\x80", "\xed\x9f\xbf", "\xef\xbf\xbf",
                           "\xf0\x90\x80\x80", "\xf4\x8f\xbf\xbf"})
    file.write_text_attribute("", text, text);
  file.close();
  CHECK(Hdf5File::open(folder.path() / "a.h5").text_attribute("", "\xf4\x8f\xbf\xbf") == "\xf4\x8f\xbf\xbf");
}

TEST_CASE("values that cannot be written are an error") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH(Hdf5File::create(folder.path() / "no" / "a.h5"), Contains("no/a.h5: cannot be written: "));
  Hdf5File file = Hdf5File::create(folder.path() / "a.h5", "the file");
  file.write<double>("x", {1}, std::vector<double>{1});
  CHECK_THROWS_WITH(file.write<double>("x", {1}, std::vector<double>{1}),
                    Contains("the file: dataset 'x': cannot be written: "));
  CHECK_THROWS_WITH(file.write<double>("y", {2}, std::vector<double>{1}), Contains("1 values given for a shape of 2"));
  CHECK_THROWS_WITH(file.create_group("x/y"), Contains("the file: group 'x': cannot be written"));
}
