#include "io/views/features_file.h"

#include <catch2/catch.hpp>
#include <limits>

#include "base/error.h"
#include "io/hdf5/hdf5_file.h"
#include "temporary_folder.h"

using namespace svnet;
using namespace svnet::io;
using Catch::Contains;

namespace {

Features example() {
  Features features;
  features.backbone = "mobilenet_v2";
  features.output = "avg_pool";
  features.preprocessing = "{\"size\":224}";
  features.weights_sha256 = "ab12";
  features.dataset_fingerprint = "cd34";
  features.input_fingerprint = "ef56";
  features.count = 2;
  features.dimension = 3;
  features.values = {1, 2, 3, -4, 5.5f, 1e-30f};
  features.theta_phi_deg = {{90, 90}, {315, 45}};
  features.paths = {"apple/1/1/90_90.jpg", "äpfel/1/1/45_315.jpg"};
  return features;
}

}  // namespace

TEST_CASE("features are read as they were written") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "features.h5";
  write_features(path, example());
  const Features features = read_features(path), expected = example();
  CHECK(features.count == 2);
  CHECK(features.dimension == 3);
  CHECK(features.values == expected.values);
  CHECK(features.theta_phi_deg == expected.theta_phi_deg);
  CHECK(features.paths == expected.paths);
  CHECK(features.backbone == "mobilenet_v2");
  CHECK(features.output == "avg_pool");
  CHECK(features.preprocessing == "{\"size\":224}");
  CHECK(features.weights_sha256 == "ab12");
  CHECK(features.dataset_fingerprint == "cd34");
  CHECK(features.input_fingerprint == "ef56");
}

TEST_CASE("features have the documented datasets and attributes") {
  const TemporaryFolder folder;
  write_features(folder.path() / "features.h5", example());
  const Hdf5File file = Hdf5File::open(folder.path() / "features.h5");
  CHECK(file.members("") == std::vector<std::string>{"features", "labels", "paths", "th_ph"});
  CHECK(file.shape("th_ph") == std::vector<Index>{2, 2});
  CHECK(file.read<double>("th_ph").values == std::vector<double>{90, 90, 315, 45});
  CHECK(file.read<std::int64_t>("labels").values == std::vector<std::int64_t>{0, 1});
  CHECK(file.text_attribute("", "input_fingerprint") == "ef56");
}

TEST_CASE("features, angles and labels of another program are read") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "features.h5";
  const auto write = [&](std::vector<std::int64_t> labels) {
    Hdf5File file = Hdf5File::create(path);
    file.write<double>("features", {2, 3}, std::vector<double>{1, 2, 3, 4, 5, 6});
    file.write<std::int64_t>("th_ph", {2, 2}, std::vector<std::int64_t>{90, 90, 315, 45});
    file.write<std::int64_t>("labels", {static_cast<Index>(labels.size())}, labels);
    file.close();
  };
  write({4, 7});
  const Features features = read_features(path);
  CHECK(features.paths.empty());
  CHECK(features.labels == std::vector<std::int64_t>{4, 7});
  CHECK(features.values == std::vector<float>{1, 2, 3, 4, 5, 6});
  CHECK(features.theta_phi_deg[1] == std::array<double, 2>{315, 45});
  CHECK(features.backbone.empty());
  {
    Hdf5File file = Hdf5File::create(path);
    file.write_text_attribute("", "backbone", "resnet50");
    file.write<double>("features", {1, 1}, std::vector<double>{std::numeric_limits<double>::quiet_NaN()});
    file.write<double>("th_ph", {1, 2}, std::vector<double>{90, 90});
    file.write<std::int64_t>("labels", {1}, std::vector<std::int64_t>{4});
    file.close();
  }
  CHECK(read_features_origin(path).backbone == "resnet50");
  CHECK(read_features_origin(path).output.empty());
  CHECK_THROWS_WITH(read_features(path), Contains("dataset 'features': row 0 has a value that is not finite"));
  write({4});
  CHECK_THROWS_WITH(read_features(path), Contains("dataset 'labels': has 1 rows, 'features' has 2"));
}

TEST_CASE("images that lie in no category have no labels") {
  const TemporaryFolder folder;
  Features features = example();
  features.paths = {"a.png", "b.png"};
  write_features(folder.path() / "features.h5", features);
  CHECK_FALSE(Hdf5File::open(folder.path() / "features.h5").has("labels"));
}

TEST_CASE("features that are incomplete or not finite are not written and replace no file") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "f.h5";
  write_features(path, example());
  const std::string before = file_contents(path);
  const auto message = [&](auto change) {
    Features features = example();
    change(features);
    try {
      write_features(path, features);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  CHECK_THAT(message([](Features& f) { f.values[4] = std::numeric_limits<float>::quiet_NaN(); }),
             Contains("f.h5: dataset 'features': row 1 (äpfel/1/1/45_315.jpg) has a value that is not finite"));
  CHECK_THAT(message([](Features& f) { f.theta_phi_deg[0][1] = std::numeric_limits<double>::infinity(); }),
             Contains("f.h5: dataset 'th_ph': row 0 (apple/1/1/90_90.jpg) has an angle that is not finite"));
  CHECK_THAT(message([](Features& f) { f.paths.pop_back(); }), Contains("'paths': has 1 rows, 'features' has 2"));
  CHECK_THAT(message([](Features& f) { f.theta_phi_deg.pop_back(); }), Contains("'th_ph': has 1 rows"));
  CHECK_THAT(message([](Features& f) { f.values.pop_back(); }), Contains("holds 5 values for 2x3"));
  CHECK_THAT(message([](Features& f) { f.count = 0; }), Contains("'features': is empty, 0x3"));
  CHECK_THAT(message([](Features& f) { f.dimension = 0; }), Contains("'features': is empty, 2x0"));
  CHECK_THAT(message([](Features& f) {
               f.labels = {0, 1}, f.paths.pop_back();
             }),
             Contains("'paths': has 1 rows, 'features' has 2"));
  CHECK_THAT(message([](Features& f) { f.paths[1] = "\xff"; }), Contains("f.h5: dataset 'paths'") && Contains("UTF-8"));
  CHECK(file_contents(path) == before);
}

TEST_CASE("features files of the wrong form are refused") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "f.h5";
  const auto message = [&](auto write) {
    {
      Hdf5File file = Hdf5File::create(path);
      for (const char* name : {"backbone", "output", "preprocessing", "weights_sha256", "dataset_fingerprint"})
        file.write_text_attribute("", name, "x");
      write(file);
      file.close();
    }
    try {
      read_features(path);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  const std::vector<float> six{1, 2, 3, 4, 5, std::numeric_limits<float>::infinity()};
  const std::vector<double> angles{1, 2, 3, 4};
  const std::vector<std::string> paths{"a", "b"};
  CHECK_THAT(message([](Hdf5File&) {}), Contains("f.h5: attribute 'input_fingerprint': is missing"));
  CHECK_THAT(message([](Hdf5File& f) { f.write_text_attribute("", "input_fingerprint", ""); }),
             Contains("f.h5: 'features': is missing"));
  CHECK_THAT(message([&](Hdf5File& f) {
               f.write_text_attribute("", "input_fingerprint", "");
               f.write<float>("features", {6}, six);
             }),
             Contains("dataset 'features': has 1 dimensions, expected 2"));
  CHECK_THAT(message([&](Hdf5File& f) {
               f.write_text_attribute("", "input_fingerprint", "");
               f.write<float>("features", {2, 3}, six);
               f.write<double>("th_ph", {1, 4}, angles);
             }),
             Contains("dataset 'th_ph': has 4 columns, expected 2"));
  CHECK_THAT(message([&](Hdf5File& f) {
               f.write_text_attribute("", "input_fingerprint", "");
               f.write<float>("features", {2, 3}, six);
               f.write<double>("th_ph", {2, 2}, angles);
               f.write<std::string>("paths", {2}, paths);
             }),
             Contains("dataset 'features': row 1 (b) has a value that is not finite"));
}
