// Which folder of src/ may include which. The tables below are the only place that says so; docs/architecture.md tells
// what each folder is for.
#include <algorithm>
#include <catch2/catch.hpp>

#include "sources.h"

using namespace svnet;

namespace {

/// A room is a folder of src/, or a single file of one, and the rooms that its files may include besides itself. A file
/// belongs to the room with the longest path that matches its own. "nn/*" stands for nn and all rooms in it.
struct Room {
  const char* path;
  std::vector<std::string> may_include;
};

const std::vector<Room> kRooms{
    {"base", {}},
    {"sandbox", {"base"}},
    {"image", {"base"}},
    {"mpi", {"base"}},
    {"semantics", {"base"}},
    {"view", {"base", "image"}},
    {"frame", {"base", "image", "view"}},
    {"localise", {"base", "image", "view"}},

    {"nn/kernels", {"base"}},
    {"nn", {"base", "nn/kernels"}},  // the tensor and the tape: files that lie in no subfolder
    {"nn/ops", {"base", "nn/kernels", "nn"}},
    {"nn/optim", {"base", "nn/kernels", "nn"}},
    {"nn/layers", {"base", "nn/kernels", "nn", "nn/ops"}},
    {"nn/graph", {"base", "nn/kernels", "nn", "nn/ops", "nn/layers"}},
    {"nn/runtime", {"base", "nn/kernels", "nn", "nn/layers", "nn/graph"}},

    {"models", {"base", "image", "nn/*"}},
    {"data", {"base"}},
    {"data/model.h", {"base", "frame", "models", "nn/*"}},
    {"data/model_part.h", {"base"}},

    {"io/files", {"base"}},
    {"io/images", {"base", "image", "io/files"}},
    {"io/events", {"base", "image", "io/images"}},
    {"io/hdf5", {"base", "sandbox", "io/files"}},
    {"io/tensors", {"base", "nn/*", "io/files"}},
    {"io/keras", {"base", "nn/*", "models", "io/files", "io/hdf5"}},
    {"io/models",
     {"base", "image", "view", "frame", "nn/*", "models", "data/model.h", "io/files", "io/tensors", "io/keras"}},
    {"io/onnx", {"base", "view", "frame", "nn/*", "models", "data/model.h", "data/model_part.h"}},
    {"io/views", {"base", "view", "data", "io/files", "io/hdf5", "io/images"}},

    {"predict",
     {"base", "image", "view", "frame", "nn/*", "models", "data", "data/model.h", "io/models", "io/tensors"}},
    {"c_api", {"base", "image", "semantics", "view", "predict"}},
    {"exports",
     {"base", "image", "view", "frame", "nn/*", "models", "data/model.h", "data/model_part.h", "io/files", "io/keras",
      "io/models", "io/onnx", "io/tensors", "predict"}},
    {"serve", {"base", "image", "view", "frame", "nn/*", "models", "data/model.h", "io/images", "predict"}},
    {"simulation", {"base", "sandbox", "image", "view", "localise", "data", "io/*"}},
    {"train/config", {"base", "frame", "semantics", "nn/*", "models"}},
    {"train",
     {"base", "image", "semantics", "view", "frame", "nn/*", "models", "data", "data/model.h", "io/*", "train/config"}},
    {"train/stages",
     {"base", "image", "semantics", "view", "frame", "nn/*", "models", "data", "data/model.h", "io/*", "predict", "train/config",
      "train"}},
    {"sorting",
     {"base", "semantics", "view", "frame", "data", "io/images", "io/views", "predict", "train"}},
    {"report",
     {"base", "image", "semantics", "view", "frame", "data", "io/*", "train/config", "train", "train/stages"}},
};

/// Whether `path` is the room or lies in it.
bool is_in(const std::string& path, const std::string& room) {
  return path.starts_with(room) && (path.size() == room.size() || path[room.size()] == '/');
}

/// The room of a file "src/…"; empty if the table has none.
std::string room_of(const std::string& file) {
  const std::string path = file.substr(std::string_view("src/").size());
  std::string best;
  for (const Room& room : kRooms)
    if (is_in(path, room.path) && std::string_view(room.path).size() > best.size()) best = room.path;
  return best;
}

/// All rooms with the rooms that they may include, patterns written out.
Arrows table_of_arrows() {
  Arrows arrows;
  for (const Room& room : kRooms) {
    std::set<std::string>& targets = arrows[room.path];
    for (const std::string& allowed : room.may_include) {
      const bool is_pattern = allowed.ends_with("/*");
      for (const Room& other : kRooms)
        if (is_pattern ? is_in(other.path, allowed.substr(0, allowed.size() - 2)) : other.path == allowed)
          targets.insert(other.path);
    }
  }
  return arrows;
}

const std::vector<SourceFile>& sources() {
  static const std::vector<SourceFile> kSources = read_sources(SVNET_SOURCE_DIR, {"src"});
  return kSources;
}

}  // namespace

TEST_CASE("the table of rooms names rooms that it has, and no circle of them") {
  for (const Room& room : kRooms)
    for (const std::string& allowed : room.may_include) {
      CAPTURE(room.path, allowed);
      CHECK((allowed.ends_with("/*") ||
             std::any_of(kRooms.begin(), kRooms.end(), [&](const Room& other) { return other.path == allowed; })));
    }
  CHECK(circles(table_of_arrows()).empty());
}

TEST_CASE("every file of src/ includes only rooms that the table allows") {
  REQUIRE(sources().size() > 100);
  const Arrows allowed = table_of_arrows();
  for (const SourceFile& file : sources()) {
    const std::string room = room_of(file.path);
    INFO(file.path << " is in the room '" << room << "'");
    CHECK_FALSE(room.empty());
    for (const std::string& included : file.includes) {
      INFO("it includes " << included);
      const std::string target = room_of(included);
      CHECK((target == room || allowed.at(room).contains(target)));
    }
  }
}

TEST_CASE("no files of src/ need each other in a circle") {
  Arrows arrows;
  for (const SourceFile& file : sources())
    for (const std::string& included : file.includes)
      if (unit_of(included) != unit_of(file.path)) arrows[unit_of(file.path)].insert(unit_of(included));
  for (const auto& circle : circles(arrows)) {
    CAPTURE(circle);
    CHECK(false);
  }
}

TEST_CASE("only base/environment.cpp reads the environment, and nothing writes it") {
  for (const SourceFile& file : read_sources(SVNET_SOURCE_DIR, {"src", "tools", "python", "bench"})) {
    if (file.path == "src/base/environment.cpp") continue;
    for (const std::string& line : file.lines) {
      INFO(file.path << ": " << line);
      CHECK(line.find("getenv(") == std::string::npos);
      CHECK(line.find("setenv(") == std::string::npos);
      CHECK(line.find("putenv(") == std::string::npos);
    }
  }
}
