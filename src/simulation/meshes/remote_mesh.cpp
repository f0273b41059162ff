#include "remote_mesh.h"

#include <cerrno>
#include <cstring>
#include <map>
#include <system_error>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include "base/error.h"
#include "base/text.h"
#include "mesh_check.h"
#include "mesh_decoding.h"
#include "mesh_stream.h"
#include "sandbox/child.h"

namespace svnet::simulation {
namespace {

namespace fs = std::filesystem;
using sandbox::bytes_of;
using sandbox::Child;
using sandbox::Descriptor;
using sandbox::Message;
using sandbox::text_of;

/// The child sends find (two texts), warn (a text), length (a number) and at last the mesh; the parent answers to find
/// with missing, found (a path, and the open file) or unreadable (a path, a reason), to length with unit.
enum MessageKind : std::uint32_t { kFind, kMissing, kFound, kUnreadable, kWarn, kLength, kUnit };

std::pair<std::string, std::string> two_texts_of(const Message& message) {
  const std::string both = text_of(message.bytes);
  const std::size_t end = std::min(both.find('\0'), both.size());
  return {both.substr(0, end), both.substr(std::min(end + 1, both.size()))};
}
double number_of(const Message& message) {
  double number = 0;
  if (message.bytes.size() == sizeof number) std::memcpy(&number, message.bytes.data(), sizeof number);
  return number;
}

/// A regular file, and how many bytes it has.
struct OpenedFile {
  Descriptor descriptor;
  std::uint64_t size = 0;
};

OpenedFile opened(const fs::path& path) {
  OpenedFile file{Descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK))};
  struct stat status {};
  const bool is_open = file.descriptor.number() >= 0 && ::fstat(file.descriptor.number(), &status) == 0;
  check(is_open, path.string(), ": cannot be read: ", std::generic_category().message(errno));
  check(S_ISREG(status.st_mode), path.string(), ": is not a regular file");
  file.size = static_cast<std::uint64_t>(status.st_size);
  return file;
}

/// The contents of a file in memory, while it exists.
class Mapped {
 public:
  Mapped(int descriptor, const std::string& name) {
    const off_t end = ::lseek(descriptor, 0, SEEK_END);
    check(end >= 0, name, ": cannot be read: ", std::generic_category().message(errno));
    size_ = static_cast<std::size_t>(end);
    if (size_ > 0) bytes_ = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, descriptor, 0);
    check(bytes_ != MAP_FAILED, name, ": cannot be read: ", std::generic_category().message(errno));
  }
  ~Mapped() {
    if (size_ > 0) ::munmap(bytes_, size_);
  }
  Mapped(const Mapped&) = delete;
  Mapped& operator=(const Mapped&) = delete;
  std::string_view contents() const { return {static_cast<const char*>(bytes_), size_}; }

 private:
  void* bytes_ = nullptr;
  std::size_t size_ = 0;
};

/// What the child sees of the collection: what the parent finds for it.
class AskedFiles : public MeshFiles {
 public:
  AskedFiles(std::string name, sandbox::Channel& channel) : MeshFiles(std::move(name)), channel_(channel) {}

  std::optional<fs::path> find(const char* kind, const std::string& reference) const override {
    channel_.send(kFind, bytes_of(std::string(kind) + '\0' + reference));
    Message answer = channel_.receive();
    if (answer.kind == kMissing) return std::nullopt;
    const auto [path, reason] = two_texts_of(answer);
    found_.insert_or_assign(path, Found{std::move(answer.descriptor), reason});
    return path;
  }
  std::string contents(const fs::path& path) const override {
    const auto found = found_.extract(path.string());
    check(!found.empty(), path.string(), ": cannot be read");
    check(found.mapped().reason.empty(), found.mapped().reason);
    return std::string(Mapped(found.mapped().file.number(), path.string()).contents());
  }
  void warn(const std::string& text) const override { channel_.send(kWarn, bytes_of(text)); }

 private:
  struct Found {
    Descriptor file;
    std::string reason;  // if it cannot be read
  };
  sandbox::Channel& channel_;
  mutable std::map<std::string, Found> found_{};
};

void serve(sandbox::Channel& channel, const std::string& name, int descriptor) {
  const Mapped file(descriptor, name);
  const AskedFiles files(name, channel);
  const Mesh mesh = decode_mesh(file.contents(), files, [&](double length) {
    channel.send(kLength, bytes_of(length));
    return number_of(channel.receive());
  });
  check(is_consistent(mesh), name, ": holds a colour, a normal or a place in a texture that is not finite");
  send_mesh(channel, mesh);
}

sandbox::Limits limits_for(std::uint64_t size) {
  // Text and JSON take up to some fifty times their size; textures have a limit of their own (mesh_draft.h).
  constexpr std::uint64_t kAlways = std::uint64_t{2} << 30, kTimes = 64, kMost = std::uint64_t{64} << 30,
                          kSlow = 1u << 20;
  sandbox::Limits limits;
  limits.memory_bytes = kAlways + std::min(kTimes * std::min(size, kMost), kMost);
  limits.processor_time = std::chrono::seconds(20 + size / kSlow);
  limits.answer_time = std::chrono::seconds(120 + size / kSlow);
  return limits;
}

void answer_find(Child& child, const MeshFiles& files, const Message& question) {
  const auto [kind, reference] = two_texts_of(question);
  const auto path = files.find(printable(kind).c_str(), reference);
  if (!path) return child.send(kMissing, {});
  try {
    const OpenedFile file = opened(*path);
    child.send(kFound, bytes_of(path->string()), file.descriptor.number());
  } catch (const Error& error) {
    child.send(kUnreadable, bytes_of(path->string() + '\0' + error.what()));
  }
}

}  // namespace

Mesh read_mesh_elsewhere(const fs::path& path, const MeshFiles& files,
                         const std::function<double(double length)>& metres_per_unit) {
  const OpenedFile file = opened(path);
  const int number = file.descriptor.number();
  Child child({path.string(), "the reader of meshes"}, std::span(&number, 1), limits_for(file.size),
              [&](sandbox::Channel& channel) { serve(channel, files.name(), number); });
  constexpr int kMostQuestions = 100'000;
  for (int question = 0; question < kMostQuestions; ++question) {
    const Message message = child.receive();
    switch (message.kind) {
      case kFind:
        answer_find(child, files, message);
        break;
      case kWarn:
        files.warn(printable(text_of(message.bytes)));
        break;
      case kLength: {
        const double unit = metres_per_unit(number_of(message));
        child.send(kUnit, bytes_of(unit));
        break;
      }
      case kMeshBytes: {
        std::optional<Mesh> mesh = receive_mesh(child, message);
        if (!mesh || !is_consistent(*mesh)) child.refuse_answer();
        return *std::move(mesh);
      }
      default:
        child.refuse_answer();
    }
  }
  child.refuse_answer();
}

}  // namespace svnet::simulation
