#include "simulation/picture_table.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "image/opencv_image.h"

namespace svnet {

Image resized_to_fit(const Image& picture, Index side_px) {
  const cv::Mat3b source = matrix_of(picture);
  const double fit = static_cast<double>(side_px) / std::max(source.rows, source.cols);
  Image result{std::max(1, static_cast<int>(source.rows * fit)), std::max(1, static_cast<int>(source.cols * fit)), {}};
  result.rgb.resize(static_cast<std::size_t>(3 * result.height * result.width));
  cv::Mat3b target = matrix_of(result);
  cv::resize(source, target, target.size(), 0, 0, fit < 1 ? cv::INTER_AREA : cv::INTER_LINEAR);
  return result;
}

Image picture_table(const std::vector<PictureRow>& rows, Index cell_px) {
  constexpr int kGap = 2, kFont = cv::FONT_HERSHEY_SIMPLEX;
  constexpr double kFontScale = 0.45;
  const int cell = static_cast<int>(cell_px), pitch = cell + kGap;
  std::size_t columns = 0;
  int label_width = 0;
  for (const PictureRow& row : rows) {
    columns = std::max(columns, row.pictures.size());
    label_width = std::max(label_width, cv::getTextSize(row.label, kFont, kFontScale, 1, nullptr).width + 16);
  }
  Image sheet{
      static_cast<Index>(rows.size()) * pitch + kGap, label_width + static_cast<Index>(columns) * pitch + kGap, {}};
  sheet.rgb.assign(static_cast<std::size_t>(3 * sheet.height * sheet.width), 255);
  cv::Mat3b canvas = matrix_of(sheet);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const int top = kGap + static_cast<int>(r) * pitch;
    cv::putText(canvas, rows[r].label, {8, top + cell / 2 + 5}, kFont, kFontScale, {0, 0, 0}, 1, cv::LINE_AA);
    for (std::size_t c = 0; c < rows[r].pictures.size(); ++c) {
      const Image picture = resized_to_fit(rows[r].pictures[c], cell_px);
      const cv::Mat3b fitted = matrix_of(picture);
      fitted.copyTo(canvas(cv::Rect(label_width + static_cast<int>(c) * pitch + (cell - fitted.cols) / 2,
                                    top + (cell - fitted.rows) / 2, fitted.cols, fitted.rows)));
    }
  }
  return sheet;
}

}  // namespace svnet
