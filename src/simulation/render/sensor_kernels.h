#pragma once
#include <span>

#include "simulation/render/rays.h"

// The arithmetic of sensor_image for many pixels at once. Each kernel has the bits of the same formulas for one pixel
// after another, on every instruction set. A row has an element for each pixel.
namespace svnet::simulation {

/// What Box and Muller's method takes of four random words: two numbers in (0, 1] and two angles.
struct PolarDraw {
  Row<float> uniform[2], angle[2];
};
void make_polar(std::size_t count, const Row<std::uint32_t> (&words)[4], PolarDraw&);

/// Logarithms of the uniform numbers, sines and cosines of the angles.
struct PolarValues {
  Row<float> log[2], sine[2], cosine[2];
};

/// The 8-bit levels of light with the first three normal numbers as noise. `srgb`: of srgb_table.
void develop(std::size_t count, const PolarValues&, const Rows3& light, float exposure, std::span<const float> srgb,
             Row<std::int32_t> (&levels)[3]);

/// Depth with the fourth normal number as noise, in whole millimetres.
void measure_depth(std::size_t count, const PolarValues&, const Row<float>& z_m, Row<float>& measured_m);

}  // namespace svnet::simulation
