// Form: fields of a table of a job file, from what `turgor.studio.tasks.forms` says of its keys.

import { fill, h, later } from "./dom.js";

const REST = 120; // milliseconds after which a slider that moved counts as one that stopped
const PLACES = 200; // places of a slider

/** Factors of units that sliders know, by dimension, to the first of each. */
const FACTORS = [
  { mm: 1, m: 1000, cm: 10, "µm": 0.001, um: 0.001, in: 25.4 },
  { deg: 1, rad: 180 / Math.PI },
  { "": 1 },
];

/**
 * @typedef {{low: number, high: number, unit: string, zero: boolean}} Limits
 * @typedef {{name: string, kind: string, units: string[], default: string, needed: boolean, allowed: string, meaning: string,
 *   example: string, limits: Limits | null, choices: string[]}} Key
 * @typedef {{header: string, words: string, keys: Key[]}} Table
 * @typedef {(values: Record<string, any>) => void} Set
 */

/** Words of a key. @param {string} name */
export const words = (name) => name.replaceAll("_", " ").replace("pneunet", "PneuNet");

/** A name as a title. @param {string} name */
export const titled = (name) => words(name)[0].toUpperCase() + words(name).slice(1);

/** A TOML value as plain text, for a field: texts without quotes, lists without brackets. @param {any} value @returns {string} */
export function written(value) {
  if (value === undefined || value === null) return "";
  if (Array.isArray(value) && value.every((each) => typeof each !== "object")) return value.join(", ");
  return typeof value === "object" ? JSON.stringify(value) : String(value);
}

/** The value of a field by what its key takes. @param {string} text @param {Key} key @returns {any} */
export function read(text, key) {
  const given = text.trim();
  if (given === "") return null;
  const one = (/** @type {string} */ part) => (part !== "" && Number.isFinite(Number(part)) ? Number(part) : part);
  if (/^[[{"]/.test(given)) {
    try {
      return JSON.parse(given);
    } catch {
      return given;
    }
  }
  const several = /^(three|two|list)/.test(key.kind) || (given.includes(",") && key.kind.includes("list"));
  if (several) return given.split(",").map((part) => one(part.trim()));
  if (key.kind.startsWith("text") || key.kind.startsWith("direction")) return given;
  if (key.units.length === 1 || key.units.length > 1) return given;
  if (given === "true" || given === "false") return given === "true";
  return one(given);
}

/** A number with its unit. @param {any} value @returns {[number, string]} */
function quantity(value) {
  const match = /^\s*(-?[\d.]+(?:e[-+]?\d+)?)\s*(\S*)\s*$/i.exec(String(value));
  return match ? [Number(match[1]), match[2]] : [NaN, ""];
}

/** A value in a unit; not a number where the units differ in kind. @param {any} value @param {string} unit */
function inUnit(value, unit) {
  const [number, own] = quantity(value);
  if (own === unit || number === 0) return number;
  const factors = /** @type {Record<string, number> | undefined} */ (FACTORS.find((each) => own in each && unit in each));
  return factors ? (number * factors[own]) / factors[unit] : NaN;
}

/** Ends and step of a slider within the limits of a key, around its value. @param {Limits} limits @param {number} value @param {boolean} whole */
export function track(limits, value, whole) {
  const size = Math.max(Math.abs(value), 1e-3);
  const low = Math.max(limits.low, limits.low < 0 ? -4 * size : limits.low);
  const high = Math.min(limits.high, Math.max(3 * size, low + size));
  const rough = (high - low) / PLACES;
  const power = 10 ** Math.floor(Math.log10(rough));
  const nice = [1, 2, 5, 10].map((each) => each * power).find((each) => each >= rough) ?? rough;
  const step = whole ? Math.max(1, Math.round(nice)) : nice;
  const digits = Math.max(0, -Math.floor(Math.log10(step)));
  const tidy = (/** @type {number} */ number) => Number(number.toFixed(digits));
  return { low: tidy(Math.ceil(low / step - 1e-9) * step), high: tidy(Math.floor(high / step + 1e-9) * step), step, digits };
}

let number = 0;

/** One field: a label, a control, what it means while it has the focus, and what is wrong with it. */
class Field {
  /** @param {Key} key @param {(value: any) => void} change */
  constructor(key, change) {
    this.key = key;
    this.change = change;
    this.id = `field-${++number}`;
    this.moving = false;
    /** @type {ReturnType<typeof track> | null} ends of the slider, and the value that they are around */
    this.ends = null;
    this.about = 0;
    this.digits = 0;
    this.wrong = h("p", { class: "wrong", id: `${this.id}-wrong`, role: "alert" });
    this.hint = h("p", { class: "quiet hint", id: `${this.id}-hint` });
    this.slider = null;
    this.input = this.#control();
    const reset = h("button", { type: "button", class: "quiet reset", title: "back to the default", "aria-label": `${words(key.name)}: back to the default`, onclick: () => change(null) }, "↺");
    this.reset = reset;
    const label = h("label", { for: this.id }, words(key.name), key.needed ? h("span", { class: "quiet" }, " (needed)") : "");
    this.element = h("div", { class: "field", "data-key": key.name }, label, h("div", { class: "row" }, this.slider, this.input, reset), this.hint, this.wrong);
  }

  #control() {
    const { key } = this;
    const marks = { id: this.id, "aria-describedby": `${this.id}-hint ${this.id}-wrong` };
    if (key.kind === "true or false") {
      return h("input", { ...marks, type: "checkbox", onchange: (/** @type {any} */ event) => this.change(event.target.checked) });
    }
    if (key.choices.length) {
      const first = key.needed ? [] : [h("option", { value: "" }, key.default ? `${key.default.replaceAll('"', "")} (default)` : "–")];
      const rest = key.choices.map((each) => h("option", { value: each }, words(each)));
      return h("select", { ...marks, onchange: (/** @type {any} */ event) => this.change(event.target.value || null) }, ...first, ...rest);
    }
    if (key.limits) this.#slide();
    return h("input", { ...marks, type: "text", autocomplete: "off", spellcheck: false, size: 12, onchange: (/** @type {any} */ event) => this.change(read(event.target.value, key)) });
  }

  #slide() {
    const stop = later(() => this.change(this.#slid()), REST);
    this.slider = h("input", {
      type: "range", "aria-label": words(this.key.name),
      oninput: () => {
        this.input.value = written(this.#slid());
        this.moving = true;
        stop();
      },
    });
  }

  #slid() {
    this.moving = false;
    const value = Number(Number(this.slider.value).toFixed(this.digits));
    const unit = this.key.limits?.unit;
    return unit ? `${value} ${unit}` : value;
  }

  /** Show a value, unless a person changes it now. @param {Key} key @param {any} value @param {string} problem */
  update(key, value, problem) {
    this.key = key;
    const set = value !== undefined;
    const shown = set ? value : key.default.replace(/^"(.*)"$/, "$1");
    this.reset.hidden = !set || key.needed;
    this.hint.textContent = [key.meaning.replaceAll("`", ""), key.allowed && `Allowed: ${key.allowed.replaceAll("`", "")}.`].filter(Boolean).join(" ");
    this.wrong.textContent = problem;
    this.wrong.hidden = !problem;
    this.input.setAttribute("aria-invalid", String(Boolean(problem)));
    if (this.input.type === "checkbox") this.input.checked = String(shown) === "true";
    else if (key.choices.length) this.input.value = set ? value : "";
    else if (!this.moving && (document.activeElement !== this.input || !problem)) this.input.value = written(set ? value : shown);
    if (this.slider && key.limits && !this.moving) this.#place(inUnit(shown, key.limits.unit));
  }

  /** @param {number} value */
  #place(value) {
    const limits = /** @type {Limits} */ (this.key.limits);
    this.slider.disabled = !Number.isFinite(value);
    if (this.slider.disabled) return;
    // the ends stay while they suit, so that the handle does not jump away from the pointer
    const whole = this.key.kind.startsWith("whole");
    const near = this.ends && value <= this.ends.high && value >= this.ends.high / 8;
    const ends = track(limits, near ? this.about : value, whole);
    if (!near) this.about = value;
    this.ends = ends;
    this.digits = ends.digits;
    Object.assign(this.slider, { min: ends.low, max: ends.high, step: ends.step });
    this.slider.value = String(value);
  }
}

/** Fields of a table, which stay in place while values change. */
export class Form {
  /** @param {Set} set called with the values of changed keys; null removes one */
  constructor(set) {
    this.set = set;
    /** @type {Map<string, Field>} */
    this.fields = new Map();
    this.element = h("div", { class: "form" });
  }

  /**
   * @param {Key[]} keys
   * @param {Record<string, any>} values
   * @param {Record<string, string>} [problems] sentences by key
   */
  update(keys, values, problems = {}) {
    const form = (/** @type {Key} */ key) => `${key.kind}|${key.choices}|${Boolean(key.limits)}|${key.needed}`;
    const made = keys.map((key) => {
      const known = this.fields.get(key.name);
      return known && form(known.key) === form(key) ? known : new Field(key, (value) => this.set({ [key.name]: value }));
    });
    const same = made.length === this.fields.size && made.every((field) => this.fields.get(field.key.name) === field);
    this.fields = new Map(made.map((field) => [field.key.name, field]));
    if (!same) fill(this.element, ...made.map((field) => field.element));
    for (const key of keys) this.fields.get(key.name)?.update(key, values[key.name], problems[key.name] ?? "");
  }
}
