#pragma once
#include <cstdlib>
#include <string>

#include <sys/wait.h>

#include "temporary_folder.h"

/// The output of a command line and its exit status; minus the signal if a signal ended it.
struct Ran {
  int status;
  std::string out, err;
};

/// Runs shell commands in `folder`. Their output is kept outside of it.
inline Ran run_shell(const std::filesystem::path& folder, const std::string& commands) {
  const TemporaryFolder output;
  const std::string out = output.path() / "out", err = output.path() / "err";
  const int status =
      std::system(("cd '" + folder.string() + "' && { " + commands + "; } >" + out + " 2>" + err).c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), file_contents(out), file_contents(err)};
}
