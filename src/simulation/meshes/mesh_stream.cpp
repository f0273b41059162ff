#include "mesh_stream.h"

#include <algorithm>
#include <cstring>

#include "mesh_check.h"

namespace svnet::simulation {
namespace {

using sandbox::Channel;
using sandbox::Child;
using sandbox::Message;

// Both ends are the same program, so values travel as they lie in memory: numbers, arrays of them and Eigen's vectors
// of fixed size.

class MeshWriter {
 public:
  explicit MeshWriter(Channel& channel) : channel_(channel), room_(channel.room()) {}

  void bytes(const void* from, std::size_t size) {
    const auto* next = static_cast<const std::byte*>(from);
    while (size > 0) {
      const std::size_t part = std::min(size, room_.size() - used_);
      std::memcpy(room_.data() + used_, next, part);
      used_ += part, next += part, size -= part;
      if (used_ == room_.size()) {
        send();
        room_ = channel_.room();
      }
    }
  }
  template <class T>
  void operator()(const T& value) {
    bytes(&value, sizeof value);
  }
  template <class T>
  void operator()(const std::vector<T>& values) {
    (*this)(std::uint64_t{values.size()});
    bytes(values.data(), values.size() * sizeof(T));
  }
  void send() { channel_.send_room(kMeshBytes, std::exchange(used_, 0)); }

 private:
  Channel& channel_;
  std::span<std::byte> room_;
  std::size_t used_ = 0;
};

class MeshReceiver {
 public:
  MeshReceiver(Child& child, std::span<const std::byte> first) : child_(child), left_(first) {}

  bool is_good() const { return good_; }
  bool is_at_end() const { return left_.empty(); }

  void bytes(void* to, std::size_t size) {
    auto* next = static_cast<std::byte*>(to);
    while (size > 0) {
      if (left_.empty()) {
        const Message message = child_.receive();
        if (message.kind != kMeshBytes || message.bytes.empty()) child_.refuse_answer();
        left_ = message.bytes;
      }
      const std::size_t part = std::min(size, left_.size());
      std::memcpy(next, left_.data(), part);
      left_ = left_.subspan(part), next += part, size -= part;
    }
  }
  template <class T>
  void operator()(T& value) {
    bytes(&value, sizeof value);
  }
  template <class T>
  void operator()(std::vector<T>& values, std::size_t most) {
    std::uint64_t count = 0;
    (*this)(count);
    good_ = good_ && count <= most;
    constexpr std::size_t kStep = std::size_t{1} << 20;
    for (std::size_t done = 0; good_ && done < count; done = values.size()) {
      values.resize(std::min<std::size_t>(count, done + kStep / sizeof(T)));
      bytes(values.data() + done, (values.size() - done) * sizeof(T));
    }
  }

 private:
  Child& child_;
  std::span<const std::byte> left_;
  bool good_ = true;
};

constexpr std::size_t kMostMaterials = 1'000'000, kMostImages = 100'000;

/// All fields of a material, in turn.
template <class Stream, class AnyMaterial>
void pass_material(Stream& stream, AnyMaterial& m) {
  int metal = m.metal ? 1 : 0;
  stream(m.colour), stream(m.second), stream(m.texture), stream(m.scale_m), stream(m.gloss), stream(m.sharpness);
  stream(metal), stream(m.clear), stream(m.image), stream(m.wrap), stream(m.metal_image), stream(m.metal_factor);
  if constexpr (!std::is_const_v<AnyMaterial>) m.metal = metal != 0;
}

}  // namespace

void send_mesh(Channel& channel, const Mesh& mesh) {
  MeshWriter write(channel);
  write(mesh.points), write(mesh.triangles), write(mesh.normals), write(mesh.uv), write(mesh.metal_uv);
  write(mesh.tints);
  write(std::uint64_t{mesh.materials.size()});
  for (const Material& material : mesh.materials) pass_material(write, material);
  write(std::uint64_t{mesh.images.size()});
  for (const Image& image : mesh.images) write(image.height), write(image.width), write(image.rgb);
  write.send();
}

std::optional<Mesh> receive_mesh(Child& child, const Message& first) {
  Mesh mesh;
  MeshReceiver read(child, first.bytes);
  read(mesh.points, 3 * kMostTriangles), read(mesh.triangles, kMostTriangles), read(mesh.normals, kMostTriangles);
  read(mesh.uv, kMostTriangles), read(mesh.metal_uv, kMostTriangles), read(mesh.tints, kMostTriangles);
  std::uint64_t materials = 0, images = 0;
  if (!read.is_good()) return std::nullopt;
  read(materials);
  for (std::uint64_t i = 0; i < materials; ++i) {
    if (i == kMostMaterials) return std::nullopt;
    pass_material(read, mesh.materials.emplace_back());
  }
  read(images);
  std::size_t bytes = 0;
  for (std::uint64_t i = 0; i < images; ++i) {
    if (i == kMostImages) return std::nullopt;
    Image& image = mesh.images.emplace_back();
    read(image.height), read(image.width), read(image.rgb, 3 * static_cast<std::size_t>(kMostTexturePixels) - bytes);
    if (!read.is_good()) return std::nullopt;
    bytes += image.rgb.size();
  }
  if (!read.is_at_end()) return std::nullopt;
  return mesh;
}

}  // namespace svnet::simulation
