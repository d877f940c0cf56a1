// Code: the job file as text with its problems at their lines, and what repeats the screen before.

import { get, part } from "../api.js";
import { fill, h, later, say } from "../dom.js";
import { codeOf } from "../snippets.js";

/** @param {HTMLElement} place @param {import("../main.js").App} app */
export async function show(place, app) {
  const seen = app.seen ?? { screen: app.shown ? "solve" : "start", name: app.shown };
  const snippets = codeOf({ job: app.shown || app.job.name, ...seen });
  const repeat = h(
    "section", { class: "card code-repeat", "aria-label": "What repeats it" },
    h("h2", {}, "What repeats it"),
    h("p", { class: "quiet" }, `The same as the screen “${seen.title ?? "Solve"}” shows, without it: in Python, and in a terminal in this folder.`),
    snippet("Python", snippets.python), snippet("Terminal", snippets.shell),
  );
  place.append(h("h1", {}, app.shown || "Code"));
  if (!app.shown) {
    place.append(repeat);
    return;
  }
  const editor = new Editor(app);
  place.append(h("div", { class: "code-columns" }, editor.element, repeat));
  await editor.start();
  return () => editor.end();
}

/** @param {string} title @param {string} text */
function snippet(title, text) {
  const copy = h("button", { type: "button", "aria-label": `copy ${title}`, onclick: () => navigator.clipboard?.writeText(text).then(() => say(`${title}: copied.`), () => say("This browser lets no page copy; mark the text.")) }, "Copy");
  return h("div", { class: "code-snippet" }, h("div", { class: "live-row" }, h("h3", {}, title), copy), h("pre", { tabindex: 0, "aria-label": title, "data-snippet": title }, text));
}

class Editor {
  /** @param {import("../main.js").App} app */
  constructor(app) {
    this.app = app;
    this.lines = h("pre", { class: "code-lines", "aria-hidden": "true" });
    this.text = h("textarea", {
      class: "code", spellcheck: false, autocapitalize: "off", autocomplete: "off", wrap: "off", rows: 12, "aria-label": `text of ${app.shown}`, "aria-describedby": "code-problems",
      oninput: () => this.#typed(),
      onkeydown: (/** @type {KeyboardEvent} */ event) => this.#key(event),
    });
    this.save = h("button", { type: "button", class: "primary", title: "Ctrl+S", onclick: () => this.#write() }, "Save");
    this.back = h("button", { type: "button", onclick: () => this.#read() }, "Discard");
    this.note = h("span", { class: "quiet", role: "status" });
    this.problems = h("ul", { class: "code-problems", id: "code-problems", "aria-live": "polite" });
    this.element = h(
      "section", { class: "code-editor", "aria-label": "Job file" },
      h("div", { class: "live-row" }, this.save, this.back, this.note),
      h("div", { class: "code-frame" }, this.lines, this.text), this.problems,
    );
    this.changed = () => this.#changed();
    /** @type {Map<number, string>} */
    this.wrong = new Map();
    this.check = later(() => this.#check(), 150);
  }

  async start() {
    this.app.job.addEventListener("change", this.changed);
    this.#read();
    const line = Number(location.hash.split("/")[3]); // of a problem that another screen shows
    if (line) this.#jump(line);
  }

  end() {
    this.app.job.removeEventListener("change", this.changed);
    if (this.#dirty()) say(`The edits of the text of '${this.app.job.name}' were not saved.`, true);
  }

  /** The text of the file; a field of a page has no line ends but \n. */
  #file() {
    return this.app.job.state?.text ?? "";
  }

  #dirty() {
    return this.text.value !== this.#file().replace(/\r\n?/g, "\n") && this.base !== undefined && this.text.value !== this.base;
  }

  #read() {
    this.text.value = this.#file();
    this.base = this.text.value;
    this.#typed();
    this.check();
  }

  /** The file has changed, by this page or by another program. */
  #changed() {
    if (this.#dirty()) {
      this.note.textContent = "The file has changed on disk. Save keeps yours, Discard takes the file.";
      this.note.className = "wrong";
      return;
    }
    const { selectionStart, selectionEnd, scrollTop } = this.text;
    this.#read();
    Object.assign(this.text, { selectionStart, selectionEnd, scrollTop });
  }

  async #write() {
    if (!this.#dirty()) return;
    const ends = this.#file().includes("\r\n") ? "\r\n" : "\n"; // as the file has them
    const text = this.text.value;
    this.base = text;
    await this.app.job.write(text.replaceAll("\n", ends));
    this.#typed();
    this.check();
  }

  #typed() {
    const dirty = this.#dirty();
    this.save.disabled = this.back.disabled = !dirty;
    this.note.textContent = dirty ? "Not saved yet" : "Saved";
    this.note.className = "quiet";
    const count = this.text.value.split("\n").length;
    this.text.rows = Math.max(12, count + 1);
    const numbers = Array.from({ length: count }, (_, k) => {
      const problem = this.wrong.get(k + 1);
      return h("span", { class: problem ? "code-line wrong" : "code-line", title: problem ?? null }, `${problem ? "● " : ""}${k + 1}\n`);
    });
    fill(this.lines, ...numbers);
  }

  async #check() {
    try {
      const found = await get(`/api/jobs/${part(this.app.job.name)}/problems`);
      this.wrong = new Map(found.map((/** @type {any} */ each) => [each.line, each.sentence]));
      fill(this.problems, ...(found.length ? found.map((/** @type {any} */ each) => this.#problem(each)) : [h("li", { class: "good" }, "Every key and value is understood.")]));
      this.#typed();
    } catch (error) {
      say(/** @type {Error} */ (error).message, true);
    }
  }

  /** @param {{line: number, sentence: string}} each */
  #problem(each) {
    const jump = h("button", { type: "button", class: "quiet", onclick: () => this.#jump(each.line) }, `line ${each.line}`);
    return h("li", { class: "wrong" }, each.line ? jump : null, ` ${each.sentence}`);
  }

  /** @param {number} line */
  #jump(line) {
    const before = this.text.value.split("\n").slice(0, line - 1).join("\n").length;
    this.text.focus();
    this.text.setSelectionRange(before + (line > 1 ? 1 : 0), before + (line > 1 ? 1 : 0));
    this.lines.children[line - 1]?.scrollIntoView({ block: "center" });
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    if (!(event.ctrlKey || event.metaKey) || event.key !== "s") return;
    event.preventDefault();
    this.#write();
  }
}
