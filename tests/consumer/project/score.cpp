// score_cpp MODEL IMAGE.ppm THETA PHI [THETA PHI]...: prints one score per line, then the index of the best.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <string>
#include <svnet/svnet.hpp>

namespace {

int run(int argc, char** argv) {
  if (argc < 5 || argc % 2 == 0) return 2;
  const svnet::ViewModel model(argv[1]);

  std::ifstream file(argv[2], std::ios::binary);
  std::string kind;
  std::int32_t width = 0, height = 0, highest = 0;
  file >> kind >> width >> height >> highest;
  file.get();
  std::vector<char> pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
  if (!file.read(pixels.data(), static_cast<std::streamsize>(pixels.size()))) return 1;

  std::vector<svnet::CameraPose> poses;
  for (int i = 3; i < argc; i += 2) poses.push_back({std::atof(argv[i]), std::atof(argv[i + 1])});
  const auto features = model.embed({reinterpret_cast<const std::uint8_t*>(pixels.data()), height, width});
  for (const float score : model.scores(features, poses)) std::printf("%.9g\n", static_cast<double>(score));
  std::printf("%zu\n", model.best_view(features, poses).index);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
