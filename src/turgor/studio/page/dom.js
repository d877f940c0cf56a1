// Dom: elements of the page from their parts.

/**
 * Make an element. Properties that begin with "on" are listeners; "class", "for", "data-…" and "aria-…" are attributes.
 * @param {string} tag
 * @param {Record<string, any>} [properties]
 * @param {...(Node | string | null | undefined | false)} children
 * @returns {any}
 */
export function h(tag, properties = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
    else if (name in made && name !== "list" && name !== "form") /** @type {any} */ (made)[name] = value;
    else made.setAttribute(name, value === true ? "" : String(value));
  }
  made.append(...children.filter((each) => each !== null && each !== undefined && each !== false));
  return made;
}

/** Replace the content of an element. @param {Element} parent @param {...(Node | string)} children */
export function fill(parent, ...children) {
  parent.replaceChildren(...children);
}

/** Show a sentence at the bottom for some seconds; errors stay until they are closed. @param {string} text @param {boolean} [wrong] */
export function say(text, wrong = false) {
  const place = /** @type {HTMLElement} */ (document.getElementById("messages"));
  const close = h("button", { type: "button", class: "quiet", "aria-label": "close", onclick: () => note.remove() }, "×");
  const note = h("div", { class: wrong ? "message wrong" : "message" }, h("span", {}, text), close);
  place.append(note);
  if (!wrong) setTimeout(() => note.remove(), 6000);
  return note;
}

/** Call a function some time after the last of several calls. @param {(...values: any[]) => void} call @param {number} wait */
export function later(call, wait) {
  let timer = 0;
  return (/** @type {any[]} */ ...values) => {
    clearTimeout(timer);
    timer = window.setTimeout(() => call(...values), wait);
  };
}
