// Linked: markers on the plots of the page, which were drawn before; a click on a plot chooses the nearest state.
// The page states for each plot where the points of its lines lie: data-lines on the figure, in shares of the drawing.

class LinkedPlot {
  constructor(figure, choose, steps) {
    this.drawn = figure.querySelector("svg");
    const { width, height } = this.drawn.viewBox.baseVal;
    this.lines = JSON.parse(figure.dataset.lines).map((line) => line.map((place) => place && [place[0] * width, place[1] * height]));
    this.markers = this.lines.map(() => svg("circle", { r: 5, class: "v-marker" }, this.drawn));
    this.steps = steps;
    this.drawn.style.cursor = "pointer";
    this.drawn.addEventListener("click", (event) => {
      const found = this.nearest(placeIn(this.drawn, event));
      if (found !== null) choose(found);
    });
  }

  nearest([x, y]) {
    let [best, least] = [null, Infinity];
    for (const line of this.lines) {
      for (const k of this.steps) {
        const away = line[k] ? Math.hypot(line[k][0] - x, line[k][1] - y) : Infinity;
        if (away < least) [best, least] = [k, away];
      }
    }
    return best;
  }

  mark(state) {
    this.markers.forEach((marker, k) => {
      const [x, y] = [0, 1].map((i) => between(this.lines[k].map((place) => place?.[i] ?? null), state));
      marker.style.display = x === null ? "none" : "";
      if (x === null) return;
      marker.setAttribute("cx", x);
      marker.setAttribute("cy", y);
    });
  }
}
