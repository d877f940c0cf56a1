// Shape: the dimensions of an actuator, or the faces of a part from a file, with the picture and what follows from it.

import { h, fill, say } from "../dom.js";
import { COLORS, Faces, follow, shapeOf } from "../faces.js";
import { Form, titled, words } from "../form.js";

/** Names that supports, loads and measures look for. */
const NAMES = ["fixed", "tip", "strain_limiting_layer", "outside"];

/** Mesh errors that the qualities aim at. */
const QUALITIES = { draft: "a first look: a mesh error of 10 %", normal: "a mesh error of 2 %", fine: "a mesh error of 0.5 %; takes several times as long" };

/** @param {HTMLElement} place @param {import("../main.js").App} app */
export function show(place, app) {
  return follow(place, app, "Shape", new Shape(app));
}

class Shape {
  /** @param {import("../main.js").App} app */
  constructor(app) {
    this.app = app;
    this.form = new Form((values) => app.job.set(Object.fromEntries(Object.entries(values).map(([key, value]) => [`actuator.${key}`, value]))));
    this.problems = h("div", { role: "alert" });
    this.facts = h("dl", { class: "facts" });
    this.quality = h("div", { class: "card" });
    this.naming = h("div", { class: "card naming", hidden: true });
    this.title = h("h2", {});
    this.about = h("p", { class: "quiet" });
    this.faces = new Faces((name, face) => this.#pick(name, face));
    const left = h("div", { class: "stack" }, h("div", { class: "card" }, this.title, this.about, this.problems, this.form.element), this.quality);
    this.rest = [left, h("div", { class: "card" }, h("h2", {}, "What follows"), this.facts)];
    this.rest.forEach((each) => (each.hidden = true)); // until there is something in them
    this.element = h("div", { class: "split" }, left, h("div", { class: "stack" }, this.faces.element, this.naming, this.rest[1]));
  }

  async draw() {
    const { state } = this.app.job;
    try {
      const shape = await shapeOf(this.app.job.name);
      this.shape = shape;
      this.rest.forEach((each) => (each.hidden = false));
      this.#fields(shape);
      this.#mesh(shape.content.mesh ?? {});
      if (shape.scene) {
        await this.faces.draw(shape.scene);
        this.#facts(shape.facts);
        this.#paint(shape);
      }
      this.element.dataset.version = state?.version;
    } catch (error) {
      this.rest[0].hidden = false;
      fill(this.problems, h("p", { class: "wrong" }, /** @type {Error} */ (error).message));
    }
  }

  /** @param {any} shape */
  #fields({ form, content, problems, kind, findings }) {
    /** @type {Record<string, string>} */
    const at = {};
    const others = [];
    for (const { key, sentence } of problems) {
      const name = key.replace(/^actuator\./, "");
      if (form?.keys.some((/** @type {any} */ each) => each.name === name)) at[name] = sentence;
      else if (key.startsWith("actuator")) others.push(h("p", { class: "wrong" }, sentence));
    }
    const file = content.actuator?.file;
    this.title.textContent = form ? titled(String(kind)) : String(file ?? "Shape");
    this.about.textContent = form
      ? "Move a slider or write a value with its unit. Each range is what the other dimensions allow."
      : kind === "mesh_file"
      ? "A mesh is used as it is. Its faces have the names of the file, or those that the job gives them in [actuator.faces]."
      : "Point at a face of the picture, and click it to give it a name. The job then says what is fixed and where the tip is.";
    fill(this.problems, ...others, ...(findings ?? []).map((/** @type {string} */ each) => h("p", { class: "note" }, each)));
    this.form.update(form?.keys ?? [], content.actuator ?? {}, at);
  }

  /** @param {any} mesh */
  #mesh(mesh) {
    if (this.shape.kind === "mesh_file") {
      fill(this.quality, h("p", { class: "quiet" }, "This part comes as a mesh, which is used as it is."));
      return;
    }
    const now = mesh.quality ?? "normal";
    const options = Object.entries(QUALITIES).map(([name, sentence]) =>
      h("label", { class: "choice" }, h("input", { type: "radio", name: "quality", value: name, checked: name === now, onchange: () => this.app.job.set({ "mesh.quality": name }) }), h("span", {}, h("b", {}, name), ` – ${sentence}`)));
    const size = mesh.size ? h("p", { class: "quiet" }, `The job states a size of ${mesh.size}, which counts instead. `, h("button", { type: "button", onclick: () => this.app.job.set({ "mesh.size": null }) }, "Let the quality choose")) : "";
    fill(this.quality, h("fieldset", {}, h("legend", {}, "Mesh"), ...options), size);
  }

  /** @param {any} facts */
  #facts({ size, wall, cavities, bodies = [], volume, mass }) {
    const mm = (/** @type {number} */ length) => Number((1000 * length).toPrecision(4));
    const mL = (/** @type {number} */ each) => `${Number((1e6 * each).toPrecision(4))} mL`;
    const rows = [
      ["Outer size", `${size.map(mm).join(" × ")} mm`],
      ["Thinnest wall", `${mm(wall)} mm`],
      ...Object.entries(cavities).map(([name, each]) => [Object.keys(cavities).length > 1 ? words(name) : "Cavity", mL(each)]),
      ...bodies.map((/** @type {any} */ each) => [`Body ${words(each.name)}`, h("span", {}, swatch(each.color), mL(each.volume))]),
      ["Rubber", mass ? `${mL(volume)}, ${Number((1000 * mass).toPrecision(3))} g` : `${mL(volume)}; a material without a density has no mass here`],
    ];
    fill(this.facts, ...rows.flatMap(([name, value]) => [h("dt", {}, name), h("dd", {}, value)]));
  }

  /** @param {any} shape */
  #paint({ scene, faces }) {
    const named = scene.parts.names.filter((/** @type {string} */ name) => faces.length ? ["fixed", "tip", "strain_limiting_layer"].includes(name) : false);
    this.faces.paint(Object.fromEntries(named.map((/** @type {string} */ name) => [name, name === "fixed" ? COLORS.support : name === "tip" ? COLORS.named : COLORS.layer])));
  }

  /** Ask for the name of a face of a file. @param {string} name @param {number} face */
  #pick(name, face) {
    const { faces, content } = this.shape;
    if (!faces.length) {
      this.faces.light(name);
      return;
    }
    const number = face >= 0 ? face : faces.findIndex((/** @type {any} */ each) => each.name === name);
    const chosen = faces[number];
    const given = content.actuator.faces ?? {};
    const input = h("input", { type: "text", list: "face-names", value: NAMES.includes(chosen.name) && chosen.name !== "outside" ? chosen.name : "", "aria-label": "name of the face", placeholder: "fixed, tip, …" });
    input.setAttribute("list", "face-names");
    const write = (/** @type {string} */ to) => {
      if (!/^[A-Za-z][\w-]*$/.test(to)) return say(`'${to}' is no name of a face; use letters, digits, '-' and '_'.`, true);
      this.naming.hidden = true;
      this.app.job.set({ [`actuator.faces.${to}`]: chosen.selector });
    };
    const free = given[chosen.name] ? h("button", { type: "button", onclick: () => ((this.naming.hidden = true), this.app.job.set({ [`actuator.faces.${chosen.name}`]: null })) }, `No longer call it ${words(chosen.name)}`) : null;
    this.naming.hidden = false;
    fill(
      this.naming,
      h("h2", {}, `This face is called ${words(chosen.name)}`),
      h("p", { class: "quiet" }, `${Number((1e6 * chosen.area).toPrecision(3))} mm². Supports and loads refer to faces by their names: “fixed” is where it is clamped, “tip” where motion is measured. A name that another face has moves here.`),
      h("form", { class: "row", onsubmit: (/** @type {Event} */ event) => (event.preventDefault(), write(input.value.trim())) },
        ...["fixed", "tip"].map((each) => h("button", { type: "button", onclick: () => write(each) }, each)), input, h("datalist", { id: "face-names" }, ...NAMES.map((each) => h("option", { value: each }))),
        h("button", { type: "submit", class: "primary" }, "Name it"), free, h("button", { type: "button", class: "quiet", onclick: () => (this.naming.hidden = true) }, "Cancel")),
    );
    input.focus();
  }
}

/** The color that a body has in its file. @param {string} color */
function swatch(color) {
  const dot = h("span", { class: "dot inline", title: color });
  dot.style.background = color || "transparent";
  return dot;
}
