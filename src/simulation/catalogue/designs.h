#pragma once
#include <vector>

#include "simulation/sculptor.h"

// How the catalogue's categories are made: a table of designs each, and a function that builds one.
namespace svnet {

/// The numbers that a category's function takes, in its own order (mostly millimetres), and its materials. Kinds are
/// whole numbers, rounded where designs are mixed.
struct Design {
  std::vector<float> number;
  std::vector<Material> look;

  float operator[](std::size_t i) const { return number[i]; }
  int kind(std::size_t i) const { return static_cast<int>(number[i] + 0.5f); }
};

struct CategoryDesigns {
  const char* name;
  void (*build)(Sculptor&, const Design&);
  std::vector<Design> designs;
};

std::vector<CategoryDesigns> tool_designs();
std::vector<CategoryDesigns> cutlery_designs();
std::vector<CategoryDesigns> vessel_designs();
std::vector<CategoryDesigns> personal_designs();
std::vector<CategoryDesigns> household_designs();

}  // namespace svnet
