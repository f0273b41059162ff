#pragma once
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "train/stages/evaluation.h"

namespace svnet::train {

/// Writes views.png, a contact sheet of held-out objects: the top view, the view that SV-net chooses and the one with
/// the best score in `problems` problems of held-out categories. Returns its path, or nothing if there are fewer than 2
/// held-out categories.
std::optional<std::filesystem::path> contact_sheet_stage(const Run& run, const EvaluationInputs& inputs,
                                                         std::uint64_t problems);

/// Writes views.png, a contact sheet of objects of `categories` with the views of the selectors. Returns its path.
std::filesystem::path write_contact_sheet(const Run& run, const std::vector<bool>& categories,
                                          std::span<const Selector> selectors);

}  // namespace svnet::train
