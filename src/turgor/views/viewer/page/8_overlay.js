// Overlay: the axes and the scale bar in the corners of the picture, and the value under the pointer.

class Overlay {
  constructor(stage, box) {
    this.stage = stage;
    this.drawn = svg("svg", { class: "v-axes", viewBox: "0 0 90 90" }, box);
    this.way = new THREE.Vector3();
    this.ends = ["x", "y", "z"].map((name) => ({
      line: svg("path", { class: "v-axis" }, this.drawn),
      text: svg("text", { class: "v-number", "text-anchor": "middle" }, this.drawn, name),
    }));
    this.scale = document.createElement("div");
    this.scale.className = "v-scale";
    box.append(this.scale);
    stage.listeners.push(() => this.draw());
  }

  draw() {
    const turn = this.stage.camera.matrixWorldInverse;
    this.ends.forEach(({ line, text }, k) => {
      const way = this.way.set(0, 0, 0).setComponent(k, 1).transformDirection(turn);
      const [x, y] = [45 + 28 * way.x, 45 - 28 * way.y];
      line.setAttribute("d", `M45 45L${x} ${y}`);
      text.setAttribute("x", 45 + 38 * way.x);
      text.setAttribute("y", 49 - 38 * way.y);
      text.style.opacity = Math.hypot(way.x, way.y) < 0.15 ? 0 : 1;
    });
    if (this.stage.pixel === this.pixel) return; // turning does not change the scale
    this.pixel = this.stage.pixel;
    const long = ticks(0, 120 * this.stage.pixel, 2).filter((l) => l > 0)[0] || 120 * this.stage.pixel;
    this.scale.style.width = `${long / this.stage.pixel}px`;
    this.scale.textContent = `${written(1000 * long)} mm`;
  }
}

// Shows what is under the pointer while no button is pressed.
class Probe {
  constructor(viewer, box) {
    this.caster = new THREE.Raycaster();
    this.tip = document.createElement("div");
    this.tip.className = "v-tip";
    this.tip.hidden = true;
    box.append(this.tip);
    let waiting = null;
    box.addEventListener("pointermove", (event) => {
      clearTimeout(waiting);
      this.tip.hidden = true;
      if (event.buttons === 0) waiting = setTimeout(() => this.#show(viewer, box, event), 120);
    });
    box.addEventListener("pointerleave", () => {
      clearTimeout(waiting);
      this.tip.hidden = true;
    });
  }

  #show(viewer, box, event) {
    const frame = box.getBoundingClientRect();
    const [x, y] = [event.clientX - frame.left, event.clientY - frame.top];
    const [hit] = hitsAt(this.caster, viewer.stage, viewer.body, event);
    if (!hit) return;
    const place = hit.point.toArray().map((value) => written(1000 * value));
    this.tip.textContent = `${viewer.describe(hit)} at (${place.join(", ")}) mm`;
    this.tip.style.left = `${Math.min(x + 12, frame.width - 220)}px`;
    this.tip.style.top = `${y + 14}px`;
    this.tip.hidden = false;
  }
}

// What a ray through the pointer meets of the surface, the nearest first, without what is cut away.
function hitsAt(caster, stage, body, event) {
  const frame = stage.box.getBoundingClientRect();
  const [x, y] = [event.clientX - frame.left, event.clientY - frame.top];
  caster.setFromCamera(new THREE.Vector2((2 * x) / frame.width - 1, 1 - (2 * y) / frame.height), stage.camera);
  const cut = body.surface.clippingPlanes?.[0];
  return caster.intersectObjects(body.meshes).filter((hit) => !cut || cut.distanceToPoint(hit.point) >= 0);
}
