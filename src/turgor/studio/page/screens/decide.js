// Decide: sweeps, optimizations, calibrations and workspaces of a job: started from a form, filling as runs end.

import { get, part, post } from "../api.js";
import { fill, h } from "../dom.js";
import { chart, legend } from "../parts/chart.js";
import { sign, withError, words, written } from "../parts/numbers.js";
import { attempt } from "../parts/runs.js";
import { StudyForm } from "../parts/study_form.js";
import { Reach } from "../parts/reach.js";

const POLL = 1500; // milliseconds between two looks at a study

/** Titles and the words of each kind. @type {Record<string, string>} */
export const KINDS = { sweep: "Sweep: compute many designs", optimize: "Optimization: find the design", calibrate: "Calibration: fit numbers to an experiment" };

/** @param {HTMLElement} place @param {import("../main.js").App} app */
export async function show(place, app) {
  const screen = new Decide(place, app);
  await screen.begin();
  return () => screen.end();
}

class Decide {
  /** @param {HTMLElement} place @param {import("../main.js").App} app */
  constructor(place, app) {
    this.app = app;
    this.job = app.job.name;
    this.alive = true;
    this.study = "";
    this.kind = "";
    this.measure = "";
    this.known = "";
    this.list = h("div", { class: "bar" });
    this.body = h("div", { class: "stack" });
    this.form = h("section", { class: "card" });
    this.reach = new Reach(app);
    place.append(h("h1", {}, `Decide about ${this.job}`), this.list, this.body, this.form, this.reach.element);
  }

  async begin() {
    await this.drawList();
    const numbers = await attempt(() => get(`/api/studies/numbers/${part(this.job)}`));
    if (!this.alive) return;
    if (numbers) {
      const { tables } = await this.app.workspace();
      new StudyForm(this.form, { job: this.job, numbers, tables, started: (study, kind) => this.open(study, kind) });
      this.reach.begin(numbers.cavities);
    } else fill(this.form, h("p", { class: "quiet" }, "Mend the problems of the job first: Solve lists them."));
    this.poll();
  }

  end() {
    this.alive = false;
    this.reach.end();
  }

  /** @param {string} study @param {string} kind */
  async open(study, kind) {
    Object.assign(this, { study, kind, known: "", measure: "" });
    await this.drawList();
    await this.look();
  }

  async drawList() {
    const studies = await get("/api/studies");
    const all = studies.flatMap((/** @type {any} */ each) => each.kinds.map((/** @type {string} */ kind) => ({ name: each.name, kind })));
    if (!this.study && all.length) ({ name: this.study, kind: this.kind } = all[0]);
    const buttons = all.map((/** @type {any} */ each) => h("button", { type: "button", "aria-pressed": String(each.name === this.study && each.kind === this.kind), onclick: () => this.open(each.name, each.kind) }, `${each.name} (${each.kind})`));
    fill(this.list, ...(buttons.length ? buttons : [h("p", { class: "quiet" }, "No study in this folder yet. A study computes a job with other numbers: begin one below.")]));
  }

  async poll() {
    if (!this.alive) return;
    if (this.study) await this.look();
    if (this.alive) setTimeout(() => this.poll(), POLL);
  }

  async look() {
    let status;
    try {
      status = await get(`/api/studies/status?study=${part(this.study)}&kind=${this.kind}`);
    } catch {
      return; // the server comes back
    }
    const text = JSON.stringify(status);
    if (!this.alive || text === this.known) return;
    this.known = text;
    this.status = status;
    this.app.seen = { ...this.app.seen, study: this.study, kind: this.kind, folder: status.folder };
    this.draw();
  }

  draw() {
    const { status } = this;
    const act = (/** @type {string} */ way) => async () => {
      if (await attempt(() => post(`/api/studies/${way}`, { study: this.study, kind: this.kind }))) await this.look();
    };
    const planned = status.planned ? ` of ${status.rule === "at most" ? "at most " : ""}${status.planned}` : "";
    const said = /** @type {Record<string, string>} */ ({ running: "is being computed", ended: "has ended", paused: "is paused", failed: "failed", none: "is not started" })[status.state];
    const head = h("div", { class: "bar" },
      h("h2", {}, status.folder), h("span", { class: "quiet", "data-state": status.state }, `${said}: ${status.rows.length}${planned} runs${status.solving ? `, ${status.solving} being solved` : ""}`),
      status.state === "running" && h("button", { type: "button", onclick: act("end") }, "Pause"),
      status.state !== "running" && status.state !== "ended" && h("button", { type: "button", onclick: act("start") }, status.state === "none" ? "Start" : "Go on"));
    const problem = status.problem && h("p", { class: "wrong" }, status.problem);
    const failed = status.state === "failed" && h("p", { class: "wrong" }, status.log.at(-1) ?? "");
    const bar = status.state === "running" && status.planned && h("progress", { max: status.planned, value: status.rows.length, "aria-label": "runs that have ended" });
    const log = h("details", {}, h("summary", {}, "Log"), h("pre", { class: "log", tabindex: 0 }, status.log.join("\n")));
    fill(this.body, h("section", { class: "card" }, ...[head, bar, problem, failed].filter(Boolean), this.#table(), log), ...this.#plots());
  }

  #measures() {
    return [...new Map(this.status.rows.flatMap((/** @type {any} */ row) => row.measures.map((/** @type {any} */ each) => [each.name, each]))).values()];
  }

  #table() {
    const { rows } = this.status;
    if (!rows.length) return h("p", { class: "quiet" }, "Each run adds a row as it ends.");
    const factors = [...new Set(rows.flatMap((/** @type {any} */ row) => row.factors.map((/** @type {any} */ each) => each.name)))];
    const measures = /** @type {any[]} */ (this.#measures()).slice(0, 8);
    const units = (/** @type {string} */ name) => rows.flatMap((/** @type {any} */ row) => row.factors).find((/** @type {any} */ each) => each.name === name)?.unit;
    const open = (/** @type {any} */ row) => () => this.#open(row);
    const body = rows.map((/** @type {any} */ row, /** @type {number} */ k) => h("tr", { class: "design", "data-row": row.key },
      h("td", {}, h("button", { type: "button", onclick: open(row) }, `Look at ${k + 1}`)),
      ...factors.map((name) => {
        const value = row.factors.find((/** @type {any} */ each) => each.name === name)?.value;
        return h("td", {}, typeof value === "number" ? written(value, 6) : value ?? "–");
      }),
      ...measures.map((/** @type {any} */ measure) => {
        const value = row.measures.find((/** @type {any} */ each) => each.name === measure.name);
        return h("td", {}, value ? withError(value.value, value.error, value.unit) : "–");
      }),
      h("td", { class: row.problem ? "wrong" : "quiet", title: row.problem }, row.problem ? row.problem.slice(0, 60) : "ended")));
    return h("div", { class: "scroll" }, h("table", { class: "numbers" },
      h("thead", {}, h("tr", {}, h("th", { scope: "col" }, "Run"), ...factors.map((name) => h("th", { scope: "col" }, units(name) ? `${name} [${sign(units(name))}]` : name)),
        ...measures.map((/** @type {any} */ each) => h("th", { scope: "col" }, words(each.name))), h("th", { scope: "col" }, "State"))),
      h("tbody", {}, ...body)));
  }

  #plots() {
    const { rows, files } = this.status;
    const measures = /** @type {any[]} */ (this.#measures());
    const out = [];
    if (measures.length && rows[0]?.factors.length) {
      if (!measures.some((each) => each.name === this.measure)) this.measure = measures[0].name;
      const menu = h("select", { "aria-label": "measure of the plot", onchange: () => { this.measure = menu.value; this.draw(); } },
        ...measures.map((each) => h("option", { value: each.name, selected: each.name === this.measure }, words(each.name))));
      const box = h("div", {});
      const series = this.#series();
      const measure = measures.find((each) => each.name === this.measure);
      const [first] = rows[0].factors;
      const x = this.kind === "sweep" ? `${first.name}${first.unit ? ` [${sign(first.unit)}]` : ""}` : "run";
      chart(box, series, { x, y: words(this.measure) });
      out.push(h("section", { class: "card" }, h("h2", {}, `${words(this.measure)}${measure.unit ? ` [${sign(measure.unit)}]` : ""}`), h("div", { class: "bar" }, menu), box, legend(series, h)));
    }
    const pictures = files.filter((/** @type {string} */ each) => each.endsWith(".png"));
    const link = (/** @type {string} */ file, show = false) => `/api/studies/file?study=${part(this.study)}&kind=${this.kind}&file=${part(file)}${show ? "&show=1" : ""}`;
    if (pictures.length) out.push(h("section", { class: "card study-pictures" }, h("h2", {}, "Pictures"), ...pictures.map((/** @type {string} */ each) => h("img", { src: link(each, true), alt: each.replace(".png", "").replaceAll("_", " ") }))));
    if (files.length) out.push(h("section", { class: "card" }, h("h2", {}, "Save"), h("div", { class: "bar" }, ...files.map((/** @type {string} */ each) => h("a", { class: "button", href: link(each) }, each)))));
    return out;
  }

  // Of a sweep the measure against the first factor, a curve for each value of the others; of a search from run to run.
  #series() {
    const { rows } = this.status;
    /** @type {Map<string, {x: number, y: number, e: number | null}[]>} */
    const groups = new Map();
    rows.forEach((/** @type {any} */ row, /** @type {number} */ k) => {
      const value = row.measures.find((/** @type {any} */ each) => each.name === this.measure);
      if (!value || value.value === null) return;
      const [first, ...others] = row.factors;
      const sweep = this.kind === "sweep" && typeof first.value === "number";
      const name = sweep ? others.map((/** @type {any} */ each) => `${each.name} ${each.value} ${each.unit}`.trim()).join(", ") || "designs" : "runs";
      groups.set(name, [...(groups.get(name) ?? []), { x: sweep ? first.value : k + 1, y: value.value, e: value.error }]);
    });
    return [...groups].map(([name, points]) => {
      points.sort((a, b) => a.x - b.x);
      return { name, x: points.map(({ x }) => x), y: points.map(({ y }) => y), error: points.map(({ e }) => e), kind: /** @type {"line"} */ ("line") };
    });
  }

  /** Write the design of a row as a job of its own, and look at its run; it is solved first where it was not. @param {any} row */
  async #open(row) {
    const made = await attempt(() => post("/api/studies/design", { study: this.study, kind: this.kind, row: row.key }));
    if (!made) return;
    const run = made.name.replace(/\.toml$/, "-results");
    const known = (await get("/api/runs")).find((/** @type {any} */ each) => each.name === run);
    if (!known && !(await attempt(() => post("/api/runs", { job: made.name, way: "fine" })))) return;
    this.app.go("look", run);
  }
}
