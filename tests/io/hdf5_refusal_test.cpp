// Files that the HDF5 library reads and Hdf5File must refuse, made with the C interface of HDF5.
#include <array>
#include <catch2/catch.hpp>
#include <cstdlib>

#include <hdf5.h>
#include <unistd.h>

#include "base/error.h"
#include "io/hdf5/hdf5_file.h"
#include "temporary_folder.h"

using namespace svnet;
using namespace svnet::io;
using Catch::Contains;

namespace {

/// A file that is written through the C interface. Identifiers are closed with the file.
class RawFile {
 public:
  explicit RawFile(const std::filesystem::path& path) {
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
    id_ = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
    H5Pclose(access);
    REQUIRE(id_ >= 0);
  }
  ~RawFile() { H5Fclose(id_); }
  hid_t id() const { return id_; }

  hid_t dataset(const char* name, std::vector<hsize_t> dims, hid_t type, hid_t creation = H5P_DEFAULT) const {
    const hid_t space = H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr);
    const hid_t made = H5Dcreate2(id_, name, type, space, H5P_DEFAULT, creation, H5P_DEFAULT);
    REQUIRE(made >= 0);
    return made;
  }
  /// Two values, all of whose bytes are 0.
  void zeros(const char* name, hid_t type) const {
    const std::array<std::byte, 256> values{};
    REQUIRE(2 * H5Tget_size(type) <= values.size());
    REQUIRE(H5Dwrite(dataset(name, {2}, type), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0);
  }
  void texts(const char* name, hid_t type, const void* values, hsize_t count) const {
    REQUIRE(H5Dwrite(dataset(name, {count}, type), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0);
  }
  void floats(const char* name, hid_t creation = H5P_DEFAULT) const {
    const std::array<float, 64> values{};
    REQUIRE(H5Dwrite(dataset(name, {64}, H5T_IEEE_F32LE, creation), H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT,
                     values.data()) >= 0);
  }

 private:
  hid_t id_;
};

/// Strings of `size` bytes, or of any length.
hid_t text_type(std::size_t size = H5T_VARIABLE) {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, size);
  return type;
}

hid_t integer_of(std::size_t bytes, std::size_t bits, std::size_t offset = 0) {
  const hid_t type = H5Tcopy(H5T_STD_I8LE);
  H5Tset_size(type, bytes);
  H5Tset_precision(type, bits);
  H5Tset_offset(type, offset);
  return type;
}

/// A float like `like` whose exponent has another bias.
hid_t biased(hid_t like) {
  const hid_t type = H5Tcopy(like);
  H5Tset_ebias(type, 1);
  return type;
}

hid_t chunked(hsize_t chunk) {
  const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_chunk(creation, 1, &chunk);
  return creation;
}

}  // namespace

TEST_CASE("links are not followed, except hard ones") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "links.h5";
  {
    const RawFile other(folder.path() / "other.h5");
    other.floats("x");
  }
  {
    const RawFile file(path);
    file.floats("x");
    H5Lcreate_hard(file.id(), "x", file.id(), "hard", H5P_DEFAULT, H5P_DEFAULT);
    H5Lcreate_soft("/x", file.id(), "soft", H5P_DEFAULT, H5P_DEFAULT);
    H5Lcreate_external("other.h5", "/x", file.id(), "external", H5P_DEFAULT, H5P_DEFAULT);
    H5Lcreate_external("other.h5", "/", file.id(), "folder", H5P_DEFAULT, H5P_DEFAULT);
  }
  const Hdf5File file = Hdf5File::open(path);
  CHECK(file.read<float>("hard").values.size() == 64);
  for (const char* name : {"soft", "external", "folder", "folder/x"})
    CHECK_THROWS_WITH(file.read<float>(name),
                      Contains("'" + std::string(name) + "'") && Contains("reached through a soft or external link"));
}

TEST_CASE("values outside the file are not read") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "outside.h5";
  folder.write("secret", std::string(256, 'x'));
  {
    const RawFile file(path);
    const hid_t external = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_external(external, (folder.path() / "secret").c_str(), 0, 256);
    file.dataset("external", {64}, H5T_IEEE_F32LE, external);
    file.floats("x");
    const hsize_t size = 64;
    const hid_t space = H5Screate_simple(1, &size, nullptr), virtuals = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_virtual(virtuals, space, ".", "/x", space);
    file.dataset("virtual", {64}, H5T_IEEE_F32LE, virtuals);
  }
  const Hdf5File file = Hdf5File::open(path);
  CHECK_THROWS_WITH(file.read<float>("external"), Contains("dataset 'external': has its values in another file"));
  CHECK_THROWS_WITH(file.read<float>("virtual"), Contains("dataset 'virtual': is a virtual dataset"));
}

TEST_CASE("filters other than gzip and shuffle are refused") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "filters.h5";
  {
    const RawFile file(path);
    const hid_t checksum = chunked(16), scale = chunked(16), fine = chunked(16);
    H5Pset_fletcher32(checksum);
    H5Pset_scaleoffset(scale, H5Z_SO_FLOAT_DSCALE, 2);
    H5Pset_shuffle(fine);
    H5Pset_deflate(fine, 9);
    file.floats("checksum", checksum);
    file.floats("scale", scale);
    file.floats("fine", fine);
  }
  const Hdf5File file = Hdf5File::open(path);
  CHECK(file.read<float>("fine").values == std::vector<float>(64));
  CHECK_THROWS_WITH(file.read<float>("checksum"), Contains("filter number 3, which is not supported"));
  CHECK_THROWS_WITH(file.read<float>("scale"), Contains("filter number 6, which is not supported"));
}

TEST_CASE("sizes that the file cannot hold are refused before memory is taken") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "sizes.h5";
  {
    const RawFile file(path);
    const hsize_t huge = hsize_t{1} << 40;
    file.dataset("huge", {huge}, H5T_IEEE_F32LE);
    file.dataset("product", {huge >> 8, huge >> 8, huge >> 8}, H5T_IEEE_F32LE);
    file.dataset("never_written", {1 << 20}, H5T_IEEE_F32LE);
    file.dataset("chunks", {1 << 20}, H5T_IEEE_F32LE, chunked(16));
    const hid_t gzip = chunked(1 << 28);
    H5Pset_deflate(gzip, 9);
    file.dataset("large_chunk", {1 << 28}, H5T_IEEE_F32LE, gzip);
    const hid_t text = H5Tcopy(H5T_C_S1);
    H5Tset_size(text, std::size_t{1} << 30);
    file.dataset("long_text", {100}, text);
  }
  const Hdf5File file = Hdf5File::open(path);
  CHECK_THROWS_WITH(file.read<float>("huge"), Contains("dataset 'huge': declares a dimension of 1099511627776"));
  CHECK_THROWS_WITH(file.read<float>("product"), Contains("dataset 'product': declares more than"));
  CHECK_THROWS_WITH(file.read<float>("never_written"), Contains("declares 4194304 bytes but only 0 are stored"));
  CHECK_THROWS_WITH(file.read<float>("chunks"), Contains("declares 4194304 bytes but only 0 are stored"));
  CHECK_THROWS_WITH(file.read<float>("large_chunk"), Contains("declares chunks that a file of"));
  CHECK_THROWS_WITH(file.read<std::string>("long_text"), Contains("declares 100 values of 1073741824 bytes"));
}

TEST_CASE("a small file is not decoded to very many values") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "bomb.h5";
  std::vector<float> values(std::size_t{5} << 20);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i % 251);
  {
    const RawFile file(path);
    const hid_t gzip = chunked(1 << 16);
    H5Pset_deflate(gzip, 9);
    REQUIRE(H5Dwrite(file.dataset("bomb", {values.size()}, H5T_IEEE_F32LE, gzip), H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL,
                     H5P_DEFAULT, values.data()) >= 0);
  }
  CHECK_THROWS_WITH(Hdf5File::open(path).read<float>("bomb"),
                    path.string() + joined(": dataset 'bomb': declares 20971520 bytes, more than the limit of 16777216 "
                                           "for what a file of ",
                                           std::filesystem::file_size(path), " bytes is decoded to"));
}

TEST_CASE("many rows that share one long string are refused") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "shared.h5";
  constexpr hsize_t kRows = 1000;
  {
    const RawFile file(path);
    const hid_t text = H5Tcopy(H5T_C_S1);
    H5Tset_size(text, H5T_VARIABLE);
    const std::string first(100'000, 'x'), other = "another";
    std::vector<const char*> values(kRows, other.c_str());
    values[0] = first.c_str();
    H5Dwrite(file.dataset("texts", {kRows}, text), text, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  }
  CHECK(Hdf5File::open(path).read<std::string>("texts").values[999] == "another");
  // A row is 16 bytes: length, address of the heap, index in the heap. All rows become the first.
  std::string bytes = file_contents(path);
  const std::string length("\xa0\x86\x01\x00", 4);
  const std::size_t row = bytes.find(length);
  REQUIRE(row != std::string::npos);
  for (std::size_t i = 1; i < kRows; ++i) bytes.replace(row + 16 * i, 16, bytes.substr(row, 16));
  const Hdf5File shared = Hdf5File::open(folder.write("shared.h5", bytes));
  CHECK_THROWS_WITH(shared.read<std::string>("texts"),
                    Contains("shared.h5: dataset 'texts': its strings are longer than the file"));
}

TEST_CASE("compound types are refused, and objects that have them are named") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "compound.h5";
  {
    const RawFile file(path);
    const hid_t pair = H5Tcreate(H5T_COMPOUND, 16);
    H5Tinsert(pair, "x", 0, H5T_NATIVE_DOUBLE);
    H5Tinsert(pair, "y", 8, H5T_NATIVE_DOUBLE);
    const std::array<double, 4> values{};
    H5Dwrite(file.dataset("pairs", {2}, pair), pair, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    file.floats("floats");
  }
  const Hdf5File file = Hdf5File::open(path);
  CHECK(file.read<float>("floats").values.size() == 64);
  CHECK_THROWS_WITH(file.read<float>("pairs"),
                    Contains("compound.h5: dataset 'pairs': holds values of type compound, not floats"));
}

TEST_CASE("types that svnet does not read are named") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "types.h5";
  const hsize_t three = 3;
  const int value = 1;
  const hid_t choice = H5Tenum_create(H5T_NATIVE_INT);
  H5Tenum_insert(choice, "one", &value);
  const std::vector<std::pair<hid_t, std::string>> types{{choice, "enumeration"},
                                                         {H5T_STD_B16LE, "bit field"},
                                                         {H5Tcreate(H5T_OPAQUE, 4), "opaque"},
                                                         {H5T_STD_REF_OBJ, "reference"},
                                                         {H5T_UNIX_D32LE, "unknown type"},
                                                         {H5Tvlen_create(H5T_NATIVE_FLOAT), "variable-length sequence"},
                                                         {H5Tarray_create2(H5T_NATIVE_FLOAT, 1, &three), "array"},
                                                         {integer_of(2, 7), "integer of unusual layout"},
                                                         {integer_of(2, 8, 3), "integer of unusual layout"},
                                                         {integer_of(3, 24), "integer of unusual layout"},
                                                         {biased(H5T_IEEE_F32LE), "float of unusual layout"},
                                                         {biased(H5T_IEEE_F64BE), "float of unusual layout"},
                                                         {H5T_NATIVE_LDOUBLE, "float of unusual layout"},
                                                         {text_type(4), "string"}};
  {
    const RawFile file(path);
    for (std::size_t i = 0; i < types.size(); ++i) file.zeros(joined("x", i).c_str(), types[i].first);
  }
  const Hdf5File file = Hdf5File::open(path);
  for (std::size_t i = 0; i < types.size(); ++i) {
    const std::string name = joined("x", i),
                      start = path.string() + ": dataset '" + name + "': holds values of type " + types[i].second;
    CHECK_THROWS_WITH(file.read<float>(name), start + ", not floats");
    CHECK_THROWS_WITH(file.read<std::int64_t>(name), start + ", not integers");
    if (types[i].second != "string") CHECK_THROWS_WITH(file.read<std::string>(name), start + ", not strings");
  }
}

TEST_CASE("numbers of either byte order and all usual sizes are read") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "numbers.h5";
  const std::vector<hid_t> floats{H5T_IEEE_F32LE, H5T_IEEE_F32BE, H5T_IEEE_F64LE, H5T_IEEE_F64BE},
      integers{H5T_STD_I8LE,  H5T_STD_I8BE,  H5T_STD_U8LE,  H5T_STD_I16LE, H5T_STD_U16BE,
               H5T_STD_I32BE, H5T_STD_U32LE, H5T_STD_I64LE, H5T_STD_U64BE};
  const std::array<double, 2> values{1, 100};
  {
    const RawFile file(path);
    std::size_t i = 0;
    for (const auto& types : {floats, integers})
      for (const hid_t type : types)
        REQUIRE(H5Dwrite(file.dataset(joined("x", i++).c_str(), {2}, type), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL,
                         H5P_DEFAULT, values.data()) >= 0);
  }
  const Hdf5File file = Hdf5File::open(path);
  for (std::size_t i = 0; i < floats.size(); ++i)
    CHECK(file.read<float>(joined("x", i)).values == std::vector<float>{1, 100});
  for (std::size_t i = floats.size(); i < floats.size() + integers.size(); ++i) {
    CHECK(file.read<std::int64_t>(joined("x", i)).values == std::vector<std::int64_t>{1, 100});
    CHECK(file.read<std::uint64_t>(joined("x", i)).values == std::vector<std::uint64_t>{1, 100});
    CHECK(file.read<double>(joined("x", i)).values == std::vector<double>{1, 100});
  }
}

TEST_CASE("strings that are too long, or not UTF-8, are refused with their number, and missing ones are empty") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "texts.h5";
  constexpr std::size_t kLimit = std::size_t{1} << 26;
  {
    const RawFile file(path);
    const std::array<const char*, 3> texts{"a", nullptr, "b"}, latin{"a", "caf\xe9", "b"};
    file.texts("missing", text_type(), texts.data(), texts.size());
    file.texts("latin", text_type(), latin.data(), latin.size());
    file.texts("fixed", text_type(2), "ab\xe9\xe9", 2);
    const hid_t spaces = text_type(4);
    H5Tset_strpad(spaces, H5T_STR_SPACEPAD);
    file.texts("spaces", spaces, "a   bcd     ", 3);
    file.texts("long", text_type(kLimit + 1), std::string(kLimit + 1, 'x').data(), 1);
    file.dataset("none", {0}, H5T_IEEE_F32LE);
  }
  const Hdf5File file = Hdf5File::open(path);
  const std::string start = path.string() + ": dataset '";
  CHECK(file.read<std::string>("missing").values == std::vector<std::string>{"a", "", "b"});
  CHECK(file.read<std::string>("spaces").values == std::vector<std::string>{"a", "bcd", ""});
  CHECK(file.read<std::string>("none").values.empty());
  CHECK_THROWS_WITH(file.read<std::string>("latin"), start + "latin': string 1 is not UTF-8");
  CHECK_THROWS_WITH(file.read<std::string>("fixed"), start + "fixed': string 1 is not UTF-8");
  CHECK_THROWS_WITH(file.read<std::string>("long"),
                    start + "long': string 0 has 67108865 bytes, more than the limit of 67108864");
}

TEST_CASE("a large dataset in chunks, many strings and many members arrive whole") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "large.h5";
  std::vector<float> values(std::size_t{1} << 19);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i);
  std::vector<std::string> texts;
  for (int i = 0; i < 5000; ++i) texts.push_back(joined("text ", i));
  constexpr int kMembers = 4400;
  const std::string long_name(250, 'x');
  {
    const RawFile file(path);
    const hid_t in_chunks = file.dataset("chunks", {values.size()}, H5T_IEEE_F32LE, chunked(1 << 12));
    REQUIRE(H5Dwrite(in_chunks, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0);
    std::vector<const char*> pointers;
    for (const std::string& text : texts) pointers.push_back(text.c_str());
    file.texts("texts", text_type(), pointers.data(), pointers.size());
    const hid_t group = H5Gcreate2(file.id(), "group", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    for (int i = 0; i < kMembers; ++i)
      H5Lcreate_hard(file.id(), "chunks", group, joined(long_name, i).c_str(), H5P_DEFAULT, H5P_DEFAULT);
  }
  const Hdf5File file = Hdf5File::open(path);
  CHECK(file.read<float>("chunks").values == values);
  CHECK(file.read<double>("chunks").values.back() == static_cast<double>(values.back()));
  CHECK(file.read<std::string>("texts").values == texts);
  const std::vector<std::string> members = file.members("group");
  REQUIRE(members.size() == kMembers);
  CHECK(members.front() == long_name + "0");
  CHECK(members.back() == joined(long_name, kMembers - 1));
}

TEST_CASE("an HDF5 file may begin after a block of the user") {
  const TemporaryFolder folder;
  for (const hsize_t block : {512, 2048}) {
    const auto path = folder.path() / "block.h5";
    const hid_t creation = H5Pcreate(H5P_FILE_CREATE);
    H5Pset_userblock(creation, block);
    H5Fclose(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, H5P_DEFAULT));
    CHECK(Hdf5File::open(path).members("").empty());
  }
  const auto text = folder.write("text.h5", std::string(3000, 'x'));
  CHECK_THROWS_WITH(Hdf5File::open(text), text.string() + ": is not an HDF5 file");
}

TEST_CASE("an attribute that declares more than its header holds is refused") {
  const TemporaryFolder folder;
  std::string bytes = file_contents(SVNET_FIXTURES "/io/keras2_split.h5");
  // Dataspace of rank 1 (version 1) with 2 values, as the message of weight_names of fc1 has it.
  const std::size_t name = bytes.find("weight_names\0", bytes.find("fc1/kernel:0") - 200);
  REQUIRE(name != std::string::npos);
  const std::size_t values = bytes.find("fc1/kernel:0", name);
  REQUIRE(values - name < 100);
  const std::size_t count = bytes.find(std::string("\2\0\0\0\0\0\0\0", 8), name);
  REQUIRE(count < values);
  bytes[count] = 100;
  CHECK_THROWS_WITH(Hdf5File::open(folder.write("damaged.h5", bytes)).text_list_attribute("fc1", "weight_names"),
                    Contains("damaged.h5: ") && Contains("'fc1'"));
}

TEST_CASE("HDF5 prints nothing, and its error printing is restored") {
  H5E_auto2_t before = nullptr, after = nullptr;
  void *before_data = nullptr, *after_data = nullptr;
  H5Eget_auto2(H5E_DEFAULT, &before, &before_data);
  REQUIRE(before != nullptr);
  const TemporaryFolder folder;
  const auto log = folder.path() / "stderr";
  const int saved = ::dup(2);
  REQUIRE(std::freopen(log.c_str(), "w", stderr));
  std::string message;
  try {
    Hdf5File::create(folder.path()).close();
  } catch (const Error& error) {
    message = error.what();
  }
  std::fflush(stderr);
  ::dup2(saved, 2);
  ::close(saved);
  CHECK_THAT(message, Contains("cannot be written: "));
  CHECK(file_contents(log).empty());
  H5Eget_auto2(H5E_DEFAULT, &after, &after_data);
  CHECK(before == after);
}

TEST_CASE("plug-ins are not loaded") {
  Hdf5File::open(SVNET_FIXTURES "/io/h5py.h5");
  unsigned state = 1;
  REQUIRE(H5PLget_loading_state(&state) >= 0);
  CHECK(state == 0);
}
