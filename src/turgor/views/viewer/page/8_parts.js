// Parts: named faces of the surface, which can be colored, light up under the pointer, and be picked by a click.

const LIT = 0xffb000;
const STILL = 4; // pixels that the pointer may move in a click

// Names, the name of each triangle, and the triangles between bodies with theirs.
async function namedParts({ names, of, face, inner, innerOf }) {
  const [a, b, c, d] = await Promise.all([indexOf(of), indexOf(face), indexOf(inner), indexOf(innerOf)]);
  return { names, of: a, face: b, inner: c, innerOf: d };
}

class Parts {
  constructor(stage, body, parts, points, triangles) {
    Object.assign(this, { stage, body, parts, points, triangles });
    this.painted = [];
    this.lit = null;
    this.onpick = null; // called with the name and the number of the face, and "over" or "click"
    this.caster = new THREE.Raycaster();
    this.#listen();
  }

  nameAt(hit) {
    return this.parts.names[this.parts.of[hit.faceIndex]] ?? "";
  }

  // Color faces by their names, such as { fixed: "#56b4e9" }; those that lie inside are seen through the rubber.
  paint(colors, inside = []) {
    this.#remove(this.painted);
    this.painted = Object.entries(colors).flatMap(([name, color]) => {
      const through = inside.includes(name);
      return this.#overlay(this.#of(name), color, through ? 0.22 : 0.7, through);
    });
    this.cut();
    this.stage.draw();
  }

  // Light up all faces of a name, also where something is in front of them; null for none.
  light(name) {
    if (name === this.lit) return;
    this.lit = name;
    this.#remove(this.lights ?? []);
    this.lights = name === null ? [] : this.#overlay(this.#of(name), LIT, 0.55, true);
    this.stage.draw();
  }

  // Colors end at the plane of a cut, as the surface does.
  cut() {
    for (const each of this.painted) {
      each.material.clippingPlanes = this.body.surface.clippingPlanes;
      each.material.needsUpdate = true;
    }
  }

  // Triangles of a name.
  #of(name) {
    const { names, of, inner, innerOf } = this.parts;
    const number = names.indexOf(name);
    const out = [];
    of.forEach((part, t) => part === number && out.push(...this.triangles.subarray(3 * t, 3 * t + 3)));
    innerOf.forEach((part, t) => part === number && out.push(...inner.subarray(3 * t, 3 * t + 3)));
    return out;
  }

  #overlay(index, color, opacity, through) {
    if (!index.length) return [];
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(this.points, 3));
    geometry.setIndex(index);
    const material = new THREE.MeshBasicMaterial({
      color, opacity, transparent: true, side: THREE.DoubleSide, depthTest: !through, depthWrite: false,
      polygonOffset: true, polygonOffsetFactor: -1, polygonOffsetUnits: -1,
    });
    return this.stage.repeat(() => {
      const mesh = new THREE.Mesh(geometry, material);
      mesh.renderOrder = through ? 9 : 7;
      mesh.frustumCulled = false;
      return mesh;
    });
  }

  #remove(objects) {
    for (const each of objects) {
      this.stage.scene.remove(each);
      each.geometry.dispose();
      each.material.dispose();
    }
  }

  // The face at the pointer; through a transparent surface the first one that is not its outside.
  #at(event) {
    const hits = hitsAt(this.caster, this.stage, this.body, event);
    const seen = this.body.surface.transparent ? hits.find((hit) => this.nameAt(hit) !== "outside") : null;
    const hit = seen ?? hits[0];
    return hit ? [this.nameAt(hit), this.parts.face[hit.faceIndex]] : [null, -1];
  }

  #listen() {
    const { box } = this.stage;
    this.stage.onpointer?.abort(); // those of the scene before this one
    this.stage.onpointer = new AbortController();
    const { signal } = this.stage.onpointer;
    let down = null;
    let waiting = false;
    const over = (event) => {
      waiting = false;
      const [name, face] = this.#at(event);
      if (name !== this.lit) this.onpick?.(name, face, "over");
      this.light(name);
    };
    box.addEventListener("pointermove", (event) => {
      if (event.buttons || waiting) return;
      waiting = true;
      requestAnimationFrame(() => over(event));
    }, { signal });
    box.addEventListener("pointerleave", () => this.light(null), { signal });
    box.addEventListener("pointerdown", (event) => (down = event), { signal });
    box.addEventListener("pointerup", (event) => {
      if (!down || Math.hypot(event.clientX - down.clientX, event.clientY - down.clientY) > STILL) return;
      const [name, face] = this.#at(event);
      if (name !== null) this.onpick?.(name, face, "click", event);
    }, { signal });
  }
}
