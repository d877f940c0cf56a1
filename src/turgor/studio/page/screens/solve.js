// Solve: checks as one edits, the load over the path, and the runs of the job while they are solved.

import { get, part, post, Refused } from "../api.js";
import { fill, h, later } from "../dom.js";
import { chart, legend } from "../parts/chart.js";
import { historyCurve, statesLine } from "../parts/dragging.js";
import { findingItem, problemItem } from "../parts/findings.js";
import { label, last, withError, words } from "../parts/numbers.js";
import { attempt, badge, costs, runLine, sceneOf, statusOf } from "../parts/runs.js";
import { picture } from "../picture.js";

const POLL = 700; // milliseconds between two looks at runs that are being solved
const SETTLE = 350; // milliseconds after the last edit before a check begins
const NOISE = 1e-6; // numbers smaller than this in their unit are round-off, as in the report
const EVERY = 1500; // least time between two drawings of the shape

/** @param {HTMLElement} place @param {import("../main.js").App} app */
export function show(place, app) {
  const screen = new Solve(place, app);
  screen.begin();
  return () => screen.end();
}

class Solve {
  /** @param {HTMLElement} place @param {import("../main.js").App} app */
  constructor(place, app) {
    this.app = app;
    this.job = app.job;
    this.alive = true;
    /** @type {any[]} */
    this.runs = [];
    /** @type {any} */
    this.estimate = null;
    /** @type {any} */
    this.checked = null;
    this.measure = "";
    this.drawn = { name: "", states: 0, time: 0, busy: false };
    this.checks = h("section", { class: "card", "aria-live": "polite" });
    this.loads = h("section", { class: "card" });
    this.start = h("div", { class: "bar" });
    this.list = h("ul", { class: "runs" });
    this.curves = h("section", { class: "card" });
    this.last = h("section", { class: "card", hidden: true });
    this.shape = h("section", { class: "picture" });
    this.shapeTitle = h("h2", {}, "Shape");
    this.log = h("pre", { class: "log", tabindex: 0, "aria-label": "log" });
    const logs = h("details", {}, h("summary", {}, "Log"), this.log);
    place.append(h("h1", {}, `Solve ${this.job.name}`),
      h("div", { class: "split" },
        h("div", { class: "stack" }, this.checks, this.loads),
        h("div", { class: "stack" }, h("section", { class: "card" }, this.start, this.list), h("div", { class: "pair" }, this.curves, h("section", { class: "card" }, this.shapeTitle, this.shape)), this.last, logs)));
    this.edited = later(() => this.check(), SETTLE);
    this.changed = () => this.edited();
  }

  begin() {
    this.job.addEventListener("change", this.changed);
    fill(this.shape, h("p", { class: "quiet" }, "The shape appears here as soon as the first state is solved."));
    this.check();
    this.poll();
  }

  end() {
    this.alive = false;
    this.job.removeEventListener("change", this.changed);
    this.viewer?.close();
  }

  // ---- checks

  async check() {
    fill(this.checks, h("h2", {}, "Checks"), h("p", { class: "quiet" }, "Checking …"));
    const version = this.job.state?.version;
    let checked;
    try {
      checked = await get(`/api/checks/${part(this.job.name)}`);
    } catch (error) {
      checked = { problems: [{ sentence: /** @type {Error} */ (error).message, key: "", fixes: [] }] };
    }
    if (!this.alive || checked.superseded || version !== this.job.state?.version) return;
    this.checked = checked;
    const problems = checked.problems.map((/** @type {any} */ each) => problemItem(each, this.job));
    const findings = (checked.findings ?? []).map((/** @type {any} */ each) => findingItem(each, this.job));
    const good = !problems.length && !findings.some((/** @type {any} */ each) => each.matches(".error"));
    fill(this.checks, h("h2", {}, "Checks"),
      ...(checked.mesh ? [h("p", {}, `${checked.mesh}.`)] : []),
      ...(checked.contact ?? []).map((/** @type {string} */ each) => h("p", { class: "quiet" }, each)),
      good && !findings.length ? h("p", { class: "good" }, "Nothing to mend: the job can be solved.") : h("ul", { class: "findings" }, ...problems, ...findings));
    this.drawStart();
    this.drawLoads();
  }

  drawStart() {
    const ready = this.checked && !this.checked.problems.length;
    const fine = this.runs.find((each) => !each.coarse);
    const busy = this.runs.some((each) => each.state === "running");
    const again = fine?.states ? " again" : "";
    const about = fine?.states ? "Its results replace those of the earlier run once they exist" : "A coarse answer first, then the fine one";
    fill(this.start,
      h("button", { type: "button", class: "primary", disabled: !ready || busy, title: about, onclick: () => this.solve("both") }, `Solve${again}`),
      h("button", { type: "button", disabled: !ready || busy, title: "Few large cells: an answer within seconds, right in its trend", onclick: () => this.solve("coarse") }, "Coarse only"),
      h("button", { type: "button", disabled: !ready || busy, onclick: () => this.solve("fine") }, "Fine only"),
      h("span", { class: "quiet" }, !this.checked ? "Checking …" : ready ? costs(this.checked.expected) : "Mend the problems first."));
  }

  drawLoads() {
    const parts = [];
    for (const load of this.checked?.loads ?? []) {
      const box = h("div", {});
      if (load.at) {
        if (!load.fixed) statesLine(box, { at: load.at, change: (at) => this.job.set({ [load.key]: at.length ? at : null }) });
        parts.push(h("h3", {}, "Requested states"), load.fixed ? h("p", { class: "quiet" }, "The file states pressures; edit them in the code.") : box);
        continue;
      }
      parts.push(h("h3", {}, `${load.name}: share of ${load.full}`));
      if (!load.points) {
        parts.push(h("p", { class: "quiet" }, h("code", {}, load.text), " is an expression; edit it in the code."));
        continue;
      }
      const timed = load.key.endsWith("over_time");
      const width = timed ? Math.max(...load.points.map((/** @type {number[]} */ each) => each[0])) : 1;
      historyCurve(box, { points: load.points, width, x: timed ? "time [s]" : "load factor", y: "share", change: (points) => this.job.set({ [load.key]: points }) });
      parts.push(box);
    }
    fill(this.loads, h("h2", {}, "Load over the path"), ...parts);
  }

  // ---- runs

  /** @param {"both" | "coarse" | "fine"} way */
  async solve(way) {
    if (!(await attempt(() => post("/api/runs", { job: this.job.name, way })))) return;
    if (way !== "fine") this.guess();
    await this.look();
  }

  // What a part of the actuator says, within seconds: before the coarse run has ended.
  async guess() {
    const estimate = await attempt(() => get(`/api/estimates/${part(this.job.name)}`));
    this.estimate = estimate?.columns.length ? { name: `from ${estimate.part}`, coarse: true, columns: estimate.columns } : null;
    if (this.alive) this.drawCurves();
  }

  async poll() {
    if (!this.alive) return;
    await this.look();
    if (this.alive) setTimeout(() => this.poll(), POLL);
  }

  async look() {
    try {
      const stem = this.job.name.replace(/\.toml$/, "");
      const all = await get("/api/runs");
      const own = all.filter((/** @type {any} */ each) => each.job === this.job.name || each.name === `${stem}-results` || each.name === `${stem}-draft`);
      const runs = await Promise.all(own.map((/** @type {any} */ each) => statusOf(each.name)));
      const before = JSON.stringify(this.runs);
      this.runs = runs.map((each) => ({ ...each, job: each.job || this.job.name }));
      if (!this.alive) return;
      if (before !== JSON.stringify(this.runs) || !this.list.childElementCount) this.draw();
      else this.drawShape();
    } catch (error) {
      if (!(error instanceof Refused) || error.status) throw error; // the server comes back
    }
  }

  draw() {
    const focus = document.activeElement?.textContent;
    fill(this.list, ...(this.runs.length ? this.runs.map((each) => runLine(each, () => this.look())) : [h("li", { class: "quiet" }, "Not solved yet. Solve gives a coarse answer first, and the fine one after it.")]));
    if (focus && document.activeElement === document.body) {
      const again = [...this.list.querySelectorAll("button")].find((each) => each.textContent === focus);
      /** @type {HTMLElement | undefined} */ (again)?.focus();
    }
    this.drawStart();
    this.drawCurves();
    const talking = this.runs.find((each) => each.state === "running") ?? this.runs[0];
    const log = (talking?.log ?? []).join("\n");
    if (this.log.textContent !== log) {
      this.log.textContent = log;
      this.log.scrollTop = this.log.scrollHeight;
    }
    this.drawShape();
  }

  drawCurves() {
    const runs = this.runs.filter((each) => each.columns.length && each.columns[0].values.length);
    if (this.estimate && !runs.some((each) => each.state === "ended")) runs.push(this.estimate);
    const names = [...new Set(runs.flatMap((each) => measures(each).map((column) => column.name)))];
    const shown = [];
    if (names.length) {
      if (!names.includes(this.measure)) this.measure = names[0];
      const menu = h("select", { "aria-label": "measure", onchange: () => { this.measure = menu.value; this.drawCurves(); } },
        ...names.map((name) => h("option", { value: name, selected: name === this.measure }, words(name))));
      const box = h("div", {});
      const series = runs.flatMap((each) => seriesOf(each, this.measure));
      const [x, y] = [drive(runs[0]), runs.flatMap((each) => each.columns).find((column) => column.name === this.measure)];
      chart(box, series, { x: label(x), y: label(y) });
      shown.push(h("div", { class: "bar" }, menu), box, legend(series, h));
      fill(this.last, table(runs));
    }
    this.last.hidden = !names.length;
    fill(this.curves, h("h2", {}, "Curves"), ...(shown.length ? shown : [h("p", { class: "quiet" }, "Each state adds a point to the curves.")]));
  }

  async drawShape() {
    const run = this.runs.find((each) => each.state === "running" && each.states) ?? this.runs.find((each) => each.states);
    const { drawn } = this;
    if (!run || drawn.busy || (drawn.name === run.name && drawn.states === run.states) || Date.now() - drawn.time < EVERY) return;
    drawn.busy = true;
    try {
      const scene = await sceneOf(run.name, "live");
      if (!scene || !this.alive) return;
      const from = drawn.name === run.name && this.viewer ? direction(this.viewer.stage) : null;
      this.viewer?.close();
      this.viewer = await picture(this.shape, scene);
      if (from) this.viewer.stage.look(...from);
      fill(this.shapeTitle, `Shape of ${run.name} `, ...[badge(run.coarse)].filter(Boolean));
      Object.assign(drawn, { name: run.name, states: run.states });
    } catch {
      fill(this.shape, h("p", { class: "quiet" }, "The shape cannot be drawn here; the numbers go on."));
      this.viewer = null;
    } finally {
      Object.assign(drawn, { busy: false, time: Date.now() });
    }
  }
}

/** From where one looks: azimuth and elevation, as the stage takes them. @param {any} stage @returns {[number, number]} */
function direction(stage) {
  const [x, y, z] = stage.camera.position.clone().sub(stage.controls.target).normalize().toArray();
  return [Math.atan2(x, -y), Math.asin(Math.max(-1, Math.min(1, z)))];
}

/** The column against which a run is drawn. @param {any} run */
export const drive = (run) => run.columns.find((/** @type {any} */ each) => each.name === "pressure" || each.name === "time") ?? run.columns[1] ?? run.columns[0];

/** Columns that a run measures, those that change. @param {any} run @returns {any[]} */
export function measures(run) {
  const x = drive(run);
  return run.columns.filter((/** @type {any} */ each) => each !== x && each.name !== "load_factor" && varies(each.values));
}

/** Whether numbers change by more than round-off. @param {(number | null)[]} values */
const varies = (values) => {
  const known = /** @type {number[]} */ (values.filter((each) => each !== null));
  return known.length > 1 && Math.max(...known) - Math.min(...known) > NOISE;
};

/** Curve of a run, if it has the measure. @param {any} run @param {string} name @returns {import("../parts/chart.js").Series[]} */
export function seriesOf(run, name) {
  const column = run.columns.find((/** @type {any} */ each) => each.name === name);
  return column ? [{ name: run.name, x: drive(run).values, y: column.values, error: column.error, kind: run.coarse ? "coarse" : "line" }] : [];
}

/** The last numbers of runs, each with its mesh error. @param {any[]} runs */
function table(runs) {
  const names = [...new Set(runs.flatMap((each) => measures(each).map((column) => column.name)))];
  const cell = (/** @type {any} */ run, /** @type {string} */ name) => {
    const column = run.columns.find((/** @type {any} */ each) => each.name === name);
    const k = column ? last(column.values) : -1;
    return h("td", {}, k < 0 ? "–" : withError(column.values[k], column.error?.[k], column.unit));
  };
  const heads = runs.map((each) => h("th", { scope: "col" }, each.name, " ", badge(each.coarse)));
  return h("div", { class: "scroll" }, h("table", { class: "numbers" },
    h("caption", {}, "At the last state"),
    h("thead", {}, h("tr", {}, h("th", { scope: "col" }, "Measure"), ...heads)),
    h("tbody", {}, ...names.map((name) => h("tr", {}, h("th", { scope: "row" }, words(name)), ...runs.map((run) => cell(run, name)))))));
}
