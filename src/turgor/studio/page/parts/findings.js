// Findings: what checks have noticed, each with what mends it as a button, and the page about it to unfold.

import { get, part } from "../api.js";
import { fill, h, say } from "../dom.js";

/** @typedef {{label: string, values: Record<string, any>}} Fix */

/** Buttons that mend something. @param {Fix[]} fixes @param {import("../job.js").Job} job */
const buttons = (fixes, job) =>
  (fixes ?? []).map((fix) => h("button", { type: "button", class: "fix", onclick: () => job.set(fix.values) }, fix.label));

/** A problem of the file, with a link to its line. @param {any} problem @param {import("../job.js").Job} job */
export function problemItem(problem, job) {
  const line = problem.line && h("a", { href: `#/code/${part(job.name)}/${problem.line}` }, `line ${problem.line}`);
  return h("li", { class: "finding error" }, h("p", {}, line, line ? " " : "", h("code", {}, problem.key), problem.key ? ": " : "", problem.sentence), ...buttons(problem.fixes, job));
}

/** A finding with its code, sentence, advice, fixes and documentation. @param {any} finding @param {import("../job.js").Job} job */
export function findingItem(finding, job) {
  const about = h("div", { class: "quiet small" });
  const open = async (/** @type {Event} */ event) => {
    if (!(/** @type {HTMLDetailsElement} */ (event.target).open) || about.childElementCount) return;
    try {
      const { paragraphs } = await get(`/api/findings/${part(finding.code)}`);
      fill(about, ...paragraphs.map((/** @type {string} */ each) => h("p", {}, each)));
    } catch (error) {
      say(/** @type {Error} */ (error).message, true);
    }
  };
  return h("li", { class: `finding ${finding.severity}` },
    h("p", {}, h("b", {}, finding.code), ` ${finding.severity}: ${finding.message} `, h("span", { class: "quiet" }, finding.advice)),
    ...buttons(finding.fixes, job),
    h("details", { ontoggle: open }, h("summary", {}, `About ${finding.code}`), about));
}
