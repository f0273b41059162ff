#pragma once
#include <filesystem>
#include <optional>

#include "train/stages/evaluation.h"

namespace svnet::train {

/// Writes views.png, a contact sheet of held-out objects: the top view, the view that SV-net chooses and the one with
/// the best score in `problems` problems of held-out categories. Returns its path, or nothing if there are fewer than 2
/// held-out categories.
std::optional<std::filesystem::path> contact_sheet_stage(const Run& run, const EvaluationInputs& inputs,
                                                         std::uint64_t problems);

}  // namespace svnet::train
