// Loads: what holds, drives, reinforces and touches the actuator, on the picture and in fields.

import { get, part } from "../api.js";
import { fill, h } from "../dom.js";
import { COLORS, Faces, follow, shapeOf } from "../faces.js";
import { Form, words, written } from "../form.js";

const DIRECTIONS = ["-z", "+z", "-x", "+x", "-y", "+y"];
const SUPPORTS = ["xyz", "x", "y", "z", "xy", "xz", "yz", "radial", "plane section"];

/** Words of each support. @type {Record<string, string>} */
const WORDS_OF = { xyz: "clamped", radial: "keeps its radius", "plane section": "stays plane" };

/** A sheet and a winding to begin with. */
const SHEET = { library: "paper", record: "hooke-polygerinos-2020", thickness: "0.1 mm" };
const STATED = ["name", "law", "E", "nu", "density"]; // keys of a fiber that is not from the library
const WINDING = { library: "kevlar-fiber", angle_from_circumference: "0 deg", spacing: "3 mm" };

/** @param {HTMLElement} place @param {import("../main.js").App} app */
export function show(place, app) {
  return follow(place, app, "Loads", new Setup(app));
}

class Setup {
  /** @param {import("../main.js").App} app */
  constructor(app) {
    this.app = app;
    /** @type {Map<string, Form>} forms by the table that they write */
    this.forms = new Map();
    this.wrong = h("div", { role: "alert" });
    this.cards = h("div", { class: "stack" });
    /** @type {Set<string>} tables whose fields are shown */
    this.open = new Set();
    this.contactOpen = false;
    this.chosen = "";
    this.own = h("div", { class: "card", hidden: true });
    this.faces = new Faces((name) => this.#choose(name));
    this.legend = h("p", { class: "quiet legend" });
    this.hint = h("p", { class: "quiet" }, "Point at a face, and click it to choose what holds, loads or reinforces it. The buttons below the picture do the same; cavities lie inside, so use “cut”, “transparent” or their button.");
    this.element = h("div", { class: "split" }, h("div", { class: "stack" }, this.wrong, this.cards), h("div", { class: "stack" }, this.hint, this.faces.element, this.legend, this.own));
  }

  async draw() {
    const { state, name } = this.app.job;
    try {
      const shape = await shapeOf(name, true);
      if (shape.scene && JSON.stringify(shape.scene) !== this.drawn) {
        this.drawn = JSON.stringify(shape.scene);
        await this.faces.draw(shape.scene);
      }
      this.job = await get(`/api/jobs/${part(name)}/forms`);
      fill(this.wrong);
      this.#cards();
      this.#paint();
      if (this.chosen) this.#choose(this.chosen);
      this.element.dataset.version = state?.version;
    } catch (error) {
      fill(this.wrong, h("p", { class: "wrong" }, /** @type {Error} */ (error).message));
    }
  }

  /** A table of the job. @param {string} name @returns {Record<string, any>} */
  #table(name) {
    const table = this.job.content[name];
    return table && typeof table === "object" ? table : {};
  }

  get #supports() {
    const stated = this.job.content.supports;
    return stated ?? (this.job.faces.includes("fixed") ? { fixed: "xyz" } : {});
  }

  /** Keys of a form by the beginning of its header. @param {string} header @param {string[]} [only] */
  #keys(header, only) {
    const table = this.job.tables.find((/** @type {any} */ each) => each.header.startsWith(header));
    return (table?.keys ?? []).filter((/** @type {any} */ key) => (only ? only.includes(key.name) : !key.kind.startsWith("table")));
  }

  /** The form of a table, which stays in place. @param {string} path @param {any[]} keys @param {Record<string, any>} values */
  #form(path, keys, values) {
    let form = this.forms.get(path);
    if (!form) {
      form = new Form((given) => this.app.job.set(Object.fromEntries(Object.entries(given).map(([key, value]) => [`${path}.${key}`, value]))));
      this.forms.set(path, form);
    }
    const at = this.job.problems.filter((/** @type {any} */ each) => each.key.startsWith(`${path}.`)).map((/** @type {any} */ each) => [each.key.slice(path.length + 1).split(".")[0], each.sentence]);
    form.update(keys, values, Object.fromEntries(at));
    return form.element;
  }

  #cards() {
    const others = this.job.problems.filter((/** @type {any} */ each) => /^(supports|loads|contact|obstacles|fibers)/.test(each.key));
    fill(this.wrong, ...others.map((/** @type {any} */ each) => h("p", { class: "wrong" }, `${each.key}: ${each.sentence}`)));
    fill(this.cards, this.#pressures(), this.#holds(), this.#gravity(), ...this.#named("obstacles", "Plates and objects", "[obstacles.NAME]"), ...this.#named("fibers", "Fibers", "[fibers.NAME]"), this.#contact());
  }

  #pressures() {
    const { cavities } = this.job;
    const loads = this.#table("loads");
    const key = this.#keys("[loads.CAVITY]", ["pressure"])[0];
    if (!cavities.length) return h("div", { class: "card" }, h("h2", {}, "Pressure"), h("p", { class: "quiet" }, "This part has no cavity. Click a face to put a pressure or a force on it."));
    const alone = cavities.length === 1 && typeof loads[cavities[0]] !== "object";
    const forms = alone
      ? [this.#form("loads", [{ ...key, needed: false, name: "pressure" }], loads)]
      : cavities.map((/** @type {string} */ name) => h("div", {}, h("h3", {}, words(name)), this.#form(`loads.${name}`, [{ ...key, needed: false }], loads[name] ?? {})));
    return h("div", { class: "card" }, h("h2", {}, cavities.length > 1 ? "Pressures" : "Pressure"), h("p", { class: "quiet" }, "Gauge pressure at the end of the path. A run rises to it from zero."), ...forms);
  }

  #holds() {
    const entries = Object.entries(this.#supports).map(([face, how]) => h("li", {}, h("button", { type: "button", class: "link", onclick: () => this.#choose(face) }, words(face)), ` ${WORDS_OF[how] ?? `fixed along ${how}`}`));
    const mirrors = this.job.faces.filter((/** @type {string} */ face) => face.startsWith("symmetry_"));
    const half = mirrors.length ? h("p", { class: "quiet" }, `Modeled is a ${mirrors.length > 1 ? "quarter" : "half"}; its cut faces are supported by themselves.`) : "";
    const none = h("p", { class: "note" }, "Nothing is fixed, so the part can fly away. Click a face and clamp it.");
    return h("div", { class: "card" }, h("h2", {}, "Supports"), entries.length ? h("ul", {}, ...entries) : none, half);
  }

  #gravity() {
    const { gravity } = this.#table("loads");
    const now = typeof gravity === "object" ? gravity.direction : gravity;
    const set = (/** @type {string | null} */ way) => this.app.job.set({ [typeof gravity === "object" && way ? "loads.gravity.direction" : "loads.gravity"]: way });
    const select = h("select", { id: "gravity", onchange: (/** @type {any} */ event) => set(event.target.value || null) }, h("option", { value: "" }, "off"), ...DIRECTIONS.map((each) => h("option", { value: each }, `towards ${each}`)));
    select.value = now ?? "";
    return h("div", { class: "card" }, h("label", { for: "gravity" }, h("b", {}, "Gravity")), " ", select);
  }

  #contact() {
    const keys = this.#keys("[contact]");
    const form = this.#form("contact", keys, this.#table("contact"));
    return h("details", { class: "card", open: this.contactOpen, ontoggle: (/** @type {any} */ event) => (this.contactOpen = event.target.open) }, h("summary", {}, h("b", {}, "Contact")), h("p", { class: "quiet" }, "Whether walls of the actuator touch each other, and how they rub."), form);
  }

  /** Tables whose names the user chooses. @param {string} kind @param {string} title @param {string} header */
  #named(kind, title, header) {
    const table = this.#table(kind);
    const entries = Object.entries(table).filter(([, values]) => typeof values === "object").map(([name, values]) => {
      const path = `${kind}.${name}`;
      const keys = kind === "obstacles" ? [...this.#keys(header, ["friction", "spring", "face"]), ...this.#keys(`[obstacles.NAME], shape = "${values.shape}"`)] : this.#keys(header).filter((/** @type {any} */ key) => !values.library || !STATED.includes(key.name));
      const remove = h("button", { type: "button", onclick: () => this.app.job.set({ [path]: null }) }, "Remove");
      const toggle = (/** @type {any} */ event) => (event.target.open ? this.open.add(path) : this.open.delete(path));
      return h("details", { open: this.open.has(path), ontoggle: toggle }, h("summary", {}, `${name} `, h("span", { class: "quiet" }, values.shape ?? written(values.face))), this.#form(path, keys, values), remove);
    });
    const add = kind === "obstacles"
      ? h("div", { class: "row wrap" }, ...["plane", "sphere", "cylinder", "box"].map((shape) => h("button", { type: "button", onclick: () => this.#obstacle(shape) }, `Add a ${shape}`)))
      : h("p", { class: "quiet" }, "Click a face of the picture to wind fibers around it.");
    return [h("div", { class: "card" }, h("h2", {}, title), ...entries, add)];
  }

  /** @param {string} shape */
  #obstacle(shape) {
    const needed = this.#keys(`[obstacles.NAME], shape = "${shape}"`).filter((/** @type {any} */ key) => key.needed);
    const name = this.#free("obstacles", shape === "plane" ? "plate" : shape);
    const values = Object.fromEntries(needed.map((/** @type {any} */ key) => [`obstacles.${name}.${key.name}`, JSON.parse(key.example)]));
    this.open.add(`obstacles.${name}`);
    return this.app.job.set({ [`obstacles.${name}.shape`]: shape, ...values });
  }

  /** @param {string} kind @param {string} stem */
  #free(kind, stem) {
    const table = this.#table(kind);
    let name = stem;
    for (let k = 2; name in table; k++) name = `${stem}_${k}`;
    return name;
  }

  /** Show what stands on a face, and what can be put there. @param {string} face */
  #choose(face) {
    this.chosen = face;
    const { cavities, regions } = this.job;
    const title = h("div", { class: "row between" }, h("h2", {}, `On the face ${words(face)}`), h("button", { type: "button", class: "quiet", "aria-label": "close", onclick: () => this.#unchoose() }, "×"));
    const parts = cavities.includes(face) ? [this.#pressureOn(face)] : [this.#supportOf(face), this.#forceOn(face)];
    this.own.hidden = false;
    fill(this.own, title, ...parts, ...(regions.includes(face) ? [] : [this.#layerOn(face)]), this.#fibersOn(face));
    this.faces.light(face);
  }

  #unchoose() {
    /** @type {Set<string>} tables whose fields are shown */
    this.open = new Set();
    this.contactOpen = false;
    this.chosen = "";
    this.own.hidden = true;
    this.faces.light(null);
  }

  /** @param {string} face */
  #supportOf(face) {
    const now = this.#supports[face] ?? "";
    const select = h("select", { id: "support", onchange: (/** @type {any} */ event) => this.#hold(face, event.target.value || null) },
      h("option", { value: "" }, "free"), ...SUPPORTS.map((each) => h("option", { value: each }, WORDS_OF[each] ? `${WORDS_OF[each]}` : `fixed along ${each}`)));
    if (now && !SUPPORTS.includes(now)) select.append(h("option", { value: now }, now));
    select.value = now;
    return h("p", { class: "row" }, h("label", { for: "support" }, "Support"), select);
  }

  /** @param {string} face @param {string | null} how */
  #hold(face, how) {
    // stated supports replace the default ones, which are therefore written, too
    const implied = this.job.content.supports ? {} : Object.fromEntries(Object.entries(this.#supports).map(([name, each]) => [`supports.${name}`, each]));
    return this.app.job.set({ ...implied, [`supports.${face}`]: how });
  }

  /** @param {string} face */
  #pressureOn(face) {
    const loads = this.#table("loads");
    const own = typeof loads[face] === "object" ? loads[face].pressure : loads.pressure;
    return h("p", {}, own ? `The pressure rises to ${own}; its field is on the left.` : "No pressure yet; its field is on the left.");
  }

  /** @param {string} face */
  #forceOn(face) {
    const values = this.#table("loads")[face] ?? {};
    const keys = [...this.#keys("[loads.CAVITY]", ["pressure"]), ...this.#keys("[loads.FACE]", ["force", "hangs"])].map((key) => ({ ...key, needed: false }));
    return h("div", {}, h("h3", {}, "Load"), this.#form(`loads.${face}`, keys, values));
  }

  /** @param {string} face */
  #layerOn(face) {
    const values = this.#table("materials")[face];
    const path = `materials.${face}`;
    if (!values) {
      const add = () => this.app.job.set(Object.fromEntries(Object.entries(SHEET).map(([key, value]) => [`${path}.${key}`, value])));
      return h("p", { class: "row wrap" }, h("button", { type: "button", onclick: add }, "Glue a layer of paper on it"), h("span", { class: "quiet" }, "a sheet that bends but does not stretch"));
    }
    const keys = this.#keys("[materials.NAME], from the library", ["library", "record", "thickness", "form"]);
    return h("div", {}, h("h3", {}, "Layer"), this.#form(path, keys, values), h("button", { type: "button", onclick: () => this.app.job.set({ [path]: null }) }, "Remove the layer"));
  }

  /** @param {string} face */
  #fibersOn(face) {
    const known = Object.entries(this.#table("fibers")).filter(([, each]) => [each.face].flat().includes(face)).map(([name]) => name);
    const add = () => {
      const name = this.#free("fibers", "winding");
      this.open.add(`fibers.${name}`);
      return this.app.job.set(Object.fromEntries(Object.entries({ face, ...WINDING }).map(([key, value]) => [`fibers.${name}.${key}`, value])));
    };
    return h("p", { class: "row wrap" }, h("button", { type: "button", onclick: add }, known.length ? "Wind more fibers on it" : "Wind fibers on it"), known.length ? h("span", { class: "quiet" }, `has ${known.join(", ")}; their fields are on the left`) : h("span", { class: "quiet" }, "threads that hold the circumference"));
  }

  /** Color the faces by what stands on them. */
  #paint() {
    /** @type {Record<string, string>} */
    const colors = {};
    /** @type {Record<string, string>} */
    const notes = {};
    const put = (/** @type {string} */ face, /** @type {keyof typeof COLORS} */ kind, /** @type {string} */ note) => {
      colors[face] ??= COLORS[kind];
      notes[face] = [notes[face], note].filter(Boolean).join(", ");
    };
    const loads = this.#table("loads");
    for (const [face, how] of Object.entries(this.#supports)) put(face, "support", WORDS_OF[how] ?? `fixed ${how}`);
    for (const name of this.job.cavities) {
      const own = typeof loads[name] === "object" ? loads[name].pressure : loads.pressure;
      if (own) put(name, "pressure", own);
    }
    for (const [face, load] of Object.entries(loads)) {
      if (face === "gravity" || typeof load !== "object" || Array.isArray(load) || this.job.cavities.includes(face)) continue;
      put(face, load.pressure ? "pressure" : "force", written(load.force ?? load.pressure ?? load.hangs));
    }
    for (const name of Object.keys(this.#table("materials"))) if (this.job.faces.includes(name)) put(name, "layer", "layer");
    for (const [name, each] of Object.entries(this.#table("fibers"))) for (const face of [each.face].flat()) put(face, "fibers", name);
    this.faces.paint(colors, notes);
    const gravity = loads.gravity ? `Gravity pulls towards ${typeof loads.gravity === "object" ? loads.gravity.direction : loads.gravity}. ` : "";
    const entry = (/** @type {keyof typeof COLORS} */ kind) => {
      const dot = h("span", { class: "dot" });
      dot.style.background = COLORS[kind];
      return h("span", { class: "row" }, dot, kind);
    };
    fill(this.legend, ...["support", "pressure", "force", "layer", "fibers"].filter((kind) => Object.values(colors).includes(COLORS[/** @type {keyof typeof COLORS} */ (kind)])).map((kind) => entry(/** @type {any} */ (kind))), gravity);
  }
}
