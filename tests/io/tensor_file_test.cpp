#include "io/tensors/tensor_file.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "io/tensors/safetensors.h"
#include "temporary_folder.h"

using namespace svnet;
using namespace svnet::io;
using Catch::Contains;

namespace {

/// (5, 3): a column of each size, and one of zeros.
Tensor three_columns() {
  Tensor tensor = Tensor::zeros({5, 3});
  for (Index i = 0; i < 5; ++i) {
    tensor.data<float>()[3 * i] = std::sin(1.3f * static_cast<float>(i + 1));
    tensor.data<float>()[3 * i + 1] = 1000 * std::cos(2.1f * static_cast<float>(i));
  }
  return tensor;
}

TensorFile with(const Tensor& tensor, StoredPrecision precision) {
  TensorFile file;
  file.description()["kind"] = "weights";
  file.add("layer/kernel", tensor, precision);
  file.add("layer/bias", Tensor::full({3}, 0.1));
  return file;
}

}  // namespace

TEST_CASE("tensors in bf16 and int8 keep their values up to the rounding of the format") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "t.safetensors";
  const Tensor tensor = three_columns();
  const auto largest_error = [&](Index column) {
    const Tensor read = TensorFile::read(path, "weights").at("layer/kernel", {5, 3});
    float most = 0;
    for (Index i = column; i < 15; i += 3)
      most = std::max(most, std::abs(read.data<float>()[i] - tensor.data<float>()[i]));
    return most;
  };
  with(tensor, StoredPrecision::f32).write(path);
  for (Index column = 0; column < 3; ++column) CHECK(largest_error(column) == 0);
  with(tensor, StoredPrecision::bf16).write(path);
  CHECK(largest_error(0) <= 1.0f / 512);
  CHECK(largest_error(1) <= 1000.0f / 512);
  with(tensor, StoredPrecision::int8).write(path);
  CHECK(largest_error(0) <= 0.5001f / 127);
  CHECK(largest_error(0) > 0);
  CHECK(largest_error(1) <= 500.1f / 127);
  CHECK(largest_error(2) == 0);
  CHECK(TensorFile::read(path, "weights").at("layer/bias", {3}).data<float>()[1] == 0.1f);
  const SafetensorsFile raw(path);
  CHECK(raw.at("layer/kernel").dtype == "I8");
  CHECK(raw.at("layer/kernel.scale").shape == Shape{3});
}

TEST_CASE("an int8 tensor that is read and written again has the same bytes") {
  const TemporaryFolder folder;
  const auto first = folder.path() / "a.safetensors", second = folder.path() / "b.safetensors";
  with(three_columns(), StoredPrecision::int8).write(first);
  with(TensorFile::read(first, "weights").at("layer/kernel", {5, 3}), StoredPrecision::int8).write(second);
  CHECK(file_contents(first) == file_contents(second));
}

TEST_CASE("a changed byte of any tensor is noticed by its checksum") {
  const TemporaryFolder folder;
  for (const auto precision : {StoredPrecision::f32, StoredPrecision::int8}) {
    const auto path = folder.path() / "t.safetensors";
    with(three_columns(), precision).write(path);
    const std::string good = file_contents(path);
    const std::size_t data = good.size() - (precision == StoredPrecision::f32 ? 72 : 39);
    for (std::size_t i = data; i < good.size(); ++i) {
      std::string bad = good;
      bad[i] = static_cast<char>(bad[i] ^ 1);
      const auto changed = folder.write("bad.safetensors", bad);
      CHECK_THROWS_WITH(TensorFile::read(changed, "weights"),
                        Contains("bad.safetensors: tensor 'layer/") && Contains("does not have its checksum"));
    }
  }
}

TEST_CASE("an int8 tensor without scales, or with others, is refused") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "t.safetensors";
  with(three_columns(), StoredPrecision::int8).write(path);
  const SafetensorsFile good(path);
  auto metadata = good.metadata();
  nlohmann::json description = nlohmann::json::parse(metadata.at("svnet"));
  description.erase("checksums");
  metadata.at("svnet") = description.dump();
  std::vector<SafetensorsTensor> tensors = good.tensors();
  const auto scale = std::ranges::find(tensors, "layer/kernel.scale", &SafetensorsTensor::name);
  scale->name = "layer/other.scale";
  write_safetensors(folder.path() / "none.safetensors", tensors, metadata);
  CHECK_THROWS_WITH(TensorFile::read(folder.path() / "none.safetensors", "weights"),
                    Contains("holds no tensor 'layer/kernel.scale'"));
  scale->name = "layer/kernel.scale";
  scale->shape = {1, 3};
  write_safetensors(folder.path() / "other.safetensors", tensors, metadata);
  CHECK_THROWS_WITH(TensorFile::read(folder.path() / "other.safetensors", "weights"),
                    Contains("tensor 'layer/kernel.scale' is F32 1x3, expected F32 3"));
}

TEST_CASE("a tensor of a dtype that weights never have is refused by name") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "t.safetensors";
  const std::vector<double> wide{1, 2};
  const std::vector<SafetensorsTensor> tensors{{"layer/kernel", "F64", {2}, std::as_bytes(std::span(wide))}};
  write_safetensors(path, tensors, {{"svnet", R"({"kind": "weights", "format": 1})"}});
  CHECK_THROWS_WITH(TensorFile::read(path, "weights"),
                    path.string() + ": tensor 'layer/kernel' is F64, expected F32, BF16 or I8");
}

TEST_CASE("a tensor of one number has one scale in int8") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "t.safetensors";
  const std::vector<float> number{-0.75f};
  TensorFile file;
  file.description()["kind"] = "weights";
  file.add("temperature", Tensor::from({}, number), StoredPrecision::int8);
  file.write(path);
  CHECK(SafetensorsFile(path).at("temperature.scale").shape == Shape{1});
  CHECK(TensorFile::read(path, "weights").at("temperature", {}).data<float>()[0] == -0.75f);
}
