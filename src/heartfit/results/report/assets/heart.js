/* The beating ventricles of each case: two scenes that turn together, a slider of time, and what follows it. */
"use strict";

const PARTS = ["outside", "inside"];
const UP = { x: 0, y: 0, z: 1 };
const VIEWS = {
  front: { eye: { x: 0, y: -1.45, z: 0.2 }, up: UP },
  left: { eye: { x: 1.45, y: 0, z: 0.2 }, up: UP },
  septum: { eye: { x: -1.45, y: 0, z: 0.2 }, up: UP },
  apex: { eye: { x: 0, y: 0, z: -1.45 }, up: { x: 0, y: -1, z: 0 } },
  base: { eye: { x: 0, y: -0.4, z: 1.4 }, up: { x: 0, y: -1, z: 0 } },
};
const LIGHT = { ambient: 0.6, diffuse: 0.55, specular: 0.08, roughness: 0.8, fresnel: 0.05 };
const LAMP = 4e4; // mm; from the beholder, a little above; plotly takes no more than 1e5
const SHADES = JSON.parse(document.getElementById("shades").textContent);

/* Integers that the page holds in base 64, deflated. */
async function unpack(text) {
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Int32Array(await new Response(stream).arrayBuffer());
}

/* Coordinates in mm of every phase, from the differences between them. */
function placesOf(steps, phases, quantum) {
  const size = steps.length / phases;
  const sum = new Int32Array(size);
  return Array.from({ length: phases }, (_, phase) => {
    const places = new Float32Array(size);
    for (let i = 0; i < size; i += 1) {
      sum[i] += steps[phase * size + i];
      places[i] = sum[i] * quantum;
    }
    return ["x", "y", "z"].map((_axis, k) => places.subarray((k * size) / 3, ((k + 1) * size) / 3));
  });
}

/* Least and largest of each coordinate over all phases of all motions, so that a heart that shrinks looks smaller. */
function extents(parts) {
  const all = Object.values(parts).flatMap((part) => Object.values(part.places).flat());
  const least = (values) => values.reduce((a, b) => Math.min(a, b), Infinity);
  return [0, 1, 2].map((axis) => [least(all.map((place) => least(place[axis]))), -least(all.map((place) => least(place[axis].map((v) => -v))))]);
}

/* Area of the triangles around each node. */
function areas([x, y, z], [i, j, k]) {
  const sums = new Float64Array(x.length);
  i.forEach((a, face) => {
    const [b, c] = [j[face], k[face]];
    const [ux, uy, uz, vx, vy, vz] = [x[b] - x[a], y[b] - y[a], z[b] - z[a], x[c] - x[a], y[c] - y[a], z[c] - z[a]];
    const area = Math.hypot(uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx) / 2;
    [a, b, c].forEach((node) => (sums[node] += area));
  });
  return sums;
}

const distances = (p, q) => Array.from(p[0], (_, n) => Math.hypot(p[0][n] - q[0][n], p[1][n] - q[1][n], p[2][n] - q[2][n]));

class Heart {
  constructor(figure) {
    this.figure = figure;
    this.given = JSON.parse(document.getElementById(figure.dataset.payload).textContent);
    this.times = this.given.times_ms;
    this.scenes = [...figure.querySelectorAll(".scene")];
    this.motions = [...figure.querySelectorAll(".motion")];
    this.slider = figure.querySelector(".time");
    this.button = figure.querySelector(".play");
    this.phase = 0;
    this.camera = VIEWS.front;
    this.control();
    this.follow();
  }

  find(name) {
    return this.figure.querySelector(`.${name}`);
  }

  control() {
    this.slider.addEventListener("input", () => this.show(Number(this.slider.value)));
    this.button.addEventListener("click", () => (this.playing ? this.pause() : this.play()));
    [...this.motions, this.find("shade"), this.find("through")].forEach((each) => each.addEventListener("change", () => this.draw()));
    this.figure.querySelectorAll("[data-view]").forEach((each) =>
      each.addEventListener("click", () => this.turn(VIEWS[each.dataset.view])),
    );
  }

  /* Unpack once, then draw both scenes; called when the figure comes into sight. */
  async open() {
    this.isOpen = true;
    this.ready ??= this.unpackAll();
    await this.ready;
    if (!this.isOpen) return;
    this.legend();
    const options = { displayModeBar: false, responsive: true };
    await Promise.all(this.scenes.map((scene, pane) => Plotly.newPlot(scene, this.traces(pane), this.layout(), options)));
    this.scenes.forEach((scene) => {
      scene.on("plotly_relayouting", (moved) => this.turned(scene, moved));
      scene.on("plotly_relayout", async (moved) => (await this.turned(scene, moved)) && this.draw());
    });
    this.figure.classList.add("drawn");
  }

  /* Give the graphics memory back: browsers keep but a few scenes. */
  close() {
    this.isOpen = false;
    this.pause();
    this.figure.classList.remove("drawn");
    this.scenes.forEach((scene) => Plotly.purge(scene));
  }

  async unpackAll() {
    const { surface, motions, quantum_mm: quantum } = this.given;
    this.parts = {};
    for (const part of PARTS) {
      const corners = await unpack(surface[part].triangles);
      const count = corners.length / 3;
      const places = {};
      for (const [name, motion] of Object.entries(motions)) {
        places[name] = placesOf(await unpack(motion[part]), this.times.length, quantum);
      }
      const triangles = [0, 1, 2].map((k) => corners.subarray(k * count, (k + 1) * count));
      const [activation, segment] = [await unpack(surface[part].activation), await unpack(surface[part].segment)];
      this.parts[part] = { triangles, places, activation, segment };
    }
    this.extents = extents(this.parts);
  }

  /* What colours a part: a value for each node or triangle. */
  values(part, name, other) {
    const { triangles, places, activation, segment } = this.parts[part];
    const now = places[name][this.phase];
    return {
      activation: () => activation,
      segment: () => segment,
      strain: () => {
        const first = areas(places[name][0], triangles);
        return areas(now, triangles).map((area, node) => 100 * (Math.sqrt(area / first[node]) - 1));
      },
      distance: () => distances(now, places[other][this.phase]),
    }[this.find("shade").value]();
  }

  traces(pane) {
    const [name, other] = [this.motions[pane].value, this.motions[1 - pane].value];
    const shade = SHADES[this.find("shade").value];
    const { eye, up } = this.camera;
    const [lx, ly, lz] = ["x", "y", "z"].map((axis) => LAMP * (eye[axis] + 0.6 * up[axis]));
    return PARTS.map((part) => {
      const { triangles, places } = this.parts[part];
      const [x, y, z] = places[name][this.phase];
      return {
        type: "mesh3d", x, y, z, i: triangles[0], j: triangles[1], k: triangles[2],
        intensity: this.values(part, name, other), intensitymode: shade.mode, cmin: shade.low, cmax: shade.high,
        colorscale: shade.colours, showscale: false, flatshading: false, lighting: LIGHT, lightposition: { x: lx, y: ly, z: lz }, hoverinfo: "skip",
        opacity: part === "outside" && this.find("through").checked ? 0.15 : 1,
      };
    });
  }

  layout() {
    const [xaxis, yaxis, zaxis] = this.extents.map((range) => ({ range, visible: false, showspikes: false }));
    const sizes = this.extents.map(([low, high]) => high - low);
    const [x, y, z] = sizes.map((size) => size / Math.cbrt(sizes[0] * sizes[1] * sizes[2]));
    const scene = { aspectmode: "manual", aspectratio: { x, y, z }, xaxis, yaxis, zaxis, camera: this.camera, dragmode: "orbit" };
    return { scene, margin: { l: 0, r: 0, t: 0, b: 0 }, paper_bgcolor: "#ffffff" };
  }

  /* Only what the surfaces are, not from where they are seen: a hand may be turning them. */
  draw() {
    this.legend();
    const changes = (traces) => Object.fromEntries(Object.keys(traces[0]).map((key) => [key, traces.map((each) => each[key])]));
    return Promise.all(this.scenes.map((scene, pane) => Plotly.restyle(scene, changes(this.traces(pane)))));
  }

  /* Look from elsewhere; the lamp comes with the beholder. */
  async turn(camera) {
    await this.look(this.scenes, camera);
    return this.draw();
  }

  /* One scene was turned by hand: the other one follows. Whether it was this one. */
  async turned(scene, { "scene.camera": camera }) {
    if (!camera || this.following) return false;
    await this.look(this.scenes.filter((each) => each !== scene), camera);
    return true;
  }

  async look(scenes, camera) {
    this.camera = camera;
    this.following = true;
    await Promise.all(scenes.map((scene) => Plotly.relayout(scene, { "scene.camera": camera })));
    this.following = false;
  }

  async show(phase) {
    this.phase = phase;
    this.slider.value = phase;
    this.find("now").value = `${Math.round(this.times[phase])} ms`;
    this.moves.forEach((move) => move(phase));
    if (this.isOpen && this.parts) await this.draw();
  }

  pause() {
    this.playing = false;
    this.button.textContent = "▶ Play";
  }

  async play() {
    this.playing = true;
    this.button.textContent = "❚❚ Pause";
    // the clock of frames from the start: performance.now() may be ahead of the first frame, before which there is no phase
    let [last, time] = [await new Promise(requestAnimationFrame), this.times[this.phase]];
    while (this.playing) {
      const now = await new Promise(requestAnimationFrame);
      time = (time + (now - last) * Number(this.find("speed").value)) % this.given.period_ms;
      last = now;
      const phase = this.times.findLastIndex((each) => each <= time);
      if (phase !== this.phase) await this.show(phase);
    }
  }

  /* Lines of time and dots on loops over the curves of the same case. */
  follow() {
    const box = document.getElementById(this.figure.dataset.follow);
    this.moves = this.given.follow.map((each) => {
      const mark = box.appendChild(document.createElement("span"));
      mark.className = each.y ? "dot" : "line";
      Object.assign(mark.style, each.y ? { background: each.colour } : { top: `${each.top}%`, height: `${each.bottom - each.top}%` });
      return (phase) => Object.assign(mark.style, { left: `${each.x[phase]}%` }, each.y ? { top: `${each.y[phase]}%` } : {});
    });
    this.moves.forEach((move) => move(0));
  }

  legend() {
    const shade = SHADES[this.find("shade").value];
    const stops = shade.colours.map(([share, colour]) => `${colour} ${100 * share}%`).join(", ");
    this.find("ramp").style.background = `linear-gradient(to right, ${stops})`;
    ["low", "high", "what"].forEach((name) => {
      this.find(name).textContent = shade[name === "what" ? "label" : name];
    });
  }
}

const hearts = new Map([...document.querySelectorAll(".heart")].map((figure) => [figure, new Heart(figure)]));
const watch = new IntersectionObserver(
  (seen) => seen.forEach(({ target, isIntersecting }) => (isIntersecting ? hearts.get(target).open() : hearts.get(target).close())),
  { rootMargin: "150px" },
);
hearts.forEach((_, figure) => watch.observe(figure));
window.addEventListener("beforeprint", () => document.querySelectorAll("details").forEach((each) => (each.open = true)));
