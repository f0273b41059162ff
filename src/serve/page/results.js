// What is said of a prediction in words and tables.

/** Puts texts into a list of terms: [[term, text], …]. */
export function showFacts(list, facts) {
  list.replaceChildren(...facts.flatMap(([term, text]) => {
    const name = document.createElement("dt"), value = document.createElement("dd");
    name.textContent = term;
    value.textContent = text;
    return [name, value];
  }));
}

/** "θ 137.5°, φ 48.6°, score 0.531" */
export function poseText(view) {
  return `θ ${view.theta_deg.toFixed(1)}°, φ ${view.phi_deg.toFixed(1)}°, score ${view.score.toFixed(3)}`;
}

export function showNotes(list, notes) {
  list.hidden = notes.length === 0;
  list.replaceChildren(...notes.map((note) => {
    const item = document.createElement("li");
    item.textContent = note.charAt(0).toUpperCase() + note.slice(1) + ".";
    return item;
  }));
}

/** The ten best views as rows of a table. */
export function showTable(table, views, isReachable) {
  (table.tBodies[0] ?? table.createTBody()).replaceChildren(...views.slice(0, 10).map((view, rank) => {
    const row = document.createElement("tr");
    for (const text of [rank + 1, view.theta_deg.toFixed(1), view.phi_deg.toFixed(1), view.score.toFixed(4),
                        isReachable(view) ? "yes" : "no"])
      row.insertCell().textContent = text;
    return row;
  }));
}

/** A matrix as JSON, which Python reads too, with its columns below each other. */
export function matrixText(rows) {
  const text = rows.map((row) => `[${row.map((number) => number.toFixed(6).padStart(9)).join(", ")}]`);
  return `[${text.join(",\n ")}]`;
}

/** JSON with lists of numbers in one line each. */
export function jsonText(value) {
  return JSON.stringify(value, null, 2).replace(/\[[-\d.e,\s]+\]/g, (numbers) => numbers.replace(/\s+/g, " "));
}

/** The line about the model below the title. */
export function modelText(model) {
  const depth = model.uses_depth ? "an image and its depth" : "an image";
  const on = model.trained_on;
  const trained = on.categories.length > 0 ? `, trained on ${on.objects} objects in ${on.categories.length} categories` : "";
  return `Model ${model.fingerprint.slice(0, 12)}: takes ${depth}${trained}; ${model.frame_meaning}. svnet ${model.version}.`;
}
