// HDF5 files that the library opens and that lead it, or its caller, astray; and files whose structures lie.
#include <cstring>
#include <fstream>
#include <functional>

#include "attacks.h"
#include "raw_hdf5.h"
#include "temporary_folder.h"

namespace svnet::attacks {
namespace {

namespace fs = std::filesystem;

std::string packed(std::uint64_t number, std::size_t bytes = 8) {
  std::string text;
  for (std::size_t i = 0; i < bytes; ++i) text += static_cast<char>(number >> 8 * i & 255);
  return text;
}

/// `bytes` with `patch` at `offset` behind the first `mark`.
std::string patched(std::string bytes, const std::string& mark, std::size_t offset, const std::string& patch) {
  const std::size_t at = bytes.find(mark);
  if (at == std::string::npos) throw std::runtime_error("no " + mark + " to patch");
  return bytes.replace(at + offset, patch.size(), patch);
}

class Corpus {
 public:
  explicit Corpus(fs::path folder) : folder_(std::move(folder)) { fs::create_directories(folder_); }

  fs::path path(const std::string& name) const { return folder_ / (name + ".h5"); }

  /// `fill` writes the file.
  void add(const std::string& name, const std::function<void(const RawHdf5&)>& fill, hid_t creation = H5P_DEFAULT) {
    {
      const RawHdf5 file(path(name), creation);
      fill(file);
    }
    note(name);
  }
  void add_bytes(const std::string& name, const std::string& bytes) {
    std::ofstream(path(name), std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    note(name);
  }
  std::vector<Attack> attacks() && { return std::move(attacks_); }

 private:
  void note(const std::string& name) { attacks_.push_back({name, path(name), fs::file_size(path(name))}); }

  fs::path folder_;
  std::vector<Attack> attacks_{};
};

/// The bytes of a good file of weights.
std::string good_bytes(const fs::path& folder, const std::function<void(const RawHdf5&)>& fill) {
  {
    const RawHdf5 file(folder / "good.h5");
    fill(file);
  }
  std::string bytes = file_contents(folder / "good.h5");
  fs::remove(folder / "good.h5");
  return bytes;
}

void add_links(Corpus& corpus) {
  corpus.add("external_link_to_a_file", [](const RawHdf5& file) {
    file.layer();
    H5Lcreate_external("/etc/passwd", "/x", file.id(), RawHdf5::kKernel, H5P_DEFAULT, H5P_DEFAULT);
  });
  corpus.add("external_link_to_itself", [](const RawHdf5& file) {
    file.layer();
    H5Lcreate_external("external_link_to_itself.h5", RawHdf5::kKernel, file.id(), RawHdf5::kKernel, H5P_DEFAULT,
                       H5P_DEFAULT);
  });
  corpus.add("soft_link_to_itself", [](const RawHdf5& file) {
    file.layer();
    H5Lcreate_soft("/dense/dense/kernel:0", file.id(), RawHdf5::kKernel, H5P_DEFAULT, H5P_DEFAULT);
  });
  corpus.add("soft_links_in_a_circle", [](const RawHdf5& file) {
    file.texts("/", "layer_names", {"dense"});
    H5Lcreate_soft("/other", file.id(), "dense", H5P_DEFAULT, H5P_DEFAULT);
    H5Lcreate_soft("/dense", file.id(), "other", H5P_DEFAULT, H5P_DEFAULT);
  });
  corpus.add("groups_in_a_circle", [](const RawHdf5& file) {
    file.group("layers");
    H5Lcreate_hard(file.id(), "layers", file.id(), "layers/again", H5P_DEFAULT, H5P_DEFAULT);
  });
  corpus.add("groups_that_branch_in_circles", [](const RawHdf5& file) {
    file.group("layers");
    for (const char* name : {"layers/a", "layers/b", "layers/c", "layers/d"})
      H5Lcreate_hard(file.id(), "layers", file.id(), name, H5P_DEFAULT, H5P_DEFAULT);
  });
  corpus.add("a_thousand_nested_groups", [](const RawHdf5& file) {
    std::string path = "layers";
    file.group(path.c_str());
    for (int i = 0; i < 1000; ++i) file.group((path += "/a").c_str());
  });
  corpus.add("a_name_that_climbs", [](const RawHdf5& file) { file.texts("/", "layer_names", {"../../etc/passwd"}); });
}

void add_other_places(Corpus& corpus) {
  corpus.add("values_in_another_file", [](const RawHdf5& file) {
    file.layer();
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_external(creation, "/etc/passwd", 0, 256);
    file.kernel({64}, H5T_IEEE_F32LE, creation);
  });
  corpus.add("values_in_endless_zeros", [](const RawHdf5& file) {
    file.layer();
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_external(creation, "/dev/zero", 0, H5F_UNLIMITED);
    file.kernel({hsize_t{1} << 30}, H5T_IEEE_F32LE, creation);
  });
  for (const auto& [name, source] :
       {std::pair("virtual_dataset_of_another_file", "/etc/passwd"), std::pair("virtual_dataset_of_itself", ".")})
    corpus.add(name, [source = source](const RawHdf5& file) {
      file.layer();
      const hsize_t size = 64;
      const hid_t space = H5Screate_simple(1, &size, nullptr), creation = H5Pcreate(H5P_DATASET_CREATE);
      H5Pset_virtual(creation, space, source, "/dense/dense/kernel:0", space);
      file.kernel({64}, H5T_IEEE_F32LE, creation);
    });
}

void add_sizes(Corpus& corpus) {
  const auto sized = [&](const char* name, const std::vector<hsize_t>& dims, hid_t type = H5T_IEEE_F32LE) {
    corpus.add(name, [&](const RawHdf5& file) {
      file.layer();
      file.kernel(dims, type);
    });
  };
  sized("a_dimension_of_2_to_the_60", {hsize_t{1} << 60});
  sized("a_product_that_overflows", {hsize_t{1} << 33, hsize_t{1} << 33, hsize_t{1} << 10});
  sized("a_product_of_nothing_after_overflow", std::vector<hsize_t>(32, 4));
  sized("a_terabyte_that_is_not_there", {hsize_t{1} << 34, 16});
  const hid_t opaque = H5Tcreate(H5T_OPAQUE, std::size_t{1} << 30), text = H5Tcopy(H5T_C_S1);
  H5Tset_size(text, std::size_t{1} << 31);
  sized("elements_of_a_gigabyte", {1000}, opaque);
  sized("strings_of_two_gigabytes", {1000}, text);

  corpus.add("gzip_bomb", [](const RawHdf5& file) {
    file.layer();
    constexpr hsize_t kChunk = 1 << 20, kChunks = 128;
    const hid_t creation = RawHdf5::chunked(kChunk);
    H5Pset_deflate(creation, 9);
    const hid_t kernel = file.kernel({kChunk * kChunks}, H5T_IEEE_F32LE, creation);
    const std::vector<float> zeros(kChunk);
    const hid_t memory = H5Screate_simple(1, &kChunk, nullptr), space = H5Dget_space(kernel);
    for (hsize_t i = 0; i < kChunks; ++i) {
      const hsize_t start = i * kChunk;
      H5Sselect_hyperslab(space, H5S_SELECT_SET, &start, nullptr, &kChunk, nullptr);
      H5Dwrite(kernel, H5T_NATIVE_FLOAT, memory, space, H5P_DEFAULT, zeros.data());
    }
  });
  corpus.add("gzip_bomb_twice_packed", [](const RawHdf5& file) {
    file.layer();
    constexpr hsize_t kChunk = 1 << 24;
    const hid_t creation = RawHdf5::chunked(kChunk);
    H5Pset_deflate(creation, 9);
    H5Pset_deflate(creation, 9);
    const std::vector<float> zeros(kChunk);
    H5Dwrite(file.kernel({kChunk}, H5T_IEEE_F32LE, creation), H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT,
             zeros.data());
  });
  corpus.add("one_chunk_of_four_gigabytes", [](const RawHdf5& file) {
    file.layer();
    const hid_t creation = RawHdf5::chunked((hsize_t{1} << 30) - 1);
    H5Pset_deflate(creation, 9);
    file.kernel({hsize_t{1} << 30}, H5T_IEEE_F32LE, creation);
  });
  corpus.add("a_hundred_million_chunks", [](const RawHdf5& file) {
    file.layer();
    file.kernel({100'000'000}, H5T_IEEE_F32LE, RawHdf5::chunked(1));
  });
}

void add_types(Corpus& corpus) {
  const auto typed = [&](const char* name, hid_t type) {
    // As features, whose values are read.
    corpus.add(name, [&](const RawHdf5& file) {
      for (const char* text :
           {"backbone", "output", "preprocessing", "weights_sha256", "dataset_fingerprint", "input_fingerprint"}) {
        const hid_t space = H5Screate(H5S_SCALAR), string = RawHdf5::variable_text();
        const char* value = "x";
        H5Awrite(H5Acreate2(file.id(), text, string, space, H5P_DEFAULT, H5P_DEFAULT), string, &value);
      }
      file.texts("/", "unused", {"x"});
      const std::vector<char> values(H5Tget_size(type) * 4);
      H5Dwrite(file.dataset("features", {2, 2}, type), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
      file.dataset("paths", {2}, RawHdf5::variable_text());
    });
  };
  const hid_t compound = H5Tcreate(H5T_COMPOUND, 16);
  H5Tinsert(compound, "x", 0, H5T_NATIVE_DOUBLE);
  H5Tinsert(compound, "y", 8, H5T_NATIVE_DOUBLE);
  hid_t nested = compound;
  for (int i = 0; i < 100; ++i) {
    const hid_t outer = H5Tcreate(H5T_COMPOUND, 16);
    H5Tinsert(outer, "x", 0, nested);
    nested = outer;
  }
  hid_t sequences = H5Tvlen_create(H5T_NATIVE_FLOAT);
  for (int i = 0; i < 20; ++i) sequences = H5Tvlen_create(sequences);
  const hsize_t dims[] = {1000, 10};
  const hid_t odd = H5Tcopy(H5T_IEEE_F32LE), wide = H5Tcopy(H5T_STD_I32LE), bits = H5Tcopy(H5T_STD_B32LE);
  H5Tset_fields(odd, 30, 20, 10, 0, 20);
  H5Tset_precision(wide, 17);
  H5Tset_offset(wide, 5);
  const hid_t choice = H5Tenum_create(H5T_NATIVE_INT);
  const int one = 1;
  H5Tenum_insert(choice, "one", &one);
  typed("compound_type", compound);
  typed("compound_type_nested_100_deep", nested);
  typed("sequences_nested_20_deep", sequences);
  typed("array_type", H5Tarray_create2(H5T_NATIVE_FLOAT, 2, dims));
  typed("float_of_odd_layout", odd);
  typed("integer_of_17_bits", wide);
  typed("bit_field", bits);
  typed("enumeration", choice);
  typed("object_reference", H5T_STD_REF_OBJ);
  typed("region_reference", H5T_STD_REF_DSETREG);
  typed("time", H5T_UNIX_D32LE);
}

void add_filters(Corpus& corpus) {
  const auto filtered = [&](const char* name, const std::function<void(hid_t)>& set) {
    corpus.add(name, [&](const RawHdf5& file) {
      file.layer();
      const hid_t creation = RawHdf5::chunked(16);
      set(creation);
      file.small_kernel(creation);
    });
  };
  filtered("filter_fletcher32", [](hid_t p) { H5Pset_fletcher32(p); });
  filtered("filter_scale_offset", [](hid_t p) { H5Pset_scaleoffset(p, H5Z_SO_FLOAT_DSCALE, 2); });
  filtered("filter_n_bit", [](hid_t p) { H5Pset_nbit(p); });
  filtered("filter_from_a_plug_in", [](hid_t p) { H5Pset_filter(p, 32001, H5Z_FLAG_OPTIONAL, 0, nullptr); });
}

/// Structures of a good file that are changed.
void add_lies(Corpus& corpus, const fs::path& folder) {
  const std::string good = good_bytes(folder, [](const RawHdf5& file) {
    file.layer();
    file.small_kernel();
  });
  corpus.add_bytes("cut_in_half", good.substr(0, good.size() / 2));
  corpus.add_bytes("cut_by_a_byte", good.substr(0, good.size() - 1));
  corpus.add_bytes("signature_alone", good.substr(0, 8));
  corpus.add_bytes("signature_and_noise", good.substr(0, 8) + std::string(4096, '\x5a'));
  corpus.add_bytes("signature_after_512_bytes_of_text", std::string(512, 'x') + good.substr(0, 100));
  corpus.add_bytes("superblock_of_version_9", patched(good, "\x89HDF", 8, "\x09"));
  corpus.add_bytes("addresses_of_3_bytes", patched(good, "\x89HDF", 13, "\x03"));
  corpus.add_bytes("root_beyond_the_end", patched(good, "\x89HDF", 64, packed(std::uint64_t{1} << 40)));
  corpus.add_bytes("group_heap_of_an_exabyte", patched(good, "HEAP", 8, packed(std::uint64_t{1} << 60)));
  corpus.add_bytes("group_heap_beyond_the_end", patched(good, "HEAP", 24, packed(std::uint64_t{1} << 40)));
  corpus.add_bytes("group_heap_free_list_of_itself", patched(good, "HEAP", 16, packed(0)));
  corpus.add_bytes("group_of_65535_entries", patched(good, "SNOD", 6, "\xff\xff"));
  corpus.add_bytes("tree_of_65535_entries", patched(good, "TREE", 6, "\xff\xff"));
  corpus.add_bytes("tree_of_level_255", patched(good, "TREE", 5, "\xff"));
  corpus.add_bytes("global_heap_of_an_exabyte", patched(good, "GCOL", 8, packed(std::uint64_t{1} << 60)));
  corpus.add_bytes("global_heap_of_nothing", patched(good, "GCOL", 8, packed(0)));
  corpus.add_bytes("global_heap_object_of_an_exabyte", patched(good, "GCOL", 24, packed(std::uint64_t{1} << 60)));
  corpus.add_bytes("global_heap_cut", patched(good, "GCOL", 4, "\x07"));

  const std::string shared = good_bytes(folder, [](const RawHdf5& file) {
    const std::string first(100'000, 'x');
    std::vector<const char*> names(2000, "another");
    names[0] = first.c_str();
    file.texts("/", "layer_names", names);
  });
  // A string is 16 bytes: length, address of the heap, index in it. All become the first, which is 100,000 bytes long.
  std::string bytes = shared;
  const std::size_t row = bytes.find(packed(100'000, 4));
  for (std::size_t i = 1; i < 2000; ++i) bytes.replace(row + 16 * i, 16, bytes.substr(row, 16));
  corpus.add_bytes("two_thousand_names_that_share_a_long_one", bytes);
  corpus.add_bytes("a_name_of_four_gigabytes", std::string(shared).replace(row, 4, "\xff\xff\xff\xff"));
  corpus.add_bytes("a_name_beyond_the_end", std::string(shared).replace(row + 4, 8, packed(std::uint64_t{1} << 40)));
  corpus.add_bytes("a_name_without_an_object", std::string(shared).replace(row + 12, 4, "\xff\xff\xff\x7f"));
  corpus.add_bytes("a_name_that_is_no_text", patched(good, "GCOL", 32, "\xff\xfe\xfd"));

  std::string chunks = good_bytes(folder, [](const RawHdf5& file) {
    file.layer();
    constexpr hsize_t kValues = 1 << 16;
    std::vector<float> values(kValues);
    for (hsize_t i = 0; i < kValues; ++i) values[i] = static_cast<float>(i);
    H5Dwrite(file.kernel({kValues}, H5T_IEEE_F32LE, RawHdf5::chunked(1024)), H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL,
             H5P_DEFAULT, values.data());
  });
  // The dataset becomes 2^33 values long, and all its chunks lie in the same place. A chunk in the tree is its size (4
  // bytes), a mask (4), where it begins in the dataset (8), a zero (8), and its address (8).
  const std::string space("\1\1\1\0\0\0\0\0", 8), place = packed(4096) + packed(1024) + packed(0);
  chunks = patched(chunks, space + packed(1 << 16), space.size(), packed(std::uint64_t{1} << 33) + packed(1ull << 33));
  const std::string address = chunks.substr(chunks.find(place) + place.size(), 8);
  for (std::uint64_t i = 0; i < 64; ++i)
    chunks = patched(chunks, packed(4096) + packed(1024 * i) + packed(0), place.size(), address);
  corpus.add_bytes("chunks_that_overlap", chunks);
}

}  // namespace

std::vector<Attack> write_hdf5_attacks(const fs::path& folder) {
  Corpus corpus(folder);
  add_links(corpus);
  add_other_places(corpus);
  add_sizes(corpus);
  add_types(corpus);
  add_filters(corpus);
  add_lies(corpus, folder);
  return std::move(corpus).attacks();
}

}  // namespace svnet::attacks
