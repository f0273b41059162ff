// The colour scale of svnet's plots (src/view/colour_scale.cpp): dark blue, green, yellow.
const STOPS = [[48, 18, 92], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]];

/** The CSS colour of a height in [0, 1]. */
export function scaleColour(height) {
  const place = Math.min(Math.max(height, 0), 1) * (STOPS.length - 1);
  const below = Math.min(Math.floor(place), STOPS.length - 2);
  const share = place - below;
  const mixed = STOPS[below].map((low, i) => Math.round(low + share * (STOPS[below + 1][i] - low)));
  return `rgb(${mixed.join(" ")})`;
}

/** A CSS gradient of the whole scale, from left to right. */
export const SCALE_GRADIENT = `linear-gradient(to right, ${STOPS.map((stop) => `rgb(${stop.join(" ")})`).join(", ")})`;
