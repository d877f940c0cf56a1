// Sequence: moves and waits that a user records, edits, plays, saves as a CSV file and loads again.

import { get, part, post } from "../api.js";
import { fill, h, say } from "../dom.js";

const SHORTEST = 0.1; // a move or wait that is shorter [s] is not recorded, or as this
const SAME = 1e-9; // share of a range within which an input has not moved

/**
 * @typedef {Record<string, number>} Values
 * @typedef {{seconds: number, values: Values}} Step to these values in this time; a wait where they are those before
 */

export class Sequence {
  /**
   * @param {import("./model.js").Table} table
   * @param {() => Values} now
   * @param {(values: Values) => void} show
   */
  constructor(table, now, show) {
    this.table = table;
    this.now = now;
    this.show = show;
    /** @type {Values} */
    this.start = now();
    /** @type {Step[]} */
    this.steps = [];
    this.repeats = 1;
    this.recording = false;
    this.playing = 0;
    this.since = 0; // end of the last recorded change
    this.began = 0; // beginning of the change that is under way
    this.list = h("ol", { class: "live-steps" });
    this.name = h("input", { value: `${table.name.replace(/\.reduced$/, "")}-sequence.csv`, "aria-label": "name of the CSV file", size: 20 });
    this.files = h("select", { "aria-label": "CSV file of the folder" });
    this.loads = h("div", { class: "live-row" }, this.files, h("button", { type: "button", onclick: () => this.load(this.files.value) }, "Load"));
    this.record = h("button", { type: "button", "aria-pressed": "false", onclick: () => this.#record(!this.recording) }, "● Record");
    this.player = h("button", { type: "button", onclick: () => this.play(!this.playing) }, "▶ Play");
    this.count = h("input", {
      type: "number", min: 1, max: 1000, value: 1, class: "live-number", "aria-label": "times that the sequence runs",
      onchange: () => (this.repeats = Math.max(1, Math.round(Number(this.count.value)) || 1)),
    });
    this.drawn = h(
      "section", { class: "card live-sequence", "aria-label": "Sequence" },
      h("h2", {}, "Sequence"),
      h("div", { class: "live-row" }, this.record, this.player, h("label", {}, "repeat ", this.count, " times")),
      this.list,
      h("div", { class: "live-row" },
        h("button", { type: "button", onclick: () => this.#add(1, this.now()) }, "Add move"),
        h("button", { type: "button", onclick: () => this.#add(1, this.#last()) }, "Add wait"),
        h("button", { type: "button", onclick: () => this.#clear() }, "Clear")),
      h("div", { class: "live-row" }, this.name, h("button", { type: "button", onclick: () => this.save() }, "Save")),
      this.loads,
    );
    this.draw();
  }

  /** The tables of the folder that may be loaded. @param {string[]} names */
  tables(names) {
    fill(this.files, ...names.map((name) => h("option", { value: name }, name)));
    this.loads.hidden = !names.length;
  }

  /** Note that a user begins to change something. */
  begins() {
    if (this.recording && !this.began) this.began = performance.now();
  }

  /** Note what a user has changed to. @param {Values} values */
  ends(values) {
    if (!this.recording || this.#same(values, this.#last())) return;
    const now = performance.now();
    const began = this.began || now;
    const pause = (began - this.since) / 1000;
    if (this.steps.length && pause >= SHORTEST) this.steps.push({ seconds: rounded(pause), values: this.#last() });
    this.steps.push({ seconds: rounded(Math.max(SHORTEST, (now - began) / 1000)), values: { ...values } });
    this.since = now;
    this.began = 0;
    this.draw();
  }

  /** Times from the start with the inputs, over all repeats. @returns {[number, number[]][]} */
  knots() {
    const row = (/** @type {Values} */ values) => this.table.inputs.map((each) => values[each.key]);
    /** @type {[number, number[]][]} */
    const out = [[0, row(this.start)]];
    let time = 0;
    for (let k = 0; k < this.repeats; k++) {
      for (const step of this.steps) out.push([(time += step.seconds), row(step.values)]);
    }
    return out;
  }

  /** @param {boolean} on */
  play(on) {
    cancelAnimationFrame(this.playing);
    this.playing = 0;
    this.player.textContent = on ? "■ Stop" : "▶ Play";
    if (!on) return;
    this.#record(false);
    const knots = this.knots();
    if (knots.length < 2) {
      this.play(false);
      say("Record a sequence first, or add a move.");
      return;
    }
    const began = performance.now();
    const frame = () => {
      const time = (performance.now() - began) / 1000;
      const k = knots.findIndex(([end]) => end >= time);
      const [before, after] = k > 0 ? [knots[k - 1], knots[k]] : [knots[0], k ? knots[knots.length - 1] : knots[0]];
      const share = k > 0 ? (time - before[0]) / (after[0] - before[0]) : k ? 1 : 0;
      this.show(Object.fromEntries(this.table.inputs.map((each, i) => [each.key, before[1][i] + share * (after[1][i] - before[1][i])])));
      if (k < 0) this.play(false);
      else this.playing = requestAnimationFrame(frame);
    };
    this.playing = requestAnimationFrame(frame);
  }

  async save() {
    try {
      const knots = this.knots();
      const made = await post(`/api/reduced/${part(this.table.name)}/sequences`, { name: this.name.value.trim(), knots });
      say(`${made.rows} rows with the tip in '${made.name}'.${made.doubtful ? ` ${made.doubtful} of them are doubtful.` : ""}`);
    } catch (error) {
      say(/** @type {Error} */ (error).message, true);
    }
  }

  /** @param {string} name */
  async load(name) {
    try {
      const { start, steps, repeats } = await get(`/api/reduced/${part(this.table.name)}/sequences/${part(name)}`);
      const values = (/** @type {number[]} */ row) => Object.fromEntries(this.table.inputs.map((each, k) => [each.key, row[k]]));
      this.start = values(start);
      this.steps = steps.map((/** @type {any} */ step) => ({ seconds: step.seconds, values: values(step.inputs) }));
      this.repeats = repeats;
      this.draw();
    } catch (error) {
      say(/** @type {Error} */ (error).message, true);
    }
  }

  draw() {
    this.count.value = this.repeats;
    const start = h("li", {}, h("span", {}, `Start at ${this.#words(this.start)}`),
      h("button", { type: "button", title: "start from the state that is shown", onclick: () => this.#begin() }, "Set"));
    fill(this.list, start, ...this.steps.map((step, k) => this.#entry(step, k)));
  }

  /** @param {Step} step @param {number} k */
  #entry(step, k) {
    const waits = this.#same(step.values, k ? this.steps[k - 1].values : this.start);
    const seconds = h("input", {
      type: "number", min: 0.01, step: 0.1, value: step.seconds, class: "live-number", "aria-label": `seconds of step ${k + 1}`,
      onchange: () => {
        step.seconds = Math.max(0.01, Number(seconds.value) || SHORTEST);
        this.draw();
      },
    });
    const tool = (/** @type {string} */ sign, /** @type {string} */ words, /** @type {() => void} */ act, off = false) =>
      h("button", { type: "button", class: "quiet", "aria-label": `${words} step ${k + 1}`, title: words, disabled: off, onclick: () => { act(); this.draw(); } }, sign);
    return h(
      "li", {},
      h("span", {}, waits ? "Wait " : `Move to ${this.#words(step.values)} in `, seconds, " s"),
      h("span", { class: "live-tools" },
        tool("↑", "earlier:", () => this.steps.splice(k - 1, 0, ...this.steps.splice(k, 1)), k === 0),
        tool("↓", "later:", () => this.steps.splice(k + 1, 0, ...this.steps.splice(k, 1)), k === this.steps.length - 1),
        tool("⎘", "copy", () => this.steps.push({ seconds: step.seconds, values: { ...step.values } })),
        tool("×", "remove", () => this.steps.splice(k, 1))),
    );
  }

  /** @param {Values} values */
  #words(values) {
    return this.table.inputs.map((each) => `${short(each.key)} ${Number(values[each.key].toPrecision(4))} ${each.unit}`.trim()).join(", ");
  }

  /** @param {boolean} on */
  #record(on) {
    if (on === this.recording) return;
    this.recording = on;
    this.record.setAttribute("aria-pressed", String(on));
    this.record.textContent = on ? "■ Stop recording" : "● Record";
    if (!on) return;
    this.play(false);
    this.since = performance.now();
    this.began = 0;
    if (!this.steps.length) this.#begin();
  }

  #begin() {
    this.start = { ...this.now() };
    this.draw();
  }

  /** @param {number} seconds @param {Values} values */
  #add(seconds, values) {
    this.steps.push({ seconds, values: { ...values } });
    this.draw();
  }

  #clear() {
    this.steps = [];
    this.repeats = 1;
    this.#begin();
  }

  #last() {
    return this.steps.length ? this.steps[this.steps.length - 1].values : this.start;
  }

  /** @param {Values} a @param {Values} b */
  #same(a, b) {
    return this.table.inputs.every((each) => Math.abs(a[each.key] - b[each.key]) <= SAME * (each.high - each.low));
  }
}

/** Name of an input without "loads." and "obstacles.". @param {string} key */
export const short = (key) => key.replace(/^(loads|obstacles)\./, "").replace(/_/g, " ");

/** @param {number} seconds */
const rounded = (seconds) => Math.round(100 * seconds) / 100;
