// Job: the job file that is open. Its text on disk is the state; every edit is written at once and can be undone.

import { get, part, patch, post, Refused } from "./api.js";
import { say } from "./dom.js";

export class Job extends EventTarget {
  constructor() {
    super();
    this.name = "";
    /** @type {{name: string, text: string, version: string, undo: number, redo: number} | null} */
    this.state = null;
    /** @type {Promise<void>} */
    this.waiting = Promise.resolve(); // for the changes before
  }

  /** Open a job file; the one that is open is not read again. @param {string} name */
  async open(name) {
    if (name === this.name && this.state) return;
    this.name = name;
    this.state = null;
    await this.read();
  }

  /** Read the file again, because this page or another program has changed it. */
  async read() {
    if (!this.name) return;
    this.#take(await get(`/api/jobs/${part(this.name)}`));
  }

  /** Set values by their dotted keys, such as {"actuator.wall": "2 mm"}; null removes one. @param {Record<string, any>} values */
  set(values) {
    return this.#change(() => patch(this.#path, { values, version: this.state?.version }));
  }

  /** Replace the whole text. @param {string} text */
  write(text) {
    return this.#change(() => patch(this.#path, { text, version: this.state?.version }));
  }

  /** @param {"undo" | "redo"} way */
  step(way) {
    return this.#change(() => post(`${this.#path}/${way}`, { version: this.state?.version }));
  }

  get #path() {
    return `/api/jobs/${part(this.name)}`;
  }

  /** @param {() => Promise<any>} request */
  async #change(request) {
    // one after another, each with the version that the one before it has made
    this.waiting = this.waiting.then(async () => {
      try {
        this.#take(await request());
      } catch (error) {
        say(/** @type {Error} */ (error).message, true);
        // a change that fails must not stop those after it
        if (error instanceof Refused && error.status === 409) await this.read().catch((lost) => say(lost.message, true));
      }
    });
    return this.waiting;
  }

  /** @param {any} state */
  #take(state) {
    const same = this.state && state.version === this.state.version && state.undo === this.state.undo;
    this.state = state;
    if (!same) this.dispatchEvent(new Event("change"));
  }
}
