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

// Numbers along a path: an array of 16-bit words for each step, and how to read them.
async function unpackedSteps(packed) {
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
    // Values of one step as floats.
    at(step) {
      const out = new Float32Array(size);
      for (let i = 0; i < size; i++) {
        const k = i % parts;
        out[i] = packed.low[k] + words[step * size + i] * scale[k];
      }
      return out;
    },
  };
}
