// The page: inputs, a prediction, and what is shown of it.
import { Api } from "./api.js";
import { Camera } from "./camera.js";
import { SCALE_GRADIENT } from "./colours.js";
import { HalfSphere } from "./half_sphere.js";
import { Region } from "./region.js";
import { jsonText, matrixText, modelText, poseText, showFacts, showNotes, showTable } from "./results.js";
import { connectTools } from "./sphere_tools.js";

const byId = (id) => document.getElementById(id);
const api = new Api();
const sphere = new HalfSphere(byId("sphere"));
const region = new Region();
const camera = new Camera(byId("camera-video"));
const topImage = new Image();
topImage.alt = "The object from above";
byId("top-figure").prepend(topImage);

let model = null;
let image = null, depth = null;  // files
let prediction = null;
let chosen = null;               // the pose whose camera is shown
let asked = 0;                   // the number of the last prediction that was asked for
let timer = 0;                   // of later()

function say(text) {
  byId("status").textContent = text;
}

function showError(problem) {
  byId("error").hidden = problem === null;
  byId("error").textContent = problem?.message ?? "";
  if (problem?.status === 401) byId("token-form").hidden = false;
}

/** Runs what a user started; what goes wrong is shown. */
async function attempt(action) {
  showError(null);
  try {
    await action();
  } catch (problem) {
    say("");
    showError(problem);
  }
}

async function loadModel() {
  model = await api.model();
  byId("token-form").hidden = true;
  byId("model-line").textContent = modelText(model);
  byId("depth-panel").hidden = !model.uses_depth;
  byId("count").max = model.limits.poses;
}

// Inputs.

function fields() {
  const grid = byId("grid").value;
  const isEven = grid === "even";
  byId("count").disabled = byId("lowest").disabled = !isEven;
  // As the browser shows the image.
  const shared = { grid, exif_orientation: "obey" };
  return isEven ? { ...shared, count: byId("count").value, lowest_phi_deg: byId("lowest").value } : shared;
}

async function predict() {
  const wanted = fields();
  if (model === null || image === null) return;
  if (model.uses_depth && depth === null) {
    say("Now choose the depth image of the same view.");
    return;
  }
  say("Computing…");
  const number = ++asked;
  let answer = null;
  try {
    answer = await api.predict(image, depth, wanted);
  } catch (problem) {
    if (number !== asked) return;
    forgetPrediction();
    throw problem;
  }
  if (number !== asked) return;  // a later one is under way
  prediction = answer;
  say(`${answer.views.length} camera poses scored.`);
  showPrediction();
}

async function takeImage(file) {
  image = file;
  depth = null;
  if (model?.uses_depth) forgetPrediction();  // until its depth is chosen
  byId("depth-file").value = "";
  if (topImage.src) URL.revokeObjectURL(topImage.src);
  topImage.src = URL.createObjectURL(file);
  await predict();
}

// Results.

function forgetPrediction() {
  prediction = null;
  clearTimeout(timer);
  byId("results").hidden = true;
}

function showPrediction() {
  byId("results").hidden = false;
  showNotes(byId("notes"), prediction.notes);
  byId("scale-bar").style.background = SCALE_GRADIENT;
  byId("scale-low").textContent = prediction.views.at(-1).score.toFixed(3);
  byId("scale-high").textContent = prediction.views[0].score.toFixed(3);
  sphere.show(prediction.views, topImage);
  showBest();
}

function showBest() {
  if (prediction === null) return;
  const isReachable = (view) => region.has(view);
  const best = prediction.views[0], reachable = prediction.views.find(isReachable);
  const rings = [{ pose: best, colour: "--bad" }];
  if (!region.isEmpty && reachable) rings.push({ pose: reachable, colour: "--reach" });
  sphere.mark(rings, isReachable);
  const count = prediction.views.filter(isReachable).length;
  showFacts(byId("best-facts"), [
    ["Best of all", poseText(best)],
    ["Best in reach", region.isEmpty ? "the same: no region is painted" : reachable ? poseText(reachable)
                                                                                     : "no candidate is in the region"],
    ["In reach", `${count} of ${prediction.views.length} candidates`],
  ]);
  showTable(byId("table"), prediction.views, isReachable);
  chosen = reachable ?? best;
  later(showCamera);
}

/** Runs an action once the user pauses. */
function later(action) {
  clearTimeout(timer);
  timer = setTimeout(() => attempt(action), 120);
}

async function showCamera() {
  const number = (id) => byId(id).value || "0";
  const place = {
    radius_m: number("radius"),
    centre_m: ["centre-x", "centre-y", "centre-z"].map(number).join(","),
    frame: byId("frame").value,
  };
  const pose = chosen;
  const camera_pose = await api.cameraPose(pose, place);
  if (pose !== chosen) return;
  byId("matrix").textContent = matrixText(camera_pose.camera_to_world);
  byId("json").textContent = jsonText({ ...pose, camera_pose });
}

async function copy(button) {
  const source = byId(button.dataset.copies);
  try {
    await navigator.clipboard.writeText(source.textContent);
    button.textContent = "Copied";
    setTimeout(() => { button.textContent = "Copy"; }, 1500);
  } catch {
    getSelection().selectAllChildren(source);
    say("The browser does not let this page copy; the text is selected, press Ctrl+C.");
  }
}

function connectInputs() {
  byId("choose-image").addEventListener("click", () => byId("image-file").click());
  byId("image-file").addEventListener("change", (event) => {
    if (event.target.files[0]) attempt(() => takeImage(event.target.files[0]));
  });
  byId("depth-file").addEventListener("change", (event) => {
    depth = event.target.files[0] ?? null;
    attempt(predict);
  });
  for (const id of ["grid", "count", "lowest"]) byId(id).addEventListener("change", () => attempt(predict));
  const drop = byId("drop");
  for (const name of ["dragover", "dragleave", "drop"])
    drop.addEventListener(name, (event) => {
      event.preventDefault();
      drop.classList.toggle("over", name === "dragover");
      const file = name === "drop" ? event.dataTransfer.files[0] : null;
      if (file) attempt(() => takeImage(file));
    });
  byId("open-camera").addEventListener("click", () => attempt(async () => {
    await camera.open();
    byId("camera-panel").hidden = false;
    byId("take-picture").focus();
  }));
  const closeCamera = () => {
    camera.close();
    byId("camera-panel").hidden = true;
    byId("open-camera").focus();
  };
  byId("close-camera").addEventListener("click", closeCamera);
  byId("take-picture").addEventListener("click", () => attempt(async () => {
    const picture = await camera.take();
    closeCamera();
    await takeImage(picture);
  }));
  byId("token-form").addEventListener("submit", (event) => {
    event.preventDefault();
    api.token = byId("token").value.trim();
    attempt(async () => {
      await loadModel();
      await predict();
    });
  });
}

function connectResults() {
  topImage.addEventListener("load", () => sphere.draw());
  topImage.addEventListener("error", () => showError(new Error("The browser cannot show this file as an image.")));
  for (const id of ["radius", "centre-x", "centre-y", "centre-z", "frame"])
    byId(id).addEventListener("input", () => later(showCamera));
  for (const button of document.querySelectorAll("button.copy")) button.addEventListener("click", () => copy(button));
  connectTools(sphere, region, showBest);
}

connectInputs();
connectResults();
attempt(loadModel);
