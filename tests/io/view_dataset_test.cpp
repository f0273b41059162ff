#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "io/views/composed_name.h"
#include "io/views/dataset_folder.h"
#include "io/views/dataset_notes.h"
#include "shared_folder.h"
#include "temporary_folder.h"

using namespace svnet;
using namespace svnet::io;
namespace fs = std::filesystem;

namespace {

std::vector<std::string> paths(const ViewDataset& dataset) {
  std::vector<std::string> result;
  for (const View& view : dataset.views) result.push_back(view.path);
  return result;
}

}  // namespace

TEST_CASE("categories, objects, poses and views are numbered in natural order") {
  const TemporaryFolder folder;
  for (const char* path :
       {"mug/10/a/90_90.png", "mug/2/pose10/90_90.png", "mug/2/pose2/90_90.JPG", "mug/2/pose2/45_315.webp",
        "mug/2/pose2/45_0.png", "mug/2/pose2/45_90.jpeg", "bowl/1/a/90_90.png", "bowl/1/a/0_359.png"})
    folder.write(path, path);
  const ViewDataset dataset = read_view_dataset(folder.path());
  CHECK(dataset.root == folder.path());
  CHECK(dataset.categories == std::vector<std::string>{"bowl", "mug"});
  REQUIRE(dataset.objects.size() == 3);
  CHECK((dataset.objects[0].name == "1" && dataset.objects[0].category == 0));
  CHECK((dataset.objects[1].name == "2" && dataset.objects[1].category == 1));
  CHECK((dataset.objects[2].name == "10" && dataset.objects[2].category == 1));
  REQUIRE(dataset.poses.size() == 4);
  CHECK(dataset.pose_path(0) == "bowl/1/a");
  CHECK(dataset.pose_path(1) == "mug/2/pose2");
  CHECK(dataset.pose_path(2) == "mug/2/pose10");
  CHECK(dataset.pose_path(3) == "mug/10/a");
  CHECK((dataset.poses[2].object == 1 && dataset.poses[2].category == 1));
  CHECK(paths(dataset) == std::vector<std::string>{"bowl/1/a/0_359.png", "bowl/1/a/90_90.png", "mug/2/pose2/45_0.png",
                                                   "mug/2/pose2/45_90.jpeg", "mug/2/pose2/45_315.webp",
                                                   "mug/2/pose2/90_90.JPG", "mug/2/pose10/90_90.png",
                                                   "mug/10/a/90_90.png"});
  const View& view = dataset.views[4];
  CHECK((view.category == 1 && view.object == 1 && view.pose == 1));
  CHECK((view.phi_deg == 45 && view.theta_deg == 315 && !view.top));
  CHECK(dataset.views[0].phi_deg == 0);
  CHECK(dataset.views[0].theta_deg == 359);
  CHECK(dataset.top_view(0) == 1);
  CHECK(dataset.top_view(1) == 5);
  CHECK(dataset.top_view(3) == 7);
  CHECK(dataset.views[5].top);
  CHECK(dataset.views_of(1).size() == 4);
  CHECK(&dataset.views_of(1).front() == &dataset.views[2]);
  CHECK(dataset.views_of(3).front().path == "mug/10/a/90_90.png");
}

TEST_CASE("hidden names, names with an underscore and files next to the categories are ignored") {
  const TemporaryFolder folder;
  for (const char* path :
       {"mug/1/1/90_90.png", "manifest.json", "_extra/depth.bin", ".git/x", "mug/_note.txt", "mug/.DS_Store",
        "mug/1/_masks/a.png", "mug/1/1/_overview.png", "mug/1/1/.45_90.png", "mug/1/1/_depth/45_90.png"})
    folder.write(path, "");
  CHECK(paths(read_view_dataset(folder.path())) == std::vector<std::string>{"mug/1/1/90_90.png"});
}

TEST_CASE("paths are relative, however the root is written") {
  const TemporaryFolder folder;
  folder.write("data/mug/1/1/90_90.png", "");
  const fs::path before = fs::current_path();
  fs::current_path(folder.path() / "data");
  std::vector<std::vector<std::string>> found;
  for (const fs::path& root : {fs::path("."), fs::path("./"), fs::path("../data"), fs::path("../data/"),
                               folder.path() / "data" / "", folder.path() / "data" / ".." / "data"})
    found.push_back(paths(read_view_dataset(root)));
  fs::current_path(before);
  for (const auto& views : found) CHECK(views == std::vector<std::string>{"mug/1/1/90_90.png"});
}

TEST_CASE("the fingerprint changes with every path and content, and with nothing else") {
  const TemporaryFolder a, b;
  for (const TemporaryFolder* folder : {&a, &b})
    for (int theta = 0; theta < 91; ++theta)
      folder->write("mug/1/1/90_" + std::to_string(theta) + ".png", "image " + std::to_string(theta));
  Parallel one(1), three(3);
  const auto print = [&](const TemporaryFolder& folder, Parallel& parallel) {
    return fingerprint(read_view_dataset(folder.path()), parallel);
  };
  const std::string first = print(a, one);
  CHECK(first.size() == 64);
  CHECK(print(b, three) == first);
  b.write("manifest.json", "{}");
  CHECK(print(b, three) == first);
  std::set<std::string> prints{first};
  b.write("mug/1/1/90_7.png", "image 8");
  prints.insert(print(b, three));
  b.write("mug/1/1/90_8.png", "image 7");
  prints.insert(print(b, three));
  b.write("mug/1/1/90_7.png", "image 7"), b.write("mug/1/1/90_8.png", "image 8");
  CHECK(print(b, three) == first);
  fs::rename(b.path() / "mug/1/1/90_7.png", b.path() / "mug/1/1/89_7.png");
  prints.insert(print(b, three));
  fs::remove(b.path() / "mug/1/1/89_7.png");
  prints.insert(print(b, three));
  CHECK(prints.size() == 5);
  const ViewDataset gone = read_view_dataset(b.path());
  const fs::path removed = b.path() / "mug/1/1/90_50.png";
  fs::remove(removed);
  CHECK_THROWS_WITH(fingerprint(gone, three), removed.string() + ": cannot be read: No such file or directory");
}

TEST_CASE("ETH-80 is 8 categories of 10 objects of 41 views") {
  const fs::path root = shared_folder("data/eth80");
  if (!fs::exists(root)) {
    WARN("skipped: " << root << " does not exist");
    return;
  }
  const ViewDataset dataset = read_view_dataset(root);
  CHECK(dataset.categories == std::vector<std::string>{"apple", "car", "cow", "cup", "dog", "horse", "pear", "tomato"});
  CHECK(dataset.objects.size() == 80);
  CHECK(dataset.poses.size() == 80);
  CHECK(dataset.views.size() == 3280);
  CHECK(dataset.objects[9].name == "10");
}

TEST_CASE("what systems leave beside images is ignored and counted") {
  const TemporaryFolder folder;
  const std::vector<std::string> left{
      ".DS_Store",           "@eaDir/x",          "Thumbs.db",       "desktop.ini",         "lost+found/x",
      "notes.txt",           "mug/Thumbs.db",     "mug/@eaDir/a/b",  "mug/1/a/desktop.ini", "mug/1/.DS_Store",
      "mug/1/a/._90_90.png", "mug/1/a/thumbs.DB", "mug/lost+found/x"};
  for (const auto& path : left) folder.write(path, "");
  for (const char* path : {"mug/1/a/90_90.png", "manifest.json", "_extra/x.txt", ".git/x"}) folder.write(path, "");
  const ViewDataset dataset = read_view_dataset(folder.path());
  CHECK(paths(dataset) == std::vector<std::string>{"mug/1/a/90_90.png"});
  CHECK(dataset.ignored.size() == left.size());
  const auto notes = dataset_notes(dataset, Parallel::shared());
  REQUIRE(notes.size() == 1);
  CHECK(notes[0].starts_with(folder.path().string() + ": 13 files or folders that are no images of a category are "
                                                      "ignored: "));
  CHECK(std::count(notes[0].begin(), notes[0].end(), '\n') == 0);
}

TEST_CASE("up to three ignored files are named in full") {
  const TemporaryFolder folder;
  for (const char* path : {"a.txt", "b.txt", "c.txt", "mug/1/a/90_90.png"}) folder.write(path, "");
  const auto notes = dataset_notes(read_view_dataset(folder.path(), ExifOrientation::obey), Parallel::shared());
  REQUIRE(notes.size() == 1);
  CHECK(notes[0] == folder.path().string() +
                        ": 3 files or folders that are no images of a category are ignored: a.txt, b.txt, c.txt");
}

TEST_CASE("names that begin with '_' or '.' and those that systems leave are ignored") {
  for (const char* name : {"_extra", ".git", "Thumbs.db", "desktop.ini", "lost+found"}) CHECK(is_ignored_name(name));
  for (const char* name : {"mug", "a_b", "90_90.png"}) CHECK_FALSE(is_ignored_name(name));
}

TEST_CASE("a name that is not UTF-8 stays as it is") {
  CHECK(composed_name("caf\xe9") == "caf\xe9");  // Latin 1
  CHECK(composed_name("cafe\xcc\x81") == "caf\xc3\xa9");
}

TEST_CASE("names of categories are the same composed (NFC) and decomposed (NFD)") {
  const std::string composed = "caf\xc3\xa9", decomposed = "cafe\xcc\x81";
  const auto dataset_with = [](const TemporaryFolder& folder, const std::string& name) {
    folder.write(name + "/1/a/90_90.png", "image");
    folder.write("cafz/1/a/90_90.png", "image");
    return read_view_dataset(folder.path());
  };
  const TemporaryFolder mac, linux_folder, both;
  const ViewDataset from_mac = dataset_with(mac, decomposed), from_linux = dataset_with(linux_folder, composed);
  CHECK(from_mac.categories == from_linux.categories);
  CHECK(std::count(from_mac.categories.begin(), from_mac.categories.end(), composed) == 1);
  CHECK(fingerprint(from_mac, Parallel::shared()) == fingerprint(from_linux, Parallel::shared()));
  CHECK(fs::exists(from_mac.root / from_mac.views[0].path));
  both.write(composed + "/1/a/90_90.png", "");
  both.write(decomposed + "/1/a/90_90.png", "");
  CHECK_THROWS_WITH(read_view_dataset(both.path()), Catch::Contains(": the same category as another folder"));
}

TEST_CASE("an EXIF orientation is reported if it is ignored, and obeying it is another dataset") {
  const TemporaryFolder folder;
  for (const char* path : {"mug/1/a/90_90.jpg", "mug/1/a/45_0.jpg"})
    folder.write(path, file_contents(fs::path(SVNET_SOURCE_DIR) / "tests/fixtures/pictures/turned.jpg"));
  folder.write("mug/1/a/45_90.jpg", file_contents(fs::path(SVNET_SOURCE_DIR) / "tests/fixtures/pictures/rgb.jpg"));
  const ViewDataset ignored = read_view_dataset(folder.path());
  const ViewDataset obeyed = read_view_dataset(folder.path(), ExifOrientation::obey);
  const auto notes = dataset_notes(ignored, Parallel::shared());
  REQUIRE(notes.size() == 1);
  CHECK(notes[0] ==
        "2 of 3 images have an EXIF orientation other than 1, which is ignored (mug/1/a/45_0.jpg: 6); "
        "exif_orientation obey turns them as viewers do");
  CHECK(dataset_notes(obeyed, Parallel::shared()).empty());
  CHECK(exif_note("a.jpg", 6, 1, 1, "--exif").starts_with("1 of 1 image has an EXIF orientation other than 1, "));
  CHECK(fingerprint(ignored, Parallel::shared()) != fingerprint(obeyed, Parallel::shared()));
}
