// One tile, triangle by triangle and pixel by pixel. All depths, outcomes and colors were recorded while the frame was drawn.

const STEPS = DATA.tile, [TILE_X, TILE_Y] = STEPS.first, TILE_W = Math.min(TILE, W - TILE_X), TILE_H = Math.min(TILE, H - TILE_Y);
let tileReady = null;
function unpackTile() {
  tileReady ||= (async () => {
    const c = STEPS.fragments, of = (key, Type) => unpackArray(c[key], Type, c.count);
    FRAME.tile = {triangle: await of("triangle", Uint16Array), x: await of("x", Uint8Array), y: await of("y", Uint8Array), sample: await of("sample", Uint8Array), outcome: await of("outcome", Uint8Array), red: await of("red", Uint8Array), green: await of("green", Uint8Array), blue: await of("blue", Uint8Array), depth: await of("depth", Float32Array), stored: await of("stored", Float32Array)};
  })();
  return tileReady;
}

// The edge functions of a triangle, as in edge.h.
const edgesOf = (t) => [0, 1, 2].map((i) => {
  const a = (i + 1) % 3, b = (i + 2) % 3, ex = t.x[b] - t.x[a], ey = t.y[b] - t.y[a];
  return {x0: t.x[a], y0: t.y[a], ex, ey, bias: ey < 0 || (ey === 0 && ex > 0) ? 0 : 1};
});

// What became of a fragment, for the colors and the legend. Outcomes are numbered as in FragmentOutcome.
const FATES = [
  {name: "rejected with its tile or block", color: "#7c3aed", has: (o) => o <= 1},
  {name: "failed a test", color: "#c0392b", has: (o) => o === 2 || o === 3},
  {name: "discarded by the shader", color: "#8d6e00", has: (o) => o === 4},
  {name: "passed, but hidden before it was shaded", color: "#8b8e97", has: (o) => o === 5},
  {name: "passed, and wrote only its depth", color: "#5f6b7a", has: (o) => o === 6},
  {name: "shaded", color: "#2f7d32", has: (o) => o === 7},
  {name: "blended or kept as a layer", color: "#1976d2", has: (o) => o >= 8},
];
const fateOf = (outcome) => FATES.find((f) => f.has(outcome));
const passes = (outcome) => outcome >= 5 && outcome <= 8;

// The fragments of the visible sample, as the first index of each triangle in `rows`, and the rows.
function tileRows() {
  const f = FRAME.tile, rows = [], first = [];
  for (let i = 0; i < f.triangle.length; ++i) {
    if (f.sample[i] !== SAMPLE) continue;
    while (first.length <= f.triangle[i]) first.push(rows.length);
    rows.push(i);
  }
  while (first.length <= STEPS.triangles.length) first.push(rows.length);
  return {rows, first};
}

// Returns the depth and the color of each pixel of the tile after the first `count` rows.
function tileAfter(rows, count) {
  const f = FRAME.tile, depth = new Float32Array(TILE_W * TILE_H), color = Array.from({length: TILE_W * TILE_H}, () => STEPS.clear);
  for (const i of rows.slice(0, count)) {
    const at = f.y[i] * TILE_W + f.x[i], outcome = f.outcome[i];
    if (passes(outcome) && STEPS.triangles[f.triangle[i]].writes_depth) depth[at] = f.depth[i];
    if (outcome === 7 || outcome === 8) color[at] = [f.red[i], f.green[i], f.blue[i]];
    else if (outcome === 5) color[at] = null;
  }
  return {depth, color};
}

// Paints the pixels of the tile into a canvas. colorOf(index) returns a CSS color, or null.
const CELL = 6;
function tileCanvas(label) {
  const {canvas, pen} = canvasFigure(TILE_W * CELL, TILE_H * CELL, label);
  const paint = (colorOf) => {
    pen.clearRect(0, 0, canvas.width, canvas.height);
    for (let y = 0; y < TILE_H; ++y) for (let x = 0; x < TILE_W; ++x) {
      const color = colorOf(y * TILE_W + x);
      if (color === null) continue;
      pen.fillStyle = color;
      pen.fillRect(x * CELL, (TILE_H - 1 - y) * CELL, CELL, CELL);
    }
  };
  return {canvas, pen, paint, box: el("div", {class: "stage"}, el("div", {class: "panel-name"}, label), canvas)};
}

const stepping = {triangle: EX === null ? 0 : Math.max(0, STEPS.triangles.findIndex((t) => t.draw === EX.draw && t.instance === EX.instance && t.primitive === EX.primitive)), pixel: -1};

// A slider with buttons. change(n) is called with the new value.
function slider(name, change) {
  const range = el("input", {type: "range", min: 0, value: 0, "aria-label": name, title: `Select a ${name} (keys ← and →)`, oninput: () => drawStep(() => change(Number(range.value)))}), output = el("output");
  const by = (n) => () => change(Math.min(Number(range.max), Math.max(0, Number(range.value) + n)));
  const element = el("div", {class: "stepper"}, el("span", {}, name), el("button", {type: "button", "aria-label": `Previous ${name}`, title: `Previous ${name} (key ← in the slider)`, onclick: by(-1)}, "−"), range, el("button", {type: "button", "aria-label": `Next ${name}`, title: `Next ${name} (key → in the slider)`, onclick: by(1)}, "+"), output);
  return {element, set: (value, count) => { range.max = Math.max(0, count - 1); range.value = value; output.textContent = `${fmt(count === 0 ? 0 : value + 1)} / ${fmt(count)}`; }};
}

function fragmentText(i) {
  const f = FRAME.tile, t = STEPS.triangles[f.triangle[i]], [x, y] = [TILE_X + f.x[i], TILE_Y + f.y[i]];
  const edges = t.edges ? edgesOf(t).map((e, k) => `E${k} = ${fmt(edgeAt(e, sampleX(x), sampleY(y)))} ≥ ${e.bias}`).join(" · ") + " → covered. " : "";
  const rejected = f.outcome[i] <= 1, compared = Number.isNaN(f.stored[i]) ? "Its depth was not compared. " : rejected ? `Farthest depth there: ${fmt(f.stored[i], 9)}. ` : `Stored depth: ${fmt(f.stored[i], 9)}. `;
  return `pixel ${px([x, H - 1 - y])}: ${edges}Depth ${fmt(f.depth[i], 9)}. ${compared}<b>${capital(HISTORY.outcomes[f.outcome[i]])}.</b>`;
}

function tileStepper() {
  const status = el("div", {class: "readout", "aria-live": "polite"}, "Loading the fragments …"), legendBox = el("div", {class: "outcomes"});
  const panels = [tileCanvas("this triangle"), tileCanvas("depth so far"), tileCanvas("color so far")];
  let tile = null;
  const count = () => tile.first[stepping.triangle + 1] - tile.first[stepping.triangle];
  const triangles = slider("triangle", (n) => { stepping.triangle = n; stepping.pixel = count() - 1; show(); });
  const pixels = slider("pixel", (n) => { stepping.pixel = n; show(); });
  const show = () => {
    const from = tile.first[stepping.triangle], own = tile.rows.slice(from, from + stepping.pixel + 1), f = FRAME.tile, t = STEPS.triangles[stepping.triangle];
    const after = tileAfter(tile.rows, from + own.length), fates = new Map(own.map((i) => [f.y[i] * TILE_W + f.x[i], fateOf(f.outcome[i])]));
    panels[0].paint((at) => (fates.has(at) ? fates.get(at).color : null));
    panels[1].paint((at) => (after.depth[at] > 0 ? depthHeat(after.depth[at]) : null));
    panels[2].paint((at) => (after.color[at] === null ? css("--faded") : `rgb(${after.color[at].join(" ")})`));
    for (const p of panels) markStep(p.pen, t, own.length > 0 ? own[own.length - 1] : null);
    triangles.set(stepping.triangle, STEPS.triangles.length);
    pixels.set(Math.max(0, stepping.pixel), count());
    status.innerHTML = `${capital(primitiveName(t))} of <i>${objectOf(t)}</i>. ${own.length > 0 ? fragmentText(own[own.length - 1]) : `It covers no pixel of the tile${DATA.samples > 1 ? ` at sample ${SAMPLE}` : ""}.`}`;
    const all = tile.rows.slice(from, from + count());
    legendBox.replaceChildren(...FATES.map((fate) => [fate, all.filter((i) => fate.has(f.outcome[i])).length]).filter(([, n]) => n > 0).map(([fate, n]) => el("span", {}, el("span", {class: "swatch", style: `background: ${fate.color}`}), `${fmt(n)} ${fate.name}`)));
  };
  unpackTile().then(() => {
    tile = tileRows();
    stepping.triangle = Math.min(stepping.triangle, STEPS.triangles.length - 1);
    if (stepping.pixel < 0) stepping.pixel = count() - 1;
    show();
  });
  return [el("div", {class: "tile-panels"}, ...panels.map((p) => p.box)), triangles.element, pixels.element, legendBox, status];
}

// Draws the outline of the triangle and the frame of the current pixel.
function markStep(pen, t, i) {
  const to = (x, y) => [(x / SUB - TILE_X) * CELL, (TILE_H - (y / SUB - TILE_Y)) * CELL];
  if (t.edges) polygon(pen, t.x.map((x, k) => to(x, t.y[k])), {stroke: css("--ink"), width: 1.5});
  if (i === null) return;
  const f = FRAME.tile, at = [f.x[i] * CELL, (TILE_H - 1 - f.y[i]) * CELL];
  for (const [color, grow] of [["#000", 1.5], ["#fff", 0.5]]) {
    pen.strokeStyle = color;
    pen.lineWidth = 1;
    pen.strokeRect(at[0] - grow, at[1] - grow, CELL + 2 * grow, CELL + 2 * grow);
  }
}

// Says that the steps end before the tile is complete.
const cutNote = () => (STEPS.left_out === 0 ? "" : ` To keep the page small, the steps end after ${plural(STEPS.triangles.length, "primitive")} with ${plural(STEPS.fragments.count, "fragment")}; the tile has ${fmt(STEPS.triangles_left_out)} more with ${plural(STEPS.left_out, "fragment")}.`);

chapter({
  id: "stepping", title: "A tile, step by step", kicker: "Tiles",
  lead: () => "The tile of the example pixel is drawn again, triangle by triangle and pixel by pixel, with the values that were recorded while the renderer drew the frame.",
  absent: () => (STEPS.triangles.length === 0 ? `Nothing is drawn in the tile of the example pixel. A frame with triangles: ${command("halfspace explain pipeline")}.` : null),
  input: () => [`${plural(STEPS.triangles.length, "primitive")} with a fragment in the tile, in submission order`],
  output: () => [plural(STEPS.fragments.count, "recorded fragment")],
  steps: () => [{name: "The steps", caption: `The sliders select a triangle of the tile and one of its pixels, row by row from the bottom; the panels show the tile after this step${DATA.samples > 1 ? `, at sample ${SAMPLE} of each pixel` : ""}. The first panel shows what became of the fragments of this triangle, in the colors of the list below it; the second the stored depths, where bright is near; the third the colors. A frame marks the last pixel. The renderer shades opaque surfaces when the visible triangle of each sample is known. A fragment that passed, and was hidden before it was shaded, never got a color; it is gray in the third panel. Transparent layers are blended after the last step, so the third panel does not contain them.${cutNote()}`, draw: tileStepper}],
  related: ["coverage", "depth", "history"], lessons: ["Depth"],
  exercises: () => [
    {ask: "How many samples would this tile have with 16 samples per pixel?", answer: TILE_W * TILE_H * 16, hint: "Multiply its width, its height and the number of samples per pixel.", why: `${TILE_W} · ${TILE_H} · 16.`},
    {ask: "How many fragments does a sample of this tile have on average, among those that the page recorded?", answer: STEPS.fragments.count / (TILE_W * TILE_H * DATA.samples), decimals: 2, hint: "See “Output”, and divide.", why: `${fmt(STEPS.fragments.count)} / ${fmt(TILE_W * TILE_H * DATA.samples)}.`},
    {ask: "Five opaque triangles overlap at a pixel and are drawn from the farthest to the nearest. How many of the five fragments pass the depth test?", answer: 5, hint: "Compare each of them with the depth that is stored before it.", why: "Each is nearer than the one before it. All but the last one are hidden before they are shaded."},
  ],
});
