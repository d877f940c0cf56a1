// Model: a reduced model in the page. It gets the modes once; a state is then a few coordinates.

/**
 * @typedef {{key: string, unit: string, factor: number, low: number, high: number, rest: number, free: boolean}} Input
 * @typedef {{name: string, title: string, inputs: Input[], scene: any, shapes: number[][], tip: number[] | null,
 *   plane: number[] | null, length: number, trained: string, measured: string[]}} Table
 */

/** The sum of fields of a block of numbers, each with its weight; the first has the weight 1.
 * @param {Float32Array} block @param {number} size numbers of a field @param {ArrayLike<number>} weights @param {Float32Array} out */
function summed(block, size, weights, out) {
  out.set(block.subarray(0, size));
  for (let k = 0; k < weights.length; k++) {
    const weight = weights[k];
    if (!weight) continue;
    const from = (k + 1) * size;
    for (let i = 0; i < size; i++) out[i] += weight * block[from + i];
  }
  return out;
}

export class LiveModel {
  /** @param {Table} table @param {ArrayBuffer} bytes */
  constructor(table, bytes) {
    this.table = table;
    const numbers = new Float32Array(bytes);
    const counts = table.shapes.map((shape) => shape.reduce((product, n) => product * n, 1));
    let from = 0;
    const [surface, obstacles, frames] = counts.map((count) => numbers.subarray(from, (from += count)));
    this.surface = surface;
    this.obstacles = obstacles;
    this.points = table.shapes[0][1];
    const modes = table.shapes[0][0] - 1;
    this.frames = Array.from({ length: table.shapes[2][0] }, (_, k) => frames.subarray(k * modes, (k + 1) * modes));
    this.q = new Float32Array(modes);
    this.values = Object.fromEntries(table.inputs.map((each) => [each.key, each.rest]));
    this.room = new Float32Array(3 * this.points);
  }

  /** Take a state. @param {number[]} q @param {Record<string, number>} values in the units that are shown */
  set(q, values) {
    this.q = Float32Array.from(q);
    this.values = values;
  }

  /** The scene of the viewer. Its positions are computed here; steps after the first are those that the picture has room for. */
  scene() {
    const { scene, shapes, inputs } = this.table;
    const positions = {
      steps: 1 + this.frames.length,
      points: this.points,
      // the first is kept by the viewer as the shape at rest, so each call gets numbers of its own
      at: (/** @type {number} */ step) =>
        summed(this.surface, 3 * this.points, step ? this.frames[step - 1] : this.q, new Float32Array(3 * this.points)),
    };
    const size = 3 * shapes[1][1];
    const places = {
      steps: 1,
      points: shapes[1][1],
      at: () => summed(this.obstacles, size, inputs.map((each) => this.values[each.key] * each.factor), new Float32Array(size)),
    };
    const obstacles = scene.obstacles && { ...scene.obstacles, positions: places };
    return { ...scene, obstacles, surface: { ...scene.surface, positions } };
  }
}

/**
 * A connection to a reduced model. It sends the newest request as soon as the one before is answered, so that a slow
 * machine skips states in place of falling behind.
 */
export class Connection extends EventTarget {
  /** @param {string} name */
  constructor(name) {
    super();
    this.number = 0;
    /** @type {any} */
    this.waiting = null;
    this.busy = false;
    this.socket = new WebSocket(`ws://${location.host}/ws/live/${encodeURIComponent(name)}`);
    this.socket.binaryType = "arraybuffer";
    /** @type {Promise<LiveModel>} */
    this.model = new Promise((resolve, reject) => {
      /** @type {Table | null} */
      let table = null;
      this.socket.onmessage = ({ data }) => {
        if (typeof data !== "string") resolve(new LiveModel(/** @type {Table} */ (table), data));
        else if (!table) {
          const value = JSON.parse(data);
          if (value.error) reject(new Error(value.error));
          else table = value;
        } else this.#answered(JSON.parse(data));
      };
      this.socket.onclose = () => {
        reject(new Error("The connection to this model has ended."));
        this.dispatchEvent(new Event("end"));
      };
    });
  }

  /** @param {any} request @returns {number} its number, which the answer repeats */
  send(request) {
    this.waiting = { ...request, number: ++this.number };
    this.#next();
    return this.number;
  }

  #next() {
    if (this.busy || !this.waiting || this.socket.readyState !== WebSocket.OPEN) return;
    this.busy = true;
    this.socket.send(JSON.stringify(this.waiting));
    this.waiting = null;
  }

  /** @param {any} answer */
  #answered(answer) {
    if (!answer.readings) this.busy = false;
    this.dispatchEvent(new CustomEvent("answer", { detail: answer }));
    this.#next();
  }

  close() {
    this.socket.onclose = null;
    this.socket.close();
  }
}
