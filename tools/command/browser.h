#pragma once
#include <filesystem>

#include "command/console.h"

namespace svnet::command {

/// Shows a file in the desktop's browser (xdg-open), without waiting for it. If there is no desktop or no xdg-open, a
/// message says so.
void show_in_browser(const std::filesystem::path& file, Console& console);

}  // namespace svnet::command
