#include "serve/static_files.h"

#include <algorithm>

#include "base/error.h"

// The assembler puts each file into the program. EMBEDDED_FILES(EMBED) is generated: EMBED(name, "file", "full path").
#include "serve/embedded_files.h"

#define SVNET_EMBED(name, file, path)                                          \
  __asm__(                                                                     \
      ".pushsection .rodata\n"                                                 \
      "svnet_page_" #name                                                      \
      "_begin:\n"                                                              \
      ".incbin \"" path                                                        \
      "\"\n"                                                                   \
      "svnet_page_" #name                                                      \
      "_end:\n"                                                                \
      ".popsection\n");                                                        \
  extern "C" {                                                                 \
  [[gnu::visibility("hidden")]] extern const char svnet_page_##name##_begin[]; \
  [[gnu::visibility("hidden")]] extern const char svnet_page_##name##_end[];   \
  }
SVNET_EMBEDDED_FILES(SVNET_EMBED)

namespace svnet::serve {
namespace {

std::string path_of(const std::string& file) {
  if (file == "index.html") return "/";
  if (file == "openapi.json") return "/openapi.json";
  return "/page/" + file;
}

std::string type_of(std::string_view file) {
  if (file.ends_with(".html")) return "text/html; charset=utf-8";
  if (file.ends_with(".css")) return "text/css; charset=utf-8";
  if (file.ends_with(".js")) return "text/javascript; charset=utf-8";
  if (file.ends_with(".svg")) return "image/svg+xml";
  if (file.ends_with(".json")) return "application/json";
  fail("[serve] the type of the file ", file, " is not known");
}

StaticFile embedded_file(const std::string& file, const char* begin, const char* end) {
  return {path_of(file), type_of(file), {begin, static_cast<std::size_t>(end - begin)}};
}

}  // namespace

const std::vector<StaticFile>& static_files() {
#define SVNET_ENTRY(name, file, path) embedded_file(file, svnet_page_##name##_begin, svnet_page_##name##_end),
  static const std::vector<StaticFile> kFiles{SVNET_EMBEDDED_FILES(SVNET_ENTRY)};
#undef SVNET_ENTRY
  return kFiles;
}

const StaticFile* static_file(std::string_view path) {
  const auto found = std::ranges::find(static_files(), path, &StaticFile::path);
  return found == static_files().end() ? nullptr : &*found;
}

}  // namespace svnet::serve
