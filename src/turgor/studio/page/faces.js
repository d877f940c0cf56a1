// Faces: the picture of a shape whose named faces light up, with the names as buttons for those who use the keyboard.

import { get, part } from "./api.js";
import { fill, h } from "./dom.js";
import { words } from "./form.js";
import { picture } from "./picture.js";

/** Colors of what stands on faces, distinct for color-blind readers too (Okabe and Ito 2008). */
export const COLORS = { support: "#0072b2", pressure: "#56b4e9", force: "#d55e00", layer: "#009e73", fibers: "#cc79a7", named: "#e69f00" };

/** The shape of a job in a picture; it is drawn again in place when the job changes. */
export class Faces {
  /** @param {(name: string, face: number) => void} pick called with a face that was clicked, or whose button was */
  constructor(pick) {
    this.pick = pick;
    this.place = h("div", { class: "faces-picture", "aria-label": "shape" });
    this.names = h("div", { class: "faces-names", role: "group", "aria-label": "faces" });
    this.empty = h("p", { class: "quiet" }, "The picture is being drawn …");
    this.element = h("div", { class: "faces" }, this.empty, this.place, this.names);
    /** @type {Record<string, string>} */
    this.colors = {};
    /** @type {Record<string, string>} */
    this.notes = {};
  }

  /** Draw a scene with named faces. @param {any} scene */
  async draw(scene) {
    this.empty.hidden = true;
    this.scene = scene;
    if (this.viewer) await this.viewer.replace(scene);
    else this.viewer = await picture(this.place, scene);
    const { parts } = this.viewer;
    parts.onpick = (/** @type {string} */ name, /** @type {number} */ face, /** @type {string} */ how) => {
      this.#mark(name);
      if (how === "click") this.pick(name, face);
    };
    this.#chips(scene.parts.names);
    this.#color();
  }

  /** Color faces by name, each with a note on its button. @param {Record<string, string>} colors @param {Record<string, string>} [notes] */
  paint(colors, notes = {}) {
    this.colors = colors;
    this.notes = notes;
    this.#color();
    if (this.scene) this.#chips(this.scene.parts.names);
  }

  #color() {
    const inside = Object.keys(this.colors).filter((name) => name.startsWith("cavity"));
    this.viewer?.parts.paint(this.colors, inside);
  }

  /** @param {string | null} name */
  light(name) {
    this.viewer?.parts.light(name);
    this.#mark(name);
  }

  close() {
    this.viewer?.close();
  }

  /** @param {string[]} names */
  #chips(names) {
    const focus = document.activeElement instanceof HTMLElement ? document.activeElement.dataset.face : undefined;
    fill(this.names, ...names.map((name) => this.#chip(name)));
    if (focus) /** @type {HTMLElement | null} */ (this.names.querySelector(`[data-face="${CSS.escape(focus)}"]`))?.focus();
  }

  /** @param {string} name */
  #chip(name) {
    const dot = h("span", { class: "dot", "aria-hidden": "true" });
    dot.style.background = this.colors[name] ?? "transparent";
    const note = this.notes[name] ? h("span", { class: "quiet" }, ` ${this.notes[name]}`) : "";
    const over = () => this.light(name);
    const out = () => this.light(null);
    return h("button", { type: "button", class: "chip", "data-face": name, onmouseenter: over, onmouseleave: out, onfocus: over, onblur: out, onclick: () => this.pick(name, -1) }, dot, words(name), note);
  }

  /** @param {string | null} name */
  #mark(name) {
    for (const each of this.names.children) each.classList.toggle("lit", /** @type {HTMLElement} */ (each).dataset.face === name);
  }
}

/**
 * The shape of a job; a CAD file as it lies in the file, or as it is modeled.
 * @param {string} job @param {boolean} [modeled] @returns {Promise<any>}
 */
export const shapeOf = (job, modeled = false) => get(`/api/jobs/${part(job)}/shape${modeled ? "?modeled" : ""}`);

/**
 * Call a function again for each change, one call after another; changes during a call give one more.
 * @param {() => Promise<void>} call
 */
export function coalesced(call) {
  let running = false;
  let again = false;
  return async () => {
    if (running) {
      again = true;
      return;
    }
    running = true;
    do {
      again = false;
      await call();
    } while (again);
    running = false;
  };
}

/**
 * Show a screen with faces, and draw it again after each change of the job; the result ends it.
 * @param {HTMLElement} place @param {import("./main.js").App} app @param {string} title
 * @param {{element: Element, faces: Faces, draw: () => Promise<any>}} screen
 */
export async function follow(place, app, title, screen) {
  place.append(h("h1", {}, title), screen.element);
  const draw = coalesced(() => screen.draw());
  app.job.addEventListener("change", draw);
  await draw();
  return () => {
    app.job.removeEventListener("change", draw);
    screen.faces.close();
  };
}
