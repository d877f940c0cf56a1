// Main: the frame of the page, and which screen is shown. The address names the screen and what it shows: #/shape/finger.toml.

import { get, listen } from "./api.js";
import { fill, h, say } from "./dom.js";
import { Job } from "./job.js";

// Screens in the order of the work. Each module exports `show(place, app)`, which may return a function that ends it.
const SCREENS = [
  { name: "start", title: "Start", of: "" },
  { name: "shape", title: "Shape", of: "job" },
  { name: "materials", title: "Materials", of: "job" },
  { name: "setup", title: "Loads", of: "job" },
  { name: "solve", title: "Solve", of: "job" },
  { name: "look", title: "Look", of: "run" },
  { name: "decide", title: "Decide", of: "job" },
  { name: "live", title: "Real time", of: "reduced" },
  { name: "code", title: "Code", of: "job" }, // of no job where none is open
];

/**
 * @typedef {object} App
 * @property {Job} job the job file that is open
 * @property {() => Promise<any>} workspace what the folder holds
 * @property {(screen: string, name?: string) => void} go show a screen
 * @property {EventTarget} changes "change" events with the names of changed files and runs in `detail`
 * @property {string} shown name of what the screen shows
 * @property {any} seen what the screen shows, for the code that repeats it (see snippets.js); a screen may add to it
 */

/** @type {App} */
const app = {
  job: new Job(),
  workspace: () => get("/api/workspace"),
  go: (screen, name) => {
    location.hash = `#/${screen}${name ? `/${encodeURIComponent(name)}` : ""}`;
  },
  changes: new EventTarget(),
  shown: "",
  seen: null,
};

const place = /** @type {HTMLElement} */ (document.getElementById("screen"));
let end = () => {};
let count = 0;

/** Names of the last job, run and reduced model, to come back to them. @type {Record<string, string>} */
const last = { job: "", run: "", reduced: "" };

async function show() {
  const [, name = "start", of = "", way = ""] = location.hash.split("/").map(decodeURIComponent);
  document.body.classList.toggle("single", way === "alone"); // a window of its own, without the other steps
  const screen = SCREENS.find((each) => each.name === name) ?? SCREENS[0];
  const own = ++count;
  end();
  end = () => {};
  app.shown = of || (screen.of && last[screen.of]) || "";
  if (screen.of) last[screen.of] = app.shown;
  try {
    if (screen.of === "job") {
      if (!app.shown && screen.name !== "code") return app.go("start");
      if (app.shown) await app.job.open(app.shown);
    }
    if (screen.name !== "code") app.seen = { screen: screen.name, title: screen.title, name: app.shown };
    document.title = `${app.shown ? `${app.shown} · ` : ""}${screen.title} · turgor studio`;
    frame(screen.name);
    const module = await import(`./screens/${screen.name}.js`);
    if (own !== count) return;
    fill(place);
    place.className = `screen-${screen.name}`;
    const ended = await module.show(place, app);
    if (own === count) end = ended ?? (() => {});
    else ended?.();
  } catch (error) {
    fill(place, h("p", { class: "wrong" }, /** @type {Error} */ (error).message));
  }
}

/** Draw the steps and the tools. @param {string} now */
function frame(now) {
  const steps = SCREENS.filter((each) => each.name !== "code").map((each) => {
    const known = !each.of || each.of !== "job" || last.job;
    const to = `#/${each.name}${each.of && last[each.of] ? `/${encodeURIComponent(last[each.of])}` : ""}`;
    const marks = { "aria-current": each.name === now ? "step" : null };
    return known ? h("a", { href: to, ...marks }, each.title) : h("span", { class: "step", title: "Open a job first" }, each.title);
  });
  fill(/** @type {Element} */ (document.getElementById("steps")), ...steps);
  tools();
}

function tools() {
  const { state } = app.job;
  const button = (/** @type {"undo" | "redo"} */ way, /** @type {string} */ sign) =>
    h("button", { type: "button", title: `${way} (Ctrl+${way === "undo" ? "Z" : "Y"})`, "aria-label": way, disabled: !state?.[way], onclick: () => app.job.step(way) }, sign);
  const code = h("a", { class: "button", href: `#/code${last.job ? `/${encodeURIComponent(last.job)}` : ""}` }, "Show the code");
  fill(
    /** @type {Element} */ (document.getElementById("tools")),
    h("span", { class: "file", title: last.job }, last.job), button("undo", "↶"), button("redo", "↷"), code,
  );
}

app.job.addEventListener("change", tools);
window.addEventListener("hashchange", show);
window.addEventListener("keydown", (event) => {
  const typing = /** @type {HTMLElement} */ (event.target).matches?.("input, textarea, select");
  if (!(event.ctrlKey || event.metaKey) || typing || !app.job.state) return;
  const way = event.key === "z" && !event.shiftKey ? "undo" : event.key === "y" || event.key === "Z" ? "redo" : null;
  if (!way) return;
  event.preventDefault();
  app.job.step(/** @type {"undo" | "redo"} */ (way));
});

let there = true;
/** @type {HTMLElement | null} */
let lost = null;
listen(
  (names) => {
    if (names.includes(app.job.name)) app.job.read().catch((error) => say(error.message, true));
    if (names.length) app.changes.dispatchEvent(new CustomEvent("change", { detail: names }));
  },
  (connected) => {
    if (connected === there) return;
    there = connected;
    document.body.classList.toggle("alone", !connected);
    lost?.remove();
    lost = say(connected ? "The studio answers again." : "The studio does not answer; this page waits for it.", !connected);
    if (connected) app.job.read().catch((error) => say(error.message, true)).then(show);
  },
);
show();
