#include "sort/dendrogram_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "base/error.h"
#include "image/contact_sheet.h"
#include "image/opencv_image.h"
#include "sort/group_colour.h"

namespace svnet {
namespace {

using Colour = std::array<std::uint8_t, 3>;

cv::Scalar scalar(const Colour& colour) { return {double(colour[0]), double(colour[1]), double(colour[2])}; }

const cv::Scalar kText(30, 30, 30), kMuted(110, 110, 110), kGrid(225, 225, 225), kCut(214, 39, 40);
constexpr double kFontSize = 0.42;
constexpr int kMargin_px = 20, kAxis_px = 46, kTree_px = 640, kName_px = 170, kGap_px = 10;

Image white_image(Index height, Index width) {
  return {height, width, std::vector<std::uint8_t>(static_cast<std::size_t>(3 * height * width), 255)};
}

/// How tall a line is: objects are small if there are many.
int line_height(std::size_t objects) { return objects <= 40 ? 60 : objects <= 120 ? 34 : 18; }

/// The objects from top to bottom, so that no lines of the tree cross: at each merge the part with the first object is
/// above the other one.
std::vector<std::int32_t> leaf_order(const semantics::Dendrogram& history) {
  const auto n = static_cast<std::int32_t>(history.items);
  std::vector<std::int32_t> first(static_cast<std::size_t>(n));
  for (std::int32_t i = 0; i < n; ++i) first[static_cast<std::size_t>(i)] = i;
  for (const semantics::Merge& merge : history.merges)
    first.push_back(std::min(first[static_cast<std::size_t>(merge.a)], first[static_cast<std::size_t>(merge.b)]));
  std::vector<std::int32_t> order, left{static_cast<std::int32_t>(first.size()) - 1};
  while (!left.empty()) {
    const std::int32_t cluster = left.back();
    left.pop_back();
    if (cluster < n) {
      order.push_back(cluster);
      continue;
    }
    const semantics::Merge& merge = history.merges[static_cast<std::size_t>(cluster - n)];
    const bool a_above = first[static_cast<std::size_t>(merge.a)] < first[static_cast<std::size_t>(merge.b)];
    left.push_back(a_above ? merge.b : merge.a);
    left.push_back(a_above ? merge.a : merge.b);
  }
  return order;
}

void write_at(cv::Mat3b& picture, const std::string& text, cv::Point place, const cv::Scalar& colour) {
  cv::putText(picture, text, place, cv::FONT_HERSHEY_SIMPLEX, kFontSize, colour, 1, cv::LINE_AA);
}

int width_of_text(const std::string& text) {
  return cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, kFontSize, 1, nullptr).width;
}

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

/// A round step that divides the range into three to seven parts.
double tick_step(double range) {
  const double power = std::pow(10, std::floor(std::log10(range / 3)));
  for (const double factor : {5.0, 2.0})
    if (range / (factor * power) >= 3) return factor * power;
  return power;
}

/// The tree and its axis. Heights grow to the right.
class TreePicture {
 public:
  TreePicture(const Grouping& grouping, std::span<const ObjectLook> looks)
      : grouping_(grouping),
        looks_(looks),
        line_(line_height(looks.size())),
        left_(kMargin_px + kName_px + line_ + 2 * kGap_px),
        bottom_(kMargin_px + kAxis_px + line_ * static_cast<int>(looks.size())),
        highest_(std::max(grouping.cut_height,
                          grouping.history.merges.empty() ? 0.0 : 1.05 * grouping.history.merges.back().height)),
        image_(white_image(bottom_ + kMargin_px, left_ + kTree_px + kMargin_px)),
        pixels_(matrix_of(image_)) {}

  Image drawn() {
    if (highest_ > 0) draw_axis();
    draw_leaves();
    draw_merges();
    if (highest_ > 0) draw_cut();
    return std::move(image_);
  }

 private:
  struct Place {
    double x, y;
  };

  double x_of(double height) const { return left_ + (highest_ > 0 ? height / highest_ * kTree_px : 0); }

  void draw_axis() {
    const double step = tick_step(highest_);
    for (int i = 0; i * step <= highest_; ++i) {
      const int x = static_cast<int>(std::lround(x_of(i * step)));
      cv::line(pixels_, {x, kMargin_px + kAxis_px - 6}, {x, bottom_}, kGrid, 1);
      const std::string text = short_number(i * step);
      write_at(pixels_, text, {x - width_of_text(text) / 2, kMargin_px + kAxis_px - 12}, kMuted);
    }
    write_at(pixels_, "distance", {kMargin_px, kMargin_px + kAxis_px - 12}, kMuted);
  }

  void draw_leaves() {
    const std::vector<std::int32_t> order = leaf_order(grouping_.history);
    places_.resize(order.size());
    for (std::size_t row = 0; row < order.size(); ++row) {
      const auto item = static_cast<std::size_t>(order[row]);
      const int top = kMargin_px + kAxis_px + line_ * static_cast<int>(row), middle = top + line_ / 2;
      const Image small = resized_to_fit(looks_[item].thumbnail, line_ - 4);
      const int x = left_ - kGap_px - line_ / 2 - static_cast<int>(small.width) / 2;
      matrix_of(small).copyTo(pixels_(cv::Rect(x, middle - static_cast<int>(small.height) / 2,
                                               static_cast<int>(small.width), static_cast<int>(small.height))));
      const std::string name = fitted_text(looks_[item].name, kName_px, kFontSize);
      write_at(pixels_, name, {left_ - 2 * kGap_px - line_ - width_of_text(name), middle + 5}, kText);
      places_[item] = {double(left_), double(middle)};
    }
  }

  void draw_merges() {
    std::vector<std::int32_t> group = grouping_.group;  // of each cluster; -1: of several groups
    for (const semantics::Merge& merge : grouping_.history.merges) {
      const auto a = static_cast<std::size_t>(merge.a), b = static_cast<std::size_t>(merge.b);
      const std::int32_t both = group[a] == group[b] ? group[a] : -1;
      const double x = x_of(merge.height);
      for (const std::size_t part : {a, b})
        line({places_[part].x, places_[part].y}, {x, places_[part].y}, colour_of(group[part]));
      line({x, places_[a].y}, {x, places_[b].y}, colour_of(both));
      if (both < 0)
        for (const std::size_t part : {a, b}) write_number(group[part], places_[part].y);
      places_.push_back({x, (places_[a].y + places_[b].y) / 2});
      group.push_back(both);
    }
  }

  /// The number of a group, as the sheet has it, where the cut crosses its line.
  void write_number(std::int32_t group, double y) {
    if (group < 0) return;
    const auto x = static_cast<int>(std::lround(x_of(grouping_.cut_height)));
    write_at(pixels_, std::to_string(group + 1), {x + 4, static_cast<int>(std::lround(y)) - 4}, kText);
  }

  static cv::Scalar colour_of(std::int32_t group) { return group < 0 ? kMuted : scalar(group_colour(group)); }

  void line(Place from, Place to, const cv::Scalar& colour) {
    constexpr int kShift = 4;  // bits of a fraction of a pixel
    const auto fixed = [](double value) { return static_cast<int>(std::lround(value * (1 << kShift))); };
    cv::line(pixels_, {fixed(from.x), fixed(from.y)}, {fixed(to.x), fixed(to.y)}, colour, 2, cv::LINE_AA, kShift);
  }

  void draw_cut() {
    constexpr int kDash_px = 6;
    const int x = static_cast<int>(std::lround(x_of(grouping_.cut_height))), top = kMargin_px + 18;
    for (int y = top; y < bottom_; y += 2 * kDash_px)
      cv::line(pixels_, {x, y}, {x, std::min(y + kDash_px, bottom_)}, kCut, 1);
    const std::string text = joined(grouping_.groups, grouping_.groups == 1 ? " group" : " groups");
    const int width = width_of_text(text), right = static_cast<int>(image_.width) - kMargin_px - width;
    write_at(pixels_, text, {std::min(x - width / 2, right), kMargin_px + 10}, kCut);
  }

  const Grouping& grouping_;
  std::span<const ObjectLook> looks_;
  int line_, left_, bottom_;
  double highest_;
  Image image_;
  cv::Mat3b pixels_;
  std::vector<Place> places_{};  // of each cluster: where its line to the right begins
};

}  // namespace

Image object_thumbnail(std::span<const Image> pictures) {
  if (pictures.size() == 1) return resized_to_fit(pictures[0], kThumbnail_px);
  constexpr Index kGap = 2, kSide = (kThumbnail_px - kGap) / 2;
  const std::size_t shown = std::min<std::size_t>(pictures.size(), 4);
  const Index rows = shown <= 2 ? 1 : 2;
  Image result = white_image(rows * kSide + (rows - 1) * kGap, kThumbnail_px);
  cv::Mat3b pixels = matrix_of(result);
  for (std::size_t i = 0; i < shown; ++i) {
    const Image part = resized_to_fit(pictures[i * pictures.size() / shown], kSide);
    const Index x = static_cast<Index>(i % 2) * (kSide + kGap) + (kSide - part.width) / 2;
    const Index y = static_cast<Index>(i / 2) * (kSide + kGap) + (kSide - part.height) / 2;
    matrix_of(part).copyTo(pixels(cv::Rect(static_cast<int>(x), static_cast<int>(y), static_cast<int>(part.width),
                                           static_cast<int>(part.height))));
  }
  return result;
}

Image groups_sheet(const Grouping& grouping, std::span<const ObjectLook> looks) {
  constexpr Index kColumns = 8;
  constexpr SheetLayout kLayout{.cell = kThumbnail_px, .gap = 8, .margin = 20, .text = 18, .font_size = kFontSize};
  std::vector<FramedGroup> framed;
  for (const auto& members : members_of(grouping)) {
    const auto number = static_cast<Index>(framed.size());
    FramedGroup group{.group = {.cells = {},
                                .title = joined("group ", number + 1, ": ", members.size(),
                                                members.size() == 1 ? " object" : " objects")},
                      .colour = group_colour(number)};
    for (const std::size_t i : members) group.group.cells.push_back({looks[i].thumbnail, looks[i].name});
    framed.push_back(std::move(group));
  }
  return framed_sheet(framed, kColumns, kLayout);
}

Image dendrogram_picture(const Grouping& grouping, std::span<const ObjectLook> looks) {
  return TreePicture(grouping, looks).drawn();
}

}  // namespace svnet
