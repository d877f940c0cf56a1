// Chart: curves with mesh errors, coarse curves dashed, measured points, and markers, as SVG.

import { written } from "./numbers.js";

const SVG = "http://www.w3.org/2000/svg";
const [WIDTH, HEIGHT] = [520, 300];
const FRAME = { left: 58, right: WIDTH - 12, top: 12, bottom: HEIGHT - 44 };

/**
 * @typedef {object} Series
 * @property {string} name
 * @property {(number | null)[]} x
 * @property {(number | null)[]} y
 * @property {(number | null)[] | null} [error]
 * @property {"line" | "coarse" | "points"} kind
 * @property {number} [mark] place between two rows that is marked
 */

/** @param {string} tag @param {Record<string, any>} attributes @param {Element} [parent] @param {string} [text] @returns {any} */
export function svg(tag, attributes, parent, text) {
  const made = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, String(value));
  if (text !== undefined) made.textContent = text;
  parent?.append(made);
  return made;
}

/** Round numbers between two ends. @param {number} low @param {number} high @param {number} about */
export function ticks(low, high, about) {
  const rough = (high - low) / about;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * ([1, 2, 5, 10].find((each) => each * power >= rough * 0.999) ?? 10);
  const out = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k++) out.push(Number((k * step).toPrecision(12)));
  return out;
}

/** Lowest and highest of some numbers, apart. @param {number[]} values @returns {[number, number]} */
function ends(values) {
  if (!values.length) return [0, 1];
  const [low, high] = [Math.min(...values), Math.max(...values)];
  return high > low ? [low, high] : [low - (Math.abs(low) || 1) / 2, high + (Math.abs(high) || 1) / 2];
}

/** Rows of which both numbers are known. @param {Series} series @returns {[number, number, number][]} */
const known = (series) =>
  series.x.flatMap((x, k) => (x === null || series.y[k] === null ? [] : [[x, series.y[k], series.error?.[k] ?? 0]])).map((row) => /** @type {[number, number, number]} */ (row));

/**
 * Draw a chart into an element.
 * @param {Element} place @param {Series[]} series @param {{x: string, y: string, title?: string}} labels
 */
export function chart(place, series, labels) {
  const rows = series.map(known);
  const [xs, ys] = [ends(rows.flat().map(([x]) => x)), ends(rows.flat().flatMap(([, y, e]) => [y - e, y + e]))];
  /** @param {number} x */
  const across = (x) => FRAME.left + ((x - xs[0]) / (xs[1] - xs[0])) * (FRAME.right - FRAME.left);
  /** @param {number} y */
  const upward = (y) => FRAME.bottom - ((y - ys[0]) / (ys[1] - ys[0])) * (FRAME.bottom - FRAME.top);
  const drawn = svg("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, class: "chart", role: "img", "aria-label": labels.title ?? `${labels.y} against ${labels.x}` });
  for (const x of ticks(...xs, 6)) {
    svg("path", { d: `M${across(x)} ${FRAME.top}V${FRAME.bottom}`, class: "grid" }, drawn);
    svg("text", { x: across(x), y: FRAME.bottom + 16, "text-anchor": "middle" }, drawn, written(x));
  }
  for (const y of ticks(...ys, 5)) {
    svg("path", { d: `M${FRAME.left} ${upward(y)}H${FRAME.right}`, class: "grid" }, drawn);
    svg("text", { x: FRAME.left - 6, y: upward(y) + 4, "text-anchor": "end" }, drawn, written(y));
  }
  svg("text", { x: (FRAME.left + FRAME.right) / 2, y: HEIGHT - 8, "text-anchor": "middle" }, drawn, labels.x);
  series.forEach((each, number) => curve(drawn, each, rows[number], number, { across, upward }));
  place.replaceChildren(drawn);
  return { across, upward, drawn };
}

/**
 * @param {Element} drawn @param {Series} series @param {[number, number, number][]} rows @param {number} number
 * @param {{across: (x: number) => number, upward: (y: number) => number}} at
 */
function curve(drawn, series, rows, number, { across, upward }) {
  const group = svg("g", { class: `series s${number % 6} ${series.kind}` }, drawn);
  svg("title", {}, group, series.name);
  if (series.kind === "points") {
    for (const [x, y] of rows) svg("circle", { cx: across(x), cy: upward(y), r: 3.5 }, group);
    return;
  }
  if (rows.some(([, , e]) => e > 0)) {
    const upper = rows.map(([x, y, e]) => `${across(x)},${upward(y + e)}`);
    const lower = rows.map(([x, y, e]) => `${across(x)},${upward(y - e)}`).reverse();
    svg("polygon", { points: [...upper, ...lower].join(" "), class: "band" }, group);
  }
  svg("path", { d: rows.map(([x, y], k) => `${k ? "L" : "M"}${across(x).toFixed(1)} ${upward(y).toFixed(1)}`).join(""), class: "line" }, group);
  for (const [x, y] of rows) svg("circle", { cx: across(x), cy: upward(y), r: 2.4 }, group);
  if (series.mark === undefined) return;
  const [x, y] = [between(series.x, series.mark), between(series.y, series.mark)];
  if (x !== null && y !== null) svg("circle", { cx: across(x), cy: upward(y), r: 6, class: "marker" }, group);
}

/** A value between two rows. @param {(number | null)[]} values @param {number} row @returns {number | null} */
export function between(values, row) {
  const first = Math.min(values.length - 1, Math.max(0, Math.floor(row)));
  const [low, high] = [values[first], values[Math.min(first + 1, values.length - 1)]];
  return low === null || high === null || low === undefined ? null : low + (row - first) * (high - low);
}

/** A legend: a line for each series. @param {Series[]} series @param {(tag: string, properties?: any, ...children: any[]) => any} h */
export function legend(series, h) {
  return h("ul", { class: "legend" }, ...series.map((each, k) =>
    h("li", { class: `s${k % 6} ${each.kind}` }, h("span", { class: "swatch", "aria-hidden": "true" }), each.name, each.kind === "coarse" && h("span", { class: "badge coarse" }, "coarse"))));
}
