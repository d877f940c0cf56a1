// Picture: the viewer of the report in a part of the page.

/** @type {Promise<string> | null} */
let markup = null;

/**
 * Show a scene: what `turgor.views.viewer.scene` packs, or sources that the page computes (see 9_viewer.js).
 * @param {Element} place
 * @param {any} scene
 * @returns {Promise<any>} the viewer: `show(step)`, `refresh()`, `close()`, `stage`
 */
export async function picture(place, scene) {
  markup ??= fetch("/viewer.html").then((answer) => answer.text());
  return /** @type {any} */ (globalThis).turgorViewer.mount(place, await markup, scene);
}
