#pragma once
#include <optional>

#include "sandbox/child.h"
#include "simulation/mesh.h"

// A mesh as messages between two processes.
namespace svnet::simulation {

/// The kind of the messages that carry a mesh.
inline constexpr std::uint32_t kMeshBytes = 100;

void send_mesh(sandbox::Channel&, const Mesh&);

/// The mesh whose first message is `first`. None for lengths beyond the limits of mesh_check.h; what it holds is not
/// checked. Memory is taken as the bytes arrive.
std::optional<Mesh> receive_mesh(sandbox::Child&, const sandbox::Message& first);

}  // namespace svnet::simulation
