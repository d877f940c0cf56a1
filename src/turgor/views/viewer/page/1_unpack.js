// Unpack: text back to arrays, as turgor.views.viewer.packing writes it.

async function inflated(text) {
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// Whole numbers of a packed index, such as the corners of triangles.
async function unpackedIndex(packed) {
  const raw = await inflated(packed.data);
  const count = raw.length / 4;
  const out = new Uint32Array(count);
  let sum = 0;
  for (let i = 0; i < count; i++) {
    const word = raw[i] + raw[count + i] * 256 + raw[2 * count + i] * 65536 + raw[3 * count + i] * 16777216;
    sum += word & 1 ? -((word + 1) / 2) : word / 2;
    out[i] = sum;
  }
  return out;
}

// States around a place between steps, such as 3.4, each with its weight. With the places of the steps along the drive
// these are the four of a cubic, else the two of a line; a whole step is one state.
function around(step, places) {
  const k = Math.floor(step);
  if (k === step) return [[k, 1]];
  if (!places) return [[k, k + 1 - step], [k + 1, step - k]];
  const at = places[k] + (step - k) * (places[k + 1] - places[k]);
  const first = Math.min(Math.max(k - 1, 0), places.length - 4);
  const near = [0, 1, 2, 3].map((i) => first + i);
  const weight = (i) => near.reduce((w, j) => (j === i ? w : (w * (at - places[j])) / (places[i] - places[j])), 1);
  return near.map((i) => [i, weight(i)]);
}

// Numbers along a path: an array of 16-bit words for each step, and how to read them, between the steps by cubics where
// their places are given.
async function unpackedSteps(packed, places) {
  const [steps, points, parts] = packed.shape;
  const raw = await inflated(packed.data);
  const count = steps * points * parts;
  const size = points * parts;
  const words = new Uint16Array(count);
  for (let i = 0; i < count; i++) {
    const word = raw[i] + raw[count + i] * 256;
    const change = word & 1 ? -((word + 1) >> 1) : word >> 1;
    const before = i < size ? (i < parts ? 0 : words[i - parts]) : words[i - size];
    words[i] = before + change; // wraps around, as the writer did
  }
  const scale = packed.span.map((span) => span / 65535);
  return {
    steps,
    points,
    parts,
    // Values of one step, or between two, as floats.
    at(step) {
      const out = new Float32Array(size);
      for (let i = 0; i < size; i++) out[i] = packed.low[i % parts];
      for (const [state, weight] of around(step, places)) {
        const factor = scale.map((one) => weight * one);
        for (let i = 0; i < size; i++) out[i] += words[state * size + i] * factor[i % parts];
      }
      return out;
    },
  };
}
