#include "io/hdf5/remote_file.h"

#include <cerrno>
#include <new>
#include <system_error>

#include <fcntl.h>
#include <sys/mman.h>

#include "io/hdf5/answer.h"
#include "io/hdf5/collected.h"
#include "io/hdf5/library.h"
#include "io/hdf5/limits.h"
#include "io/hdf5/wire.h"

namespace svnet::io::hdf5 {
namespace {

/// The file itself is mapped. Besides it the child needs a whole dataset that is stored in chunks, as the library and
/// as the caller sees it, and the library's own memory.
sandbox::Limits limits_for(std::uint64_t size) {
  constexpr std::uint64_t kLibrary = std::uint64_t{24} << 20, kFast = std::uint64_t{16} << 20, kSlow = 1u << 20;
  sandbox::Limits limits;
  limits.memory_bytes = size + kLibrary + 2 * largest_decoded(size);
  limits.processor_time = std::chrono::seconds(5 + size / kFast);
  limits.answer_time = std::chrono::seconds(60 + size / kSlow);
  return limits;
}

/// The child's life: opens the mapped file, and answers until nobody asks.
void serve(sandbox::Channel& channel, int descriptor, const std::string& name, std::uint64_t size) {
  const Quiet quiet;
  void* image = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor, 0);
  check(image != MAP_FAILED, name, ": cannot be read: ", std::generic_category().message(errno));
  File file{name, size, open_image(name, image, size)};
  ChannelSink sink(channel);
  for (;;) {
    const Request request = receive_request(channel);
    try {
      hdf5::answer(file, request, sink);
      sink.end();
    } catch (const Error& error) {
      sink.error(error.what());
    }
  }
}

}  // namespace

RemoteFile::RemoteFile(const std::filesystem::path& path, std::uint64_t size) : name_(path.string()) {
  const sandbox::Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  check(file.number() >= 0, name_, ": cannot be read: ", std::generic_category().message(errno));
  const int given[] = {file.number()};
  child_ =
      std::make_unique<sandbox::Child>(sandbox::Task{name_, "the HDF5 library"}, given, limits_for(size),
                                       [&](sandbox::Channel& channel) { serve(channel, file.number(), name_, size); });
  Collected root(name_, size);
  answer({.ask = Ask::has}, root);  // throws if the library cannot open the file
}

void RemoteFile::answer(const Request& request, Sink& sink) {
  if (child_ == nullptr && failure_.empty()) throw std::bad_alloc();
  check(child_ != nullptr, failure_);
  std::string error;
  try {
    error = ask(*child_, request, sink);
  } catch (const std::bad_alloc&) {
    child_.reset();
    throw;
  } catch (const std::exception& failure) {
    child_.reset();
    failure_ = failure.what();
    throw;
  }
  if (!error.empty()) fail(error.starts_with(name_) ? "" : name_ + ": ", error);
}

}  // namespace svnet::io::hdf5
