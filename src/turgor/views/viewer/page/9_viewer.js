// Viewer: reads the scene, builds the picture, and connects it with the controls. Each part of a scene is packed, or a
// source that a page computes, such as a reduced model: indices as an array, and steps as an object with `steps`,
// `points` and `at(step)`.

const PLAY = 160; // milliseconds between two steps
const REST = 250; // milliseconds after which a slider counts as at rest
const BETWEEN = 0.05; // smallest part of a step on the slider
const CLOUD = 6000; // points that the picture is fitted to

// A text with the numbers between those of others, each with its weight; the heaviest where their words differ.
function blended(texts) {
  const number = /-?\d+(\.\d+)?(e[-+]?\d+)?/g;
  const form = ([text]) => text.replace(number, "#");
  const [first] = texts.toSorted((a, b) => b[1] - a[1]);
  if (texts.some((each) => form(each) !== form(first))) return first[0];
  const numbers = texts.map(([text, weight]) => [text.match(number) ?? [], weight]);
  let k = -1;
  return first[0].replace(number, () => {
    k += 1;
    const digits = Math.max(...numbers.map(([found]) => (found[k].split(".")[1] ?? "").length));
    return String(numbers.reduce((sum, [found, weight]) => sum + weight * Number(found[k]), 0).toFixed(digits));
  });
}

// Length of the way from one place of each vertex to another [mm].
function moved(points, rest) {
  const out = new Float32Array(points.length / 3);
  for (let v = 0; v < out.length; v++) {
    const way = [0, 1, 2].map((i) => points[3 * v + i] - rest[3 * v + i]);
    out[v] = 1000 * Math.hypot(...way);
  }
  return out;
}

const indexOf = (given) => (given.buffer ? given : unpackedIndex(given));
const stepsOf = (given, places) => (given.at ? given : unpackedSteps(given, places));

class Viewer {
  constructor(root, values) {
    this.root = root;
    this.values = values;
    this.find = (name) => root.querySelector(`[data-v="${name}"]`);
    this.step = -1;
    this.linked = [];
  }

  async start() {
    const picture = this.find("picture");
    this.root.hidden = false;
    this.stage = new Stage(picture);
    const places = await this.#fill();
    this.#frame(...places);
    new Overlay(this.stage, picture);
    new Probe(this, picture);
    this.#controls();
    this.#first();
  }

  // Show another scene of the same kind, such as after a change of a dimension, from the same side; aim at it again
  // where its size has changed.
  async replace(values) {
    const { radius } = this.stage;
    this.values = values;
    this.stage.clear();
    const places = await this.#fill();
    const turn = this.stage.direction;
    this.#frame(...places);
    if (Math.abs(this.stage.radius - radius) < 1e-9 * radius) this.stage.restore(turn);
    else this.stage.look(turn.azimuth, turn.elevation);
    for (const control of this.root.querySelectorAll(".v-side input[type=checkbox]")) control.dispatchEvent(new Event("change"));
    this.step = -1;
    this.#first();
    this.cut();
  }

  async #fill() {
    const { surface, inside, fields, threads, obstacles, path, parts, images, places: drive } = this.values;
    const [triangles, cut, centers, positions] = await Promise.all([
      indexOf(surface.triangles), indexOf(surface.cut), indexOf(surface.centers),
      stepsOf(surface.positions, drive),
    ]);
    this.positions = positions;
    this.data = await Promise.all(fields.map((field) => field.data && stepsOf(field.data)));
    this.stage.images(images);
    this.skin = new Skin(triangles, {
      shape: surface.triangles.shape, cut, centers, mirrors: surface.mirrors, sides: surface.sides, images: images.length,
      slow: this.stage.slow,
    });
    this.body = new Body(this.stage, this.skin, this.values);
    if (threads) this.body.addThreads(await indexOf(threads.lengths), await stepsOf(threads.positions, drive));
    const places = obstacles && (await stepsOf(obstacles.positions, drive));
    if (obstacles) this.body.addObstacles(await indexOf(obstacles.triangles), places);
    const line = path && (await stepsOf(path.positions, drive));
    if (path) this.body.addPath(await indexOf(path.triangles), line);
    this.section = new Section(this.stage, this.skin, inside ? await this.#open(inside, fields) : []);
    this.rest = positions.at(0);
    if (!fields.length) this.body.surface.color.set(RUBBER);
    this.parts = parts && new Parts(this.stage, this.body, await namedParts(parts), this.rest, triangles);
    return [places, line];
  }

  #first() {
    for (const name of ["obstacles", "threads", "path"]) this.find(name).parentElement.hidden = !this.body[name];
    this.show(0);
    if (this.values.steps.length > 1) this.body.keepRest();
    if (this.values.fields.length) this.field(0);
    this.show(this.values.steps.length - 1);
    this.stage.now();
  }

  async #open(inside, fields) {
    this.depth = await stepsOf(inside.positions, this.values.places);
    this.within = await Promise.all(fields.map((field) => field.inside && stepsOf(field.inside)));
    return indexOf(inside.tetrahedra);
  }

  // The face of the cut at this step, colored by the field.
  #face() {
    if (!this.shown) return;
    const points = this.body.open && this.depth?.at(this.step);
    this.section.material.map = this.body.surface.map;
    this.section.material.needsUpdate = true;
    this.section.set(this.body.open && this.body.plane, points, points && this.#shares(points));
  }

  #shares(points) {
    const { low, high } = this.shown;
    const within = this.within[this.number];
    const rest = within ? null : this.depth.at(0);
    const values = within ? within.at(this.step) : moved(points, rest);
    return values.map((value) => (value - low) / (high - low));
  }

  // Aim at some points of all steps and images, and at obstacles as far as they are near.
  #frame(obstacles, line) {
    const cloud = [];
    const place = new THREE.Vector3();
    const { steps, points } = this.positions;
    const stride = Math.max(1, Math.ceil((steps * points * this.stage.matrices.length) / CLOUD));
    for (let step = 0; step < steps; step++) {
      const at = this.positions.at(step);
      for (let v = step % stride; v < points; v += stride) {
        for (const matrix of this.stage.matrices) cloud.push(...place.fromArray(at, 3 * v).applyMatrix4(matrix).toArray());
      }
    }
    this.box = new THREE.Box3().setFromArray(cloud);
    if (obstacles) {
      const near = this.box.clone().expandByScalar(0.25 * this.box.min.distanceTo(this.box.max) / 2);
      const at = obstacles.at(obstacles.steps - 1);
      for (let v = 0; v < at.length; v += 3) cloud.push(...near.clampPoint(place.fromArray(at, v), place).toArray());
    }
    if (line) cloud.push(...line.at(0));
    this.stage.frame(cloud);
  }

  // What the pointer is at: the name of a face, or the value of the field.
  describe(hit) {
    if (this.parts && !this.shown) return this.parts.nameAt(hit).replaceAll("_", " ");
    const share = hit.uv.x;
    const field = this.shown;
    const value = field.low + share * (field.high - field.low);
    return `${field.label} ${written(value, 3)} ${field.unit}`.trim();
  }

  // Show a step of the path, or a place between two.
  show(step) {
    if (step === this.step) return;
    this.step = step;
    this.points = this.positions.at(step);
    this.skin.move(this.points);
    this.body.moveThreads?.(step);
    this.body.moveObstacles?.(step);
    this.body.movePath?.(step);
    if (this.shown) this.#color();
    const { steps, places } = this.values;
    this.find("slider").value = step;
    this.find("label").textContent = blended(around(step, places).map(([k, weight]) => [steps[k].label, weight]));
    const row = around(step).reduce((sum, [k, weight]) => sum + weight * steps[k].state, 0);
    this.linked.forEach((each) => each.mark(row));
    this.stage.draw();
  }

  // Show a step while the slider moves: frames that come too slowly are drawn roughly.
  #scrub(step) {
    if (!this.stage.turning) this.stage.turn(true);
    clearTimeout(this.settling);
    this.settling = setTimeout(() => this.#settle(), REST);
    this.show(step);
  }

  #settle() {
    clearTimeout(this.settling);
    this.stage.turn(false);
  }

  // Draw the step again, because a source has changed.
  refresh() {
    const { step } = this;
    this.step = -1;
    this.show(step);
  }

  // Free what the graphics card has; the picture is gone then.
  close() {
    this.play(false);
    this.stage?.renderer.dispose();
    this.root.remove();
  }

  // Show the step nearest to a state of the solution.
  choose(state) {
    const away = this.values.steps.map((each) => Math.abs(each.state - state));
    this.show(away.indexOf(Math.min(...away)));
  }

  field(number) {
    this.number = number;
    this.shown = this.values.fields[number];
    drawBar(this.find("bar"), this.shown);
    this.find("note").textContent = this.shown.note;
    this.body.paint(this.shown.colors);
    this.#color();
    this.stage.draw();
  }

  #color() {
    const data = this.data[this.number];
    this.skin.color(data ? data.at(this.step) : moved(this.points, this.rest), this.shown.low, this.shown.high);
    this.#face();
  }

  #controls() {
    const slider = this.find("slider");
    slider.max = this.values.steps.length - 1;
    slider.step = this.values.places ? BETWEEN : 1;
    slider.addEventListener("input", () => this.#scrub(Number(slider.value)));
    slider.addEventListener("change", () => this.#settle());
    this.find("play").addEventListener("click", () => this.play(!this.timer));
    const menu = this.find("field");
    menu.parentElement.hidden = !this.values.fields.length;
    slider.parentElement.hidden = this.values.steps.length < 2;
    this.find("ghost").parentElement.hidden = this.values.steps.length < 2;
    this.find("cells").parentElement.hidden = !this.values.fields.length; // flat triangles of a picture are no cells
    this.values.fields.forEach((field, k) => menu.append(new Option(field.unit ? `${field.label} [${field.unit}]` : field.label, k)));
    menu.addEventListener("change", () => this.field(Number(menu.value)));
    const toggles = {
      cells: (on) => this.body.show("cells", on),
      ghost: (on) => this.body.show("ghost", on),
      clear: (on) => this.body.transparent(on),
      light: (on) => this.stage.light(on),
      obstacles: (on) => this.#visible(this.body.obstacles, on),
      threads: (on) => this.#visible(this.body.threads, on),
      path: (on) => this.#visible(this.body.path, on),
    };
    for (const [name, change] of Object.entries(toggles)) {
      this.find(name).addEventListener("change", (event) => change(event.target.checked));
    }
    for (const name of ["axis", "turned", "place"]) this.find(name).addEventListener("input", () => this.cut());
    const views = { start: [AZIMUTH, ELEVATION], front: [0, 0], side: [Math.PI / 2, 0], top: [0, Math.PI / 2 - 1e-4] };
    for (const [name, way] of Object.entries(views)) this.find(name).addEventListener("click", () => this.stage.look(...way));
    if (this.values.curves) this.#chart();
    else this.find("curves").hidden = true;
  }

  #visible(objects, on) {
    objects?.forEach((each) => (each.visible = on));
    this.stage.draw();
  }

  #chart() {
    const { y } = this.values.curves;
    const chart = new Chart(this.find("chart"), this.values.curves, (state) => this.choose(state));
    const menu = this.find("column");
    y.forEach((column, k) => menu.append(new Option(words(column.label), k)));
    menu.addEventListener("change", () => chart.draw(y[Number(menu.value)]));
    chart.draw(y[0]);
    this.linked.push(chart);
    const known = this.values.steps.map((each) => each.state);
    for (const figure of document.querySelectorAll("figure[data-lines]")) {
      this.linked.push(new LinkedPlot(figure, (state) => this.choose(state), known));
    }
  }

  cut() {
    const axis = Number(this.find("axis").value);
    for (const name of ["place", "turned"]) this.find(name).disabled = axis < 0;
    const share = Number(this.find("place").value) / 1000;
    const [low, high] = [this.box.min, this.box.max].map((corner) => corner.toArray()[Math.max(axis, 0)]);
    this.body.cut(axis, low + share * (high - low), this.find("turned").checked);
    this.parts?.cut();
    this.#face();
    this.find("where").textContent = axis < 0 ? "" : `${"xyz"[axis]} = ${written(1000 * (low + share * (high - low)), 3)} mm`;
  }

  play(on) {
    clearInterval(this.timer);
    this.timer = null;
    this.find("play").textContent = on ? "❚❚" : "▶";
    this.find("play").setAttribute("aria-label", on ? "stop" : "play");
    if (!on) return;
    const count = this.values.steps.length;
    if (this.step === count - 1) this.show(0);
    const part = this.values.places && !this.stage.slow ? 4 : 1;
    const next = () => Math.min((Math.floor(this.step * part + 1e-9) + 1) / part, count - 1);
    this.timer = setInterval(() => (this.step < count - 1 ? this.show(next()) : this.play(false)), PLAY / part);
  }
}

async function startViewers() {
  for (const root of document.querySelectorAll(".viewer")) {
    const values = JSON.parse(root.querySelector("script[type='application/json']").textContent);
    try {
      const viewer = new Viewer(root, values);
      await viewer.start();
      root.viewer = viewer;
      document.documentElement.classList.add("live"); // the still pictures step back
    } catch (error) {
      root.hidden = true; // no WebGL: the still pictures stay
      root.dataset.failed = String(error);
    }
  }
}

// Put a viewer into an element of another page, from the markup of viewer.html without its data.
async function mountViewer(place, markup, values) {
  place.innerHTML = markup;
  const viewer = new Viewer(place.querySelector(".viewer"), values);
  await viewer.start();
  viewer.root.viewer = viewer;
  return viewer;
}

globalThis.turgorViewer = { mount: mountViewer };
startViewers();
