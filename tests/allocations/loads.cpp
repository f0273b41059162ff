#include "loads.h"

#include <cstring>
#include <fstream>
#include <iterator>
#include <new>
#include <set>
#include <span>
#include <stdexcept>
#include <string_view>

#include "base/error.h"
#include "image/oriented.h"
#include "io/files/atomic_file.h"
#include "io/files/whole_file.h"
#include "io/images/depth_file.h"
#include "io/images/image_codecs.h"
#include "io/images/image_file.h"
#include "io/images/texture_image.h"
#include "io/keras/keras_weights.h"
#include "io/models/checkpoint.h"
#include "io/models/model_file.h"
#include "io/tensors/safetensors.h"
#include "io/views/camera_file.h"
#include "io/views/dataset_folder.h"
#include "io/views/features_file.h"
#include "io/views/pose_list_file.h"
#include "io/views/scores_file.h"
#include "sandbox/mode.h"
#include "simulation/meshes/mesh_file.h"
#include "svnet/svnet.h"
#include "train/config/config_file.h"

namespace svnet::allocations {
namespace {

namespace fs = std::filesystem;

/// FNV-1a over what a loader returned. Allocates nothing.
class Digest {
 public:
  template <class T>
  requires std::is_trivially_copyable_v<T> Digest& add(const T& value) { return add_bytes(&value, sizeof value); }
  Digest& add(std::string_view text) { return add_bytes(text.data(), text.size()); }
  Digest& add(const std::string& text) { return add(std::string_view(text)); }
  template <class T>
  Digest& add(const std::vector<T>& values) {
    for (const T& value : values) add(value);
    return add(values.size());
  }
  Digest& add(const Parameters& parameters) {
    for (const auto& [name, tensor] : parameters.items())
      add(name).add_bytes(tensor.data<float>(), static_cast<std::size_t>(tensor.size()) * sizeof(float));
    return *this;
  }
  Digest& add_bytes(const void* bytes, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i)
      value_ = (value_ ^ static_cast<const unsigned char*>(bytes)[i]) * 0x100000001b3u;
    return *this;
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

std::uint64_t digest(const Image& image) { return Digest().add(image.height).add(image.width).add(image.rgb).value(); }

std::uint64_t digest(const simulation::Mesh& mesh) {
  Digest all;
  for (const auto& point : mesh.points) all.add_bytes(point.data(), sizeof(float) * 3);
  for (const auto& triangle : mesh.triangles) all.add(triangle.corner).add(triangle.material);
  for (const auto& corners : mesh.normals)
    for (const auto& normal : corners) all.add_bytes(normal.data(), sizeof(float) * 3);
  for (const auto& material : mesh.materials)
    all.add_bytes(material.colour.data(), sizeof(float) * 3).add(material.image);
  for (const Image& image : mesh.images) all.add(image.rgb);
  return all.value();
}

std::uint64_t digest(const Model& model) {
  return Digest().add(model.backbone).add(model.backbone_parameters).add(model.head_parameters).value();
}

/// The status of a function of svnet.h as the exception that it stands for.
void checked(svnet_status status) {
  if (status == SVNET_OK) return;
  if (status == SVNET_OUT_OF_MEMORY) throw std::bad_alloc();
  if (status == SVNET_INTERNAL_ERROR) throw std::runtime_error(svnet_last_error());
  throw Error(svnet_last_error());
}

std::uint64_t load_by_c(const fs::path& path) {
  struct Owner {
    svnet_model* model = nullptr;
    ~Owner() { svnet_model_free(model); }
  } owner;
  checked(svnet_model_load(path.c_str(), &owner.model));
  constexpr std::int32_t kSide = 24;
  std::vector<std::uint8_t> pixels(kSide * kSide * 3, 200);
  for (std::size_t i = 0; i < pixels.size() / 3; i += 2) pixels[i] = static_cast<std::uint8_t>(i);
  const std::vector<float> depth(kSide * kSide, 0.5f);
  std::vector<float> features(svnet_feature_count(owner.model));
  checked(svnet_embed_with_depth(owner.model, pixels.data(), kSide, kSide, kSide * 3, SVNET_RGB8, depth.data(),
                                 features.data()));
  const double poses[] = {90, 90, 30, 45, 200, 0};
  float scores[3];
  checked(svnet_score(owner.model, features.data(), poses, 3, scores));
  return Digest().add(features).add(scores[0]).add(scores[1]).add(scores[2]).value();
}

std::uint64_t load_keras(const fs::path& path) {
  const io::KerasWeightsFile file(path);
  Digest all;
  for (const io::KerasLayer& layer : file.layers())
    for (const io::KerasArray& array : layer.arrays) all.add(array.name).add(file.values(array));
  return all.value();
}

std::uint64_t load_features(const fs::path& path) {
  const Features features = io::read_features(path);
  return Digest().add(features.backbone).add(features.values).add(features.theta_phi_deg).add(features.paths).value();
}

std::uint64_t load_scores(const fs::path& path) {
  const Scores scores = io::read_scores(path);
  return Digest().add(scores.clustering).add(scores.individual).add(scores.count).add(scores.paths).value();
}

std::uint64_t load_snapshot(const fs::path& path) {
  const io::ScoresSnapshot snapshot = io::read_scores_snapshot(path);
  return Digest().add(snapshot.input_fingerprint).add(snapshot.problems).add(snapshot.sums).value();
}

std::uint64_t load_safetensors(const fs::path& path) {
  const io::SafetensorsFile file(path);
  Digest all;
  for (const io::SafetensorsTensor& tensor : file.tensors())
    all.add(tensor.name).add_bytes(tensor.bytes.data(), tensor.bytes.size());
  for (const auto& [key, text] : file.metadata()) all.add(key).add(text);
  return all.value();
}

std::uint64_t load_config(const fs::path& path) {
  const std::string root[] = {"dataset.root=data", "scores.problems=100"};
  return Digest().add(train::to_yaml(train::read_config(path, root))).value();
}

std::uint64_t load_camera(const fs::path& path) { return Digest().add(io::camera_json(io::read_camera(path))).value(); }

std::uint64_t load_poses(const fs::path& path) {
  Digest all;
  for (const view::CameraPose& pose : io::read_pose_list(path)) all.add(pose.theta_deg).add(pose.phi_deg);
  return all.value();
}

std::uint64_t load_depth(const fs::path& path) { return Digest().add(io::read_depth(path).metres).value(); }

std::uint64_t load_picture(const fs::path& path) { return digest(io::read_image(path, ExifOrientation::obey)); }

std::uint64_t load_texture(const fs::path& path) {
  const auto contents = io::image_contents(path);
  return digest(io::decode_texture(contents[0] % 2 == 0 ? "a.tga" : "a.png", std::span(contents).subspan(1)));
}

std::uint64_t load_mesh(const fs::path& path) { return digest(simulation::read_mesh(path)); }

std::uint64_t load_dataset(const fs::path& path) {
  Digest all;
  for (const View& view : io::read_view_dataset(path).views) all.add(view.path).add(view.theta_deg);
  return all.value();
}

using Loader = std::uint64_t (*)(const fs::path&);

std::function<std::uint64_t()> in_mode(sandbox::Mode mode, Loader loader, const fs::path& path) {
  return [=] {
    sandbox::set_mode(mode);
    return loader(path);
  };
}

/// A loader that needs no library's process.
Load plain(const std::string& format, Loader loader, const fs::path& path) {
  return {format + " " + path.filename().string(), in_mode(sandbox::Mode::on, loader, path)};
}

/// All files of a folder that can be read: some seeds are none.
void add_readable(std::vector<Load>& loads, const std::string& format, Loader loader, const fs::path& folder) {
  std::set<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(folder)) paths.insert(entry.path());
  const std::size_t before = loads.size();
  for (const fs::path& path : paths) try {
      loader(path);
      loads.push_back(plain(format, loader, path));
    } catch (const Error&) {
    }
  check(loads.size() > before, folder.string(), ": has no file that can be read");
}

/// One that decodes in a child process: while allocations of this process fail, while those of the child do, and
/// without a child.
void add_decoded(std::vector<Load>& loads, const std::string& format, Loader loader, const fs::path& path) {
  const std::string name = format + " " + path.filename().string();
  loads.push_back({name, in_mode(sandbox::Mode::on, loader, path)});
  loads.push_back({name + ", in the child", in_mode(sandbox::Mode::on, loader, path), Where::children});
  loads.push_back({name + ", --sandbox off", in_mode(sandbox::Mode::off, loader, path), Where::here, true});
}

/// A file that is written in a folder of its own: it stays what it was, or becomes what it shall be, and is alone.
Load written(const std::string& name, const fs::path& folder, const std::function<void(const fs::path&)>& write) {
  fs::create_directories(folder);
  const fs::path path = folder / "file";
  write(path);
  const std::string whole = io::whole_file(path);
  const std::string before = "what was there before";
  const auto put_before = [=] { std::ofstream(path, std::ios::binary) << before; };
  put_before();
  return {name,
          [=] { return write(path), std::uint64_t{0}; },
          Where::here,
          true,
          false,
          [=] {
            const auto count = std::distance(fs::directory_iterator(folder), fs::directory_iterator());
            const std::string contents = io::whole_file(path);
            put_before();
            if (count != 1) return joined("there are ", count, " files");
            return contents == whole || contents == before ? std::string() : "the file is partial";
          }};
}

void write_bytes(const fs::path& path, const std::string& contents) {
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << contents;
}

void add_meshes(std::vector<Load>& loads, const fs::path& seeds, const fs::path& work) {
  const std::string png = io::encoded_png("png", Image{2, 2, std::vector<std::uint8_t>(12, 80)});
  write_bytes(work / "m.mtl", "newmtl skin\nKd 1 0.5 0\nmap_Kd a.png\n");
  write_bytes(work / "a.png", png);
  for (const char* mesh : {"mesh_obj/square", "mesh_ply/text", "mesh_ply/little", "mesh_stl/binary", "mesh_stl/text",
                           "mesh_gltf/textured", "mesh_gltf/json"}) {
    const std::string format = fs::path(mesh).parent_path().string().substr(5);
    const bool is_json = std::string_view(mesh).ends_with("json");
    const std::string ending = format == "gltf" && !is_json ? "glb" : format;
    const fs::path path = work / (fs::path(mesh).filename().string() + "." + ending);
    write_bytes(path, io::whole_file(seeds / mesh));
    add_decoded(loads, ending, load_mesh, path);
  }
}

void add_writers(std::vector<Load>& loads, const fs::path& seeds, const fs::path& work) {
  sandbox::set_mode(sandbox::Mode::off);
  const Model model = io::read_model(seeds / "c_api/turned_int8");
  loads.push_back(
      written("write a model", work / "model", [=](const fs::path& path) { io::write_model(path, model); }));
  const Features features = io::read_features(seeds / "hdf5_tables/features");
  loads.push_back(
      written("write features", work / "features", [=](const fs::path& path) { io::write_features(path, features); }));
  const Scores scores = io::read_scores(seeds / "hdf5_tables/scores");
  loads.push_back(
      written("write scores", work / "scores", [=](const fs::path& path) { io::write_scores(path, scores); }));
  const Image image = io::read_image(seeds / "picture/written.png");
  loads.push_back(written("write a PNG", work / "png", [=](const fs::path& path) { io::write_png(path, image); }));
  loads.push_back(written("write a photograph as PNG", work / "photograph", [=](const fs::path& path) {
    io::write_atomically(path, io::encoded_png(path.string(), image, io::PngContent::photograph));
  }));
  DepthImage depth{64, 48, std::vector<float>(64 * 48)};
  for (std::size_t i = 0; i < depth.metres.size(); ++i) depth.metres[i] = 0.5f + 0.001f * static_cast<float>(i % 97);
  loads.push_back(written("write depth as PNG", work / "depth_png",
                          [=](const fs::path& path) { io::write_depth_png(path, depth); }));
  const std::vector<std::uint8_t> mask(64 * 48, 255);
  loads.push_back(written("write a mask as PNG", work / "mask", [=](const fs::path& path) {
    io::write_atomically(path, io::encoded_grey_png(path.string(), 64, 48, mask));
  }));
}

}  // namespace

std::vector<Load> all_loads(const fs::path& seeds, const fs::path& work) {
  checked(svnet_set_threads(1));
  std::vector<Load> loads;
  for (const char* model : {"radians_f32", "harmonics_bf16", "turned_int8", "depth_f32"}) {
    loads.push_back(plain("svnet_model_load", load_by_c, seeds / "c_api" / model));
    loads.back().destroys_json = true;
    loads.push_back({std::string("model ") + model, [=] { return digest(io::read_model(seeds / "c_api" / model)); }});
    loads.back().destroys_json = true;
  }
  loads.push_back(plain("safetensors", load_safetensors, seeds / "safetensors/turned"));
  loads.back().destroys_json = true;
  for (const char* keras : {"keras_legacy.h5", "keras3_nested.weights.h5"})
    add_decoded(loads, "Keras", load_keras, seeds / "keras" / keras);
  add_decoded(loads, "HDF5", load_features, seeds / "hdf5_tables/features");
  add_decoded(loads, "HDF5", load_scores, seeds / "hdf5_tables/scores");
  add_decoded(loads, "HDF5", load_snapshot, seeds / "hdf5_tables/snapshot");
  for (const char* config : {"short", "documented"}) {
    const fs::path path = work / (std::string(config) + ".yaml");
    write_bytes(path, io::whole_file(seeds / "config" / config));
    loads.push_back(plain("configuration", load_config, path));
  }
  for (const char* camera : {"plain", "posed", "realsense", "ros_message", "ros_file"})
    loads.push_back(plain("camera", load_camera, seeds / "camera" / camera));
  for (const char* poses : {"plain", "quoted"}) loads.push_back(plain("poses", load_poses, seeds / "poses" / poses));
  add_readable(loads, "depth", load_depth, seeds / "depth");
  add_readable(loads, "picture", load_picture, seeds / "picture");
  add_readable(loads, "texture", load_texture, seeds / "texture");
  for (const char* view : {"ball/0/1/90_90.png", "ball/0/1/45_0.png", "cube/1/1/90_90.png", "cube/1/1/0_359.jpg"})
    write_bytes(work / "dataset" / view, "");
  loads.push_back(plain("data set", load_dataset, work / "dataset"));
  add_meshes(loads, seeds, work / "meshes");
  add_writers(loads, seeds, work / "written");
  return loads;
}

}  // namespace svnet::allocations
