// Live: a reduced model that answers while a slider or the tip moves.

import { fill, h, later } from "../dom.js";
import { Handle } from "../live/handle.js";
import { Connection } from "../live/model.js";
import { Sequence, short } from "../live/sequence.js";
import { picture } from "../picture.js";

const STEPS = 400; // steps of a slider
const FINE = 300; // milliseconds of rest after which all pixels are drawn

/** @param {HTMLElement} place @param {import("../main.js").App} app */
export async function show(place, app) {
  if (!app.shown) return choice(place, app);
  const note = h("p", { class: "quiet", role: "status" }, `Opening ${app.shown} …`);
  place.append(h("h1", {}, app.shown), note);
  const connection = new Connection(app.shown);
  try {
    const model = await connection.model;
    note.remove();
    const ended = await new Live(place, app, connection, model).start();
    return () => {
      ended();
      connection.close();
    };
  } catch (error) {
    connection.close();
    fill(note, /** @type {Error} */ (error).message);
    note.className = "wrong";
  }
}

/** What the folder has, or how to make one. @param {HTMLElement} place @param {import("../main.js").App} app */
async function choice(place, app) {
  const { reduced } = await app.workspace();
  const names = reduced.map((/** @type {string} */ name) => h("li", {}, h("a", { href: `#/live/${encodeURIComponent(name)}` }, name)));
  place.append(
    h("h1", {}, "In real time"),
    names.length ? h("ul", {}, ...names) : h("p", {}, "This folder has no reduced model yet."),
    h("p", { class: "quiet" }, "A reduced model answers in milliseconds, so that the picture follows a slider or the tip under the mouse. Train one in a terminal; it takes some minutes:"),
    h("pre", { class: "live-command" }, 'turgor reduce finger.toml --along loads.pressure="0..20 kPa" -o finger.reduced'),
  );
}

class Live {
  /** @param {HTMLElement} place @param {import("../main.js").App} app @param {Connection} connection @param {import("../live/model.js").LiveModel} model */
  constructor(place, app, connection, model) {
    this.place = place;
    this.app = app;
    this.connection = connection;
    this.model = model;
    this.table = model.table;
    /** @type {Map<string, {slider: any, field: any, free: any}>} */
    this.controls = new Map();
    /** @type {Handle | null} */
    this.handle = null;
    this.dragging = 0; // number of the last request of the handle
    this.sent = new Map();
    this.fine = later(() => this.viewer.stage.quick(false), FINE);
    /** Milliseconds from a change to its picture, for the benchmark. @type {number[]} */
    this.delays = [];
    this.rows = h("dl", { class: "live-rows" });
    this.readings = h("dl", { class: "live-rows" });
    this.measures = h("section", { class: "card live-readings", "aria-label": "Measures", hidden: true }, h("h2", {}, "All measures"),
      h("p", { class: "quiet" }, "They follow when nothing moves. The first ± is the error of the mesh of the full model, the second the largest known one of the reduction."), this.readings);
    this.far = h("p", { class: "live-far", role: "status" });
    this.state = h("p", { class: "live-state", role: "status" });
    this.refusal = h("p", { class: "wrong", role: "alert", hidden: true });
    this.sequence = new Sequence(this.table, () => ({ ...this.model.values }), (values) => this.#ask({ inputs: values }));
  }

  async start() {
    const drawn = h("div", {});
    const shown = h("div", { class: "live-picture" }, drawn);
    const side = h(
      "div", { class: "live-side" },
      h("section", { class: "card", "aria-label": "Inputs" }, h("h2", {}, "Inputs"), ...this.table.inputs.map((each) => this.#input(each)), this.refusal),
      h("section", { class: "card", "aria-label": "State" }, h("h2", {}, "State"), this.far, this.rows, this.state,
        h("p", { class: "quiet" }, `${this.table.trained} ± is the error of the mesh of the full model.`)),
      this.sequence.drawn,
    );
    this.place.append(h("div", { class: "split live-split" }, side, shown));
    this.viewer = await picture(drawn, this.model.scene());
    if (this.table.tip) {
      this.handle = new Handle(this.viewer, this.table, (wanted, settle) => this.#want(wanted, settle));
      shown.append(h("p", { class: "quiet" }, "Drag the blue dot at the tip: the inputs that are marked follow. Drag elsewhere to turn the picture."));
    }
    shown.append(this.measures);
    this.connection.addEventListener("answer", (event) => this.#answered(/** @type {CustomEvent} */ (event).detail));
    this.connection.addEventListener("end", () => (this.state.textContent = "The connection has ended."));
    const changed = (/** @type {any} */ event) => {
      if (event.detail.includes(this.table.name)) location.reload(); // trained again
      this.#tables();
    };
    this.app.changes.addEventListener("change", changed);
    await this.#tables();
    this.#ask({ inputs: this.model.values });
    /** @type {any} */ (this.place).live = this; // what the benchmark reads
    return () => {
      this.sequence.play(false);
      this.app.changes.removeEventListener("change", changed);
      this.viewer.close();
    };
  }

  async #tables() {
    this.sequence.tables((await this.app.workspace()).tables);
  }

  /** @param {import("../live/model.js").Input} given */
  #input(given) {
    const id = `live-${given.key}`;
    const words = short(given.key);
    const slider = h("input", { type: "range", id, min: given.low, max: given.high, step: (given.high - given.low) / STEPS, value: given.rest });
    const field = h("input", { type: "text", inputmode: "decimal", class: "live-number", value: given.rest, "aria-label": `${words} in ${given.unit || "SI"}` });
    const free = h("input", { type: "checkbox", checked: given.free });
    this.controls.set(given.key, { slider, field, free });
    const take = (/** @type {number} */ value) => this.#ask({ inputs: { ...this.model.values, [given.key]: value } });
    slider.addEventListener("pointerdown", () => this.sequence.begins());
    slider.addEventListener("input", () => {
      this.sequence.begins();
      take(Number(slider.value));
    });
    const end = () => this.sequence.ends({ ...this.model.values, ...this.aim });
    slider.addEventListener("change", end);
    field.addEventListener("change", () => {
      take(Number(field.value.replace(",", ".")));
      end();
    });
    const range = `${number(given.low)} to ${number(given.high)} ${given.unit}`;
    return h(
      "div", { class: "live-input" },
      h("label", { for: id }, words), h("span", { class: "quiet" }, range),
      slider, h("span", { class: "live-value" }, field, ` ${given.unit}`),
      this.table.tip && h("label", { class: "quiet live-free" }, free, " follows the tip"),
    );
  }

  /** @param {any} request */
  #ask(request) {
    if (!request.wanted) this.handle?.rested();
    this.aim = request.wanted ? null : request.inputs;
    this.sent.set(this.connection.send(request), performance.now());
  }

  /** @param {number[]} wanted @param {boolean} settle */
  #want(wanted, settle) {
    this.sequence.play(false);
    this.sequence.begins();
    const free = [...this.controls].filter(([, { free: box }]) => box.checked).map(([key]) => key);
    this.#ask({ inputs: this.model.values, wanted, free, settle });
    this.dragging = settle ? this.connection.number : 0;
  }

  /** @param {any} answer */
  #answered(answer) {
    if (answer.readings) {
      if (answer.number !== this.connection.number) return;
      write(this.readings, answer.readings);
      this.measures.hidden = !answer.readings.length;
      this.measures.classList.remove("old");
      return;
    }
    const began = this.sent.get(answer.number);
    for (const number of this.sent.keys()) if (number <= answer.number) this.sent.delete(number);
    this.refusal.hidden = !answer.refused;
    if (answer.refused) {
      this.refusal.textContent = answer.refused;
      this.#fields(this.model.values, true);
      return;
    }
    this.measures.classList.add("old"); // until those of this state come
    this.model.set(answer.q, answer.inputs);
    this.viewer.stage.quick(true);
    this.viewer.refresh();
    this.fine();
    this.handle?.at(answer.tip);
    this.#fields(answer.inputs, false);
    this.#describe(answer);
    this.app.seen = { ...this.app.seen, inputs: this.table.inputs.map((each) => ({ ...each, value: answer.inputs[each.key] })) };
    if (began) requestAnimationFrame(() => requestAnimationFrame(() => this.delays.push(performance.now() - began)));
    if (answer.number === this.dragging) this.sequence.ends({ ...answer.inputs });
  }

  /** @param {Record<string, number>} values @param {boolean} all also what is being typed */
  #fields(values, all) {
    for (const [key, { slider, field }] of this.controls) {
      if (document.activeElement !== slider || all) slider.value = String(values[key]);
      if (document.activeElement !== field || all) field.value = number(values[key]);
      slider.setAttribute("aria-valuetext", field.value);
    }
  }

  /** @param {any} answer */
  #describe(answer) {
    const millimeters = 1000 * (answer.distance ?? 0);
    const near = millimeters < 1e-3 * 1000 * this.table.length;
    const limits = (answer.limits ?? []).map((/** @type {string} */ each) => each.replace(/^(loads|obstacles)\./, ""));
    this.far.hidden = answer.distance === undefined;
    this.far.textContent = near ? "The tip is where you want it." : `The wanted place is ${number(millimeters)} mm away.${limits.length ? ` At a limit: ${limits.join(", ")}.` : ""}`;
    this.far.classList.toggle("out", !near);
    write(this.rows, answer.rows);
    const percent = Number((100 * answer.estimate).toPrecision(2));
    this.state.textContent = answer.doubtful
      ? `Doubtful: the error of the reduction may be more than 2 % here (estimated ${percent} %).`
      : `Estimated error of the reduction: ${percent} % of the largest displacement.`;
    this.state.classList.toggle("out", answer.doubtful);
  }

}

/** @param {HTMLElement} list @param {[string, string][]} rows */
function write(list, rows) {
  fill(list, ...rows.map(([words, text]) => h("div", {}, h("dt", {}, words), h("dd", {}, text))));
}

/** A number as short as it can be with four digits. @param {number} value */
const number = (value) => (Math.abs(value) < 1e-9 ? "0" : String(Number(value.toPrecision(4))));
