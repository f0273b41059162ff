// The description of a model, which real files hold inside two layers of JSON, where mutations rarely survive. The
// input is its JSON, a line "%%", and a line "name size size …" for each tensor; the values of tensors are made up.
#include "fuzz_target.h"
#include "io/models/model_file.h"
#include "io/tensors/safetensors_header.h"
#include "predict/predictor.h"

using namespace svnet;
using namespace svnet::fuzz;

namespace {

std::string_view take_until(std::string_view& text, std::string_view end) {
  const std::string_view front = text.substr(0, text.find(end));
  text.remove_prefix(std::min(text.size(), front.size() + end.size()));
  return front;
}

/// A tensor of at most 65,536 elements; none for a line that is not understood.
std::optional<io::SafetensorsEntry> entry_in(std::string_view line, std::uint64_t begin) {
  io::SafetensorsEntry entry{.name = std::string(take_until(line, " ")), .dtype = "F32", .shape = {}};
  std::uint64_t count = 1;
  while (!line.empty()) {
    const int size = std::atoi(std::string(take_until(line, " ")).c_str());
    if (size < 0 || size > 65536 || (count *= static_cast<std::uint64_t>(size)) > 65536) return {};
    entry.shape.push_back(size);
  }
  entry.begin = begin;
  entry.end = begin + 4 * count;
  return entry;
}

std::string model_file(Bytes input) {
  std::string_view text = text_of(input);
  io::SafetensorsHeader header{.entries = {}, .metadata = {{"svnet", std::string(take_until(text, "\n%%\n"))}}};
  std::uint64_t size = 0;
  while (!text.empty() && header.entries.size() < 64)
    if (auto entry = entry_in(take_until(text, "\n"), size)) {
      size = entry->end;
      header.entries.push_back(std::move(*entry));
    }
  const std::string json = io::safetensors_header_text("input", header);
  std::string file(8, '\0');
  for (std::size_t i = 0; i < 8; ++i) file[i] = static_cast<char>(json.size() >> 8 * i & 0xff);
  file += json;
  for (std::uint64_t i = 0; i < size; ++i) file += i % 4 == 3 ? '\x3d' : static_cast<char>(i % 128);
  return file;
}

}  // namespace

SVNET_FUZZ_TARGET(model_description) {
  if (input.size() > 65536) return;
  accept([&] {
    const std::string file = model_file(input);
    const Model model = io::parse_model("input", std::as_bytes(std::span(file)));
    const predict::Predictor predictor(model);
    if (predictor.feature_count() > 65536) return;
    const Tensor features = Tensor::zeros({1, predictor.feature_count()});
    predictor.scores(features, std::vector<view::CameraPose>{{90, 90}, {10, 45}});
  });
}
