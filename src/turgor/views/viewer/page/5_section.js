// Section: the face that a cut opens, colored by the field inside and outlined; made anew for each image and step.

class Section {
  constructor(stage, skin, tetrahedra) {
    this.stage = stage;
    this.skin = skin;
    this.tetrahedra = tetrahedra;
    this.material = new THREE.MeshBasicMaterial({
      side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: 0.7, polygonOffsetUnits: 1,
      stencilWrite: true, stencilRef: 0, stencilFunc: THREE.NotEqualStencilFunc, // only where the cap is
    });
    const ink = new THREE.LineBasicMaterial({ color: INK });
    const empty = (kind, material, order) =>
      stage.repeat(() => {
        const made = new kind(new THREE.BufferGeometry(), material);
        made.renderOrder = order;
        made.frustumCulled = made.visible = false;
        return made;
      });
    this.faces = empty(THREE.Mesh, this.material, 3);
    this.outlines = empty(THREE.LineSegments, ink, 9);
  }

  // Show the face for points and shares of the color bar at the vertices; without a plane hide it. Where the cells are
  // too many for the page there are no shares, and only the outline is drawn.
  set(plane, points, shares) {
    this.faces.forEach((face, k) => {
      const outline = this.outlines[k];
      face.visible = Boolean(plane && shares);
      outline.visible = Boolean(plane);
      if (!plane) return;
      const own = plane.clone().applyMatrix4(this.stage.matrices[k].clone().invert());
      fill(outline, { position: [this.#outline(own), 3] });
      if (!face.visible) return;
      const { places, colors } = this.#slice(own, points, shares);
      fill(face, { position: [places, 3], uv: [colors, 2] });
    });
  }

  // Where a plane meets the tetrahedra.
  #slice(plane, points, shares) {
    const height = heights(plane, points);
    const places = [];
    const colors = [];
    const put = (a, b) => {
      const t = meet(height, points, a, b, places);
      colors.push((1 - t) * shares[a] + t * shares[b], 0.5);
    };
    for (let k = 0; k < this.tetrahedra.length; k += 4) {
      const above = [];
      const below = [];
      for (let i = 0; i < 4; i++) {
        const v = this.tetrahedra[k + i];
        (height[v] >= 0 ? above : below).push(v);
      }
      if (above.length === 1) below.forEach((v) => put(above[0], v));
      else if (above.length === 3) above.forEach((v) => put(v, below[0]));
      else if (above.length === 2) {
        const [a, b] = above;
        const [c, d] = below;
        for (const [p, q] of [[a, c], [a, d], [b, d], [a, c], [b, d], [b, c]]) put(p, q);
      }
    }
    return { places, colors };
  }

  // Where a plane meets the skin.
  #outline(plane) {
    const points = this.skin.geometry.attributes.position.array;
    const index = this.skin.geometry.index.array;
    const height = heights(plane, points);
    const places = [];
    for (let k = 0; k < index.length; k += 3) {
      for (let i = 0; i < 3; i++) {
        const [a, b] = [index[k + i], index[k + ((i + 1) % 3)]];
        if (height[a] >= 0 !== height[b] >= 0) meet(height, points, a, b, places);
      }
    }
    return places;
  }
}

// Height of each point above a plane.
function heights({ normal, constant }, points) {
  const out = new Float32Array(points.length / 3);
  for (let v = 0; v < out.length; v++) {
    out[v] = normal.x * points[3 * v] + normal.y * points[3 * v + 1] + normal.z * points[3 * v + 2] + constant;
  }
  return out;
}

// Add the place where an edge meets the plane; return its share of the way.
function meet(height, points, a, b, places) {
  const t = height[a] / (height[a] - height[b]);
  for (let i = 0; i < 3; i++) places.push((1 - t) * points[3 * a + i] + t * points[3 * b + i]);
  return t;
}

function fill(object, attributes) {
  object.geometry.dispose();
  object.geometry = new THREE.BufferGeometry();
  for (const [name, [values, parts]] of Object.entries(attributes)) {
    object.geometry.setAttribute(name, new THREE.BufferAttribute(new Float32Array(values), parts));
  }
}
