#include "train/top_frames.h"

#include <catch2/catch.hpp>
#include <fstream>

#include "bar_dataset.h"
#include "base/error.h"
#include "io/views/dataset_folder.h"
#include "temporary_folder.h"

using namespace svnet;
using namespace svnet::train;
using frame::DepthChoice;

namespace {

namespace fs = std::filesystem;

std::vector<frame::TopFrame> frames_of(const ViewDataset& dataset, DepthChoice depth, int threads = 2) {
  Parallel parallel(threads);
  return top_frames(dataset, depth, {}, parallel);
}

}  // namespace

TEST_CASE("top views of a dataset are measured as prediction measures them, with any number of threads") {
  const TemporaryFolder folder;
  write_bar_dataset(folder.path(), true);
  const ViewDataset dataset = io::read_view_dataset(folder.path());
  REQUIRE(dataset.poses.size() == 12);
  for (const DepthChoice depth : {DepthChoice::none, DepthChoice::heights}) {
    const auto frames = frames_of(dataset, depth);
    REQUIRE(frames.size() == 12);
    const DepthImage measured = io::read_depth(top_depth_file(dataset, 7));
    const Image image =
        io::read_image(folder.path() / dataset.views[static_cast<std::size_t>(dataset.top_view(7))].path);
    const auto expected = frame::to_values(frame::top_frame(image, depth == DepthChoice::none ? nullptr : &measured));
    CHECK(frame::to_values(frames[7]) == expected);
    // The floats' rounding is in the frames themselves.
    CHECK(frames[7].axis.direction_deg == static_cast<double>(expected[1]));
    CHECK(fingerprint(frames_of(dataset, depth, 5)) == fingerprint(frames));
    for (const frame::TopFrame& top : frames) {
      CHECK(top.axis.kind == frame::AxisKind::found);
      CHECK(top.heights.are_known == (depth == DepthChoice::heights));
    }
  }
}

TEST_CASE("the fingerprint of frames changes with any value and with their order") {
  const TemporaryFolder folder;
  write_bar_dataset(folder.path(), true);
  const auto frames = frames_of(io::read_view_dataset(folder.path()), DepthChoice::heights);
  const std::string before = fingerprint(frames);
  auto changed = frames;
  changed[3].heights.volume *= 1.001;
  CHECK(fingerprint(changed) != before);
  changed = frames;
  changed[11].axis.kind = frame::AxisKind::round;
  CHECK(fingerprint(changed) != before);
  changed = frames;
  std::swap(changed[0], changed[1]);
  CHECK(fingerprint(changed) != before);
  changed = frames;
  changed.pop_back();
  CHECK(fingerprint(changed) != before);
}

TEST_CASE("a top view without depth is an error that names the file, and only if depth is wanted") {
  const TemporaryFolder folder;
  write_bar_dataset(folder.path(), true);
  const fs::path depth = folder.path() / "_extra/cue/1/1/90_90_depth.png";
  REQUIRE(fs::remove(depth));
  const ViewDataset dataset = io::read_view_dataset(folder.path());
  CHECK_THROWS_WITH(frames_of(dataset, DepthChoice::heights),
                    Catch::Contains(depth.string() + ": no such file; sv_net.depth: heights needs the depth image"));
  CHECK_NOTHROW(frames_of(dataset, DepthChoice::none));
  folder.write("_extra/cue/1/1/90_90_depth.png", "no image");
  CHECK_THROWS_WITH(frames_of(dataset, DepthChoice::heights), Catch::Contains(depth.string()));
}

TEST_CASE("the depth of a top view may be a NumPy file") {
  const TemporaryFolder folder;
  write_bar_dataset(folder.path(), true);
  const ViewDataset dataset = io::read_view_dataset(folder.path());
  const fs::path png = folder.path() / "_extra/awl/0/1/90_90_depth.png", npy = fs::path(png).replace_extension(".npy");
  CHECK(top_depth_file(dataset, 0) == png);
  const auto before = frames_of(dataset, DepthChoice::heights);
  const DepthImage depth = io::read_depth(png);
  std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (" + std::to_string(depth.height) + ", " +
                       std::to_string(depth.width) + "), }";
  header.append(64 - (10 + header.size() + 1) % 64, ' ').push_back('\n');
  std::string contents("\x93NUMPY\x01\x00", 8);
  contents.push_back(static_cast<char>(header.size() % 256));
  contents.push_back(static_cast<char>(header.size() / 256));
  contents += header;
  contents.append(reinterpret_cast<const char*>(depth.metres.data()), depth.metres.size() * sizeof(float));
  fs::remove(png);
  folder.write("_extra/awl/0/1/90_90_depth.npy", contents);
  CHECK(top_depth_file(dataset, 0) == npy);
  const auto after = frames_of(dataset, DepthChoice::heights);
  CHECK(after[0].heights.height == Approx(before[0].heights.height).epsilon(1e-3));
}
