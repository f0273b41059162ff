// The region of the half-sphere that the robot can reach, as the user paints it.

/** The unit vector from the object to a camera: x, y, z (docs/camera-convention.md). */
export function outwards(pose) {
  const theta = (pose.theta_deg * Math.PI) / 180, phi = (pose.phi_deg * Math.PI) / 180;
  return [Math.cos(phi) * Math.cos(theta), Math.cos(phi) * Math.sin(theta), Math.sin(phi)];
}

/** Discs on the half-sphere, painted or erased one after the other. Without any painted disc everything is reachable. */
export class Region {
  #discs = [];

  get isEmpty() {
    return !this.#discs.some((disc) => disc.paints);
  }

  clear() {
    this.#discs = [];
  }

  /** Paints or erases what is within `radius_deg` of a direction. */
  apply(direction, radius_deg, paints) {
    const last = this.#discs.at(-1);
    const near = Math.cos((radius_deg * Math.PI) / 180);
    // A drag makes many discs; those that move by less than 1.5 degrees add nothing that one sees.
    if (last && last.paints === paints && last.near === near && dot(last.direction, direction) > 0.99966) return;
    this.#discs.push({ direction, near, paints });
  }

  /** Whether a pose is in the region: the last disc that covers it decides. */
  has(pose) {
    if (this.isEmpty) return true;
    const direction = outwards(pose);
    const disc = this.#discs.findLast((candidate) => dot(candidate.direction, direction) >= candidate.near);
    return disc !== undefined && disc.paints;
  }
}

function dot(a, b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
