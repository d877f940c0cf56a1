// Runs: what a run shows of itself, and what can be done with it.

import { get, part, post } from "../api.js";
import { h, say } from "../dom.js";
import { duration } from "./numbers.js";

/** Words for the states of a run. @type {Record<string, string>} */
const WORDS = { running: "is being solved", ended: "has ended", early: "ended early", paused: "is paused", failed: "failed", elsewhere: "is being solved elsewhere" };

/** @param {string} name */
export const statusOf = (name) => get(`/api/runs/status?run=${part(name)}`);

/** @param {string} name @param {string} [kind] "live" for a few states of a run that is being solved */
export const sceneOf = (name, kind = "whole") => get(`/api/runs/scene?run=${part(name)}&part=${kind}`);

/** @param {string} name @param {string} file @param {boolean} [show] */
export const fileOf = (name, file, show = false) => `/api/runs/file?run=${part(name)}&file=${part(file)}${show ? "&show=1" : ""}`;

/** The mark of coarse numbers. @param {boolean} coarse */
export const badge = (coarse) => coarse && h("span", { class: "badge coarse", title: "Numbers of a coarse mesh: right in their trend, not in their digits." }, "coarse");

/** Do something that the server may refuse. @param {() => Promise<any>} request */
export async function attempt(request) {
  try {
    return await request();
  } catch (error) {
    say(/** @type {Error} */ (error).message, true);
    return null;
  }
}

/**
 * A run as a line: its state, how far it is, and its buttons.
 * @param {any} run @param {() => void} changed
 */
export function runLine(run, changed) {
  const act = (/** @type {string} */ path, /** @type {any} */ body) => async () => {
    if (await attempt(() => post(path, body))) changed();
  };
  const button = (/** @type {string} */ title, /** @type {string} */ about, /** @type {() => void} */ click) => h("button", { type: "button", title: about, onclick: click }, title);
  const resume = { job: run.job || run.lock || "", run: run.name, way: "resume" };
  const tools = [];
  if (run.state === "running") {
    tools.push(button("Pause", "It writes what it has, and can go on later", act("/api/runs/pause", { run: run.name })));
    tools.push(button("Stop", "It ends within a second; its states are on disk", act("/api/runs/stop", { run: run.name })));
  }
  if (run.state === "paused" && resume.job) tools.push(button("Go on", "From its last state", act("/api/runs", resume)));
  if (run.states) tools.push(h("a", { class: "button", href: `#/look/${part(run.name)}` }, "Look"));
  const left = /([\d:]+) left/.exec(run.message)?.[1];
  const said = run.state === "running" ? `${Math.round(100 * run.progress)} % of the load${left ? `, ${left} left` : ""}` : "";
  return h("li", { class: `run ${run.state}`, "data-run": run.name },
    h("div", { class: "head" }, h("b", {}, run.name), badge(run.coarse), h("span", { class: "quiet" }, WORDS[run.state] ?? run.state), h("span", { class: "tools" }, ...tools)),
    run.state === "running" && h("progress", { max: 1, value: run.progress, "aria-label": `progress of ${run.name}` }),
    h("div", { class: run.state === "failed" ? "wrong small" : "quiet small" }, said ? `${said}. ` : "", run.message.startsWith("step") ? "" : run.message),
    run.waiting?.length ? h("div", { class: "quiet small" }, `Then: ${run.waiting.join(", ")}.`) : null);
}

/** Expected costs as a sentence. @param {any} expected */
export function costs(expected) {
  if (!expected) return "";
  const met = expected.meeting ? ` (${duration(expected.meeting)} if walls meet)` : "";
  const time = expected.seconds === null ? "An open time: the first run of a motion shows it" : `About ${duration(expected.seconds)}${met}`;
  return `${time}, and ${(expected.memory / 1e9).toFixed(1)} GB of memory.`;
}
