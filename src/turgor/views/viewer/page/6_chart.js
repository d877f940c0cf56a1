// Chart: small drawings as SVG: color bar, response with a marker, axes of the picture.

const SVG = "http://www.w3.org/2000/svg";

function svg(tag, attributes, parent, text) {
  const made = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  if (text !== undefined) made.textContent = text;
  parent?.append(made);
  return made;
}

// Round numbers between two ends.
function ticks(low, high, about) {
  const rough = (high - low) / about;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 5, 10].find((s) => s * power >= rough * 0.999);
  const out = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k++) out.push(k * step);
  return out.map((value) => Number(value.toPrecision(12)));
}

function written(value, digits = 4) {
  if (value === null || !Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  const text = size >= 1e-3 && size < 1e5 ? String(Number(value.toPrecision(digits))) : value.toPrecision(digits);
  return text.replace("-", "−");
}

function words(label) {
  return label.replace(/mm2\b/g, "mm²").replace(/mm3\b/g, "mm³").replace(/\bm2\b/g, "m²").replace(/\bm3\b/g, "m³")
    .replace("[deg]", "[°]").replace("[um]", "[µm]");
}

// The color bar of a field, with an arrow where larger values have the last color.
function drawBar(box, field) {
  box.replaceChildren();
  const bytes = Uint8Array.from(atob(field.colors), (c) => c.charCodeAt(0));
  const width = 270;
  const drawn = svg("svg", { viewBox: `0 0 ${width + 20} 46`, class: "v-bar", "data-field": field.key }, box);
  const gradient = svg("linearGradient", { id: "v-colors" }, svg("defs", {}, drawn));
  const count = bytes.length / 3;
  for (let i = 0; i < count; i += 5) {
    const color = `rgb(${bytes[3 * i]},${bytes[3 * i + 1]},${bytes[3 * i + 2]})`;
    svg("stop", { offset: i / (count - 1), "stop-color": color }, gradient);
  }
  svg("rect", { x: 4, y: 2, width, height: 14, fill: "url(#v-colors)" }, drawn);
  const last = `rgb(${[...bytes.slice(-3)].join(",")})`;
  if (field.data) svg("path", { d: `M${4 + width + 1} 2 l9 7 l-9 7z`, fill: last }, drawn);
  for (const value of ticks(field.low, field.high, 5)) {
    const x = 4 + ((value - field.low) / (field.high - field.low)) * width;
    svg("path", { d: `M${x} 16v5`, class: "v-tick" }, drawn);
    svg("text", { x, y: 34, "text-anchor": "middle", class: "v-number" }, drawn, written(value));
  }
}

// A response with a marker at the step that is shown; a click chooses the nearest step.
class Chart {
  constructor(box, curves, choose) {
    this.curves = curves;
    this.choose = choose;
    this.box = box;
    this.column = curves.y[0];
  }

  draw(column) {
    this.column = column;
    this.box.replaceChildren();
    const [width, height] = (this.size = [300, 190]);
    const known = column.values.map((y, k) => [this.curves.x.values[k], y]).filter(([x, y]) => x !== null && y !== null);
    const ends = (values) => {
      const [low, high] = [Math.min(...values), Math.max(...values)];
      return high > low ? [low, high] : [low - 1, high + 1];
    };
    const spread = column.error ? column.values.flatMap((y, k) => [y - (column.error[k] ?? 0), y + (column.error[k] ?? 0)]) : [];
    const rig = column.measured.flatMap(({ x, y }) => x.map((value, k) => [value, y[k]])).filter((at) => !at.includes(null));
    const [xs, ys] = [0, 1].map((i) => ends([...known, ...rig].map((at) => at[i]).concat(i ? spread : [])));
    const frame = (this.frame = { left: 48, right: width - 10, top: 8, bottom: height - 38 });
    this.x = (x) => frame.left + ((x - xs[0]) / (xs[1] - xs[0])) * (frame.right - frame.left);
    this.y = (y) => frame.bottom - ((y - ys[0]) / (ys[1] - ys[0])) * (frame.bottom - frame.top);
    const drawn = (this.drawn = svg("svg", { viewBox: `0 0 ${width} ${height}`, class: "v-chart" }, this.box));
    this.#axes(drawn, xs, ys);
    if (column.error) this.#band(drawn, column);
    const line = known.map(([x, y], k) => `${k ? "L" : "M"}${this.x(x).toFixed(1)} ${this.y(y).toFixed(1)}`).join("");
    svg("path", { d: line, class: "v-line" }, drawn);
    for (const k of this.curves.steps) {
      const [x, y] = [this.curves.x.values[k], column.values[k]];
      if (x !== null && y !== null) svg("circle", { cx: this.x(x), cy: this.y(y), r: 2.2, class: "v-dot" }, drawn);
    }
    for (const [x, y] of rig) svg("circle", { cx: this.x(x), cy: this.y(y), r: 3, class: "v-measured" }, drawn);
    if (rig.length) {
      const names = column.measured.map(({ name }) => name).join(", ");
      svg("text", { x: frame.left + 8, y: frame.top + 12, class: "v-number v-said" }, drawn, `measured: ${names}`);
    }
    this.marker = svg("circle", { r: 6, class: "v-marker" }, drawn);
    drawn.addEventListener("click", (event) => this.#clicked(event));
    if (this.step !== undefined) this.mark(this.step);
  }

  #axes(drawn, xs, ys) {
    const { left, right, top, bottom } = this.frame;
    for (const value of ticks(...xs, 5)) {
      svg("path", { d: `M${this.x(value)} ${top}V${bottom}`, class: "v-grid" }, drawn);
      svg("text", { x: this.x(value), y: bottom + 15, "text-anchor": "middle", class: "v-number" }, drawn, written(value));
    }
    for (const value of ticks(...ys, 4)) {
      svg("path", { d: `M${left} ${this.y(value)}H${right}`, class: "v-grid" }, drawn);
      svg("text", { x: left - 5, y: this.y(value) + 4, "text-anchor": "end", class: "v-number" }, drawn, written(value));
    }
    const name = words(this.curves.x.label);
    svg("text", { x: (left + right) / 2, y: bottom + 33, "text-anchor": "middle", class: "v-number" }, drawn, name);
  }

  #band(drawn, column) {
    const rows = column.values.map((y, k) => [this.curves.x.values[k], y, column.error[k]]).filter((row) => !row.includes(null));
    const upper = rows.map(([x, y, e]) => `${this.x(x)},${this.y(y + e)}`);
    const lower = rows.map(([x, y, e]) => `${this.x(x)},${this.y(y - e)}`).reverse();
    svg("polygon", { points: [...upper, ...lower].join(" "), class: "v-band" }, drawn);
  }

  // Move the marker to a row of the response, or between two.
  mark(step) {
    this.step = step;
    const [x, y] = [this.curves.x, this.column].map(({ values }) => between(values, step));
    const known = x !== null && y !== null;
    this.marker.style.display = known ? "" : "none";
    if (!known) return;
    this.marker.setAttribute("cx", this.x(x));
    this.marker.setAttribute("cy", this.y(y));
  }

  #clicked(event) {
    const [x, y] = placeIn(this.drawn, event);
    const away = (k) => Math.hypot(this.x(this.curves.x.values[k]) - x, this.y(this.column.values[k]) - y);
    const known = this.curves.steps.filter((k) => this.column.values[k] !== null && this.curves.x.values[k] !== null);
    this.choose(known.reduce((best, k) => (away(k) < away(best) ? k : best)));
  }
}

// A value between two rows of a column; null where one of them is.
function between(values, row) {
  const near = around(row);
  return near.some(([k]) => values[k] === null) ? null : near.reduce((sum, [k, weight]) => sum + weight * values[k], 0);
}

// Place of a mouse event in the coordinates of a drawing.
function placeIn(drawn, event) {
  const place = new DOMPoint(event.clientX, event.clientY).matrixTransform(drawn.getScreenCTM().inverse());
  return [place.x, place.y];
}
