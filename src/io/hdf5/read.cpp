#include <type_traits>

#include "io/hdf5/collected.h"
#include "io/hdf5/hdf5_file.h"
#include "io/hdf5/open_file.h"

namespace svnet::io {
namespace {

using hdf5::As;
using hdf5::Ask;
using hdf5::Request;

template <class T>
constexpr As as() {
  if constexpr (std::is_same_v<T, float>) {
    return As::real32;
  } else if constexpr (std::is_same_v<T, double>) {
    return As::real64;
  } else if constexpr (std::is_same_v<T, std::int64_t>) {
    return As::signed64;
  } else if constexpr (std::is_same_v<T, std::uint64_t>) {
    return As::unsigned64;
  } else {
    static_assert(std::is_same_v<T, std::string>);
    return As::text;
  }
}

/// `Sink`: Collected, or CollectedNumbers.
template <class Sink = hdf5::Collected>
Sink answer(const hdf5::OpenFile& file, const Request& request) {
  Sink sink(file.here.name, file.here.size);
  file.answer(request, sink);
  return sink;
}

}  // namespace

bool Hdf5File::has(const std::string& object) const {
  return answer(*state_, {.ask = Ask::has, .object = object}).take_truth();
}

bool Hdf5File::is_group(const std::string& object) const {
  return answer(*state_, {.ask = Ask::is_group, .object = object}).take_truth();
}

std::vector<std::string> Hdf5File::members(const std::string& group) const {
  return answer(*state_, {.ask = Ask::members, .object = group}).take_texts();
}

std::vector<Index> Hdf5File::shape(const std::string& dataset) const {
  return answer(*state_, {.ask = Ask::shape, .object = dataset}).take_shape();
}

template <class T>
Hdf5Array<T> Hdf5File::read(const std::string& dataset) const {
  const Request request{.ask = Ask::dataset, .as = as<T>(), .object = dataset};
  if constexpr (std::is_same_v<T, std::string>) {
    auto found = answer(*state_, request);
    std::vector<T> texts = found.take_texts();
    return {found.take_shape(), std::move(texts)};
  } else {
    auto found = answer<hdf5::CollectedNumbers<T>>(*state_, request);
    std::vector<T> numbers = found.take_numbers();
    return {found.take_shape(), std::move(numbers)};
  }
}

template Hdf5Array<float> Hdf5File::read(const std::string&) const;
template Hdf5Array<double> Hdf5File::read(const std::string&) const;
template Hdf5Array<std::int64_t> Hdf5File::read(const std::string&) const;
template Hdf5Array<std::uint64_t> Hdf5File::read(const std::string&) const;
template Hdf5Array<std::string> Hdf5File::read(const std::string&) const;

bool Hdf5File::has_attribute(const std::string& object, const std::string& name) const {
  return answer(*state_, {.ask = Ask::has_attribute, .object = object, .attribute = name}).take_truth();
}

std::string Hdf5File::text_attribute(const std::string& object, const std::string& name) const {
  return answer(*state_, {.ask = Ask::attribute, .object = object, .attribute = name}).take_text();
}

std::vector<std::string> Hdf5File::text_list_attribute(const std::string& object, const std::string& name) const {
  return answer(*state_, {.ask = Ask::list, .object = object, .attribute = name}).take_texts();
}

template <class T>
T Hdf5File::number_attribute(const std::string& object, const std::string& name) const {
  return answer<hdf5::CollectedNumbers<T>>(*state_,
                                           {.ask = Ask::attribute, .as = as<T>(), .object = object, .attribute = name})
      .take_number();
}

template double Hdf5File::number_attribute(const std::string&, const std::string&) const;
template std::int64_t Hdf5File::number_attribute(const std::string&, const std::string&) const;
template std::uint64_t Hdf5File::number_attribute(const std::string&, const std::string&) const;

}  // namespace svnet::io
