#pragma once
#include <vector>

#include "simulation/sculptor.h"

// Each category of the catalogue is a table of designs and a function that builds an object from one.
namespace svnet::simulation {

/// The parameters of a category's function, in its own order and mostly in millimetres, and its materials. A parameter
/// that selects a kind is an integer; mixed designs round it.
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

}  // namespace svnet::simulation
