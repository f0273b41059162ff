#include "base/error.h"
#include "simulate_sorting/collection.h"

namespace svnet {

bool can_render() { return false; }

void render_collection(const std::filesystem::path&, std::vector<std::string>, const std::vector<std::string>&,
                       std::uint64_t, const Messages&) {
  fail("this program was built without the simulation; give a data set");
}

}  // namespace svnet
