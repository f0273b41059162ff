#include "command/log_file.h"

#include <cerrno>
#include <cstring>
#include <ctime>
#include <iomanip>

#include "base/error.h"

namespace svnet::command {

LogFile::LogFile(const std::filesystem::path& path) : path_(path), file_(path, std::ios::app) {
  check(file_.is_open(), path_.string(), ": cannot open the log file, check that its folder can be written to");
}

void LogFile::write(std::string_view text) {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  ::localtime_r(&now, &local);
  errno = 0;
  file_ << std::put_time(&local, "%Y-%m-%d %H:%M:%S ") << text << '\n' << std::flush;
  check(file_.good(), path_.string(),
        ": cannot write the log file: ", errno != 0 ? std::strerror(errno) : "is the disk full?");
}

}  // namespace svnet::command
