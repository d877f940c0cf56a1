// Materials: what each region of the job is made of, from the library or from tests of one's own.

import { get, part, post } from "../api.js";
import { fill, h, say } from "../dom.js";
import { Library } from "../rubber/library.js";
import { Tests } from "../rubber/tests.js";

/** @param {HTMLElement} place @param {import("../main.js").App} app */
export async function show(place, app) {
  const now = h("dl", { class: "live-rows" });
  const region = h("select", { "aria-label": "region that a choice is for" });
  const path = `/api/jobs/${part(app.job.name)}/materials`;
  const use = async (/** @type {any} */ choice, /** @type {string} */ words) => {
    try {
      const entry = await post(path, { region: region.value, choice });
      await app.job.set({ [`materials.${region.value}`]: entry });
      say(`${region.value}: ${words}.`);
    } catch (error) {
      say(/** @type {Error} */ (error).message, true);
    }
  };
  const [library, tests] = [new Library(use), new Tests(use)];
  const regions = async () => {
    try {
      const entries = Object.entries(await get(path));
      const before = region.value;
      fill(region, ...(entries.length ? entries.map(([name]) => name) : ["body"]).map((name) => h("option", {}, name)));
      if (entries.some(([name]) => name === before)) region.value = before;
      fill(now, ...entries.map(([name, entry]) => h("div", {}, h("dt", {}, name), h("dd", {}, said(/** @type {any} */ (entry))))));
    } catch (error) {
      fill(now, h("div", { class: "wrong" }, /** @type {Error} */ (error).message));
    }
  };
  const tables = async () => tests.tables((await app.workspace()).tables);
  place.append(
    h("h1", {}, "Materials"),
    h("section", { class: "card", "aria-label": "In this job" }, h("h2", {}, "In this job"), now, h("p", {}, h("label", {}, "“Use” gives a material to ", region))),
    h("div", { class: "rubber-columns" }, library.element, tests.element),
  );
  app.job.addEventListener("change", regions);
  app.changes.addEventListener("change", tables);
  await Promise.all([regions(), tables(), library.start()]);
  tests.plot.draw([]);
  return () => {
    app.job.removeEventListener("change", regions);
    app.changes.removeEventListener("change", tables);
  };
}

/** An entry of [materials] in words. @param {any} entry */
function said(entry) {
  const sheet = entry.thickness ? `, ${entry.thickness} thick` : "";
  if (entry.library) return `${entry.library}${entry.record ? `, ${entry.record}` : ""}${sheet}`;
  const constants = Object.entries(entry).filter(([key]) => !["law", "source", "stretch_range", "name", "thickness", "form"].includes(key));
  return `${String(entry.law).replaceAll("_", "-")}: ${constants.map(([key, value]) => `${key} = ${typeof value === "object" ? JSON.stringify(value) : value}`).join(", ")}${sheet}${entry.source ? ` (${entry.source.text})` : ""}`;
}
