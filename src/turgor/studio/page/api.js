// Api: requests to the server. An answer that is no success becomes an error with the sentence of the server.

export class Refused extends Error {
  /** @param {string} sentence @param {number} status */
  constructor(sentence, status) {
    super(sentence);
    this.status = status;
  }
}

/** @param {string} method @param {string} path @param {any} [value] @returns {Promise<any>} */
async function request(method, path, value) {
  const raw = value instanceof Blob;
  const body = value === undefined ? undefined : raw ? value : JSON.stringify(value);
  let answer;
  try {
    answer = await fetch(path, { method, body, headers: raw || !body ? {} : { "Content-Type": "application/json" } });
  } catch {
    throw new Refused("The studio does not answer. Start it again with `turgor studio`; nothing is lost.", 0);
  }
  const kind = answer.headers.get("Content-Type") ?? "";
  const content = kind.includes("json") ? await answer.json() : await answer.text();
  if (!answer.ok) throw new Refused(content.error ?? String(content).slice(0, 400), answer.status);
  return content;
}

/** @param {string} path */
export const get = (path) => request("GET", path);
/** @param {string} path @param {any} [value] */
export const post = (path, value) => request("POST", path, value ?? {});
/** @param {string} path @param {any} value */
export const patch = (path, value) => request("PATCH", path, value);

/** A name as a part of a path. @param {string} name */
export const part = (name) => encodeURIComponent(name);

/**
 * Hear of changes in the folder; the connection is opened again after the server has ended or the machine has slept.
 * @param {(names: string[]) => void} changed
 * @param {(there: boolean) => void} connected
 */
export function listen(changed, connected) {
  const socket = new WebSocket(`ws://${location.host}/ws/events`);
  socket.onmessage = (event) => {
    connected(true);
    changed(JSON.parse(event.data).changed);
  };
  socket.onclose = () => {
    connected(false);
    setTimeout(() => listen(changed, connected), 1000);
  };
}
