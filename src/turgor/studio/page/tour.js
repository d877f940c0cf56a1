// Tour: five short steps that point at the parts of the page, once for each browser.

import { h } from "./dom.js";

const SEEN = "turgor-studio-tour";

/** What each step points at, and says. */
const STEPS = [
  { at: ".families", title: "Choose a finger", text: "Each picture is a family of actuators. A click on the Fast PneuNet writes a job file: a soft finger that bends under air pressure." },
  { at: "#steps", title: "Go from left to right", text: "Shape has the dimensions, Materials the rubber, Loads the pressure and what is clamped. Every step can be left as it is." },
  { at: "#steps", title: "Press Solve", text: "A coarse answer comes within seconds and says that it is coarse; the fine one follows. Look shows how the finger bends." },
  { at: "#tools", title: "Nothing is lost", text: "Every change is written to the job file at once. These arrows undo and repeat; “Show the code” shows the file, and the script that does the same." },
  { at: ".zone", title: "Bring your own part", text: "A STEP, STL or mesh file can be dropped here later. Now choose the Fast PneuNet, and bend your first finger." },
];

/**
 * Begin the tour, unless it was seen.
 * @param {Element} place @param {boolean} [again] @returns {() => void} ends it
 */
export function tour(place, again = false) {
  if (!again && stored()) return () => {};
  document.querySelector(".tour")?.remove();
  let step = 0;
  const title = h("h2", {});
  const text = h("p", {});
  const count = h("span", { class: "quiet" });
  const next = h("button", { type: "button", class: "primary", onclick: () => (step < STEPS.length - 1 ? go(step + 1) : end()) });
  const back = h("button", { type: "button", onclick: () => go(step - 1) }, "Back");
  const close = h("button", { type: "button", class: "quiet", "aria-label": "close the tour", onclick: () => end() }, "×");
  const note = h("section", { class: "tour card", role: "dialog", "aria-label": "tour", tabIndex: -1 }, h("div", { class: "row between" }, title, close), text, h("div", { class: "row between" }, count, h("span", { class: "row" }, back, next)));
  /** @type {Element | null} */
  let pointed = null;

  const point = () => pointed?.classList.remove("pointed");
  function end() {
    point();
    note.remove();
    document.removeEventListener("keydown", escape);
    try {
      localStorage.setItem(SEEN, "seen");
    } catch {
      // a browser that stores nothing shows the tour again
    }
  }
  /** @param {KeyboardEvent} event */
  function escape(event) {
    if (event.key === "Escape") end();
  }
  /** @param {number} to */
  function go(to) {
    step = to;
    point();
    pointed = document.querySelector(STEPS[to].at);
    pointed?.classList.add("pointed");
    const box = pointed?.getBoundingClientRect();
    // what is larger than the window stays where it is: else its title would be out of sight
    if (box && box.height < window.innerHeight && (box.top < 0 || box.bottom > window.innerHeight)) pointed?.scrollIntoView({ block: "nearest" });
    title.textContent = STEPS[to].title;
    text.textContent = STEPS[to].text;
    count.textContent = `${to + 1} of ${STEPS.length}`;
    back.hidden = to === 0;
    next.textContent = to < STEPS.length - 1 ? "Next" : "Begin";
  }
  document.addEventListener("keydown", escape);
  place.append(note);
  go(0);
  if (again) note.focus();
  return () => {
    point();
    note.remove();
    document.removeEventListener("keydown", escape);
  };
}

function stored() {
  try {
    return localStorage.getItem(SEEN) !== null;
  } catch {
    return false;
  }
}
