// Plot: lines and points against a stretch, as SVG, with a range that can be dragged.

const SPACE = "http://www.w3.org/2000/svg";
const [WIDTH, HEIGHT] = [640, 400];
const EDGE = { left: 58, right: 14, top: 14, bottom: 44 };
export const COLORS = 8; // classes `series-0` … of the style

/**
 * @typedef {{label: string, x: number[], y: (number | null)[], kind: "line" | "points", color: number, range?: [number, number] | null}} Series
 * one with a range is drawn faintly outside of it
 */

/** @param {string} tag @param {Record<string, any>} [attributes] @param {string} [text] */
function svg(tag, attributes = {}, text) {
  const made = document.createElementNS(SPACE, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, String(value));
  if (text !== undefined) made.textContent = text;
  return made;
}

/** Round places between two numbers. @param {number} low @param {number} high @param {number} most */
export function ticks(low, high, most) {
  const raw = (high - low) / most || 1;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = power * ([1, 2, 5, 10].find((each) => each * power >= raw) ?? 10);
  const out = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k++) out.push(Number((k * step).toPrecision(10)));
  return out;
}

export class Plot {
  /** @param {string} label @param {string} across @param {string} upward @param {(low: number, high: number) => void} [choose] called with a range that was dragged */
  constructor(label, across, upward, choose) {
    this.words = { label, across, upward };
    this.choose = choose;
    this.element = /** @type {SVGSVGElement} */ (svg("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "img", class: choose ? "plot ranged" : "plot" }));
    /** @type {[number, number] | null} */
    this.range = null;
    this.box = [1, 2, 0, 1];
    if (choose) this.element.addEventListener("pointerdown", (event) => this.#drag(event));
  }

  /** @param {Series[]} series @param {[number, number] | null} [range] */
  draw(series, range = null) {
    this.range = range;
    const x = series.flatMap((each) => each.x);
    const y = series.flatMap((each) => /** @type {number[]} */ (each.y.filter((value) => value !== null)));
    const high = Math.max(0, ...y);
    this.box = x.length ? [Math.min(...x), Math.max(...x), Math.min(0, ...y), high > 0 ? 1.04 * high : 1] : [1, 2, 0, 1];
    if (this.box[0] === this.box[1]) this.box[1] += 1;
    const names = series.map((each) => each.label).join(", ");
    this.element.setAttribute("aria-label", `${this.words.label}: ${names || "nothing chosen yet"}`);
    this.element.replaceChildren(...this.#axes(), ...this.#marked(), ...series.flatMap((each) => this.#series(each)), ...this.#legend(series));
  }

  /** @param {number} x */
  #across = (x) => EDGE.left + ((x - this.box[0]) / (this.box[1] - this.box[0])) * (WIDTH - EDGE.left - EDGE.right);
  /** @param {number} y */
  #upward = (y) => HEIGHT - EDGE.bottom - ((y - this.box[2]) / (this.box[3] - this.box[2])) * (HEIGHT - EDGE.top - EDGE.bottom);

  #axes() {
    const [left, right, low, high] = this.box;
    const out = [];
    for (const x of ticks(left, right, 7)) {
      out.push(svg("line", { class: "plot-grid", x1: this.#across(x), x2: this.#across(x), y1: EDGE.top, y2: HEIGHT - EDGE.bottom }));
      out.push(svg("text", { x: this.#across(x), y: HEIGHT - EDGE.bottom + 17, "text-anchor": "middle" }, String(x)));
    }
    for (const y of ticks(low, high, 6)) {
      out.push(svg("line", { class: "plot-grid", x1: EDGE.left, x2: WIDTH - EDGE.right, y1: this.#upward(y), y2: this.#upward(y) }));
      out.push(svg("text", { x: EDGE.left - 6, y: this.#upward(y) + 4, "text-anchor": "end" }, String(y)));
    }
    out.push(svg("text", { x: (WIDTH + EDGE.left) / 2, y: HEIGHT - 8, "text-anchor": "middle" }, this.words.across));
    out.push(svg("text", { transform: `translate(15 ${HEIGHT / 2}) rotate(-90)`, "text-anchor": "middle" }, this.words.upward));
    return out;
  }

  #marked() {
    if (!this.range) return [];
    const [from, to] = this.range.map((x) => Math.min(Math.max(this.#across(x), EDGE.left), WIDTH - EDGE.right));
    return [svg("rect", { class: "plot-range", x: from, y: EDGE.top, width: Math.max(0, to - from), height: HEIGHT - EDGE.top - EDGE.bottom })];
  }

  /** @param {Series} each */
  #series(each) {
    const color = `series-${each.color % COLORS}`;
    if (each.kind === "points") {
      return each.x.map((x, k) => {
        const inside = !this.range || (x >= this.range[0] - 1e-9 && x <= this.range[1] + 1e-9);
        return svg("circle", { class: `plot-point ${color}${inside ? "" : " faint"}`, cx: this.#across(x), cy: this.#upward(each.y[k] ?? 0), r: 3.2 });
      });
    }
    const path = (/** @type {(x: number) => boolean} */ inside) => {
      let text = "";
      let down = false;
      each.x.forEach((x, k) => {
        const y = each.y[k];
        down = down && y !== null && inside(x);
        if (y === null || !inside(x)) return;
        text += `${down ? "L" : "M"}${this.#across(x).toFixed(1)} ${this.#upward(y).toFixed(1)}`;
        down = true;
      });
      return text;
    };
    const { range } = each;
    const whole = svg("path", { class: `plot-line ${color}${range ? " faint" : ""}`, d: path(() => true) });
    return range ? [whole, svg("path", { class: `plot-line ${color}`, d: path((x) => x >= range[0] && x <= range[1]) })] : [whole];
  }

  /** @param {Series[]} series */
  #legend(series) {
    return series.flatMap((each, k) => {
      const y = EDGE.top + 14 + 17 * k;
      const sign = each.kind === "points"
        ? svg("circle", { class: `plot-point series-${each.color % COLORS}`, cx: EDGE.left + 20, cy: y - 4, r: 3.2 })
        : svg("path", { class: `plot-line series-${each.color % COLORS}`, d: `M${EDGE.left + 10} ${y - 4}h20` });
      return [sign, svg("text", { x: EDGE.left + 36, y }, each.label)];
    });
  }

  /** @param {PointerEvent} event */
  #at(event) {
    const frame = this.element.getBoundingClientRect();
    const share = (((event.clientX - frame.left) / frame.width) * WIDTH - EDGE.left) / (WIDTH - EDGE.left - EDGE.right);
    return this.box[0] + Math.min(1, Math.max(0, share)) * (this.box[1] - this.box[0]);
  }

  /** @param {PointerEvent} event */
  #drag(event) {
    const from = this.#at(event);
    this.element.setPointerCapture(event.pointerId);
    const move = (/** @type {PointerEvent} */ now) => {
      const to = this.#at(now);
      if (Math.abs(to - from) > 0.01 * (this.box[1] - this.box[0])) this.choose?.(Math.min(from, to), Math.max(from, to));
    };
    this.element.addEventListener("pointermove", move);
    const end = () => this.element.removeEventListener("pointermove", move);
    this.element.addEventListener("pointerup", end, { once: true });
    this.element.addEventListener("pointercancel", end, { once: true });
  }
}
