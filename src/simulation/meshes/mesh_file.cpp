#include "simulation/meshes/mesh_file.h"

#include <algorithm>
#include <assimp/Importer.hpp>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>
#include <utility>

#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include "base/error.h"
#include "base/text.h"
#include "io/images/image_codecs.h"
#include "io/images/image_file.h"
#include "ply_check.h"
#include "simulation/texture.h"

namespace svnet {
namespace {

namespace fs = std::filesystem;

/// In lower case.
std::string extension_of(const fs::path& path) { return lower_case(path.extension().string()); }

/// With "%20" and the like as the bytes that they stand for (RFC 3986, section 2.1).
std::string decoded_uri(std::string_view uri) {
  std::string result;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    std::uint8_t byte = 0;
    const char* digits = uri.data() + i + 1;
    if (uri[i] == '%' && i + 2 < uri.size() && std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2) {
      result += static_cast<char>(byte);
      i += 2;
    } else {
      result += uri[i];
    }
  }
  return result;
}

/// The texture `reference` of the scene: embedded, or a file beside the mesh.
Image texture(const aiScene& scene, const fs::path& mesh, const std::string& reference) {
  const std::string name = mesh.string() + ": texture '" + printable(reference) + "'";
  if (const aiTexture* embedded = scene.GetEmbeddedTexture(reference.c_str())) {
    check(embedded->mHeight == 0, name, ": is stored as bare pixels, expected a PNG or JPEG inside");
    const Bytes bytes(reinterpret_cast<const std::uint8_t*>(embedded->pcData), embedded->mWidth);
    if (has_bytes(bytes, 0, "\xff\xd8\xff")) return decode_jpeg(name, bytes);
    check(has_bytes(bytes, 0, "\x89PNG\r\n\x1a\n"), name, ": is neither a PNG nor a JPEG picture");
    return decode_png(name, bytes);
  }
  // Only from the mesh's own folder: a file must not make us read any path of this machine.
  std::string file = extension_of(mesh) == ".glb" ? decoded_uri(reference) : reference;
  for (char& c : file)
    if (c == '\\') c = '/';
  return read_image(mesh.parent_path() / fs::path(file).filename());
}

Material material_of(const aiScene& scene, const aiMaterial& from, const fs::path& path, Mesh& mesh) {
  Material material;
  aiColor3D colour(0.6f, 0.6f, 0.6f);
  if (from.Get(AI_MATKEY_BASE_COLOR, colour) != AI_SUCCESS) from.Get(AI_MATKEY_COLOR_DIFFUSE, colour);
  material.colour = material.second = Vec3(colour.r, colour.g, colour.b).cwiseMax(0.0f).cwiseMin(1.0f);
  float metallic = 0;
  if (from.Get(AI_MATKEY_METALLIC_FACTOR, metallic) == AI_SUCCESS) material.metal = metallic > 0.5f;
  aiString reference;
  for (const aiTextureType kind : {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE}) {
    if (material.texture == Texture::picture || from.GetTexture(kind, 0, &reference) != AI_SUCCESS) continue;
    material.texture = Texture::picture;
    material.picture = static_cast<int>(mesh.pictures.size());
    mesh.pictures.push_back(texture(scene, path, reference.C_Str()));
  }
  return material;
}

/// The part's material, or one of its own in the mean of its vertices' colours, which scanners write in place of
/// textures.
int material_of_part(const aiMesh& part, Mesh& mesh) {
  const auto number = static_cast<int>(part.mMaterialIndex);
  Material material = mesh.materials.at(part.mMaterialIndex);
  if (!part.HasVertexColors(0) || material.texture == Texture::picture) return number;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (unsigned v = 0; v < part.mNumVertices; ++v)
    for (int c = 0; c < 3; ++c) {
      const double level = 255.0 * static_cast<double>(part.mColors[0][v][static_cast<unsigned>(c)]);
      if (level >= 0)
        sum[c] += static_cast<double>(linear_from_srgb(static_cast<std::uint8_t>(std::min(std::round(level), 255.0))));
    }
  material.colour = material.second = (sum / part.mNumVertices).cast<float>();
  mesh.materials.push_back(material);
  return static_cast<int>(mesh.materials.size()) - 1;
}

std::string file_contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream contents;
  contents << file.rdbuf();
  return std::move(contents).str();
}

void check_corners(const aiScene& scene, const std::string& name) {
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& part = *scene.mMeshes[m];
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];
      check(face.mNumIndices > 0, name, ": face ", f, " of part ", m, " has no corners; is the file incomplete?");
      for (unsigned k = 0; k < face.mNumIndices; ++k)
        check(face.mIndices[k] < part.mNumVertices, name, ": face ", f, " of part ", m, " has a corner at point ",
              face.mIndices[k], " of ", part.mNumVertices);
    }
  }
}

}  // namespace

bool is_mesh_name(const fs::path& path) {
  const std::string extension = extension_of(path);
  return extension == ".obj" || extension == ".ply" || extension == ".stl" || extension == ".glb";
}

Mesh read_mesh(const fs::path& path, double metres_per_unit) {
  constexpr std::size_t kMostTriangles = 5'000'000;
  const std::string name = path.string();
  check(std::ifstream(path, std::ios::binary).good() && !fs::is_directory(path), name,
        ": cannot be read; expected a mesh (OBJ, PLY, STL or GLB)");
  check(is_mesh_name(path), name, ": is not named like a mesh; expected .obj, .ply, .stl or .glb");
  if (extension_of(path) == ".ply") check_ply(name, file_contents(path));
  Assimp::Importer importer;
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  // One step after the other: Debian's Assimp aborts where it has to triangulate faces of fewer than three corners, and
  // trusts the corners that a file names.
  const aiScene* scene = importer.ReadFile(name, 0);
  if (scene != nullptr) check_corners(*scene, name);
  for (const unsigned steps : {static_cast<unsigned>(aiProcess_ValidateDataStructure | aiProcess_SortByPType),
                               static_cast<unsigned>(aiProcess_Triangulate | aiProcess_PreTransformVertices |
                                                     aiProcess_JoinIdenticalVertices)})
    if (scene != nullptr) scene = importer.ApplyPostProcessing(steps);
  check(scene != nullptr, name, ": is no mesh that can be read: ", printable(importer.GetErrorString()));
  Mesh mesh;
  for (unsigned i = 0; i < scene->mNumMaterials; ++i)
    mesh.materials.push_back(material_of(*scene, *scene->mMaterials[i], path, mesh));
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& part = *scene->mMeshes[m];
    if ((part.mPrimitiveTypes & aiPrimitiveType_TRIANGLE) == 0) continue;
    const auto base = static_cast<std::uint32_t>(mesh.points.size());
    const int material = material_of_part(part, mesh);
    for (unsigned v = 0; v < part.mNumVertices; ++v) {
      const aiVector3D& p = part.mVertices[v];
      const Vec3 point = Vec3(p.x, p.y, p.z) * static_cast<float>(metres_per_unit);
      check(point.allFinite(), name, ": vertex ", v, " of part ", m, " is not finite");
      mesh.points.push_back(point);
    }
    check(mesh.triangles.size() + part.mNumFaces <= kMostTriangles, name, ": has more than ", kMostTriangles,
          " triangles; make it simpler");
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];
      if (face.mNumIndices != 3) continue;
      Mesh::Triangle triangle{{}, material};
      std::array<Vec2, 3> uv;
      for (unsigned k = 0; k < 3; ++k) {
        triangle.corner[k] = base + face.mIndices[k];
        const aiVector3D at = part.HasTextureCoords(0) ? part.mTextureCoords[0][face.mIndices[k]] : aiVector3D();
        uv[k] = Vec2(at.x, at.y).allFinite() ? Vec2(at.x, at.y) : Vec2(0, 0);
      }
      mesh.triangles.push_back(triangle);
      mesh.uv.push_back(uv);
    }
  }
  check(!mesh.triangles.empty(), name, ": holds no triangles");
  if (mesh.pictures.empty()) mesh.uv.clear();
  shade_smoothly(mesh);
  return mesh;
}

}  // namespace svnet
