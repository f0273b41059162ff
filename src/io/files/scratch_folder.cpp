#include "io/files/scratch_folder.h"

#include <cerrno>
#include <cstdlib>
#include <system_error>

#include "base/environment.h"
#include "base/error.h"

namespace svnet::io {
namespace {

std::filesystem::path temporary_folder() {
  const std::string chosen = environment_variable("TMPDIR");
  std::filesystem::path folder = chosen.empty() ? "/tmp" : chosen;
  std::error_code error;
  check(std::filesystem::is_directory(folder, error), folder.string(),
        ": is no folder for temporary files; set TMPDIR to one");
  return folder;
}

}  // namespace

ScratchFolder::ScratchFolder(const std::string& prefix) {
  const auto temporary = temporary_folder();
  std::string name = (temporary / (prefix + "-XXXXXX")).string();
  if (mkdtemp(name.data()) == nullptr) {
    const int error = errno;
    fail(temporary.string(), ": no temporary folder can be made in it: ", std::generic_category().message(error),
         "; set TMPDIR to a folder that can be written");
  }
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace svnet::io
