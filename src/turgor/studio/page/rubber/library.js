// Library: the published records as a table, the curves of those that are marked, and one of them for a region of the job.

import { get, post } from "../api.js";
import { fill, h, later, say } from "../dom.js";
import { COLORS, Plot } from "../plot.js";

// What is drawn before anything is marked: a soft and a stiff rubber.
const FIRST = ["ecoflex-00-30\nyeoh-steck-2019", "elastosil-m4601\nyeoh-mosadegh-2014"];

export class Library {
  /** @param {(choice: any, words: string) => void} use */
  constructor(use) {
    this.use = use;
    /** @type {any[]} */
    this.records = [];
    /** @type {Set<string>} */
    this.marked = new Set();
    this.plot = new Plot("stress-stretch curves of the library", "stretch [-]", "nominal stress [MPa]");
    this.mode = h("select", { onchange: () => this.#curves() }, ...["uniaxial", "planar", "equibiaxial"].map((mode) => h("option", {}, mode)));
    this.most = h("input", { type: "number", min: 1.1, max: 10, step: 0.5, value: 3, class: "live-number", onchange: () => this.#curves() });
    this.filter = h("input", { type: "search", placeholder: "name, law, hardness, source …", oninput: later(() => this.#table(), 150) });
    this.rows = h("tbody", {});
    const heads = ["curve", "use", "material", "law", "tested to", "doubts and source"];
    this.element = h(
      "section", { class: "card rubber-library", "aria-label": "Library" },
      h("h2", {}, "Library"),
      h("p", { class: "quiet" }, "Constants as they were published. A curve is bold where the rubber was tested, faint beyond; mark several to compare them."),
      h("div", { class: "live-row" }, h("label", {}, "mode ", this.mode), h("label", {}, "to stretch ", this.most)),
      this.plot.element,
      h("label", { class: "rubber-filter" }, "Find ", this.filter),
      h("div", { class: "rubber-scroll", tabindex: 0, role: "region", "aria-label": "records" }, h("table", {}, h("thead", {}, h("tr", {}, ...heads.map((head) => h("th", { scope: "col" }, head)))), this.rows)),
    );
  }

  async start() {
    this.records = await get("/api/materials");
    this.marked = new Set(FIRST.filter((name) => this.records.some((each) => key(each) === name)));
    this.#table();
    await this.#curves();
  }

  #table() {
    const wanted = this.filter.value.toLowerCase().split(/\s+/).filter(Boolean);
    const shown = this.records.filter((each) => {
      const text = `${each.library} ${each.record} ${each.name} ${each.kind} ${each.hardness} ${each.law} ${each.source}`.toLowerCase();
      return wanted.every((/** @type {string} */ word) => text.includes(word));
    });
    fill(this.rows, ...(shown.length ? shown.map((each) => this.#row(each)) : [h("tr", {}, h("td", { colspan: 6, class: "quiet" }, "No record has these words."))]));
  }

  /** @param {any} each */
  #row(each) {
    const name = `${each.library} ${each.record}`;
    const mark = h("input", {
      type: "checkbox", checked: this.marked.has(key(each)), "aria-label": `curve of ${name}`,
      onchange: () => {
        if (mark.checked) this.marked.add(key(each));
        else this.marked.delete(key(each));
        if (this.marked.size > COLORS) this.marked.delete([...this.marked][0]);
        this.#table();
        this.#curves();
      },
    });
    const use = h("button", { type: "button", "aria-label": `use ${name}`, onclick: () => this.use({ library: each.library, record: each.record }, name) }, "Use");
    const warnings = each.doubts.filter((/** @type {any} */ doubt) => doubt.severity === "warning").length;
    const words = warnings ? `${warnings} doubt${warnings > 1 ? "s" : ""}` : each.doubts.length ? "notes" : "source";
    return h(
      "tr", {},
      h("td", {}, mark), h("td", {}, use),
      h("td", {}, h("b", {}, each.name), h("br"), h("span", { class: "quiet rubber-record" }, each.record), h("br"), `${each.kind}${each.hardness ? `, ${each.hardness}` : ""}`),
      h("td", {}, each.law.replaceAll("_", "-"), h("br"), h("span", { class: "quiet" }, each.printed)),
      h("td", {}, each.range ? `${each.range[0]} to ${each.range[1]}` : "–"),
      h("td", {}, h("details", {}, h("summary", { class: warnings ? "rubber-doubt" : "" }, words),
        ...each.doubts.map((/** @type {any} */ doubt) => h("p", {}, `${doubt.code} ${doubt.severity}: ${doubt.text}`)), h("p", { class: "quiet" }, each.source))),
    );
  }

  async #curves() {
    const records = [...this.marked].map((each) => each.split("\n"));
    try {
      const curves = await post("/api/materials/curves", { records, mode: this.mode.value, most: Number(this.most.value) || 3 });
      this.plot.draw(curves.filter((/** @type {any} */ each) => each.stress).map((/** @type {any} */ each, /** @type {number} */ k) =>
        ({ label: each.label, x: each.stretch, y: each.stress, kind: "line", color: k, range: each.range })));
    } catch (error) {
      say(/** @type {Error} */ (error).message, true);
    }
  }
}

/** @param {any} record */
const key = (record) => `${record.library}\n${record.record}`;
