#pragma once
#include <array>

#include "base/enum_names.h"

namespace svnet::sandbox {

/// How files that libraries decode (HDF5, meshes with their textures) are read. on: in a child process that can do
/// nothing else (child.h). off: in this process, as programs usually do; for files that one trusts.
enum class Mode { on, off };

constexpr auto enum_table(Mode) { return std::to_array<EnumName<Mode>>({{Mode::on, "on"}, {Mode::off, "off"}}); }

/// Of the whole process, `on` at its start. Files that are open already keep theirs. Safe to call from several threads.
void set_mode(Mode);
Mode mode();

}  // namespace svnet::sandbox
