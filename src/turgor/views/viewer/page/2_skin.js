// Skin: six-node triangles cut into flat ones, with normals and values, for each step.

// Flat triangles of the whole actuator beyond which each side has two parts, not four: with a graphics card and without.
const MOST_TRIANGLES = { fast: 500000, slow: 40000 };

// Lattice on a triangle: shape functions at its points, and its flat triangles.
function lattice(parts, sides) {
  const places = [];
  const number = new Map();
  for (let i = 0; i <= parts; i++) {
    for (let j = 0; j <= parts - i; j++) {
      number.set(i + "," + j, places.length);
      places.push([i / parts, j / parts]);
    }
  }
  const pieces = [];
  for (let i = 0; i < parts; i++) {
    for (let j = 0; j < parts - i; j++) {
      const at = (a, b) => number.get(a + "," + b);
      pieces.push(at(i, j), at(i + 1, j), at(i, j + 1));
      if (i + j < parts - 1) pieces.push(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
  return { places, pieces, shape: places.map((place) => shapeAt(place, sides)) };
}

// Shape functions of three or six nodes at a place of the reference triangle.
function shapeAt([r, s], sides) {
  const L = [1 - r - s, r, s];
  if (!sides) return L;
  return [...L.map((l) => l * (2 * l - 1)), ...sides.map(([a, b]) => 4 * L[a] * L[b])];
}

// Their derivatives along both directions.
function slopesAt([r, s], sides) {
  const L = [1 - r - s, r, s];
  const G = [[-1, -1], [1, 0], [0, 1]];
  if (!sides) return G;
  return [
    ...L.map((l, a) => [(4 * l - 1) * G[a][0], (4 * l - 1) * G[a][1]]),
    ...sides.map(([a, b]) => [0, 1].map((k) => 4 * (L[a] * G[b][k] + L[b] * G[a][k]))),
  ];
}

class Skin {
  constructor(triangles, { shape, cut, centers, mirrors, sides, images, slow }) {
    this.centers = new Set(centers);
    this.nodes = shape[1];
    this.triangles = triangles;
    this.faces = shape[0];
    this.cut = cut;
    this.mirrors = mirrors;
    this.sides = this.nodes === 6 ? sides : null;
    const parts = this.nodes === 3 ? 1 : this.faces * 16 * images <= MOST_TRIANGLES[slow ? "slow" : "fast"] ? 4 : 2;
    this.grid = lattice(parts, this.sides);
    const corners = [[0, 0], [1, 0], [0, 1]];
    const own = this.sides ? sides.map(([a, b]) => [0, 1].map((k) => (corners[a][k] + corners[b][k]) / 2)) : [];
    this.slopes = [...corners, ...own].map((place) => slopesAt(place, this.sides));
    this.geometry = this.#geometry();
    this.lines = this.#lines();
  }

  #geometry() {
    const { places, pieces } = this.grid;
    const count = this.faces * places.length;
    const index = new Uint32Array(this.faces * pieces.length);
    for (let f = 0, i = 0; f < this.faces; f++) for (const p of pieces) index[i++] = f * places.length + p;
    const geometry = new THREE.BufferGeometry();
    geometry.setIndex(new THREE.BufferAttribute(index, 1));
    geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(3 * count), 3));
    geometry.setAttribute("normal", new THREE.BufferAttribute(new Float32Array(3 * count), 3));
    geometry.setAttribute("uv", new THREE.BufferAttribute(new Float32Array(2 * count).fill(0.5), 2));
    return geometry;
  }

  // Normals at the vertices of a step, continuous within a patch and across mirror planes.
  #normals(points) {
    const out = new Float32Array(points.length);
    const n = this.nodes;
    for (let f = 0; f < this.faces; f++) {
      for (let q = 0; q < n; q++) {
        const t = [0, 0, 0, 0, 0, 0];
        for (let a = 0; a < n; a++) {
          const [dr, ds] = this.slopes[q][a];
          const v = 3 * this.triangles[f * n + a];
          for (let i = 0; i < 3; i++) {
            t[i] += dr * points[v + i];
            t[3 + i] += ds * points[v + i];
          }
        }
        const at = 3 * this.triangles[f * n + q];
        out[at] += t[1] * t[5] - t[2] * t[4];
        out[at + 1] += t[2] * t[3] - t[0] * t[5];
        out[at + 2] += t[0] * t[4] - t[1] * t[3];
      }
    }
    for (let v = 0; v < out.length / 3; v++) {
      this.mirrors.forEach((axis, k) => (this.cut[v] >> k) & 1 && (out[3 * v + axis] = 0));
      const long = Math.hypot(out[3 * v], out[3 * v + 1], out[3 * v + 2]) || 1;
      for (let i = 0; i < 3; i++) out[3 * v + i] /= long;
    }
    return out;
  }

  // Interpolate values of the vertices (parts each) to the lattice of every triangle.
  #spread(values, parts, to, stride) {
    const { shape } = this.grid;
    const n = this.nodes;
    let at = 0;
    for (let f = 0; f < this.faces; f++) {
      for (const N of shape) {
        for (let i = 0; i < parts; i++) {
          let sum = 0;
          for (let a = 0; a < n; a++) sum += N[a] * values[parts * this.triangles[f * n + a] + i];
          to[at + i] = sum;
        }
        at += stride;
      }
    }
  }

  move(points) {
    const { position, normal } = this.geometry.attributes;
    this.#spread(points, 3, position.array, 3);
    this.#spread(this.#normals(points), 3, normal.array, 3);
    position.needsUpdate = normal.needsUpdate = true;
    this.geometry.computeBoundingSphere();
    for (const kind of Object.values(this.lines)) moveLines(kind, points);
  }

  color(values, low, high) {
    const { uv } = this.geometry.attributes;
    const share = values.map((value) => (value - low) / (high - low));
    this.#spread(share, 1, uv.array, 2);
    uv.needsUpdate = true;
  }

  // Lines of cell edges, and of sharp edges: sides that one triangle alone has, but for those on a cut face.
  #lines() {
    const sides = this.sides ?? [[0, 1], [1, 2], [2, 0]];
    const found = new Map();
    for (let f = 0; f < this.faces; f++) {
      sides.forEach(([p, q], k) => {
        const at = f * this.nodes;
        const [a, b] = [this.triangles[at + p], this.triangles[at + q]];
        const middle = this.sides ? this.triangles[at + 3 + k] : -1;
        const key = Math.min(a, b) * 67108864 + Math.max(a, b);
        const known = found.get(key);
        if (known) known.count++;
        else found.set(key, { nodes: middle < 0 ? [a, b] : [a, middle, b], count: 1 });
      });
    }
    const every = [...found.values()];
    const onCut = ({ nodes }) => nodes.reduce((bits, v) => bits & this.cut[v], ~0) !== 0;
    const cells = every.filter(({ nodes }) => !this.centers.has(nodes[1]));
    const sharp = every.filter((side) => side.count === 1 && !onCut(side));
    return { cells: linesThrough(cells), sharp: linesThrough(sharp) };
  }
}

// Line segments through vertices; curved sides are drawn in four parts.
function linesThrough(sides) {
  const weights = [0, 0.25, 0.5, 0.75, 1].map((t) => [(1 - t) * (1 - 2 * t), 4 * t * (1 - t), t * (2 * t - 1)]);
  const count = sides.reduce((sum, { nodes }) => sum + (nodes.length === 3 ? 8 : 2), 0);
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(3 * count), 3));
  return { sides, weights, geometry };
}

function moveLines({ sides, weights, geometry }, points) {
  const to = geometry.attributes.position.array;
  let at = 0;
  for (const { nodes } of sides) {
    const [a, m, b] = nodes.length === 3 ? nodes : [nodes[0], -1, nodes[1]];
    const place = (k, i) =>
      m < 0
        ? points[3 * (k ? b : a) + i]
        : weights[k][0] * points[3 * a + i] + weights[k][1] * points[3 * m + i] + weights[k][2] * points[3 * b + i];
    for (let k = 0; k < (m < 0 ? 1 : 4); k++) {
      for (const end of [k, k + 1]) for (let i = 0; i < 3; i++) to[at++] = place(end, i);
    }
  }
  geometry.attributes.position.needsUpdate = true;
  geometry.computeBoundingSphere();
}
