// Study form: which numbers of a job vary, and what is read, wanted or fitted; it writes a study file and starts it.

import { post } from "../api.js";
import { fill, h } from "../dom.js";
import { sign, words, written } from "./numbers.js";
import { attempt } from "./runs.js";

const RANGE = 0.2; // a factor is varied by this share of its value at first

/** @type {[string, string][]} */
const TITLES = [["sweep", "Sweep: compute many designs"], ["optimize", "Optimization: find the design"], ["calibrate", "Calibration: fit numbers to an experiment"]];

export class StudyForm {
  /**
   * @param {HTMLElement} place
   * @param {{job: string, numbers: any, tables: string[], started: (study: string, kind: string) => void}} given
   */
  constructor(place, given) {
    Object.assign(this, given);
    this.given = given;
    this.kind = "sweep";
    /** @type {{key: string, low: string, high: string, levels: string}[]} */
    this.factors = [this.#factor(this.#first())];
    this.goals = { measure: given.numbers.measures[0], value: "", way: "target", most: "25", at: "" };
    this.experiment = given.tables[0] ?? "";
    this.name = "";
    this.place = place;
    this.draw();
  }

  // The number that is varied most often.
  #first() {
    const keys = this.given.numbers.numbers.map((/** @type {any} */ each) => each.key);
    return keys.find((/** @type {string} */ each) => each === "actuator.wall") ?? keys.find((/** @type {string} */ each) => each.startsWith("actuator.")) ?? keys[0];
  }

  /** @param {string} key */
  #factor(key) {
    const number = this.#number(key);
    const text = (/** @type {number} */ share) => (number.whole ? String(Math.max(1, Math.round(number.value * share))) : `${Number((number.value * share).toPrecision(4))}${number.unit ? ` ${number.unit}` : ""}`);
    return { key, low: text(1 - RANGE), high: text(1 + RANGE), levels: "3" };
  }

  /** @param {string} key */
  #number(key) {
    return this.given.numbers.numbers.find((/** @type {any} */ each) => each.key === key) ?? { value: 1, unit: "", whole: false };
  }

  draw() {
    const field = (/** @type {string} */ title, /** @type {any} */ control) => h("label", {}, h("span", { class: "quiet small" }, title), control);
    const kind = h("select", { onchange: () => { this.kind = kind.value; this.draw(); } }, ...TITLES.map(([value, title]) => h("option", { value, selected: value === this.kind }, title)));
    const name = h("input", { value: this.name || this.#free(), onchange: () => { this.name = name.value; } });
    const rows = this.factors.map((factor, k) => this.#row(factor, k, field));
    const more = h("button", { type: "button", onclick: () => { this.factors.push(this.#factor(this.#next())); this.draw(); } }, "One more number");
    const start = h("button", { type: "button", class: "primary", onclick: () => this.#start(name.value) }, "Start");
    fill(this.place, h("h2", {}, "Begin a study"),
      h("form", { class: "form", onsubmit: (/** @type {Event} */ event) => event.preventDefault() },
        h("div", { class: "line" }, field("Kind", kind), field("Name of its file", name)),
        h("h3", {}, this.kind === "calibrate" ? "Numbers to fit" : "Numbers that vary"), ...rows, h("div", {}, more),
        ...this.#wanted(field), h("div", {}, start)));
  }

  #free() {
    return `${this.given.job.replace(/\.toml$/, "")}-${this.kind}.toml`;
  }

  #next() {
    const used = new Set(this.factors.map(({ key }) => key));
    return this.given.numbers.numbers.find((/** @type {any} */ each) => !used.has(each.key) && each.key.startsWith("actuator."))?.key ?? this.given.numbers.numbers[0].key;
  }

  /** @param {any} factor @param {number} k @param {(title: string, control: any) => any} field */
  #row(factor, k, field) {
    const menu = h("select", { onchange: () => { this.factors[k] = this.#factor(menu.value); this.draw(); } }, ...this.given.numbers.numbers.map((/** @type {any} */ each) =>
      h("option", { value: each.key, selected: each.key === factor.key }, `${each.key} = ${written(each.value, 6)} ${sign(each.unit)}`.trim())));
    const input = (/** @type {"low" | "high" | "levels"} */ name) => {
      const made = h("input", { value: factor[name], size: 9, onchange: () => { factor[name] = made.value.trim(); } });
      return made;
    };
    const drop = h("button", { type: "button", class: "quiet", "aria-label": `leave ${factor.key} out`, disabled: this.factors.length < 2, onclick: () => { this.factors.splice(k, 1); this.draw(); } }, "×");
    return h("div", { class: "line", "data-factor": factor.key }, field("Number", menu), field("From", input("low")), field("To", input("high")), this.kind === "sweep" && field("Levels", input("levels")), drop);
  }

  /** @param {(title: string, control: any) => any} field */
  #wanted(field) {
    const { goals } = this;
    const measure = h("select", { onchange: () => { goals.measure = measure.value; } }, ...this.given.numbers.measures.map((/** @type {string} */ each) => h("option", { value: each, selected: each === goals.measure }, words(each))));
    const text = (/** @type {"value" | "most" | "at"} */ key, /** @type {string} */ hint) => {
      const made = h("input", { value: goals[key], placeholder: hint, size: 12, onchange: () => { goals[key] = made.value.trim(); } });
      return made;
    };
    if (this.kind === "sweep") return [h("h3", {}, "What is read"), h("div", { class: "line" }, field("Measure", measure), field("At the pressure (the end by default)", text("at", "15 kPa")))];
    if (this.kind === "optimize") {
      const way = h("select", { onchange: () => { goals.way = way.value; this.draw(); } }, ...["target", "minimize", "maximize"].map((each) => h("option", { value: each, selected: each === goals.way }, each)));
      return [h("h3", {}, "What is wanted"), h("div", { class: "line" }, field("Goal", way), field("Measure", measure), goals.way === "target" && field("Value", text("value", "40 deg")),
        field("At the pressure (the end by default)", text("at", "15 kPa")), field("Runs at most", text("most", "25")))];
    }
    if (!this.given.tables.length) return [h("p", { class: "quiet" }, "Put a CSV file of the experiment into the folder first, or drop it on Look.")];
    const table = h("select", { onchange: () => { this.experiment = table.value; } }, ...this.given.tables.map((each) => h("option", { value: each, selected: each === this.experiment }, each)));
    return [h("h3", {}, "What is fitted"), h("div", { class: "line" }, field("Experiment", table))];
  }

  // Tables of the study file.
  #values() {
    const plain = (/** @type {string} */ text) => (/^-?[\d.]+(e-?\d+)?$/i.test(text) ? Number(text) : text);
    /** @type {Record<string, any>} */
    const values = {};
    for (const { key, low, high, levels } of this.factors) {
      values[`factors.${key}`] = { low: plain(low), high: plain(high), ...(this.kind === "sweep" ? { levels: Number(levels) || 3 } : {}) };
    }
    const { goals } = this;
    const at = goals.at ? { at: { pressure: goals.at } } : {};
    if (this.kind === "sweep") values.sweep = { measures: [goals.measure], ...at };
    else if (this.kind === "calibrate") values.calibrate = { experiments: [this.experiment] };
    else {
      const goal = goals.way === "target" ? { targets: [{ measure: goals.measure, value: plain(goals.value), ...at }] } : { objectives: [{ [goals.way]: goals.measure, ...at }] };
      values.optimize = { most_solves: Number(goals.most) || 25, ...goal };
    }
    return values;
  }

  /** @param {string} name */
  async #start(name) {
    const begun = await attempt(() => post("/api/studies", { name, kind: this.kind, job: this.given.job, values: this.#values() }));
    if (begun) this.given.started(begun.name, this.kind);
  }
}
