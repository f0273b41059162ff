// The half-sphere of camera poses on a canvas, seen from any side by a parallel projection. From above, azimuth 0 is to
// the left and 90 is down, as in the top image, which lies on the table.
import { scaleColour } from "./colours.js";
import { outwards } from "./region.js";

const RADIAN = Math.PI / 180;
const FIRST_TILT = 38 * RADIAN;

export class HalfSphere {
  #canvas;
  #context;
  #spin = 0;           // about the vertical axis
  #tilt = FIRST_TILT;  // 0: from above; a quarter turn: from the side
  #views = [];
  #image = null;
  #isReachable = () => true;
  #rings = [];         // {pose, colour: a CSS variable}
  #brush = null;       // {direction, radius_deg}

  constructor(canvas) {
    this.#canvas = canvas;
    this.#context = canvas.getContext("2d");
    new ResizeObserver(() => this.draw()).observe(canvas);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.draw());
  }

  /** `views`: {theta_deg, phi_deg, score}, best first. `image`: what lies on the table, or null. */
  show(views, image) {
    this.#views = views;
    this.#image = image;
  }

  mark(rings, isReachable) {
    this.#rings = rings;
    this.#isReachable = isReachable;
    this.draw();
  }

  set brush(brush) {
    this.#brush = brush;
    this.draw();
  }

  /** Turns by pixels of a drag. */
  turn(right, down) {
    const half = this.#canvas.clientWidth / 2;
    this.#spin -= right / half;
    this.#tilt = Math.min(Math.max(this.#tilt - down / half, 0), Math.PI / 2);
    this.draw();
  }

  lookFromAbove() {
    this.#spin = this.#tilt = 0;
    this.draw();
  }

  /** The direction at a place of the canvas, in CSS pixels from its upper left corner; null beside the half-sphere. */
  directionAt(left, top) {
    const { middleX, middleY, radius } = this.#place(this.#canvas.clientWidth, this.#canvas.clientHeight);
    const x = (left - middleX) / radius, y = (top - middleY) / radius;
    const inside = 1 - x * x - y * y;
    if (inside < 0) return null;
    for (const towards of [Math.sqrt(inside), -Math.sqrt(inside)]) {
      const v = y * Math.cos(this.#tilt) + towards * Math.sin(this.#tilt);
      const w = towards * Math.cos(this.#tilt) - y * Math.sin(this.#tilt);
      if (w < 0) continue;
      const cos = Math.cos(this.#spin), sin = Math.sin(this.#spin);
      return [-(x * cos + v * sin), v * cos - x * sin, w];
    }
    return null;
  }

  /** Where a direction is on the canvas, in CSS pixels from its upper left corner: [left, top]. */
  placeOf(direction) {
    const { middleX, middleY, radius } = this.#place(this.#canvas.clientWidth, this.#canvas.clientHeight);
    const [x, y] = this.#seen(direction);
    return [middleX + radius * x, middleY + radius * y];
  }

  draw() {
    const width = this.#canvas.clientWidth, height = this.#canvas.clientHeight;
    if (width === 0) return;
    const density = window.devicePixelRatio || 1;
    this.#canvas.width = Math.round(width * density);
    this.#canvas.height = Math.round(height * density);
    const context = this.#context;
    context.setTransform(density, 0, 0, density, 0, 0);
    const place = this.#place(width, height);
    this.#drawTable(place, density);
    context.setTransform(density, 0, 0, density, 0, 0);
    this.#drawNet(place, false);
    this.#drawViews(place);
    this.#drawNet(place, true);
    this.#drawLabels(place);
    for (const { pose, colour } of this.#rings) this.#drawRing(place, outwards(pose), colour);
    if (this.#brush) this.#drawBrush(place);
  }

  /** The middle of the half-sphere's base, so that all of it is in the middle of the canvas, and its radius. */
  #place(width, height) {
    const radius = 0.39 * Math.min(width, height);
    return { middleX: width / 2, middleY: height / 2 + 0.5 * radius * (1 - Math.cos(this.#tilt)), radius };
  }

  /** A direction as seen: to the right, down, towards the viewer. */
  #seen([x, y, z]) {
    const cos = Math.cos(this.#spin), sin = Math.sin(this.#spin);
    const u = -x * cos - y * sin, v = -x * sin + y * cos;
    return [u, v * Math.cos(this.#tilt) - z * Math.sin(this.#tilt), z * Math.cos(this.#tilt) + v * Math.sin(this.#tilt)];
  }

  #colour(name) {
    return getComputedStyle(this.#canvas).getPropertyValue(name);
  }

  #drawTable({ middleX, middleY, radius }, density) {
    if (!this.#image?.naturalWidth) return;
    const { naturalWidth, naturalHeight } = this.#image;
    const half = 0.68 / Math.max(naturalWidth, naturalHeight);
    const across = half * naturalWidth, along = half * naturalHeight;
    const cos = Math.cos(this.#spin) * radius, sin = Math.sin(this.#spin) * radius, flat = Math.cos(this.#tilt);
    const context = this.#context;
    context.setTransform(density * cos, density * sin * flat, -density * sin, density * cos * flat,
                         density * middleX, density * middleY);
    context.drawImage(this.#image, -across, -along, 2 * across, 2 * along);
  }

  /** Circles of elevation and half-circles of azimuth, of the side towards the viewer or of the other. */
  #drawNet({ middleX, middleY, radius }, isFront) {
    const context = this.#context;
    context.strokeStyle = this.#colour("--edge");
    const line = (poses, width) => {
      context.lineWidth = width;
      context.beginPath();
      let drawing = false;
      for (const pose of poses) {
        const [x, y, towards] = this.#seen(outwards(pose));
        const isShown = towards >= -1e-9 === isFront;
        if (isShown && drawing) context.lineTo(middleX + radius * x, middleY + radius * y);
        else if (isShown) context.moveTo(middleX + radius * x, middleY + radius * y);
        drawing = isShown;
      }
      context.stroke();
    };
    const steps = Array.from({ length: 73 }, (_, i) => 5 * i);
    context.globalAlpha = isFront ? 0.45 : 0.3;
    for (const phi_deg of [0, 30, 60]) line(steps.map((theta_deg) => ({ theta_deg, phi_deg })), phi_deg === 0 ? 1.75 : 0.75);
    for (const theta_deg of [0, 45, 90, 135, 180, 225, 270, 315])
      line(steps.slice(0, 19).map((phi_deg) => ({ theta_deg, phi_deg })), 0.75);
    context.globalAlpha = 1;
  }

  /** A disc per view that touches the sphere, far ones first; small where the robot cannot go. */
  #drawViews({ middleX, middleY, radius }) {
    if (this.#views.length === 0) return;
    const high = this.#views[0].score, low = this.#views.at(-1).score;
    const lowest = Math.min(...this.#views.map((view) => Math.sin(view.phi_deg * RADIAN)));
    const area = (2 * Math.PI * (1 - lowest)) / this.#views.length;
    const size = radius * Math.min(0.54 * Math.sqrt(area), 0.075);
    const seen = this.#views.map((view) => ({ view, at: this.#seen(outwards(view)) }));
    seen.sort((a, b) => a.at[2] - b.at[2]);
    const context = this.#context;
    for (const { view, at: [x, y, towards] } of seen) {
      const side = this.#isReachable(view) ? size : 0.35 * size;
      context.globalAlpha = towards < 0 ? 0.55 : 1;
      context.fillStyle = scaleColour(high > low ? (view.score - low) / (high - low) : 1);
      context.beginPath();
      context.ellipse(middleX + radius * x, middleY + radius * y, side * Math.max(Math.abs(towards), 0.2), side,
                      Math.atan2(y, x), 0, 2 * Math.PI);
      context.fill();
    }
    context.globalAlpha = 1;
  }

  #drawLabels({ middleX, middleY, radius }) {
    const context = this.#context;
    context.fillStyle = this.#colour("--ink");
    context.strokeStyle = this.#colour("--panel");
    context.lineWidth = 3;
    context.font = `${Math.max(11, radius / 13)}px system-ui, sans-serif`;
    context.textAlign = "center";
    context.textBaseline = "middle";
    for (let theta_deg = 0; theta_deg < 360; theta_deg += 45) {
      const [x, y] = this.#seen(outwards({ theta_deg, phi_deg: 0 }));
      const right = middleX + 1.13 * radius * x, down = middleY + (1.12 * y + (y > 0 ? 0.03 : 0)) * radius;
      context.strokeText(`${theta_deg}°`, right, down);
      context.fillText(`${theta_deg}°`, right, down);
    }
  }

  #drawRing({ middleX, middleY, radius }, direction, colour) {
    const [x, y] = this.#seen(direction);
    const context = this.#context;
    for (const [style, width] of [["#fff", 6], [this.#colour(colour), 3]]) {
      context.strokeStyle = style;
      context.lineWidth = width;
      context.beginPath();
      context.arc(middleX + radius * x, middleY + radius * y, 0.085 * radius + (colour === "--bad" ? 4 : 0), 0, 2 * Math.PI);
      context.stroke();
    }
  }

  /** The rim of the brush, a circle on the sphere. */
  #drawBrush({ middleX, middleY, radius }) {
    const [x, y, z] = this.#brush.direction;
    const theta_deg = Math.atan2(y, x) / RADIAN, phi_deg = Math.asin(Math.min(z, 1)) / RADIAN;
    const east = outwards({ theta_deg: theta_deg + 90, phi_deg: 0 });
    const north = outwards({ theta_deg: theta_deg + 180, phi_deg: 90 - phi_deg });
    const cos = Math.cos(this.#brush.radius_deg * RADIAN), sin = Math.sin(this.#brush.radius_deg * RADIAN);
    const context = this.#context;
    context.beginPath();
    for (let step = 0; step <= 48; ++step) {
      const a = (2 * Math.PI * step) / 48;
      const at = [x, y, z].map((middle, i) => cos * middle + sin * (Math.cos(a) * east[i] + Math.sin(a) * north[i]));
      const [right, down] = this.#seen(at);
      context.lineTo(middleX + radius * right, middleY + radius * down);
    }
    context.strokeStyle = this.#colour("--ink");
    context.lineWidth = 2;
    context.setLineDash([5, 4]);
    context.stroke();
    context.setLineDash([]);
  }
}
