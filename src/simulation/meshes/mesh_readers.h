#pragma once
#include <string_view>

#include "mesh_draft.h"
#include "mesh_files.h"

// One reader per format. Each takes the whole file, fills the draft, and throws Error that begins with the draft's name
// for what it cannot read completely. `files` finds what the mesh names, and takes warnings.
namespace svnet::simulation {

/// Wavefront OBJ, with MTL materials. Without a texture, colours of vertices replace Kd.
void read_obj(std::string_view file, const MeshFiles& files, MeshDraft& draft);

/// PLY (G. Turk, The PLY Polygon File Format, 1994): text or binary; colours of vertices and faces (multiplied if there
/// are both), coordinates per vertex, or per face corner as MeshLab writes them; triangle strips.
void read_ply(std::string_view file, const MeshFiles& files, MeshDraft& draft);

/// STL: text or binary; colours per facet by the conventions of VisCAM and Magics.
void read_stl(std::string_view file, const MeshFiles& files, MeshDraft& draft);

/// glTF 2.0, as GLB or as JSON with its buffers beside it or inside.
void read_gltf(std::string_view file, const MeshFiles& files, MeshDraft& draft);

}  // namespace svnet::simulation
