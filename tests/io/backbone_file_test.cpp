#include "io/models/backbone_file.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "base/parallel.h"
#include "io/files/file_hash.h"
#include "io/tensors/safetensors.h"
#include "temporary_folder.h"

using namespace svnet;
using namespace svnet::io;
using namespace svnet::models;

namespace {

bool same_numbers(const Parameters& a, const Parameters& b) {
  return std::ranges::all_of(a.items(), [&](const auto& item) {
    return std::ranges::equal(item.second.template values<float>(), b.at(item.first).template values<float>());
  });
}

/// Writes the file again with its tensors changed.
template <class Change>
void rewrite(const std::filesystem::path& from, const std::filesystem::path& to, const Change& change) {
  const SafetensorsFile file(from);
  std::vector<SafetensorsTensor> tensors = file.tensors();
  change(tensors);
  write_safetensors(to, tensors, file.metadata());
}

}  // namespace

TEST_CASE("a backbone is read from its file, up to any layer") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "w.safetensors";
  const Backbone backbone = random_backbone("tiny_xception", "", 5);
  write_backbone(path, backbone, "made for a test");
  KerasLoadReport report;
  const Backbone back = read_backbone("tiny_xception", path, "", &report);
  CHECK(back.output_name() == "avg_pool");
  CHECK(same_numbers(backbone.parameters(), back.parameters()));
  CHECK(report.unused.empty());
  CHECK(report.loaded.size() == 26);
  CHECK(report.loaded.front() == "block1_conv1");

  const Backbone inner = read_backbone("tiny_xception", path, "block4_act", &report);
  CHECK(inner.output_name() == "block4_act");
  CHECK(same_numbers(inner.parameters(), backbone.parameters()));
  CHECK(report.loaded.size() == 20);
  CHECK(report.unused.size() == 6);
}

TEST_CASE("weights that do not fit are refused") {
  const TemporaryFolder folder;
  const auto good = folder.path() / "w.safetensors", bad = folder.path() / "bad.safetensors";
  write_backbone(good, random_backbone("tiny_xception", "", 5), "");
  const auto read = [&] { return read_backbone("tiny_xception", bad); };
  const std::string name = bad.string();
  const auto find = [](std::vector<SafetensorsTensor>& tensors, const std::string& wanted) {
    return std::ranges::find(tensors, wanted, &SafetensorsTensor::name);
  };
  rewrite(good, bad, [&](auto& tensors) { tensors.erase(find(tensors, "block3_sepconv1_bn/gamma")); });
  CHECK_THROWS_WITH(read(), name + ": there is no tensor 'block3_sepconv1_bn/gamma'");
  rewrite(good, bad, [&](auto& tensors) {
    tensors.push_back(tensors.front());
    tensors.back().name = "block9/kernel";
  });
  CHECK_THROWS_WITH(read(), Catch::StartsWith(name + ": holds tensor 'block9/kernel' (") &&
                                Catch::EndsWith("), for which the network has no place"));
  rewrite(good, bad, [&](auto& tensors) {
    auto& kernel = *find(tensors, "block1_conv1/kernel");
    std::swap(kernel.shape[2], kernel.shape[3]);
  });
  CHECK_THROWS_WITH(read(), name + ": tensor 'block1_conv1/kernel' is 3x3x24x3, expected 3x3x3x24");
  CHECK_THROWS_WITH(read_backbone("mobilenet", good),
                    good.string() + ": holds weights of tiny_xception, expected weights of mobilenet");
  folder.write("bad.safetensors", "no weights at all");
  CHECK_THROWS_WITH(read(), Catch::StartsWith(name + ": is not a safetensors file"));
  CHECK_THROWS_WITH(read_backbone("tiny_xception", folder.path() / "none.safetensors"),
                    Catch::Contains("none.safetensors: cannot be read: No such file"));
}

TEST_CASE("the built-in weights are those of data/, are small, and give different images different features") {
  const auto file = std::filesystem::path(SVNET_SOURCE_DIR) / "data/tiny_xception.safetensors";
  CHECK(std::filesystem::file_size(file) <= 1500000);
  const auto built_in = built_in_backbone("tiny_xception");
  REQUIRE(built_in);
  CHECK(built_in->sha256 == file_sha256(file));
  CHECK(same_numbers(built_in->backbone.parameters(), read_backbone("tiny_xception", file).parameters()));
  CHECK(built_in_backbone("tiny_xception", "block4_act")->backbone.output_name() == "block4_act");

  // Batches of one image of noise and one of a gradient: the features are finite, differ, and most are not 0.
  Tensor batch = Tensor::empty({2, 96, 96, 3});
  for (Index i = 0; i < batch.size(); ++i)
    batch.data<float>()[i] = i < batch.size() / 2 ? static_cast<float>(i * 7919 % 255) / 127.5f - 1
                                                  : static_cast<float>(i / 288 % 96) / 48 - 1;
  const Tensor features = built_in->backbone.features(batch);
  Index used = 0;
  for (Index d = 0; d < 256; ++d) {
    CHECK(std::isfinite(features.data<float>()[d]));
    used += features.data<float>()[d] != features.data<float>()[256 + d];
  }
  CHECK(used > 100);

  CHECK_FALSE(built_in_backbone("mobilenet"));
  CHECK_THROWS_WITH(built_in_backbone("tiny"), Catch::Contains("there is no backbone 'tiny'"));
  CHECK_THROWS_WITH(built_in_backbone("tiny_xception", "block4_axt"), Catch::Contains("did you mean 'block4_act'?"));
}

TEST_CASE("weights are found in a folder by the names they are published under") {
  const TemporaryFolder folder;
  const BackboneKind& kind = backbone_kind("mobilenet");
  CHECK_FALSE(find_weights(kind, folder.path()));
  folder.write("mobilenet_1_0_224_tf.h5", "");
  CHECK(find_weights(kind, folder.path()) == folder.path() / "mobilenet_1_0_224_tf.h5");
  folder.write("mobilenet_1_0_224_tf_no_top.h5", "");
  CHECK(find_weights(kind, folder.path()) == folder.path() / "mobilenet_1_0_224_tf_no_top.h5");
  folder.write("mobilenet.safetensors", "");
  CHECK(find_weights(kind, folder.path()) == folder.path() / "mobilenet.safetensors");
}
