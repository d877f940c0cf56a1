// Handle: the tip in the picture, to be dragged by the mouse or moved by the arrow keys, and the place that was wanted.

import { h } from "../dom.js";

const STEP = 0.01; // step of an arrow key, over the length of the actuator
const EDGE = 0.2; // a plane that is seen at a flatter angle than this is not dragged in

/** @typedef {[number, number, number]} Vector */

/** @param {ArrayLike<number>} a @param {ArrayLike<number>} b @param {number} [t] @returns {Vector} */
const plus = (a, b, t = 1) => [a[0] + t * b[0], a[1] + t * b[1], a[2] + t * b[2]];
/** @param {ArrayLike<number>} a @param {ArrayLike<number>} b */
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

export class Handle {
  /**
   * @param {any} viewer
   * @param {import("./model.js").Table} table
   * @param {(wanted: Vector, settle: boolean) => void} want called with the wanted displacement of the tip [m]
   */
  constructor(viewer, table, want) {
    this.stage = viewer.stage;
    this.rest = /** @type {Vector} */ (table.tip);
    this.plane = table.plane;
    this.length = table.length;
    this.want = want;
    /** @type {Vector} */
    this.tip = [0, 0, 0];
    /** @type {Vector | null} */
    this.wanted = null;
    this.line = h("div", { class: "live-line", hidden: true });
    this.mark = h("div", { class: "live-mark", hidden: true });
    this.grip = h("button", {
      type: "button", class: "live-grip", title: "Drag the tip; or the arrow keys",
      "aria-label": "tip: drag it with the mouse or move it with the arrow keys",
      onpointerdown: (/** @type {PointerEvent} */ event) => this.#down(event),
      onkeydown: (/** @type {KeyboardEvent} */ event) => this.#key(event),
      onkeyup: (/** @type {KeyboardEvent} */ event) => event.key.startsWith("Arrow") && this.wanted && this.want(this.wanted, true),
    });
    this.stage.box.append(this.line, this.mark, this.grip);
    this.stage.listeners.push(() => this.place());
  }

  /** Show where the tip is now. @param {Vector} tip displacement [m] */
  at(tip) {
    this.tip = tip;
    this.place();
  }

  /** Forget the wanted place. */
  rested() {
    this.wanted = null;
    this.place();
  }

  /** The camera's axes in space: to the right, upwards, towards the viewer. @returns {Vector[]} */
  #axes() {
    const e = this.stage.camera.matrixWorld.elements;
    return [[e[0], e[1], e[2]], [e[4], e[5], e[6]], [e[8], e[9], e[10]]];
  }

  /** Place on the picture [pixels]. @param {Vector} point */
  #seen(point) {
    const { camera, box, pixel } = this.stage;
    const [right, up] = this.#axes();
    const e = camera.matrixWorld.elements;
    const from = plus(point, [e[12], e[13], e[14]], -1);
    const middle = [(camera.left + camera.right) / 2, (camera.top + camera.bottom) / 2];
    return [
      box.clientWidth / 2 + (dot(from, right) - middle[0]) / pixel,
      box.clientHeight / 2 - (dot(from, up) - middle[1]) / pixel,
    ];
  }

  place() {
    const [x, y] = this.#seen(plus(this.rest, this.tip));
    this.grip.style.transform = `translate(${x}px, ${y}px) translate(-50%, -50%)`;
    this.line.hidden = this.mark.hidden = !this.wanted;
    if (!this.wanted) return;
    const [a, b] = this.#seen(plus(this.rest, this.wanted));
    this.mark.style.transform = `translate(${a}px, ${b}px) translate(-50%, -50%)`;
    this.line.style.width = `${Math.hypot(a - x, b - y)}px`;
    this.line.style.transform = `translate(${x}px, ${y}px) rotate(${Math.atan2(b - y, a - x)}rad)`;
  }

  /** Move a point across the picture; it stays in the plane of the tip where there is one. @param {Vector} from @param {number} dx @param {number} dy @returns {Vector} */
  #moved(from, dx, dy) {
    const [right, up, near] = this.#axes();
    const to = plus(plus(from, right, dx), up, dy);
    const slope = this.plane ? dot(this.plane, near) : 0;
    if (!this.plane || Math.abs(slope) < EDGE) return to;
    return plus(to, near, -dot(to, this.plane) / slope);
  }

  /** @param {PointerEvent} event */
  #down(event) {
    event.preventDefault();
    event.stopPropagation(); // the picture does not turn
    this.grip.focus();
    this.grip.setPointerCapture(event.pointerId);
    const start = this.tip;
    const { pixel } = this.stage;
    const move = (/** @type {PointerEvent} */ now) => {
      now.stopPropagation();
      this.wanted = this.#moved(start, (now.clientX - event.clientX) * pixel, -(now.clientY - event.clientY) * pixel);
      this.want(this.wanted, false);
      this.place();
    };
    const end = () => {
      this.grip.removeEventListener("pointermove", move);
      if (this.wanted) this.want(this.wanted, true);
    };
    this.grip.addEventListener("pointermove", move);
    this.grip.addEventListener("pointerup", end, { once: true });
    this.grip.addEventListener("pointercancel", end, { once: true });
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    const ways = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const way = ways[/** @type {keyof typeof ways} */ (event.key)];
    if (event.key === "Escape") this.rested();
    if (!way) return;
    event.preventDefault();
    const step = STEP * this.length;
    this.wanted = this.#moved(this.wanted ?? this.tip, way[0] * step, way[1] * step);
    this.want(this.wanted, false);
    this.place();
  }
}
