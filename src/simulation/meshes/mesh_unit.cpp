#include "mesh_unit.h"

#include <cstdio>
#include <vector>

#include "base/error.h"
#include "simulation/collection.h"

namespace svnet::simulation {
namespace {

struct Unit {
  double metres;
  const char* name;
};
constexpr Unit kCentimetres{0.01, "centimetres"}, kMillimetres{0.001, "millimetres"};

std::string length_text(double metres) {
  char text[32];
  std::snprintf(text, sizeof text, metres < 0.01 ? "%.3g mm" : "%.3g m", metres < 0.01 ? metres * 1000 : metres);
  return text;
}

bool is_household(double length_m) { return length_m >= 0.03 && length_m <= 0.5; }
bool is_collectable(double length_m) { return length_m >= kSmallestObject_m && length_m <= kLargestObject_m; }

/// The units in which the length makes sense.
std::vector<Unit> sensible_units(double length, bool (*makes_sense)(double)) {
  std::vector<Unit> units;
  for (const Unit& unit : {kMillimetres, kCentimetres})
    if (makes_sense(length * unit.metres)) units.push_back(unit);
  return units;
}

[[noreturn]] void fail_size(double length_m, const std::string& name, const std::string& hint) {
  fail(name, ": is ", length_text(length_m), " long, objects may be ", length_text(kSmallestObject_m), " to ",
       length_text(kLargestObject_m), "; is its unit right?", hint);
}

}  // namespace

double metres_per_unit(double length, const std::string& name, std::optional<double> given,
                       const std::function<void(const std::string&)>& warn) {
  if (is_collectable(length * given.value_or(1))) return given.value_or(1);
  std::vector<Unit> units = sensible_units(length, is_household);
  if (units.empty()) units = sensible_units(length, is_collectable);
  if (!given && units.size() == 1) {
    warn(joined(name, ": is ", length, " units long, taken as ", units[0].name, ": ",
                length_text(length * units[0].metres), " (--unit decides otherwise)"));
    return units[0].metres;
  }
  std::string hint;
  if (given && is_household(length)) units.insert(units.begin(), {1, "metres"});
  for (const Unit& unit : units) {
    if (given && !is_household(length * unit.metres)) continue;
    hint += joined(hint.empty() ? " With" : ", with", " --unit ", unit.metres, " it would be ",
                   length_text(length * unit.metres));
    if (given) break;
  }
  fail_size(length * given.value_or(1), name, hint.empty() ? "" : hint + ".");
}

}  // namespace svnet::simulation
