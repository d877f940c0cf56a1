// Tests: tables of a user, the points of them that count, and the laws fitted to these.

import { part, post } from "../api.js";
import { fill, h, say } from "../dom.js";
import { Plot } from "../plot.js";

const LAWS = ["neo-hooke", "mooney-rivlin", "yeoh", "gent", "ogden-2", "ogden-3", "arruda-boyce"];
const USUAL = ["neo-hooke", "mooney-rivlin", "yeoh", "gent"]; // seconds; Ogden's law takes longer
const MOST = 100e6; // bytes of a file that the server reads

export class Tests {
  /** @param {(choice: any, words: string) => void} use */
  constructor(use) {
    this.use = use;
    /** @type {Map<string, any>} tests by their files */
    this.read = new Map();
    /** @type {any[]} */
    this.fits = [];
    /** @type {Set<string>} laws whose curves are drawn */
    this.shown = new Set();
    this.plot = new Plot("points of the tests and fitted laws", "stretch [-]", "nominal stress [MPa]", (low, high) => this.#range(low, high));
    this.files = h("ul", { class: "rubber-files" });
    this.notes = h("div", { class: "rubber-notes" });
    const pick = (/** @type {string} */ label, /** @type {[string, string][]} */ options) =>
      h("select", { "aria-label": label, onchange: () => this.#readAll() }, ...options.map(([value, text]) => h("option", { value }, text)));
    this.mode = pick("mode of the test", [["", "as the file says"], ...["uniaxial", "equibiaxial", "planar", "simple_shear", "biaxial"].map((each) => /** @type {[string, string]} */ ([each, each.replace("_", " ")]))]);
    this.stress = pick("stress of the test", [["", "as the file says"], ["nominal", "nominal (engineering)"], ["cauchy", "Cauchy (true)"]]);
    this.cycle = pick("cycle of the test", [["first", "the first loading"], ["last", "the last loading"]]);
    this.specimen = h("input", { placeholder: "33 mm, 6 mm, 3 mm", "aria-label": "length, width and thickness of the specimen", onchange: () => this.#readAll() });
    const edge = (/** @type {string} */ label) => h("input", { type: "number", step: 0.05, min: 0, class: "live-number", "aria-label": label, onchange: () => this.#draw() });
    this.low = edge("smallest stretch that counts");
    this.high = edge("largest stretch that counts");
    this.laws = LAWS.map((law) => ({ law, box: h("input", { type: "checkbox", checked: USUAL.includes(law) }) }));
    this.run = h("button", { type: "button", class: "primary", onclick: () => this.#fit() }, "Fit and compare");
    this.results = h("div", { class: "rubber-scroll", "aria-live": "polite" });
    this.chooser = h("input", { type: "file", accept: ".csv,.txt", multiple: true, class: "rubber-chooser", "aria-label": "tables of tests", onchange: () => this.#send([...this.chooser.files]) });
    this.how = h("div", {},
      h("div", { class: "rubber-how" }, h("label", {}, "mode ", this.mode), h("label", {}, "stress ", this.stress), h("label", {}, "specimen ", this.specimen), h("label", {}, "cycles: ", this.cycle)),
      this.notes, this.plot.element,
      h("div", { class: "live-row" }, h("label", {}, "points from stretch ", this.low), h("label", {}, "to ", this.high),
        h("button", { type: "button", onclick: () => this.#range(NaN, NaN) }, "All points"), h("span", { class: "quiet" }, "or drag over the plot")),
      h("fieldset", { class: "rubber-laws" }, h("legend", {}, "laws"), ...this.laws.map(({ law, box }) => h("label", {}, box, ` ${law}`))),
      this.run, this.results);
    this.how.hidden = true;
    this.element = h(
      "section", { class: "card rubber-tests", "aria-label": "Your tests" },
      h("h2", {}, "Your own tests"),
      h("p", { class: "quiet" }, "A table with a header, such as stretch and engineering stress (MPa), or force, extension and the specimen. Drop it here, or put it into the folder."),
      h("label", { class: "rubber-drop" }, "Drop a CSV file, or choose one ", this.chooser), this.files, this.how,
    );
    this.element.addEventListener("dragover", (/** @type {DragEvent} */ event) => event.preventDefault());
    this.element.addEventListener("drop", (/** @type {DragEvent} */ event) => {
      event.preventDefault();
      this.#send([...(event.dataTransfer?.files ?? [])]);
    });
  }

  /** The tables of the folder. @param {string[]} names */
  tables(names) {
    const box = (/** @type {string} */ name) => {
      const mark = h("input", { type: "checkbox", value: name, checked: this.read.has(name), onchange: () => (mark.checked ? this.#read(name) : this.#forget(name)) });
      return h("li", {}, h("label", {}, mark, ` ${name}`));
    };
    fill(this.files, ...names.map(box));
  }

  /** @param {File[]} files */
  async #send(files) {
    for (const file of files) {
      try {
        if (file.size > MOST) throw new Error(`'${file.name}' has ${(file.size / 1e6).toFixed(0)} MB; at most ${MOST / 1e6} MB are read. Put it into the folder instead.`);
        const name = file.name.replace(/\.txt$/i, ".csv");
        const sent = await post(`/api/uploads?name=${part(name)}`, new Blob([file]));
        await this.#read(sent.name);
      } catch (error) {
        say(/** @type {Error} */ (error).message, true);
      }
    }
    this.chooser.value = "";
  }

  #reading() {
    return { mode: this.mode.value, stress: this.stress.value, specimen: this.specimen.value.trim(), cycle: this.cycle.value };
  }

  async #readAll() {
    for (const name of [...this.read.keys()]) await this.#read(name);
  }

  /** @param {string} name */
  async #read(name) {
    try {
      this.read.set(name, await post("/api/materials/tests", { file: name, ...this.#reading() }));
    } catch (error) {
      this.read.set(name, { file: name, columns: [], tests: [], refused: /** @type {Error} */ (error).message });
    }
    this.#changed();
  }

  /** @param {string} name */
  #forget(name) {
    this.read.delete(name);
    this.#changed();
  }

  #changed() {
    this.fits = [];
    fill(this.results);
    this.how.hidden = !this.read.size;
    for (const box of this.files.querySelectorAll("input")) box.checked = this.read.has(box.value);
    fill(this.notes, ...[...this.read.values()].map((each) => this.#note(each)));
    this.#range(NaN, NaN);
  }

  /** What was understood of a file. @param {any} each */
  #note(each) {
    const roles = each.columns.map((/** @type {any} */ column) => h("li", {}, h("code", {}, column.name), column.role ? ` is the ${column.role}` : " is not used"));
    const tests = each.tests.map((/** @type {any} */ test) => h("p", {}, `${test.name}: ${test.mode}, ${test.count} points. ${test.edits.join(" ")}`));
    return h("div", {}, h("b", {}, each.file), each.refused && h("p", { class: "wrong", role: "alert" }, each.refused), ...tests, roles.length ? h("ul", { class: "quiet" }, ...roles) : null);
  }

  /** @returns {any[]} */
  #tests() {
    return [...this.read.values()].flatMap((each) => each.tests);
  }

  /** @param {number} low @param {number} high */
  #range(low, high) {
    this.low.value = Number.isNaN(low) ? "" : low.toFixed(2);
    this.high.value = Number.isNaN(high) ? "" : high.toFixed(2);
    this.#draw();
  }

  /** @returns {[number, number] | null} */
  #ends() {
    const all = this.#tests().flatMap((test) => test.stretch);
    if ((!this.low.value && !this.high.value) || !all.length) return null;
    return [Number(this.low.value) || Math.min(...all), Number(this.high.value) || Math.max(...all)];
  }

  #draw() {
    const points = this.#tests().map((test, k) => ({ label: test.name, x: test.stretch, y: test.stress, kind: /** @type {const} */ ("points"), color: k }));
    const lines = this.fits.filter((fit) => this.shown.has(fit.law)).flatMap((fit, k) =>
      fit.curves.map((/** @type {any} */ curve) => ({ label: fit.curves.length > 1 ? `${fit.law}, ${curve.name}` : fit.law, x: curve.stretch, y: curve.stress, kind: /** @type {const} */ ("line"), color: k + points.length })));
    this.plot.draw([...points, ...lines], this.#ends());
  }

  async #fit() {
    const laws = this.laws.filter(({ box }) => box.checked).map(({ law }) => law);
    const files = [...this.read.values()].filter((each) => each.tests.length).map((each) => each.file);
    this.run.disabled = true;
    fill(this.results, h("p", { class: "quiet" }, "Fitting …"));
    try {
      const found = await post("/api/materials/fits", { files, laws, range: this.#ends(), ...this.#reading() });
      this.fits = found.fits;
      this.shown = new Set(found.fits.slice(0, 2).map((/** @type {any} */ fit) => fit.law));
      this.#table(found);
      this.#draw();
    } catch (error) {
      fill(this.results, h("p", { class: "wrong", role: "alert" }, /** @type {Error} */ (error).message));
    }
    this.run.disabled = false;
  }

  /** @param {any} found */
  #table(found) {
    const heads = ["curve", "use", "law", "constants", "error", "AIC", "stable", "findings"];
    const row = (/** @type {any} */ fit) => {
      const mark = h("input", { type: "checkbox", checked: this.shown.has(fit.law), "aria-label": `curve of ${fit.law}`, onchange: () => {
        if (mark.checked) this.shown.add(fit.law);
        else this.shown.delete(fit.law);
        this.#draw();
      } });
      const lost = Object.entries(fit.instability).map(([mode, stretch]) => `${mode} from ${Number(stretch).toPrecision(3)}`).join(", ");
      const use = h("button", { type: "button", disabled: !fit.entry, "aria-label": `use ${fit.law}`, onclick: () => this.use(fit.entry, `${fit.law}, fitted`) }, "Use");
      return h("tr", {},
        h("td", {}, mark), h("td", {}, use), h("td", {}, h("b", {}, fit.law)), h("td", {}, ...fit.parameters.flatMap((/** @type {string} */ each) => [each, h("br")])),
        h("td", {}, `${Number((100 * fit.relative).toPrecision(2))} %`), h("td", {}, fit.aic.toFixed(0)),
        h("td", { class: fit.stable ? "good" : "rubber-doubt" }, fit.stable ? "yes" : `no: ${lost}`),
        h("td", {}, fit.findings.length ? h("details", {}, h("summary", {}, fit.findings.map((/** @type {string} */ each) => each.split(" ")[0]).join(", ")), ...fit.findings.map((/** @type {string} */ each) => h("p", {}, each))) : "none"));
    };
    fill(this.results,
      h("table", {}, h("thead", {}, h("tr", {}, ...heads.map((head) => h("th", { scope: "col" }, head)))), h("tbody", {}, ...found.fits.map(row))),
      ...[...found.words, ...found.failed].map((/** @type {string} */ each) => h("p", {}, each)));
  }
}
