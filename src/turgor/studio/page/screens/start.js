// Start: the files of the folder, families as pictures to begin with, and a place where own parts are dropped.

import { get, part, post } from "../api.js";
import { fill, h } from "../dom.js";
import { titled } from "../form.js";
import { tour } from "../tour.js";

const MOST = 100e6; // bytes that the server takes
const FIRST = "fast_pneunet"; // what a beginner bends
const UNITS = ["mm", "cm", "m", "in", "µm"];

/** @param {HTMLElement} place @param {import("../main.js").App} app */
export async function show(place, app) {
  const screen = new Start(app);
  place.append(screen.element);
  await screen.draw();
  app.changes.addEventListener("change", screen.draw);
  const end = tour(place);
  return () => {
    app.changes.removeEventListener("change", screen.draw);
    end();
  };
}

class Start {
  /** @param {import("../main.js").App} app */
  constructor(app) {
    this.app = app;
    this.lists = h("section", { class: "lists", "aria-label": "in this folder" });
    this.families = h("div", { class: "families" });
    this.answer = h("div", { role: "alert" });
    this.input = h("input", { type: "file", class: "sr", id: "part-file", "aria-label": "a part, a table or a job", accept: ".step,.stp,.brep,.brp,.stl,.msh,.inp,.vtk,.vtu,.toml", onchange: () => this.#send([...this.input.files]) });
    this.zone = this.#zone();
    this.tour = h("button", { type: "button", onclick: () => tour(this.element, true) }, "Show me around");
    this.draw = this.draw.bind(this);
    this.element = h("div", { class: "stack" },
      h("div", { class: "row between" }, h("h1", {}, "Bend your first finger, or go on"), this.tour),
      this.lists,
      h("section", {}, h("h2", {}, "Begin with a family"), h("p", { class: "quiet" }, "A click writes a job file that runs as it is: dimensions, material, pressure. All of it can be changed afterwards."), this.families),
      h("section", {}, h("h2", {}, "Bring your own part"), this.zone, this.answer));
  }

  async draw() {
    const content = await this.app.workspace();
    this.names = content.jobs.map((/** @type {any} */ each) => each.name);
    const of = (/** @type {string} */ kind) => content.jobs.filter((/** @type {any} */ each) => each.kind === kind).map((/** @type {any} */ each) => each.name);
    const used = content.parts.map((/** @type {string} */ name) => h("li", {}, name, " ", h("button", { type: "button", onclick: () => this.#job({ name, unit: /\.(step|stp)$/i.test(name) }) }, "Make a job")));
    fill(
      this.lists,
      list("Job files", links(of("job"), "shape"), "None yet. Choose a family below; its job file appears here."),
      list("Runs", links(content.runs, "look"), "None yet. A run begins on the screen Solve and stays in a folder of its own."),
      list("Studies", links(of("study"), "decide"), "None yet. A study varies a job: a sweep, an optimization, a calibration."),
      list("Parts", used, "None yet. Drop a STEP, STL or mesh file at the bottom of this page."),
      ...(content.reduced.length ? [list("Reduced models", links(content.reduced, "live"), "")] : []),
    );
    if (!this.families.children.length) {
      await this.#families();
      get("/api/ready").catch(() => {}); // the first shape then comes at once
    }
  }

  async #families() {
    const families = await get("/page/families/families.json");
    families.sort((/** @type {any} */ a, /** @type {any} */ b) => Number(b.name === FIRST) - Number(a.name === FIRST));
    fill(this.families, ...families.map((/** @type {any} */ each) => {
      const title = titled(each.name);
      const about = each.words.split(/[:(]/)[0].trim().replace(/(?<! al)\.$/, "");
      return h("button", { type: "button", class: "family", title: each.words, "data-family": each.name, onclick: () => this.#begin(each.name) },
        h("img", { src: `/page/families/${each.name}.png`, alt: "", width: 240, height: 150, loading: "lazy", onerror: (/** @type {any} */ event) => event.target.remove() }), h("b", {}, title), about.toLowerCase() === title.toLowerCase() ? "" : h("span", { class: "quiet" }, about));
    }));
  }

  /** @param {string} family */
  async #begin(family) {
    await this.#open({ family }, this.#free(family));
  }

  /** A name of a job that no file has. @param {string} stem */
  #free(stem) {
    const names = new Set(this.names);
    let name = `${stem}.toml`;
    for (let k = 2; names.has(name); k++) name = `${stem}-${k}.toml`;
    return name;
  }

  /** @param {any} what @param {string} name */
  async #open(what, name) {
    this.element.classList.add("busy");
    try {
      await post("/api/jobs", { ...what, name });
      this.app.go("shape", name);
    } catch (error) {
      this.#wrong(/** @type {Error} */ (error).message);
    } finally {
      this.element.classList.remove("busy");
    }
  }

  #zone() {
    const button = h("button", { type: "button", onclick: () => this.input.click() }, "Choose a file");
    const zone = h("div", { class: "zone", role: "group", "aria-label": "own part" }, h("p", {}, "Drop a file here, or ", button),
      h("p", { class: "quiet" }, "STEP, BREP or STL from a CAD program; a mesh of gmsh, Abaqus, CalculiX or VTK; or a job file. Draw the rubber, not the air: cavities are found. It stays on this machine."), this.input);
    const over = (/** @type {boolean} */ on) => (/** @type {DragEvent} */ event) => {
      event.preventDefault();
      zone.classList.toggle("over", on);
    };
    zone.addEventListener("dragover", over(true));
    zone.addEventListener("dragleave", over(false));
    zone.addEventListener("drop", (/** @type {DragEvent} */ event) => {
      over(false)(event);
      this.#send([...(event.dataTransfer?.files ?? [])]);
    });
    return zone;
  }

  /** @param {string} sentence */
  #wrong(sentence) {
    fill(this.answer, h("p", { class: "message wrong" }, sentence));
  }

  /** @param {File[]} files */
  async #send(files) {
    const [file] = files;
    this.input.value = "";
    if (!file) return;
    if (files.length > 1) return this.#wrong("One file at a time, please: a job has one part.");
    if (file.size > MOST) return this.#wrong(`'${file.name}' has ${(file.size / 1e6).toFixed(0)} MB; at most ${MOST / 1e6} MB are read. Put it into the folder of the studio instead.`);
    fill(this.answer, h("p", { class: "quiet" }, `'${file.name}' is being read …`));
    try {
      const sent = await post(`/api/uploads?name=${part(file.name)}`, new Blob([file]));
      if (sent.kind === "table") fill(this.answer, h("p", {}, `'${sent.name}' is a table: fit laws to it on the screen Materials of a job.`));
      else if (sent.kind === "job") this.app.go("shape", sent.name);
      else await this.#job(sent);
    } catch (error) {
      this.#wrong(/** @type {Error} */ (error).message);
    }
  }

  /** Make a job of a part; ask for the unit where the file states none. @param {any} sent */
  async #job(sent) {
    const stem = sent.name.replace(/\.[^.]*$/, "");
    if (sent.unit) {
      fill(this.answer);
      return this.#open({ part: sent.name }, this.#free(stem));
    }
    const size = (/** @type {string} */ unit) => (sent.size ?? []).map((/** @type {number} */ side) => Number((1000 * side).toPrecision(3))).join(" × ").concat(" ", unit).trim();
    const buttons = UNITS.map((unit) => h("button", { type: "button", "data-unit": unit, onclick: () => this.#open({ part: sent.name, unit }, this.#free(stem)) }, size(unit)));
    fill(this.answer, h("div", { class: "card" }, h("h2", {}, `In which unit is '${sent.name}'?`), h("p", { class: "quiet" }, "The file does not say it. How large is the part?"), h("div", { class: "row wrap" }, ...buttons)));
    buttons[0].focus();
  }
}

/** @param {string[]} names @param {string} screen */
const links = (names, screen) => names.map((name) => h("li", {}, h("a", { href: `#/${screen}/${part(name)}` }, name)));

/** @param {string} title @param {Node[]} entries @param {string} empty */
function list(title, entries, empty) {
  return h("div", {}, h("h2", {}, title), entries.length ? h("ul", {}, ...entries) : h("p", { class: "quiet" }, empty));
}
