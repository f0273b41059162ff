#include "io/files/file_format.h"

#include <algorithm>
#include <fstream>

#include "base/text.h"

namespace svnet::io {
namespace {

using namespace std::string_view_literals;

constexpr std::size_t kLookedAt = 512;

struct Signature {
  std::string_view start, meaning;
};

constexpr Signature kBinary[] = {
    {"\x89HDF\r\n\x1a\n"sv, "an HDF5 file"},
    {"\x1f\x8b"sv, "compressed by gzip; decompress it: 'gunzip'"},
    {"BZh"sv, "compressed by bzip2; decompress it: 'bunzip2'"},
    {"\xfd"
     "7zXZ\0"sv,
     "compressed by xz; decompress it: 'unxz'"},
    {"\x28\xb5\x2f\xfd"sv, "compressed by zstd; decompress it: 'unzstd'"},
    {"\x89PNG\r\n\x1a\n"sv, "a PNG image"},
    {"\xff\xd8\xff"sv, "a JPEG image"},
    {"GIF8"sv, "a GIF image; convert it to PNG"},
    {"II*\0"sv, "a TIFF image; convert it to PNG"},
    {"MM\0*"sv, "a TIFF image; convert it to PNG"},
    {"\x93NUMPY"sv, "a NumPy array (.npy)"},
    {"\xff\xfe"sv, "text in UTF-16; save it as UTF-8"},
    {"\xfe\xff"sv, "text in UTF-16; save it as UTF-8"},
    {"%PDF-"sv, "a PDF document"},
    {"\x80\x02"sv, "a Python pickle, such as PyTorch writes"},
    {"\x80\x04"sv, "a Python pickle, such as PyTorch writes"},
};

/// In lower case, after a byte order mark and white space.
constexpr Signature kText[] = {
    {"version https://git-lfs"sv, "a Git LFS pointer; get the file itself by 'git lfs pull'"},
    {"<!doctype html"sv, "a web page (HTML), as a failed download leaves it; download the file again"},
    {"<html"sv, "a web page (HTML), as a failed download leaves it; download the file again"},
    {"<?xml"sv, "an XML text, as a failed download leaves it; download the file again"},
};

/// By the name of the first member, which is in the archive's first bytes.
std::string_view meaning_of_zip(std::string_view bytes) {
  constexpr std::size_t kHeader = 30;
  const auto byte = [&](std::size_t at) { return std::size_t{static_cast<unsigned char>(bytes[at])}; };
  const std::string_view first =
      bytes.size() < kHeader ? std::string_view() : bytes.substr(kHeader, byte(26) + 256 * byte(27));
  if (first.ends_with("data.pkl") || first.ends_with(".format_version"))
    return "weights of PyTorch, which are not read; save them with Keras";
  if (first.ends_with(".npy")) return "an archive of NumPy arrays (.npz)";
  return "a zip archive; if it is a .keras file, take model.weights.h5 out of it: 'unzip'";
}

std::string_view meaning_of(std::string_view bytes) {
  if (bytes.empty()) return "empty";
  if (bytes.starts_with("PK\x03\x04")) return meaning_of_zip(bytes);
  if (bytes.substr(std::min<std::size_t>(4, bytes.size())).starts_with("ftyp"))
    return "an HEIC or AVIF image, or a video; convert it to PNG or JPEG";
  for (const Signature& signature : kBinary)
    if (bytes.starts_with(signature.start)) return signature.meaning;
  if (bytes.size() > 9 && bytes.substr(4, 5) == "\0\0\0\0{"sv && "\"} \n"sv.find(bytes[9]) != std::string_view::npos)
    return "a safetensors file";
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
  bytes.remove_prefix(std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size()));
  const std::string text = lower_case(bytes);
  for (const Signature& signature : kText)
    if (text.starts_with(signature.start)) return signature.meaning;
  return {};
}

}  // namespace

std::string recognised_instead(std::string_view first_bytes) {
  const std::string_view meaning = meaning_of(first_bytes.substr(0, kLookedAt));
  return meaning.empty() ? std::string() : ", but " + std::string(meaning);
}

std::string recognised_instead(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return {};
  std::string bytes(kLookedAt, '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(stream.gcount()));
  return recognised_instead(std::string_view(bytes));
}

}  // namespace svnet::io
