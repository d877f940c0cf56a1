// Look: scrub through the states of a run, next to other runs and the points of an experiment; save what it has.

import { get, part, post } from "../api.js";
import { fill, h, later, say } from "../dom.js";
import { between, chart, legend } from "../parts/chart.js";
import { label, withError, words } from "../parts/numbers.js";
import { attempt, badge, fileOf, sceneOf, statusOf } from "../parts/runs.js";
import { picture } from "../picture.js";
import { drive, measures } from "./solve.js";

const NUMBERS = 120; // milliseconds between two updates of curves and numbers while one scrubs: the picture goes first
const MOST = 3; // runs side by side: more pictures than this are too small

/** Files that a button makes where they are not there yet: kind, title, name. @type {[string, string, (names: string[]) => string | undefined][]} */
const FILES = [
  ["report", "Report", (names) => names.find((each) => each === "report.html")],
  ["picture", "Picture of this state", () => undefined],
  ["gif", "Motion (GIF)", (names) => names.find((each) => each === "motion.gif")],
  ["glb", "Body (GLB)", (names) => names.find((each) => each === "motion.glb")],
  ["vtu", "Fields (VTU)", (names) => names.find((each) => each === "vtu/state.pvd")],
  ["csv", "Numbers (CSV)", (names) => names.find((each) => each === "response.csv")],
];

/** @param {HTMLElement} place @param {import("../main.js").App} app */
export async function show(place, app) {
  const content = await app.workspace();
  const names = app.shown.split(" + ").filter(Boolean);
  if (!names.length) {
    const runs = content.runs.map((/** @type {string} */ name) => h("li", {}, h("a", { href: `#/look/${part(name)}` }, name)));
    place.append(h("h1", {}, "Look at a run"), runs.length ? h("ul", {}, ...runs) : h("p", { class: "quiet" }, "No run in this folder yet. Solve a job, and its states are here while it is solved."));
    return undefined;
  }
  const screen = new Look(place, app, names, content);
  await screen.begin();
  return () => screen.end();
}

class Look {
  /** @param {HTMLElement} place @param {import("../main.js").App} app @param {string[]} names @param {any} content */
  constructor(place, app, names, content) {
    this.app = app;
    this.names = names.slice(0, MOST);
    this.alive = true;
    /** @type {any[]} */
    this.runs = [];
    /** @type {any[]} */
    this.viewers = [];
    this.measure = "";
    /** @type {number | undefined} */
    this.late = undefined;
    /** @type {{name: string, columns: any[]} | null} */
    this.experiment = null;
    this.pictures = h("div", { class: "stack" });
    this.curves = h("section", { class: "card" });
    this.table = h("section", { class: "card" });
    this.files = h("section", { class: "card" });
    place.append(h("h1", {}, "Look at ", ...this.names.flatMap((name, k) => [k ? " and " : "", name])),
      this.#tools(content), this.pictures, h("div", { class: "pair" }, this.curves, this.table), this.files);
    place.addEventListener("dragover", (event) => event.preventDefault());
    place.addEventListener("drop", (event) => this.#dropped(event));
    this.changed = later((/** @type {CustomEvent} */ event) => {
      if (this.names.some((name) => event.detail.includes(name))) this.load();
    }, 600);
  }

  /** @param {any} content */
  #tools(content) {
    const others = content.runs.filter((/** @type {string} */ name) => !this.names.includes(name));
    const open = (/** @type {string[]} */ names) => this.app.go("look", names.join(" + "));
    const more = h("select", { "aria-label": "compare with a run", disabled: this.names.length >= MOST || !others.length, onchange: () => more.value && open([...this.names, more.value]) },
      h("option", { value: "" }, "Compare with a run …"), ...others.map((/** @type {string} */ name) => h("option", { value: name }, name)));
    const table = h("select", { "aria-label": "compare with an experiment", onchange: () => this.#experiment(table.value) },
      h("option", { value: "" }, content.tables.length ? "Compare with an experiment …" : "Drop a CSV file of an experiment here"),
      ...content.tables.map((/** @type {string} */ name) => h("option", { value: name }, name)));
    const fewer = this.names.length > 1 ? this.names.map((name) => h("button", { type: "button", onclick: () => open(this.names.filter((each) => each !== name)) }, `Close ${name}`)) : [];
    return h("div", { class: "bar" }, more, table, ...fewer);
  }

  async begin() {
    this.app.changes.addEventListener("change", this.changed);
    await this.load();
  }

  end() {
    this.alive = false;
    this.app.changes.removeEventListener("change", this.changed);
    for (const each of this.viewers) each?.viewer.close();
  }

  async load() {
    const runs = await Promise.all(this.names.map(statusOf));
    if (!this.alive) return;
    const same = this.runs.length && runs.every((each, k) => each.states === this.runs[k].states && each.state === this.runs[k].state);
    this.runs = runs;
    this.drawFiles();
    this.drawCurves();
    if (!same) await this.drawPictures();
    if (this.alive) this.marks();
  }

  // ---- pictures

  async drawPictures() {
    for (const each of this.viewers) each?.viewer.close();
    this.viewers = [];
    const places = this.runs.map((run) => h("div", { class: "picture" }, h("p", { class: "quiet" }, run.states ? "Reading the states …" : "No state is solved yet.")));
    const box = h("div", { class: this.runs.length > 1 ? "pair" : "" }, ...this.runs.map((run, k) =>
      h("section", { class: "card" }, h("h2", {}, run.name, badge(run.coarse)), places[k])));
    fill(this.pictures, box);
    for (const [k, run] of this.runs.entries()) {
      if (!run.states) continue;
      try {
        const scene = await sceneOf(run.name);
        if (!this.alive) return;
        if (!scene) continue;
        const viewer = await picture(places[k], { ...scene, curves: null });
        this.viewers[k] = { viewer, scene };
        places[k].append(...scene.notes.map((/** @type {string} */ each) => h("p", { class: "quiet small" }, each)));
        this.#follow(k, viewer);
      } catch (error) {
        fill(places[k], h("p", { class: "wrong" }, /** @type {Error} */ (error).message));
      }
    }
  }

  /** Move the marks, and the other pictures, with the slider of one. @param {number} k @param {any} viewer */
  #follow(k, viewer) {
    const shown = viewer.show.bind(viewer);
    viewer.show = (/** @type {number} */ step) => {
      shown(step);
      if (this.linking) return;
      this.linking = true;
      this.viewers.forEach((other, number) => {
        if (other && number !== k) other.viewer.show(this.#same(k, step, number));
      });
      this.linking = false;
      this.late ??= window.setTimeout(() => { this.late = undefined; this.marks(); }, NUMBERS);
    };
  }

  /** Step of another run at the same drive. @param {number} from @param {number} step @param {number} to */
  #same(from, step, to) {
    const [here, there] = [from, to].map((k) => this.viewers[k].scene.steps.map((/** @type {any} */ each) => drive(this.runs[k]).values[each.state] ?? null));
    const count = this.viewers[to].scene.steps.length;
    const share = step / Math.max(1, this.viewers[from].scene.steps.length - 1);
    const value = between(here, step);
    if (value === null || there.includes(null) || drive(this.runs[from]).name !== drive(this.runs[to]).name) return Math.round(share * (count - 1));
    const after = there.findIndex((/** @type {number} */ each) => each >= value);
    if (after < 0) return count - 1;
    if (!after) return 0;
    const place = after - 1 + (value - there[after - 1]) / (there[after] - there[after - 1] || 1);
    return this.viewers[to].scene.places ? place : Math.round(place);
  }

  /** Row of the response that is shown of a run. @param {number} k */
  #row(k) {
    const known = this.viewers[k];
    if (!known) return Math.max(0, (drive(this.runs[k])?.values.length ?? 1) - 1);
    return between(known.scene.steps.map((/** @type {any} */ each) => each.state), known.viewer.step) ?? 0;
  }

  // ---- numbers

  drawCurves() {
    const runs = this.runs.filter((each) => each.columns.length && each.columns[0].values.length);
    const names = [...new Set(runs.flatMap((each) => measures(each).map((column) => column.name)))];
    if (!names.length) {
      fill(this.curves, h("h2", {}, "Curves"), h("p", { class: "quiet" }, "No numbers yet."));
      return;
    }
    if (!names.includes(this.measure)) this.measure = names[0];
    const menu = h("select", { "aria-label": "measure", onchange: () => { this.measure = menu.value; this.drawCurves(); } },
      ...names.map((name) => h("option", { value: name, selected: name === this.measure }, words(name))));
    this.box = h("div", {});
    this.key = h("div", {});
    fill(this.curves, h("h2", {}, "Curves"), h("div", { class: "bar" }, menu), this.box, this.key);
    this.marks();
  }

  marks() {
    if (!this.box || !this.alive) return;
    const first = this.runs.find((each) => each.columns.some((/** @type {any} */ column) => column.name === this.measure));
    if (!first) return;
    /** @type {import("../parts/chart.js").Series[]} */
    const series = this.runs.flatMap((run, k) => {
      const column = run.columns.find((/** @type {any} */ each) => each.name === this.measure);
      return column ? [{ name: run.name, x: drive(run).values, y: column.values, error: column.error, kind: run.coarse ? "coarse" : "line", mark: this.#row(k) }] : [];
    });
    const x = drive(first);
    const y = first.columns.find((/** @type {any} */ each) => each.name === this.measure);
    series.push(...this.#points(x, y));
    chart(this.box, series, { x: label(x), y: label(y) });
    fill(this.key, legend(series, h));
    this.#numbers();
  }

  #numbers() {
    const names = [...new Set(this.runs.flatMap((each) => (each.columns.length ? measures(each).map((column) => column.name) : [])))];
    const cell = (/** @type {any} */ run, /** @type {number} */ k, /** @type {string} */ name) => {
      const column = run.columns.find((/** @type {any} */ each) => each.name === name);
      if (!column) return h("td", {}, "–");
      const row = this.#row(k);
      return h("td", {}, withError(between(column.values, row), column.error ? between(column.error, row) : null, column.unit));
    };
    const at = this.runs.map((run, k) => (run.columns.length ? withError(between(drive(run).values, this.#row(k)), null, drive(run).unit) : ""));
    fill(this.table, h("h2", {}, "Numbers at the shown state"), h("div", { class: "scroll" }, h("table", { class: "numbers" },
      h("thead", {}, h("tr", {}, h("th", { scope: "col" }, "Measure ± mesh error"), ...this.runs.map((run, k) => h("th", { scope: "col" }, `${run.name} at ${at[k]}`, badge(run.coarse))))),
      h("tbody", {}, ...names.map((name) => h("tr", {}, h("th", { scope: "row" }, words(name)), ...this.runs.map((run, k) => cell(run, k, name))))))));
  }

  // ---- experiments

  /** @param {string} name */
  async #experiment(name) {
    if (!name) this.experiment = null;
    else {
      const read = await attempt(() => get(`/api/runs/experiment?table=${part(name)}`));
      if (!read) return;
      this.experiment = { name, columns: read.columns };
    }
    this.marks();
  }

  /** Points of the experiment, in the units of the run. @param {any} x @param {any} y @returns {import("../parts/chart.js").Series[]} */
  #points(x, y) {
    if (!this.experiment) return [];
    const find = (/** @type {any} */ wanted) => this.experiment?.columns.find((each) => plain(each.name) === plain(wanted.name));
    const [across, upward] = [find(x), find(y)];
    if (!across || !upward) {
      say(`'${this.experiment.name}' has no columns '${x.name}' and '${y.name}'; it has ${this.experiment.columns.map((each) => each.name).join(", ")}.`);
      return [];
    }
    const scaled = (/** @type {any} */ column, /** @type {any} */ like) => {
      const share = scale(column.unit || like.unit) / scale(like.unit);
      return column.values.map((/** @type {number | null} */ each) => (each === null ? null : each * share));
    };
    return [{ name: this.experiment.name, x: scaled(across, x), y: scaled(upward, y), kind: "points" }];
  }

  /** @param {DragEvent} event */
  async #dropped(event) {
    const file = event.dataTransfer?.files[0];
    if (!file) return;
    event.preventDefault();
    const done = await attempt(() => post(`/api/runs/experiment?name=${part(file.name)}`, file));
    if (done) await this.#experiment(done.name);
  }

  // ---- files

  drawFiles() {
    const rows = this.runs.map((run) => h("div", { class: "bar" }, this.runs.length > 1 && h("b", {}, run.name), ...FILES.map(([kind, title, find]) => this.#button(run, kind, title, find(run.files)))));
    const all = this.runs.map((run) => h("details", {}, h("summary", {}, `All files of ${run.name}`), h("ul", {}, ...run.files.map((/** @type {string} */ name) => h("li", {}, h("a", { href: fileOf(run.name, name) }, name))))));
    fill(this.files, h("h2", {}, "Save"), ...rows, ...all);
  }

  /** @param {any} run @param {string} kind @param {string} title @param {string | undefined} file */
  #button(run, kind, title, file) {
    if (file && kind === "vtu") return h("a", { class: "button", href: `/api/runs/fields?run=${part(run.name)}` }, title);
    if (file) return h("a", { class: "button", href: fileOf(run.name, file), target: kind === "report" ? "_blank" : null, rel: "noopener" }, title);
    if (kind === "csv") return null;
    const make = async () => {
      button.disabled = true;
      button.textContent = `${title}: being made …`;
      const k = this.runs.indexOf(run);
      const made = await attempt(() => post("/api/runs/make", { run: run.name, kind, state: Math.round(this.#row(Math.max(0, k))) }));
      if (!this.alive) return;
      if (made && kind !== "report" && kind !== "vtu") location.assign(fileOf(run.name, made.file));
      if (made) say(`'${made.file}' is in the folder '${run.name}'.`);
      await this.load();
    };
    const button = h("button", { type: "button", disabled: run.state === "running", title: run.state === "running" ? "When the run has ended" : "It is made now", onclick: make }, title);
    return button;
  }
}

/** A name without what laboratories add to it. @param {string} name */
const plain = (name) => name.toLowerCase().replace(/[^a-z0-9]+/g, "_").replace(/^_|_$/g, "");

/** Units of tables of laboratories, in SI. @type {Record<string, number>} */
const UNITS = { m: 1, mm: 1e-3, um: 1e-6, rad: 1, deg: Math.PI / 180, "°": Math.PI / 180, Pa: 1, kPa: 1e3, MPa: 1e6, bar: 1e5, mbar: 100, psi: 6894.757, m3: 1, mL: 1e-6, ml: 1e-6, L: 1e-3, N: 1, mN: 1e-3, s: 1, ms: 1e-3 };

/** @param {string} unit */
const scale = (unit) => UNITS[unit] ?? 1;
