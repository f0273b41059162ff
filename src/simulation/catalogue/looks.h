#pragma once
#include "simulation/mesh.h"

// Materials by name. Colours are linear RGB.
namespace svnet::simulation::looks {

inline Material plastic(float r, float g, float b) {
  return {.colour = {r, g, b}, .second = {r, g, b}, .gloss = 0.05f, .sharpness = 60};
}
inline Material matte(float r, float g, float b) {
  return {
      .colour = {r, g, b}, .second = 0.8f * Vec3(r, g, b), .texture = Texture::speckled, .scale_m = 0.003f, .gloss = 0};
}
inline Material ceramic(float r, float g, float b) {
  return {.colour = {r, g, b}, .second = {r, g, b}, .gloss = 0.06f, .sharpness = 200};
}
inline Material metal(float r, float g, float b, float sharpness) {
  return {.colour = {r, g, b}, .second = {r, g, b}, .gloss = 0.5f, .sharpness = sharpness, .metal = true};
}
inline Material steel() {
  Material m = metal(0.62f, 0.62f, 0.64f, 60);
  m.second = {0.5f, 0.5f, 0.52f};
  m.texture = Texture::brushed;
  m.scale_m = 0.002f;
  return m;
}
inline Material chrome() { return metal(0.72f, 0.73f, 0.75f, 150); }
inline Material iron() { return metal(0.23f, 0.23f, 0.25f, 25); }
inline Material brass() { return metal(0.72f, 0.5f, 0.2f, 90); }
inline Material aluminium() { return metal(0.7f, 0.71f, 0.72f, 30); }
inline Material wood(float r, float g, float b) {
  return {.colour = {r, g, b},
          .second = 0.62f * Vec3(r, g, b),
          .texture = Texture::wood,
          .scale_m = 0.006f,
          .gloss = 0.04f,
          .sharpness = 40};
}
inline Material beech() { return wood(0.62f, 0.42f, 0.24f); }
inline Material walnut() { return wood(0.27f, 0.14f, 0.07f); }
inline Material clear(float r, float g, float b, float share = 0.85f) {
  return {.colour = {r, g, b}, .second = {r, g, b}, .gloss = 0.06f, .sharpness = 250, .clear = share};
}

inline Material black() { return plastic(0.02f, 0.02f, 0.022f); }
inline Material white() { return plastic(0.82f, 0.82f, 0.8f); }
inline Material red() { return plastic(0.6f, 0.03f, 0.03f); }
inline Material blue() { return plastic(0.03f, 0.1f, 0.45f); }
inline Material green() { return plastic(0.04f, 0.32f, 0.09f); }
inline Material yellow() { return plastic(0.8f, 0.55f, 0.03f); }
inline Material orange() { return plastic(0.8f, 0.22f, 0.02f); }
inline Material grey() { return plastic(0.25f, 0.26f, 0.27f); }
inline Material purple() { return plastic(0.25f, 0.06f, 0.35f); }
inline Material teal() { return plastic(0.03f, 0.35f, 0.36f); }

}  // namespace svnet::simulation::looks
