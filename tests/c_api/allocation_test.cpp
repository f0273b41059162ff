// After the first calls a context allocates nothing: counted in malloc, below every library.
#include <array>
#include <catch2/catch.hpp>
#include <memory>

#include "loaded_model.h"
#include "malloc_count.h"
#include "view/pose_grid.h"

using namespace svnet;

TEST_CASE("every allocation is counted") {
  const std::size_t before = malloc_count();
  const auto bytes = std::make_unique<std::array<char, 100>>();
  const Loaded loaded;
  CHECK(malloc_count() > before + 100);
  CHECK(bytes != nullptr);
}

TEST_CASE("a context allocates nothing once it has seen an image and poses of a size") {
  Model symmetric = small_model();
  symmetric.symmetries = 8;
  Model nearest = small_model();
  nearest.preprocessing.interpolation = Interpolation::nearest;
  struct Case {
    const char* name;
    Model model;
    bool embeds;  // without allocating
  };
  for (const Case& c :
       {Case{"camera", small_model(), true}, Case{"symmetries", symmetric, true}, Case{"nearest", nearest, true},
        Case{"axis", small_axis_model(), false}, Case{"turned", small_turned_model(), false}}) {
    INFO(c.name);
    const Loaded loaded(c.model);
    svnet_context* context = nullptr;
    REQUIRE(svnet_context_create(loaded.model, &context) == SVNET_OK);
    const std::vector<double> poses = pairs_of(view::fibonacci_half_sphere(500, 0));
    const Image one = small_image(), other = [&] {
      Image image = one;
      for (auto& value : image.rgb) value = static_cast<std::uint8_t>(255 - value);
      return image;
    }();
    std::vector<float> features(svnet_feature_count(loaded.model)), scores(500);
    std::array<std::size_t, 5> indices{};
    std::size_t best = 0, found = 0;
    float margin = 0;
    const auto embed = [&](const Image& image) {
      return svnet_context_embed(context, image.rgb.data(), 70, 50, 150, SVNET_RGB8, nullptr, features.data());
    };
    const auto choose = [&](std::size_t count) {
      return svnet_context_score(context, features.data(), poses.data(), count, scores.data()) == SVNET_OK &&
             svnet_context_best_view(context, features.data(), poses.data(), count, &best, nullptr) == SVNET_OK &&
             svnet_context_best_views(context, features.data(), poses.data(), count, 5, 20, indices.data(), nullptr,
                                      &found) == SVNET_OK &&
             svnet_context_margin(context, features.data(), poses.data(), count, &margin) == SVNET_OK;
    };
    REQUIRE(embed(one) == SVNET_OK);
    REQUIRE(choose(500));
    bool done = true;
    std::size_t by_embed = 0, by_choice = 0;
    for (const Image* image : {&other, &one, &other}) {
      const std::size_t before = malloc_count();
      done = done && embed(*image) == SVNET_OK;
      const std::size_t between = malloc_count();
      for (const std::size_t count : {500, 1, 77}) done = done && choose(count);
      by_embed += between - before;
      by_choice += malloc_count() - between;
    }
    svnet_context_free(context);
    CHECK(done);
    CHECK(by_choice == 0);
    CHECK((by_embed == 0) == c.embeds);
  }
}
