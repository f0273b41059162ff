// svnet_turned_accuracy MODEL FOLDER [STEP]: how well the scores of a model turn with the object. Every STEP-th
// (default 7) top view of the dataset in FOLDER is turned in the image by an angle, and the paper's poses with it.
// Prints, per angle, the rank correlation of the scores before and after, over the poses, and their largest difference;
// and whether features have the same bits in ten runs with one and two threads.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iomanip>
#include <iostream>

#include "base/error.h"
#include "base/parallel.h"
#include "frame/turned_image.h"
#include "io/images/image_file.h"
#include "io/views/dataset_folder.h"
#include "predict/predictor.h"
#include "train/within_pose.h"
#include "view/pose_grid.h"

namespace svnet {
namespace {

std::vector<double> scores_of(const predict::Predictor& predictor, const Image& image, double turned_deg) {
  std::vector<view::CameraPose> poses = view::paper_grid();
  for (view::CameraPose& pose : poses) pose.theta_deg += turned_deg;
  const std::vector<float> scores = predictor.scores(predictor.embed(image), poses);
  return {scores.begin(), scores.end()};
}

/// Counter-clockwise; by quarters exactly, else without what lies outside the inscribed circle.
Image turned(const Image& image, double angle_deg) {
  return std::fmod(angle_deg, 90) == 0 ? frame::quarter_turned_square(image, static_cast<int>(angle_deg / 90))
                                       : frame::turned_image(image, 90 - angle_deg);
}

bool same_bits(const predict::Predictor& predictor, const Image& image) {
  std::vector<float> first;
  bool same = true;
  for (int run = 0; run < 10; ++run) {
    Parallel::shared().resize(1 + run % 2);
    const Tensor features = predictor.embed(image);
    const auto values = features.values<float>();
    if (first.empty()) first.assign(values.begin(), values.end());
    same = same && std::equal(values.begin(), values.end(), first.begin(), first.end());
  }
  return same;
}

void measure(const std::filesystem::path& model, const std::filesystem::path& folder, Index step) {
  const predict::Predictor predictor(model);
  const ViewDataset dataset = io::read_view_dataset(folder);
  std::vector<Image> images;
  for (std::size_t pose = 0; pose < dataset.poses.size(); pose += static_cast<std::size_t>(step)) {
    const Index top = dataset.top_view(static_cast<Index>(pose));
    images.push_back(io::read_image(dataset.root / dataset.views[static_cast<std::size_t>(top)].path));
  }
  std::vector<std::vector<double>> before;
  for (const Image& image : images) before.push_back(scores_of(predictor, image, 0));
  std::cout << images.size() << " top views\n angle  mean    5 %     least   difference\n" << std::fixed;
  for (const double angle_deg : {5.0, 11.25, 17.0, 22.5, 30.0, 45.0, 90.0, 180.0}) {
    std::vector<double> correlations;
    double sum = 0, difference = 0;
    for (std::size_t i = 0; i < images.size(); ++i) {
      const auto after = scores_of(predictor, turned(images[i], angle_deg), angle_deg);
      correlations.push_back(train::rank_correlation(before[i], after));
      sum += correlations.back();
      for (std::size_t k = 0; k < after.size(); ++k)
        difference = std::max(difference, std::abs(after[k] - before[i][k]));
    }
    std::sort(correlations.begin(), correlations.end());
    std::cout << std::setw(6) << std::setprecision(2) << angle_deg << std::setprecision(4) << "  "
              << sum / static_cast<double>(correlations.size()) << "  " << correlations[correlations.size() / 20]
              << "  " << correlations[0] << "  " << std::setprecision(7) << difference << "\n";
  }
  std::cout << "same bits: " << (same_bits(predictor, images[0]) ? "yes" : "no") << "\n";
}

}  // namespace
}  // namespace svnet

int main(int argc, char** argv) {
  if (argc < 3 || argc > 4) {
    std::cerr << "usage: svnet_turned_accuracy MODEL FOLDER [STEP]\n";
    return 2;
  }
  try {
    svnet::measure(argv[1], argv[2], argc > 3 ? std::max(1, std::atoi(argv[3])) : 7);
  } catch (const svnet::Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
