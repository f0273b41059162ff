#include "command/browser.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/environment.h"
#include "base/error.h"

extern char** environ;

namespace svnet::command {
namespace {

/// Starts a program of the PATH that outlives this one, with its output discarded. Returns whether it was started.
bool start(const char* program, const std::string& argument) {
  posix_spawn_file_actions_t files;
  if (::posix_spawn_file_actions_init(&files) != 0) return false;
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    ::posix_spawn_file_actions_addopen(&files, descriptor, "/dev/null", O_RDWR, 0);
  std::string name = program, file = argument;
  char* const arguments[] = {name.data(), file.data(), nullptr};
  pid_t child = 0;
  const int failure = ::posix_spawnp(&child, program, &files, nullptr, arguments, environ);
  ::posix_spawn_file_actions_destroy(&files);
  if (failure != 0) return false;
  int status = 0;
  // xdg-open hands the file over and ends; one that is still at work is left alone.
  return ::waitpid(child, &status, WNOHANG) == 0 || (WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

}  // namespace

void show_in_browser(const std::filesystem::path& file, Console& console) {
  show_address_in_browser(std::filesystem::absolute(file).string(), console);
}

void show_address_in_browser(const std::string& address, Console& console) {
  const bool desktop = !environment_variable("DISPLAY").empty() || !environment_variable("WAYLAND_DISPLAY").empty();
  if (!desktop) {
    console.line("There is no desktop here, and so no browser; open " + address + " on another machine.");
    return;
  }
  if (!start("xdg-open", address))
    console.line("There is no xdg-open here to show a browser; open " + address + " in one.");
}

}  // namespace svnet::command
