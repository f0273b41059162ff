// Answers to a reader of HDF5 that come from a process which an attacker may have taken over: what makes no sense is
// refused.
#include <array>
#include <catch2/catch.hpp>
#include <filesystem>
#include <new>

#include "base/error.h"
#include "io/hdf5/collected.h"
#include "io/hdf5/limits.h"
#include "io/hdf5/remote_file.h"
#include "io/hdf5/wire.h"
#include "sandbox/child.h"

using namespace svnet;
using namespace svnet::io::hdf5;

namespace {

using Shape = std::vector<std::uint64_t>;
using Texts = std::vector<std::string>;

const std::string kRefusal =
    "a.h5: the HDF5 library gave an answer that makes no sense; the file is damaged or was made to attack";
constexpr std::uint64_t kFileSize = 1000;

Collected collected() { return {"a.h5", kFileSize}; }

template <class T>
std::span<const std::byte> bytes_of(const std::vector<T>& values) {
  return std::as_bytes(std::span(values));
}

}  // namespace

TEST_CASE("an answer of one truth is taken once") {
  Collected answer = collected();
  CHECK_THROWS_WITH(answer.take_truth(), kRefusal);
  answer.truth(true);
  CHECK(answer.take_truth());
  CHECK_THROWS_WITH(answer.truth(true), kRefusal);
}

TEST_CASE("a shape is one that a file of this size can hold") {
  const auto shape_of = [](const Shape& shape) {
    Collected answer = collected();
    answer.shape(shape);
    return answer.take_shape();
  };
  CHECK(shape_of({}).empty());
  CHECK(shape_of({2, 3}) == std::vector<Index>{2, 3});
  CHECK(shape_of({0, kLargestBytes}) == std::vector<Index>{0, static_cast<Index>(kLargestBytes)});
  CHECK(shape_of(Shape(32, 1)).size() == 32);
  CHECK_THROWS_WITH(shape_of(Shape(33, 1)), kRefusal);
  CHECK_THROWS_WITH(shape_of({kLargestBytes + 1}), kRefusal);
  CHECK_THROWS_WITH(shape_of({0, kLargestBytes + 1}), kRefusal);
  CHECK_THROWS_WITH(shape_of({largest_decoded(kFileSize), 2}), kRefusal);
  CHECK_THROWS_WITH(shape_of({std::uint64_t{1} << 32, std::uint64_t{1} << 32}), kRefusal);

  Collected answer = collected();
  CHECK_THROWS_WITH(answer.take_shape(), kRefusal);
  answer.shape(Shape{1});
  CHECK_THROWS_WITH(answer.shape(Shape{1}), kRefusal);
}

TEST_CASE("texts are as many as the shape says, plain, and not longer than the file allows") {
  Collected names = collected();  // without a shape, as the members of a group
  names.texts(Texts{"a", "b"});
  CHECK_THROWS_WITH(names.take_text(), kRefusal);
  CHECK(names.take_texts() == Texts{"a", "b"});
  CHECK_THROWS_WITH(collected().take_text(), kRefusal);

  Collected values = collected();
  values.shape(Shape{2});
  values.texts(Texts{"a"});
  CHECK_THROWS_WITH(values.take_texts(), kRefusal);
  CHECK_THROWS_WITH(values.texts(Texts{"\xff"}), kRefusal);
  values.texts(Texts{"b"});
  CHECK_THROWS_WITH(values.texts(Texts{"c"}), kRefusal);
  CHECK(values.take_texts() == Texts{"a", "b"});

  Collected endless = collected();
  const Texts large{std::string(largest_decoded(kFileSize), 'x')};
  CHECK_THROWS_WITH(endless.texts(large), kRefusal);
}

TEST_CASE("numbers are whole, after their shape, and as many as it says") {
  CHECK_THROWS_WITH(collected().values({}), kRefusal);
  const auto numbers_of = [](const Shape& shape, std::span<const std::byte> bytes) {
    CollectedNumbers<double> answer("a.h5", kFileSize);
    answer.shape(shape);
    answer.values(bytes);
    return answer.take_numbers();
  };
  const std::vector<double> two{1.5, -2};
  CHECK(numbers_of({2}, bytes_of(two)) == two);
  CHECK_THROWS_WITH(numbers_of({1}, bytes_of(two)), kRefusal);
  CHECK_THROWS_WITH(numbers_of({3}, bytes_of(two)), kRefusal);
  CHECK_THROWS_WITH(numbers_of({2}, bytes_of(two).first(15)), kRefusal);
  CHECK_THROWS_WITH(numbers_of({1}, bytes_of(two).subspan(4, 8)), kRefusal);

  CollectedNumbers<double> answer("a.h5", kFileSize);
  CHECK_THROWS_WITH(answer.values(bytes_of(two)), kRefusal);
  CHECK_THROWS_WITH(answer.take_number(), kRefusal);
  answer.shape(Shape{2});
  answer.values(bytes_of(two));
  CHECK_THROWS_WITH(answer.take_number(), kRefusal);
}

namespace {

const std::string kChildsRefusal = kRefusal + ", and nothing outside its process was touched";

/// The numbers of kinds of messages (wire.cpp).
enum MessageKind : std::uint32_t { kRequest, kTruth, kShape, kTextPart, kTextEnd, kTexts, kValues, kEnd, kError };

/// What is collected of a child that takes any request and then sends what `lie` sends.
template <class Lie>
Collected answer_of(const Lie& lie) {
  sandbox::Child child({"a.h5", "the HDF5 library"}, {}, {}, [&](sandbox::Channel& channel) {
    channel.receive();
    lie(channel);
    channel.receive();
  });
  Collected answer = collected();
  const std::string error = ask(child, {.ask = Ask::has, .object = "x"}, answer);
  if (!error.empty()) fail(error);
  return answer;
}

std::span<const std::byte> bytes(std::string_view text) { return std::as_bytes(std::span(text)); }

}  // namespace

TEST_CASE("a reader takes an answer piece by piece to its end") {
  CHECK(answer_of([](sandbox::Channel& channel) {
          channel.send(kTruth, bytes("\1"));
          channel.send(kEnd, {});
        }).take_truth());
  // A truth is one byte; anything else is false.
  CHECK_FALSE(answer_of([](sandbox::Channel& channel) {
                channel.send(kTruth, bytes("\1\1"));
                channel.send(kEnd, {});
              }).take_truth());
  CHECK(answer_of([](sandbox::Channel& channel) {
          channel.send(kTexts, bytes(std::string_view("a\0b", 3)));
          channel.send(kTextPart, bytes("lo"));
          channel.send(kTextPart, bytes("ng"));
          channel.send(kTextEnd, {});
          channel.send(kEnd, {});
        }).take_texts() == Texts{"a", "b", "long"});
  CHECK_THROWS_WITH(answer_of([](sandbox::Channel& channel) { channel.send(kError, bytes("a.h5: \x1b[31mdamaged")); }),
                    Catch::StartsWith("a.h5: ") && Catch::EndsWith("[31mdamaged") && !Catch::Contains("\x1b"));
}

TEST_CASE("an answer of a kind that nobody asked for is refused") {
  CHECK_THROWS_WITH(answer_of([](sandbox::Channel& channel) { channel.send(kRequest, {}); }), kChildsRefusal);
  CHECK_THROWS_WITH(answer_of([](sandbox::Channel& channel) { channel.send(99, {}); }), kChildsRefusal);
  CHECK_THROWS_WITH(answer_of([](sandbox::Channel& channel) { channel.send(kValues, bytes("12345678")); }), kRefusal);
}

TEST_CASE("a text without end is refused") {
  CHECK_THROWS_WITH(answer_of([](sandbox::Channel& channel) {
                      const std::string part(std::size_t{1} << 16, 'x');
                      for (std::uint64_t sent = 0; sent <= kLargestText; sent += part.size())
                        channel.send(kTextPart, bytes(part));
                    }),
                    kChildsRefusal);
}

TEST_CASE("a request that breaks the protocol ends the process that reads files") {
  const auto outcome_of = [](std::uint32_t kind, const std::string& request) {
    sandbox::Child child({"a.h5", "the HDF5 library"}, {}, {}, [](sandbox::Channel& channel) {
      std::string outcome = "refused";
      try {
        const Request got = receive_request(channel);
        outcome = got.object + "/" + got.attribute;
      } catch (const sandbox::ChannelClosed&) {  // NOLINT(bugprone-empty-catch): said by `outcome`
      }
      channel.send(kEnd, bytes(outcome));
      channel.receive();
    });
    child.send(kind, bytes(request));
    const auto answer = child.receive();
    return std::string(reinterpret_cast<const char*>(answer.bytes.data()), answer.bytes.size());
  };
  // Ask::attribute, As::text, the length of the object's name, the names.
  const auto request = [](char length) {
    return std::string("\6\0\0\0\4\0\0\0", 8) + length + std::string(7, '\0') + "fc1unit";
  };
  CHECK(outcome_of(kRequest, request(3)) == "fc1/unit");
  CHECK(outcome_of(kRequest, request(7)) == "fc1unit/");
  CHECK(outcome_of(kRequest, request(8)) == "refused");
  CHECK(outcome_of(kTruth, request(3)) == "refused");
  CHECK(outcome_of(kRequest, "short") == "refused");
}

TEST_CASE("after an answer that could not be taken, a file is not asked again") {
  struct Full : Collected {
    using Collected::Collected;
    void truth(bool) override { throw std::bad_alloc(); }
  };
  const std::string path = SVNET_FIXTURES "/io/h5py.h5";
  const auto size = std::filesystem::file_size(path);
  const Request request{.ask = Ask::has, .object = "packed"};
  RemoteFile file(path, size), other(path, size);
  Collected answer(path, size), twice(path, size);
  file.answer(request, answer);
  CHECK(answer.take_truth());
  Full full(path, size);
  CHECK_THROWS_AS(file.answer(request, full), std::bad_alloc);
  CHECK_THROWS_AS(file.answer(request, twice), std::bad_alloc);

  twice.truth(true);
  const std::string refusal = path + kRefusal.substr(4);
  CHECK_THROWS_WITH(other.answer(request, twice), refusal);
  CHECK_THROWS_WITH(other.answer(request, answer), refusal);
}
