#include "train/frame_head.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include "base/error.h"
#include "frame/top_view.h"
#include "models/pose_head.h"
#include "predict/predictor.h"
#include "train/within_pose.h"

using namespace svnet;
using namespace svnet::train;
using frame::DepthChoice;

namespace {

constexpr Index kCategories = 8, kPosesOfCategory = 4;

/// Wedge-shaped bars at random angles on a plain table. A view scores by a rule in the bar's own frame: it is worth the
/// more the more it looks across the bar and from low; the level of a pose is random.
struct Bars {
  ViewDataset dataset;
  std::vector<Image> top_images;
  std::vector<DepthImage> depths;
  std::vector<double> angles_deg;
  Scores scores;

  Bars() {
    std::mt19937 random(11);
    std::normal_distribution<double> normal;
    for (Index category = 0; category < kCategories; ++category) {
      dataset.categories.push_back(std::string(1, static_cast<char>('a' + category)));
      for (Index i = 0; i < kPosesOfCategory; ++i) add_pose(category, random, normal(random));
    }
    for (std::size_t v = 0; v < dataset.views.size(); ++v) {
      scores.individual.push_back(rule(v));
      scores.standard_error.push_back(0.001);
      scores.paths.push_back(dataset.views[v].path);
    }
    scores.global.assign(scores.individual.rbegin(), scores.individual.rend());
  }

  void add_pose(Index category, std::mt19937& random, double level) {
    const auto pose = static_cast<Index>(dataset.poses.size()), first = static_cast<Index>(dataset.views.size());
    dataset.objects.push_back({"o", category});
    for (int theta = 0; theta < 360; theta += 45)
      for (const int phi : {45, 75}) add_view({"", category, pose, pose, phi, theta, false});
    add_view({"", category, pose, pose, 90, 90, true});
    const auto count = static_cast<Index>(dataset.views.size()) - first;
    dataset.poses.push_back({"1", pose, category, first, count, first + count - 1});
    levels.push_back(0.5 + 0.1 * level);
    angles_deg.push_back(static_cast<double>(random() % 360));
    const frame::Shape bar = frame::wedge(1.4, 0.4, angles_deg.back());
    top_images.push_back(frame::picture_of(bar, {.height = 96, .width = 96, .seed = static_cast<unsigned>(random())}));
    depths.push_back(frame::depth_of(bar, [](double, double) { return 0.03; }));
  }
  void add_view(View view) {
    view.path = std::to_string(dataset.views.size());
    dataset.views.push_back(view);
  }

  double rule(std::size_t v) const {
    const View& view = dataset.views[v];
    const auto pose = static_cast<std::size_t>(view.pose);
    const double along = (view.theta_deg - angles_deg[pose]) * std::numbers::pi / 180;
    const double low = std::cos(view.phi_deg * std::numbers::pi / 180);
    return levels[pose] + 0.1 * low - 0.1 * low * std::cos(2 * along);
  }

  /// The features of the frame `axis` of every pose.
  std::vector<float> frames(DepthChoice depth = DepthChoice::none) const {
    std::vector<float> features;
    for (std::size_t p = 0; p < top_images.size(); ++p) {
      const frame::TopFrameValues values =
          frame::to_values(frame::top_frame(top_images[p], depth == DepthChoice::none ? nullptr : &depths[p]));
      features.insert(features.end(), values.begin(), values.end());
    }
    return features;
  }

  std::vector<double> levels;
};

const Bars& bars() {
  static const Bars bars;
  return bars;
}

/// The first six categories; the last two are never trained on.
std::vector<bool> training() {
  std::vector<bool> categories(kCategories, true);
  categories[6] = categories[7] = false;
  return categories;
}

std::vector<bool> others() {
  std::vector<bool> categories = training();
  categories.flip();
  return categories;
}

FrameHead fitted(const Scores& scores, DepthChoice depth = DepthChoice::none, Target target = Target::individual) {
  return fit_frame_head(bars().dataset, bars().frames(depth), scores, training(), target, {.depth = depth}, 3);
}

}  // namespace

TEST_CASE("a ridge head finds a rule in the object's frame that holds for other categories") {
  const DepthChoice depth = GENERATE(DepthChoice::none, DepthChoice::heights);
  Scores scores = bars().scores;
  for (std::size_t v = 0; v < scores.individual.size(); ++v)
    if (others()[static_cast<std::size_t>(bars().dataset.views[v].category)]) scores.individual[v] = std::nan("");
  const FrameHead head = fitted(scores, depth);
  CHECK(head.spec.depth == depth);
  CHECK(head.fit.ridge.error < 0.15);
  const auto predicted = predictions(head, bars().dataset, bars().frames(depth));
  const WithinPose within = within_pose(bars().dataset, predicted, bars().scores.individual, others());
  CHECK(within.poses == 2 * kPosesOfCategory);
  CHECK(within.spearman > 0.9);
  CHECK(within.regret < 0.02);
  CHECK(within.better_than_top == 1);
  CHECK(within.better_than_rand == 1);
}

TEST_CASE("a ridge head learns the target it is told to") {
  const FrameHead individual = fitted(bars().scores), global = fitted(bars().scores, DepthChoice::none, Target::global);
  CHECK(individual.fit.ridge.weights != global.fit.ridge.weights);
  Scores swapped = bars().scores;
  std::swap(swapped.individual, swapped.global);
  CHECK(fitted(swapped).fit.ridge.weights == global.fit.ridge.weights);
}

TEST_CASE("the model of a ridge head predicts what the head does, by its sigmoid") {
  const DepthChoice depth = GENERATE(DepthChoice::none, DepthChoice::heights);
  const FrameHead head = fitted(bars().scores, depth);
  const auto expected = predictions(head, bars().dataset, bars().frames(depth));
  const Model model = model_of(head);
  CHECK(model.input_fingerprint.empty());
  const predict::Predictor predictor(model);
  CHECK(predictor.uses_depth() == (depth == DepthChoice::heights));
  for (const std::size_t pose : {std::size_t{0}, std::size_t{13}, std::size_t{31}}) {
    const Tensor features = predictor.embed(bars().top_images[pose], &bars().depths[pose]);
    std::vector<view::CameraPose> poses;
    for (const View& view : bars().dataset.views_of(static_cast<Index>(pose)))
      poses.push_back({static_cast<double>(view.theta_deg), static_cast<double>(view.phi_deg)});
    const std::vector<float> scores = predictor.scores(features, poses);
    const auto first = static_cast<std::size_t>(bars().dataset.poses[pose].first_view);
    for (std::size_t i = 0; i < scores.size(); ++i)
      CHECK(scores[i] == Approx(1 / (1 + std::exp(-models::kLogitPerScore * expected[first + i]))).margin(1e-6));
  }
}

TEST_CASE("scores count the less the larger their standard errors are") {
  std::mt19937 random(2);
  Scores wrong = bars().scores;
  std::vector<bool> is_wrong(wrong.individual.size());
  for (std::size_t v = 0; v < wrong.individual.size(); ++v)
    if (random() % 4 == 0) {
      wrong.individual[v] += random() % 2 == 0 ? 0.3 : -0.3;
      is_wrong[v] = true;
    }
  Scores known = wrong;
  for (std::size_t v = 0; v < is_wrong.size(); ++v)
    if (is_wrong[v]) known.standard_error[v] = 30;
  const auto truth = predictions(fitted(bars().scores), bars().dataset, bars().frames());
  const auto distance = [&](const Scores& scores) {
    const auto predicted = predictions(fitted(scores), bars().dataset, bars().frames());
    double squares = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) squares += (predicted[i] - truth[i]) * (predicted[i] - truth[i]);
    return std::sqrt(squares / static_cast<double>(truth.size()));
  };
  CHECK(distance(known) < 0.005);
  CHECK(distance(wrong) > 2 * distance(known));
}

TEST_CASE("a score without a standard error counts no more than the least certain one") {
  std::mt19937 random(4);
  Scores scores = bars().scores;
  for (std::size_t v = 0; v < scores.individual.size(); ++v) {
    scores.standard_error[v] = 0.01;
    if (random() % 4 != 0) continue;
    scores.individual[v] += 0.3;
    scores.standard_error[v] = 0.5;
  }
  const auto with_largest = fitted(scores).fit.ridge.weights;
  bool one_is_left = false;
  for (double& error : scores.standard_error)
    if (error == 0.5 && std::exchange(one_is_left, true)) error = std::nan("");
  CHECK(fitted(scores).fit.ridge.weights == with_largest);
  scores.standard_error.assign(scores.standard_error.size(), std::nan(""));
  CHECK_NOTHROW(fitted(scores));
}

TEST_CASE("a ridge head needs scores of this dataset, and two categories of them") {
  Scores scores = bars().scores;
  std::vector<bool> one(kCategories, false);
  one[2] = true;
  CHECK_THROWS_AS(fit_frame_head(bars().dataset, bars().frames(), scores, one, Target::individual, {}, 3), Error);
  CHECK_THROWS_WITH(
      fit_frame_head(bars().dataset, std::vector<float>(15), scores, training(), Target::individual, {}, 3),
      "[head] 15 features do not belong to 32 top views");
  scores.paths[5] = "another";
  CHECK_THROWS_WITH(fitted(scores), Catch::StartsWith("scores"));
}

TEST_CASE(
    "networks learn the rule too, alone and averaged with the ridge regression, and the model scores as they do") {
  const HeadChoice choice = GENERATE(HeadChoice::network, HeadChoice::both, HeadChoice::best);
  const FrameHead head =
      fit_frame_head(bars().dataset, bars().frames(), bars().scores, training(), Target::individual, {}, 3, choice);
  const auto predicted = predictions(head, bars().dataset, bars().frames());
  const WithinPose within = within_pose(bars().dataset, predicted, bars().scores.individual, others());
  CHECK(within.spearman > 0.8);
  CHECK(head.fit.tried.size() == (choice == HeadChoice::best ? 3 : 0));
  if (choice == HeadChoice::network) CHECK(head.fit.ridge_share == 0);
  if (choice == HeadChoice::both) CHECK(head.fit.ridge_share == 0.5);
  if (choice == HeadChoice::best) {
    CHECK_THAT(tried_text(head.fit.tried), Catch::Contains("ridge 0.9") && Catch::Contains(", network "));
    for (const TriedHead& tried : head.fit.tried) CHECK(tried.within_pose.spearman > 0.8);
    return;
  }
  CHECK(head.fit.networks.size() == kNetworks);

  const predict::ScoreHead score_head(model_of(head));
  const Index pose = 2;
  const std::vector<float> frames = bars().frames();
  Tensor top = Tensor::empty({1, score_head.feature_count()});
  std::copy_n(frames.data() + pose * score_head.feature_count(), score_head.feature_count(), top.data<float>());
  std::vector<view::CameraPose> poses;
  for (const View& view : bars().dataset.views_of(pose))
    poses.push_back({static_cast<double>(view.theta_deg), static_cast<double>(view.phi_deg)});
  const std::vector<float> scores = score_head.scores(top, poses);
  const auto first = static_cast<std::size_t>(bars().dataset.poses[static_cast<std::size_t>(pose)].first_view);
  for (std::size_t i = 0; i < scores.size(); ++i)
    CHECK(scores[i] == Approx(1 / (1 + std::exp(-models::kLogitPerScore * predicted[first + i]))).margin(1e-5));
}

TEST_CASE("fitted networks have the same bits for any number of threads") {
  const int threads_before = Parallel::shared().threads();
  std::vector<std::vector<double>> fits;
  for (const int threads : {1, 2, 5}) {
    Parallel::shared().resize(threads);
    const FrameHead head = fit_frame_head(bars().dataset, bars().frames(), bars().scores, training(),
                                          Target::individual, {}, 3, HeadChoice::network);
    fits.push_back(predictions(head, bars().dataset, bars().frames()));
  }
  Parallel::shared().resize(threads_before);
  CHECK(fits[1] == fits[0]);
  CHECK(fits[2] == fits[0]);
}
