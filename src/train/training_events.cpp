#include "train/training_events.h"

#include <sstream>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/split.h"
#include "base/text.h"

namespace svnet::train {
namespace {

std::string tag_of(const std::string& column) {
  constexpr std::string_view kValidation = "validation_";
  return column.starts_with(kValidation) ? "validation/" + column.substr(kValidation.size()) : "training/" + column;
}

}  // namespace

TrainingEvents::TrainingEvents(const std::filesystem::path& run_folder) : file_(run_folder, "training") {}

void TrainingEvents::add(const std::string& metrics) {
  std::istringstream text(metrics);
  std::string line;
  std::getline(text, line);
  const std::vector<std::string> columns = split(line, ',');
  for (std::size_t row = 0; std::getline(text, line); ++row) {
    if (row < rows_) continue;
    const std::vector<std::string> cells = split(line, ',');
    Index epoch = 0;
    check(cells.size() == columns.size() && parse_number(cells[0], epoch), "[training] metrics.csv, row ", row + 1,
          ": does not fit the header");
    for (std::size_t i = 2; i < cells.size(); ++i)  // after epoch and step
      if (double value = 0; parse_number(cells[i], value)) file_.add_scalar(tag_of(columns[i]), epoch, value);
    ++rows_;
  }
}

}  // namespace svnet::train
