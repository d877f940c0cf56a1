// Body: the actuator with its lines, its cut, its outline at rest, and what stands next to it.

const RUBBER = 0xdcd9d4;

class Body {
  constructor(stage, skin, values) {
    this.stage = stage;
    this.skin = skin;
    this.plane = new THREE.Plane(new THREE.Vector3(0, 1, 0), 0);
    this.surface = new THREE.MeshLambertMaterial({
      side: THREE.FrontSide, polygonOffset: true, polygonOffsetFactor: 1.5, polygonOffsetUnits: 2,
    });
    this.meshes = stage.repeat(() => this.#mesh(skin.geometry, this.surface, 6));
    this.inks = {};
    this.lines = {};
    for (const [kind, look] of Object.entries({ sharp: [INK, 0.75], cells: [INK, 0.28] })) {
      this.inks[kind] = new THREE.LineBasicMaterial({ color: look[0], opacity: look[1], transparent: true });
      this.lines[kind] = stage.repeat(() => this.#line(skin.lines[kind].geometry, this.inks[kind]));
    }
    this.show("cells", false);
    this.cap = new Cap(stage, skin.geometry, this.plane);
    this.ghost = [];
  }

  #mesh(geometry, material, order) {
    const mesh = new THREE.Mesh(geometry, material);
    mesh.renderOrder = order;
    mesh.frustumCulled = false;
    return mesh;
  }

  #line(geometry, material) {
    const line = new THREE.LineSegments(geometry, material);
    line.renderOrder = 8;
    line.frustumCulled = false;
    return line;
  }

  // Keep the outline of the step that is drawn now as the outline at rest.
  keepRest() {
    const copy = this.skin.lines.sharp.geometry.clone();
    const ink = new THREE.LineBasicMaterial({ color: 0x9aa3ae });
    this.ghost = this.stage.repeat(() => this.#line(copy, ink));
    this.ghost.forEach((line) => (line.renderOrder = 4));
    this.stage.faint = [...this.ghost, ...this.lines.cells];
  }

  paint(colors) {
    const bytes = Uint8Array.from(atob(colors), (c) => c.charCodeAt(0));
    const data = new Uint8Array((bytes.length / 3) * 4).fill(255);
    for (let i = 0; i < bytes.length / 3; i++) data.set(bytes.subarray(3 * i, 3 * i + 3), 4 * i);
    const map = new THREE.DataTexture(data, bytes.length / 3, 1, THREE.RGBAFormat);
    map.colorSpace = THREE.SRGBColorSpace;
    map.magFilter = map.minFilter = THREE.LinearFilter;
    map.needsUpdate = true;
    this.surface.map?.dispose();
    this.surface.map = map;
    this.surface.needsUpdate = true;
  }

  show(kind, on) {
    (kind === "ghost" ? this.ghost : this.lines[kind]).forEach((line) => (line.visible = on));
    this.stage.draw();
  }

  transparent(on) {
    Object.assign(this.surface, { transparent: on, opacity: on ? 0.35 : 1, depthWrite: !on });
    this.#sides();
    this.stage.draw();
  }

  // A closed body hides its inner side, which need not be drawn.
  #sides() {
    this.surface.side = this.open || this.surface.transparent ? THREE.DoubleSide : THREE.FrontSide;
    this.surface.needsUpdate = true;
  }

  // Cut away one side of a plane across an axis (0, 1, 2, or -1 for none) at a place [m]: the one towards the camera of
  // the first view, or the other.
  cut(axis, place, turned) {
    const on = axis >= 0;
    if (on) {
      const kept = (axis === 1) !== turned ? 1 : -1;
      this.plane.normal.set(0, 0, 0).setComponent(axis, kept);
      this.plane.constant = -kept * place;
    }
    for (const material of [this.surface, this.inks.sharp, this.inks.cells, ...(this.threadInk ? [this.threadInk] : [])]) {
      material.clippingPlanes = on ? [this.plane] : null;
      material.needsUpdate = true;
    }
    this.cap.set(on, axis, place);
    this.open = on;
    this.#sides();
    this.stage.draw();
  }

  addThreads(lengths, positions) {
    const count = lengths.reduce((sum, n) => sum + 2 * (n - 1), 0);
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(3 * count), 3));
    this.threadInk = new THREE.LineBasicMaterial({ color: 0x16324f });
    this.threads = this.stage.repeat(() => this.#line(geometry, this.threadInk));
    this.moveThreads = (step) => {
      const points = positions.at(step);
      const to = geometry.attributes.position.array;
      let from = 0;
      let at = 0;
      for (const n of lengths) {
        for (let k = 0; k < n - 1; k++) for (let i = 0; i < 6; i++) to[at++] = points[3 * (from + k) + i];
        from += n;
      }
      geometry.attributes.position.needsUpdate = true;
    };
  }

  addObstacles(triangles, positions) {
    const geometry = new THREE.BufferGeometry();
    geometry.setIndex(new THREE.BufferAttribute(triangles, 1));
    const material = new THREE.MeshLambertMaterial({
      color: 0x7c8795, transparent: true, opacity: 0.45, side: THREE.DoubleSide, depthWrite: false,
    });
    const mesh = this.#mesh(geometry, material, 10);
    this.stage.scene.add(mesh);
    this.obstacles = [mesh];
    this.moveObstacles = (step) => {
      geometry.setAttribute("position", new THREE.BufferAttribute(positions.at(step), 3));
      geometry.computeVertexNormals();
    };
  }

  // The line that was to be followed, and a mark on it, of the whole actuator.
  addPath(triangles, positions) {
    const geometry = new THREE.BufferGeometry();
    geometry.setIndex(new THREE.BufferAttribute(triangles, 1));
    const ink = { color: 0xd55e00, side: THREE.DoubleSide, depthTest: false, transparent: true, opacity: 0.85 };
    const mesh = this.#mesh(geometry, new THREE.MeshBasicMaterial(ink), 11); // seen through the rubber
    this.stage.scene.add(mesh);
    this.path = [mesh];
    this.movePath = (step) => geometry.setAttribute("position", new THREE.BufferAttribute(positions.at(step), 3));
  }
}

// Cap: the solid that a cut opens, found by counting in each pixel how often a ray enters and leaves it.
class Cap {
  constructor(stage, geometry, plane) {
    this.stage = stage;
    const count = (side, action, order) => {
      const material = new THREE.MeshBasicMaterial({
        side, clippingPlanes: [plane], depthWrite: false, depthTest: false, colorWrite: false, stencilWrite: true,
        stencilFunc: THREE.AlwaysStencilFunc, stencilFail: action, stencilZFail: action, stencilZPass: action,
      });
      return stage.repeat(() => {
        const mesh = new THREE.Mesh(geometry, material);
        mesh.renderOrder = order;
        mesh.frustumCulled = false;
        return mesh;
      });
    };
    this.counters = [
      ...count(THREE.BackSide, THREE.IncrementWrapStencilOp, 1),
      ...count(THREE.FrontSide, THREE.DecrementWrapStencilOp, 1),
    ];
    const material = new THREE.MeshBasicMaterial({
      color: RUBBER, side: THREE.DoubleSide, stencilWrite: true, stencilRef: 0, stencilFunc: THREE.NotEqualStencilFunc,
      polygonOffset: true, polygonOffsetFactor: 1.5, polygonOffsetUnits: 2,
    });
    this.face = new THREE.Mesh(new THREE.PlaneGeometry(1, 1), material);
    this.face.renderOrder = 2;
    stage.scene.add(this.face);
    this.set(false, 0, 0);
  }

  set(on, axis, place) {
    [...this.counters, this.face].forEach((mesh) => (mesh.visible = on));
    if (!on) return;
    const normal = new THREE.Vector3().setComponent(axis, 1);
    this.face.position.copy(this.stage.center).setComponent(axis, place);
    this.face.lookAt(this.face.position.clone().add(normal));
    this.face.scale.setScalar(6 * this.stage.radius);
  }
}
