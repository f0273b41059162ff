// svnet-demo-data: rendered solids in the layout of a data set, to try the programs on without any download.
#include <filesystem>

#include "base/parallel.h"
#include "command/command.h"
#include "demo_dataset/picture.h"
#include "io/fresh_folder.h"
#include "io/image_file.h"

namespace svnet::demo {
namespace {

/// The directions (θ, φ) of the paper: θ every 45° but 270°, φ every 15° from 45° to 75°, and the top view.
std::vector<std::pair<int, int>> view_directions() {
  std::vector<std::pair<int, int>> directions{{90, 90}};
  for (int phi = 45; phi <= 75; phi += 15)
    for (int theta = 0; theta < 360; theta += 45)
      if (theta != 270) directions.emplace_back(theta, phi);
  return directions;
}

/// Turned about the vertical by a random angle, after being laid on its side where `lying`.
Eigen::Matrix3f random_rotation(bool lying, RandomStream& random) {
  const auto turn = static_cast<float>(random.uniform() * 2 * EIGEN_PI);
  const Eigen::AngleAxisf tilt(lying ? static_cast<float>(EIGEN_PI / 2) : 0.0f, Vec3::UnitX());
  return (Eigen::AngleAxisf(turn, Vec3::UnitZ()) * tilt).toRotationMatrix();
}

void write_dataset(const std::filesystem::path& output, Index size, std::uint64_t seed, Index objects,
                   Console& console) {
  constexpr int kPoses = 2;
  const auto directions = view_directions();
  const auto views = static_cast<Index>(directions.size());
  const auto total = static_cast<Index>(kCategoryNames.size()) * objects * kPoses * views;
  FreshFolder folder(output);
  Progress progress(console.messages(), "pictures", total);
  Index done = 0;
  for (std::size_t category = 0; category < kCategoryNames.size(); ++category)
    for (Index object = 1; object <= objects; ++object) {
      RandomStream random(seed, Stream::collection, category * 1000 + static_cast<std::uint64_t>(object));
      const Solid solid(static_cast<Category>(category), random);
      for (int pose = 1; pose <= kPoses; ++pose) {
        const Placed placed = put_down(solid, random_rotation(pose == 2 && solid.can_lie(), random));
        const auto pose_folder =
            folder.path() / kCategoryNames[category] / std::to_string(object) / std::to_string(pose);
        std::filesystem::create_directories(pose_folder);
        Parallel::shared().for_chunks(views, 1, [&](Index view, Index, int) {
          const auto [theta, phi] = directions[static_cast<std::size_t>(view)];
          const std::string name = std::to_string(phi) + "_" + std::to_string(theta) + ".png";
          write_png(pose_folder / name, picture(placed, theta, phi, size));
        });
        progress.update(done += views);
      }
    }
  folder.keep();
  console.result(joined(total, " pictures in ", output.string()));
}

}  // namespace
}  // namespace svnet::demo

int main(int argc, char** argv) {
  using namespace svnet;
  Command command("svnet-demo-data",
                  "Makes a small data set of rendered solids: 8 categories, 2 poses of each object, 22 views of each "
                  "pose, as CATEGORY/OBJECT/POSE/PHI_THETA.png.",
                  "svnet-demo-data --output runs/demo/data");
  std::filesystem::path output;
  Index size = 128, objects = 4;
  std::uint64_t seed = 1;
  command.app().add_option("--output", output, "The folder to make")->required()->type_name("DIR");
  command.app().add_option("--size", size, "Height and width in pixels (128)")->check(CLI::Range(16, 1024));
  command.app().add_option("--seed", seed, "Seed of the proportions, colours and poses (1)");
  command.app().add_option("--objects", objects, "Objects of each category (4)")->check(CLI::Range(1, 999));
  return command.run(argc, argv, [&](Console& console) { demo::write_dataset(output, size, seed, objects, console); });
}
