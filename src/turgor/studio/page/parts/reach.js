// Reach: how far the tip gets with all combinations of the pressures of several cavities.

import { get, part, post } from "../api.js";
import { fill, h } from "../dom.js";
import { svg, ticks } from "./chart.js";
import { written } from "./numbers.js";
import { attempt } from "./runs.js";

const POLL = 2000; // milliseconds between two looks
const [WIDTH, HEIGHT, EDGE] = [420, 340, 46];

export class Reach {
  /** @param {import("../main.js").App} app */
  constructor(app) {
    this.app = app;
    this.element = h("section", { class: "card", hidden: true });
    this.plot = h("div", {});
    this.known = "";
    this.alive = true;
  }

  /** @param {string[]} cavities */
  begin(cavities) {
    if (cavities.length < 2) return;
    this.element.hidden = false;
    const inputs = cavities.map((name) => h("input", { value: "0, 10, 20 kPa", "data-cavity": name, size: 16 }));
    const start = async () => {
      const pressures = Object.fromEntries(inputs.map((each) => [each.dataset.cavity, each.value]));
      if (await attempt(() => post("/api/studies/workspace", { job: this.app.job.name, pressures }))) await this.look();
    };
    const fields = inputs.map((each, k) => h("label", {}, h("span", { class: "quiet small" }, cavities[k]), each));
    fill(this.element, h("h2", {}, "Workspace of the tip"), h("p", { class: "quiet" }, "Every combination of these pressures is a run."),
      h("div", { class: "form" }, h("div", { class: "line" }, ...fields, h("button", { type: "button", onclick: start }, "Compute the workspace"))), this.plot);
    this.poll();
  }

  end() {
    this.alive = false;
  }

  async poll() {
    if (!this.alive) return;
    await this.look();
    if (this.alive) setTimeout(() => this.poll(), POLL);
  }

  async look() {
    /** @type {any} */
    let found;
    try {
      found = await get(`/api/studies/workspace/${part(this.app.job.name)}`);
    } catch {
      return;
    }
    const text = JSON.stringify(found);
    if (text === this.known || found.state === "none") return;
    this.known = text;
    const said = /** @type {Record<string, string>} */ ({ running: "is being computed", ended: "has ended", failed: "ended early" })[found.state];
    const size = found.area ? ` The tip reaches ${written(found.area)} mm²${found.volume ? ` and ${written(found.volume)} mL` : ""}.` : "";
    const planes = found.points.length > 1 ? [["x", 0, "z", 2], ["y", 1, "z", 2]].map((each) => plane(found.points, /** @type {any} */ (each))) : [];
    fill(this.plot, h("p", {}, `It ${said}: ${found.points.length} runs.${size}`), h("div", { class: "pair" }, ...planes),
      ...(found.state === "failed" ? [h("p", { class: "wrong" }, found.message)] : []));
  }
}

/** Corners of the hull around points of a plane. @param {[number, number][]} points @returns {[number, number][]} */
export function hull(points) {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const turn = (/** @type {number[]} */ o, /** @type {number[]} */ a, /** @type {number[]} */ b) => (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
  const half = (/** @type {[number, number][]} */ along) => {
    /** @type {[number, number][]} */
    const out = [];
    for (const point of along) {
      while (out.length > 1 && turn(out[out.length - 2], out[out.length - 1], point) <= 0) out.pop();
      out.push(point);
    }
    return out.slice(0, -1);
  };
  return [...half(sorted), ...half(sorted.reverse())];
}

/** Places of the tip in a plane, at one scale. @param {any[]} points @param {[string, number, string, number]} axes */
function plane(points, [across, i, upward, j]) {
  const places = points.map(({ tip }) => /** @type {[number, number]} */ ([tip[i], tip[j]]));
  const [xs, ys] = [0, 1].map((k) => places.map((each) => each[k]));
  const middle = [xs, ys].map((each) => (Math.min(...each) + Math.max(...each)) / 2);
  const size = 1.1 * Math.max(Math.max(...xs) - Math.min(...xs), Math.max(...ys) - Math.min(...ys), 1e-6);
  const scale = Math.min(WIDTH - 2 * EDGE, HEIGHT - 2 * EDGE) / size;
  const at = (/** @type {number[]} */ [x, y]) => [WIDTH / 2 + (x - middle[0]) * scale, HEIGHT / 2 - (y - middle[1]) * scale];
  const drawn = svg("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, class: "chart", role: "img", "aria-label": `places of the tip in ${across} and ${upward}` });
  for (const x of ticks(middle[0] - size / 2, middle[0] + size / 2, 5)) svg("text", { x: at([x, 0])[0], y: HEIGHT - 22, "text-anchor": "middle" }, drawn, written(x));
  for (const y of ticks(middle[1] - size / 2, middle[1] + size / 2, 5)) svg("text", { x: 40, y: at([0, y])[1] + 4, "text-anchor": "end" }, drawn, written(y));
  const group = svg("g", { class: "series s0 line" }, drawn);
  svg("polygon", { points: hull(places).map((each) => at(each).join(",")).join(" "), class: "band" }, group);
  points.forEach((point, k) => {
    const [cx, cy] = at(places[k]);
    svg("title", {}, svg("circle", { cx, cy, r: 4 }, group), point.name);
  });
  svg("text", { x: WIDTH / 2, y: HEIGHT - 4, "text-anchor": "middle" }, drawn, `${across} and ${upward} [mm]`);
  return drawn;
}
