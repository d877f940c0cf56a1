// Dragging: a load history as a curve whose points are moved by the mouse or the arrow keys, added by a click on the
// line, and removed by Delete; and states as marks on a line.

import { fill, h } from "../dom.js";
import { svg, ticks } from "./chart.js";
import { written } from "./numbers.js";

const [WIDTH, HEIGHT] = [420, 200];
const FRAME = { left: 44, right: WIDTH - 14, top: 14, bottom: HEIGHT - 36 };
const FINE = 0.01; // places and shares are rounded to this part of their range

/**
 * @param {Element} place
 * @param {{points: [number, number][], width: number, x: string, y: string, change: (points: [number, number][]) => void}} given
 */
export function historyCurve(place, given) {
  const points = given.points.map((each) => /** @type {[number, number]} */ ([...each]));
  const low = Math.min(0, ...points.map(([, y]) => y));
  const high = Math.max(1, ...points.map(([, y]) => y));
  const across = (/** @type {number} */ x) => FRAME.left + (x / given.width) * (FRAME.right - FRAME.left);
  const upward = (/** @type {number} */ y) => FRAME.bottom - ((y - low) / (high - low)) * (FRAME.bottom - FRAME.top);
  const drawn = svg("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, class: "chart drag", role: "group", "aria-label": `${given.y} against ${given.x}` });
  for (const x of ticks(0, given.width, 5)) {
    svg("path", { d: `M${across(x)} ${FRAME.top}V${FRAME.bottom}`, class: "grid" }, drawn);
    svg("text", { x: across(x), y: FRAME.bottom + 15, "text-anchor": "middle" }, drawn, written(x));
  }
  for (const y of ticks(low, high, 4)) {
    svg("path", { d: `M${FRAME.left} ${upward(y)}H${FRAME.right}`, class: "grid" }, drawn);
    svg("text", { x: FRAME.left - 6, y: upward(y) + 4, "text-anchor": "end" }, drawn, written(y));
  }
  svg("text", { x: (FRAME.left + FRAME.right) / 2, y: HEIGHT - 6, "text-anchor": "middle" }, drawn, given.x);
  const hit = svg("path", { class: "hit" }, drawn);
  const line = svg("path", { class: "line" }, drawn);
  const path = () => {
    const way = points.map(([x, y], k) => `${k ? "L" : "M"}${across(x)} ${upward(y)}`).join("");
    line.setAttribute("d", way);
    hit.setAttribute("d", way);
  };
  /** Where a pointer is, in shares. @param {PointerEvent} event @returns {[number, number]} */
  const at = (event) => {
    const { x, y } = new DOMPoint(event.clientX, event.clientY).matrixTransform(drawn.getScreenCTM().inverse());
    return [((x - FRAME.left) / (FRAME.right - FRAME.left)) * given.width, low + ((FRAME.bottom - y) / (FRAME.bottom - FRAME.top)) * (high - low)];
  };
  /** Move a point between its neighbors; the first one stays at the start. @param {number} k @param {number} x @param {number} y */
  const move = (k, x, y) => {
    const step = FINE * given.width;
    const before = k ? points[k - 1][0] + step : 0;
    const after = k < points.length - 1 ? points[k + 1][0] - step : given.width;
    const inside = k === 0 ? points[0][0] : k === points.length - 1 ? points[k][0] : Math.min(after, Math.max(before, x));
    points[k] = [round(inside, given.width), round(Math.min(high, Math.max(low, y)), high - low)];
    path();
    knobs[k].setAttribute("cx", String(across(points[k][0])));
    knobs[k].setAttribute("cy", String(upward(points[k][1])));
    knobs[k].setAttribute("aria-valuetext", `${written(points[k][1])} at ${written(points[k][0])}`);
  };
  const finish = () => given.change(points);
  const knobs = points.map((point, k) => {
    const knob = svg("circle", { cx: across(point[0]), cy: upward(point[1]), r: 7, class: "knob", tabindex: 0, role: "slider",
      "aria-label": `point ${k + 1}`, "aria-valuetext": `${written(point[1])} at ${written(point[0])}`, "aria-valuenow": point[1] }, drawn);
    knob.addEventListener("pointerdown", (/** @type {PointerEvent} */ event) => {
      knob.setPointerCapture(event.pointerId);
      const follow = (/** @type {PointerEvent} */ moved) => move(k, ...at(moved));
      knob.addEventListener("pointermove", follow);
      knob.addEventListener("pointerup", () => { knob.removeEventListener("pointermove", follow); finish(); }, { once: true });
    });
    knob.addEventListener("keydown", (/** @type {KeyboardEvent} */ event) => {
      const step = /** @type {Record<string, [number, number]>} */ ({ ArrowUp: [0, 1], ArrowDown: [0, -1], ArrowRight: [1, 0], ArrowLeft: [-1, 0] })[event.key];
      if (step) {
        event.preventDefault();
        move(k, points[k][0] + step[0] * FINE * given.width, points[k][1] + step[1] * FINE * (high - low));
        finish();
      } else if ((event.key === "Delete" || event.key === "Backspace") && k && k < points.length - 1) {
        points.splice(k, 1);
        finish();
      }
    });
    return knob;
  });
  hit.addEventListener("click", (/** @type {PointerEvent} */ event) => {
    const [x, y] = at(event);
    const after = points.findIndex(([other]) => other > x);
    if (after < 1) return;
    points.splice(after, 0, [round(x, given.width), round(y, high - low)]);
    finish();
  });
  path();
  fill(place, drawn, h("p", { class: "quiet small" }, "Drag the points, or move them by the arrow keys. A click on the line adds a point; Delete removes one."));
}

/**
 * States as marks on the path from rest to the full load.
 * @param {Element} place @param {{at: number[], change: (at: number[]) => void}} given
 */
export function statesLine(place, given) {
  const at = [...given.at];
  const across = (/** @type {number} */ x) => FRAME.left + x * (FRAME.right - FRAME.left);
  const drawn = svg("svg", { viewBox: `0 0 ${WIDTH} 74`, class: "chart drag", role: "group", "aria-label": "load factors of states" });
  for (const x of ticks(0, 1, 5)) svg("text", { x: across(x), y: 52, "text-anchor": "middle" }, drawn, written(x));
  svg("text", { x: (FRAME.left + FRAME.right) / 2, y: 70, "text-anchor": "middle" }, drawn, "load factor");
  const line = svg("path", { d: `M${FRAME.left} 24H${FRAME.right}`, class: "line" }, drawn);
  const hit = svg("path", { d: `M${FRAME.left} 24H${FRAME.right}`, class: "hit" }, drawn);
  svg("circle", { cx: across(1), cy: 24, r: 4, class: "end" }, drawn);
  const where = (/** @type {PointerEvent} */ event) => {
    const { x } = new DOMPoint(event.clientX, event.clientY).matrixTransform(drawn.getScreenCTM().inverse());
    return Math.min(0.99, Math.max(0.01, round((x - FRAME.left) / (FRAME.right - FRAME.left), 1)));
  };
  const finish = () => given.change([...new Set(at)].sort((a, b) => a - b));
  at.forEach((x, k) => {
    const knob = svg("circle", { cx: across(x), cy: 24, r: 7, class: "knob", tabindex: 0, role: "slider", "aria-label": `state ${k + 1}`, "aria-valuenow": x }, drawn);
    const move = (/** @type {number} */ to) => { at[k] = to; knob.setAttribute("cx", String(across(to))); };
    knob.addEventListener("pointerdown", (/** @type {PointerEvent} */ event) => {
      knob.setPointerCapture(event.pointerId);
      const follow = (/** @type {PointerEvent} */ moved) => move(where(moved));
      knob.addEventListener("pointermove", follow);
      knob.addEventListener("pointerup", () => { knob.removeEventListener("pointermove", follow); finish(); }, { once: true });
    });
    knob.addEventListener("keydown", (/** @type {KeyboardEvent} */ event) => {
      const step = event.key === "ArrowRight" ? FINE : event.key === "ArrowLeft" ? -FINE : 0;
      if (step) move(Math.min(0.99, Math.max(0.01, round(at[k] + step, 1))));
      else if (event.key === "Delete" || event.key === "Backspace") at.splice(k, 1);
      else return;
      event.preventDefault();
      finish();
    });
  });
  for (const each of [hit, line]) each.addEventListener("click", (/** @type {PointerEvent} */ event) => { at.push(where(event)); finish(); });
  fill(place, drawn, h("p", { class: "quiet small" }, "A click on the line requests a state at this share of the load; drag it, or remove it by Delete."));
}

/** Round to a part of a range. @param {number} value @param {number} range */
function round(value, range) {
  const step = FINE * range;
  return Number((Math.round(value / step) * step).toPrecision(10));
}
