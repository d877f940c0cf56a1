// Start: the job files, runs and reduced models of the folder, and families to begin with.

import { part, post } from "../api.js";
import { fill, h, say } from "../dom.js";

/** @param {HTMLElement} place @param {import("../main.js").App} app */
export async function show(place, app) {
  const lists = h("section", { class: "lists" });
  place.append(h("h1", {}, "Bend your first finger, or go on"), lists);
  const draw = async () => {
    const content = await app.workspace();
    fill(
      lists,
      list("Job files", content.jobs.filter((/** @type {any} */ each) => each.kind === "job").map((/** @type {any} */ each) => each.name), "shape"),
      list("Runs", content.runs, "look"),
      list("Reduced models", content.reduced, "live"),
    );
  };
  await draw();
  app.changes.addEventListener("change", draw);
  return () => app.changes.removeEventListener("change", draw);
}

/** @param {string} title @param {string[]} names @param {string} screen */
function list(title, names, screen) {
  const entries = names.map((name) => h("li", {}, h("a", { href: `#/${screen}/${part(name)}` }, name)));
  return h("div", {}, h("h2", {}, title), names.length ? h("ul", {}, ...entries) : h("p", { class: "quiet" }, "None in this folder yet."));
}

/** Write the job of a family and open it. @param {import("../main.js").App} app @param {string} family @param {string} name */
export async function begin(app, family, name) {
  try {
    await post("/api/jobs", { family, name });
    app.go("shape", name);
  } catch (error) {
    say(/** @type {Error} */ (error).message, true);
  }
}
