// Code: the job file as text, to read and to edit, and a script that repeats it.

import { h } from "../dom.js";

/** @param {HTMLElement} place @param {import("../main.js").App} app */
export function show(place, app) {
  const text = h("textarea", { class: "code", spellcheck: false, "aria-label": "job file", rows: 30 });
  const save = h("button", { type: "button", onclick: () => app.job.write(text.value) }, "Save");
  const read = () => {
    text.value = app.job.state?.text ?? "";
  };
  read();
  place.append(h("h1", {}, app.job.name), text, save);
  app.job.addEventListener("change", read);
  return () => app.job.removeEventListener("change", read);
}
