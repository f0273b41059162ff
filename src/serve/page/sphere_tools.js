// Pointer and keys on the half-sphere: they turn it, or paint or erase the region that the robot can reach.

const STEP_PX = 5;  // of an arrow key with the brush; turning takes twice that
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
const TOOL_KEYS = { t: "turn", p: "paint", e: "erase" };

/** Connects the canvas and the controls below it. Calls `changed` after each change of the region. */
export function connectTools(sphere, region, changed) {
  const byId = (id) => document.getElementById(id);
  const canvas = byId("sphere");
  let cursor = [0, 0, 1];  // the direction of the brush's middle
  let last = null;         // where the pointer was while it is down

  const tool = () => document.querySelector("input[name=tool]:checked").value;
  const brush = () => ({ direction: cursor, radius_deg: Number(byId("brush").value) });

  function chooseTool(name) {
    document.querySelector(`input[name=tool][value=${name}]`).checked = true;
    canvas.classList.toggle("paints", name !== "turn");
    sphere.brush = name === "turn" ? null : brush();
  }

  /** Moves the brush to a place of the canvas; where there is no half-sphere it stays. */
  function moveBrush(left, top) {
    cursor = sphere.directionAt(left, top) ?? cursor;
    sphere.brush = brush();
  }

  function applyBrush() {
    region.apply(cursor, brush().radius_deg, tool() === "paint");
    changed();
  }

  const place = (event) => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    last = place(event);
    if (tool() === "turn" || !sphere.directionAt(...last)) return;
    moveBrush(...last);
    applyBrush();
  });
  canvas.addEventListener("pointermove", (event) => {
    const at = place(event);
    if (tool() === "turn") {
      if (last) sphere.turn(at[0] - last[0], at[1] - last[1]);
    } else if (sphere.directionAt(...at)) {
      moveBrush(...at);
      if (last) applyBrush();
    }
    if (last) last = at;
  });
  for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, () => { last = null; });

  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const arrow = ARROWS[event.key], named = TOOL_KEYS[event.key.toLowerCase()];
    if (arrow && tool() === "turn") {
      sphere.turn(2 * STEP_PX * arrow[0], 2 * STEP_PX * arrow[1]);
    } else if (arrow) {
      const [left, top] = sphere.placeOf(cursor);
      moveBrush(left + STEP_PX * arrow[0], top + STEP_PX * arrow[1]);
    } else if (named) {
      chooseTool(named);
    } else if (event.key === "Home") {
      sphere.lookFromAbove();
    } else if (event.key === " " && tool() !== "turn") {
      applyBrush();
    } else {
      return;
    }
    event.preventDefault();
  });

  for (const input of document.querySelectorAll("input[name=tool]"))
    input.addEventListener("change", () => chooseTool(input.value));
  byId("brush").addEventListener("input", () => chooseTool(tool()));
  byId("from-above").addEventListener("click", () => sphere.lookFromAbove());
  byId("reset-region").addEventListener("click", () => {
    region.clear();
    changed();
  });
}
