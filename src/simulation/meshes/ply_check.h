#pragma once
#include <string>
#include <string_view>

namespace svnet {

/// Throws Error, which begins with `name`, where the header of a PLY file is not complete, or its body does not hold
/// all elements that the header declares. Assimp takes a header at its word: it waits for ever for one that does not
/// end, makes room for whatever is declared, and fills elements that are missing with what was read before.
void check_ply(const std::string& name, std::string_view file);

}  // namespace svnet
