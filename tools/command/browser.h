#pragma once
#include <filesystem>
#include <string>

#include "command/console.h"

namespace svnet::command {

/// Shows a file in the desktop's browser (xdg-open), without waiting for it. If there is no desktop or no xdg-open, a
/// message says so.
void show_in_browser(const std::filesystem::path& file, Console& console);

/// The same for a page that a server has: "http://127.0.0.1:8080".
void show_address_in_browser(const std::string& address, Console& console);

}  // namespace svnet::command
