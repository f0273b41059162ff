#include "io/events/event_file.h"

#include <catch2/catch.hpp>
#include <csignal>
#include <cstring>
#include <functional>
#include <protozero/pbf_reader.hpp>
#include <vector>

#include <sys/resource.h>

#include "base/crc32c.h"
#include "base/error.h"
#include "io/files/whole_file.h"
#include "temporary_folder.h"

using namespace svnet;
using namespace svnet::io;

namespace {

struct Event {
  Index step = 0;
  std::string version{}, tag{}, image{};
  float value = 0;
};

Event parsed(std::string_view bytes) {
  Event event;
  protozero::pbf_reader reader(bytes.data(), bytes.size());
  while (reader.next()) switch (reader.tag()) {
      case 2:
        event.step = reader.get_int64();
        break;
      case 3:
        event.version = reader.get_string();
        break;
      case 5: {
        protozero::pbf_reader summary = reader.get_message();
        REQUIRE(summary.next(1));
        protozero::pbf_reader value = summary.get_message();
        while (value.next()) switch (value.tag()) {
            case 1:
              event.tag = value.get_string();
              break;
            case 2:
              event.value = value.get_float();
              break;
            case 4: {
              protozero::pbf_reader image = value.get_message();
              while (image.next())
                if (image.tag() == 4)
                  event.image = image.get_bytes();
                else
                  image.skip();
              break;
            }
            default:
              value.skip();
          }
        break;
      }
      default:
        reader.skip();
    }
  return event;
}

template <class Number>
Number number_at(const std::string& bytes, std::size_t place) {
  Number number;
  std::memcpy(&number, bytes.data() + place, sizeof number);
  return number;
}

std::uint32_t masked(std::string_view bytes) {
  const std::uint32_t crc = crc32c(bytes);
  return ((crc >> 15) | (crc << 17)) + 0xA282EAD8U;
}

std::vector<Event> read_events(const std::filesystem::path& file) {
  const std::string bytes = whole_file(file);
  std::vector<Event> events;
  for (std::size_t at = 0; at < bytes.size();) {
    const auto size = number_at<std::uint64_t>(bytes, at);
    const std::string_view event = std::string_view(bytes).substr(at + 12, size);
    CHECK(number_at<std::uint32_t>(bytes, at + 8) == masked(std::string_view(bytes).substr(at, 8)));
    CHECK(number_at<std::uint32_t>(bytes, at + 12 + size) == masked(event));
    events.push_back(parsed(event));
    at += size + 16;
  }
  return events;
}

}  // namespace

TEST_CASE("scalars and images stand in records with checksums") {
  const TemporaryFolder folder;
  EventFile file(folder.path(), "training");
  CHECK_THAT(file.path().filename().string(), Catch::StartsWith("events.out.tfevents."));
  file.add_scalar("training/loss", 1, 0.5);
  file.add_scalar("training/loss", 2, 0.25);
  file.add_image("half-spheres", 2, {1, 2, {1, 2, 3, 4, 5, 6}});
  const auto events = read_events(file.path());  // while it is open
  REQUIRE(events.size() == 4);
  CHECK(events[0].version == "brain.Event:2");
  CHECK(events[2].tag == "training/loss");
  CHECK(events[2].step == 2);
  CHECK(events[2].value == 0.25f);
  CHECK_THAT(events[3].image, Catch::StartsWith("\x89PNG"));
}

TEST_CASE("events that the disk does not take are an error that names the file") {
  // A limit on file sizes fails like a full disk.
  const TemporaryFolder folder;
  EventFile scalars(folder.path(), "scalars"), images(folder.path(), "images");
  Image noise{100, 100, std::vector<std::uint8_t>(3 * 100 * 100)};
  unsigned state = 1;
  for (auto& byte : noise.rgb) byte = static_cast<std::uint8_t>((state = state * 1664525u + 1013904223u) >> 24);
  rlimit before;
  REQUIRE(::getrlimit(RLIMIT_FSIZE, &before) == 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{50, before.rlim_max};
  REQUIRE(::setrlimit(RLIMIT_FSIZE, &small) == 0);
  std::vector<std::string> messages;
  const auto add = [&](const std::function<void()>& write) {
    try {
      write();
    } catch (const Error& error) {
      messages.emplace_back(error.what());
    }
  };
  add([&] { scalars.add_scalar("loss", 1, 0.5); });
  add([&] { images.add_image("noise", 1, noise); });
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  CHECK(messages == std::vector<std::string>{scalars.path().string() + ": cannot be written: File too large",
                                             images.path().string() + ": cannot be written: File too large"});
}

TEST_CASE("a new file replaces those of the same writer, and no others") {
  const TemporaryFolder folder;
  folder.write("events.out.tfevents.1.training", "old");
  folder.write("events.out.tfevents.1.evaluation", "other");
  const EventFile file(folder.path(), "training");
  CHECK_FALSE(std::filesystem::exists(folder.path() / "events.out.tfevents.1.training"));
  CHECK(std::filesystem::exists(folder.path() / "events.out.tfevents.1.evaluation"));
  CHECK_THROWS_WITH(EventFile(folder.path() / "none", "training"), Catch::Contains("none"));
}
