#include "simulate_sorting/table_picture.h"

#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>

#include "base/error.h"
#include "image/contact_sheet.h"
#include "image/opencv_image.h"
#include "io/images/image_file.h"
#include "sort/dendrogram_picture.h"
#include "sort/group_colour.h"

namespace svnet {
namespace {

constexpr int kBorder_px = 5;
constexpr std::array<std::uint8_t, 3> kFrame{120, 120, 120};

class TablePicture {
 public:
  explicit TablePicture(const SimulationReport& report) : report_(report), table_(report.tables[0].table) {}

  FramedGroup from_above() const {
    FramedGroup group = empty_group("The table, seen from above");
    for (std::size_t i = 0; i < table_.poses.size(); ++i) {
      const auto top = static_cast<std::int32_t>(report_.dataset.top_view(table_.poses[i]));
      group.group.cells.push_back({framed(i, std::span(&top, 1), false), name_of_object(i)});
    }
    return group;
  }

  /// A group per bin.
  std::vector<FramedGroup> bins(std::size_t selector) const {
    std::vector<FramedGroup> groups;
    const sorting::Outcome& outcome = report_.tables[0].outcomes[selector];
    const auto views = static_cast<std::size_t>(report_.selectors[selector].views);
    const std::int32_t bins = std::ranges::max(outcome.bins) + 1;
    for (std::int32_t bin = 0; bin < bins; ++bin) {
      FramedGroup group = empty_group(joined(report_.selectors[selector].name, ", bin ", bin + 1));
      Index wrong = 0;
      for (std::size_t i = 0; i < outcome.bins.size(); ++i) {
        if (outcome.bins[i] != bin) continue;
        wrong += outcome.wrong[i];
        const auto seen = std::span(outcome.views).subspan(i * views, views);
        group.group.cells.push_back({framed(i, seen, outcome.wrong[i]), name_of_object(i)});
      }
      group.group.title += wrong == 0 ? "" : joined(": ", wrong, " wrong");
      if (bin == 0)
        group.group.title += joined(" (", outcome.wrong_count, " of ", outcome.bins.size(),
                                    " objects in wrong bins with ", report_.selectors[selector].name, ")");
      groups.push_back(std::move(group));
    }
    return groups;
  }

 private:
  static FramedGroup empty_group(const std::string& title) {
    return {.group = {.cells = {}, .title = title}, .colour = kFrame};
  }

  /// "mug/3".
  std::string name_of_object(std::size_t i) const {
    const std::string path = report_.dataset.pose_path(table_.poses[i]);
    return path.substr(0, path.find_last_of('/'));
  }

  /// Views of an object in a square.
  Image framed(std::size_t object, std::span<const std::int32_t> views, bool is_wrong) const {
    std::vector<Image> pictures;
    for (const std::int32_t view : views) {
      const auto file = report_.dataset.root / report_.dataset.views[static_cast<std::size_t>(view)].path;
      pictures.push_back(io::read_image(file, report_.dataset.exif_orientation));
    }
    const Image thumbnail = resized_to_fit(object_thumbnail(pictures), kThumbnail_px - 2 * kBorder_px);
    const auto [red, green, blue] = group_colour(table_.truth[object]);
    Image square{kThumbnail_px, kThumbnail_px, {}};
    square.rgb.assign(static_cast<std::size_t>(3 * kThumbnail_px * kThumbnail_px), 255);
    cv::Mat3b pixels = matrix_of(square);
    matrix_of(thumbnail).copyTo(pixels(cv::Rect(
        static_cast<int>(kThumbnail_px - thumbnail.width) / 2, static_cast<int>(kThumbnail_px - thumbnail.height) / 2,
        static_cast<int>(thumbnail.width), static_cast<int>(thumbnail.height))));
    cv::rectangle(pixels, cv::Rect(0, 0, pixels.cols, pixels.rows), cv::Scalar(255, 255, 255), 2 * kBorder_px - 1);
    cv::rectangle(pixels, cv::Rect(kBorder_px / 2, kBorder_px / 2, pixels.cols - kBorder_px, pixels.rows - kBorder_px),
                  cv::Scalar(red, green, blue), kBorder_px);
    if (is_wrong) cross_out(pixels);
    return square;
  }

  /// A cross in the upper right corner.
  static void cross_out(cv::Mat3b& pixels) {
    constexpr int kSide_px = 22, kInset_px = kBorder_px + 4;
    const int right = pixels.cols - 1 - kInset_px, left = right - kSide_px, top = kInset_px, bottom = top + kSide_px;
    for (const auto& [colour, width] : {std::pair{cv::Scalar(255, 255, 255), 9}, std::pair{cv::Scalar(220, 0, 0), 4}}) {
      cv::line(pixels, {left, top}, {right, bottom}, colour, width, cv::LINE_AA);
      cv::line(pixels, {left, bottom}, {right, top}, colour, width, cv::LINE_AA);
    }
  }

  const SimulationReport& report_;
  const sorting::Table& table_;
};

}  // namespace

Image table_picture(const SimulationReport& report, const std::vector<std::size_t>& selectors) {
  constexpr SheetLayout kLayout{.cell = kThumbnail_px, .gap = 8, .margin = 20, .text = 18, .font_size = 0.42};
  constexpr Index kColumns = 6;  // of the bins
  check(!report.tables.empty(), "[simulation] there are no tables");
  const TablePicture picture(report);
  const FramedGroup table = picture.from_above();
  const Image above = framed_sheet(std::span(&table, 1), kColumns * std::ssize(selectors), kLayout);
  std::vector<Image> columns;
  Index height = 0, width = 0;
  for (const std::size_t selector : selectors) {
    columns.push_back(framed_sheet(picture.bins(selector), kColumns, kLayout));
    height = std::max(height, columns.back().height);
    width += columns.back().width;
  }
  Image sheet{above.height + height, std::max(above.width, width), {}};
  sheet.rgb.assign(static_cast<std::size_t>(3 * sheet.height * sheet.width), 255);
  cv::Mat3b pixels = matrix_of(sheet);
  const auto paste = [&](const Image& part, Index x, Index y) {
    matrix_of(part).copyTo(pixels(cv::Rect(static_cast<int>(x), static_cast<int>(y), static_cast<int>(part.width),
                                           static_cast<int>(part.height))));
  };
  paste(above, 0, 0);
  Index x = 0;
  for (const Image& column : columns) {
    paste(column, x, above.height);
    x += column.width;
  }
  return sheet;
}

}  // namespace svnet
