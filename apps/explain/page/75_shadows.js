// The shadow map: how it looks from the light, and one lookup with the weights of its texels.

const SHADOW = DATA.shadow, LOOK = SHADOW && SHADOW.lookup && SHADOW.lookup.view >= 0 ? SHADOW.lookup : null;

function mapPicture() {
  const {canvas, pen} = canvasFigure(512, 512, "The shadow map: the depth of the scene, seen from the light"), box = el("div", {class: "stage"}, canvas);
  canvas.style.maxWidth = "512px";
  withImage(SHADOW.map, (image) => {
    pen.imageSmoothingEnabled = false;
    pen.drawImage(image, 0, 0, 512, 512);
    if (LOOK) ring(pen, 1, [LOOK.x / SHADOW.size * 512, 512 - LOOK.y / SHADOW.size * 512], 22);
  });
  if (LOOK) canvas.dataset.ring = SHADOW.pixel.join();
  return addLoupe(box, canvas, 512, 512);
}

// How the pixel of the lookup was chosen if it is not the example pixel.
const nearestPixel = () => (LOOK.factor > 0 && LOOK.factor < 1 ? "a pixel near the example pixel that is partially in shadow" : "a pixel near the example pixel that the map covers");

// The weights of the texels in the filter, or null if the page has none.
const WEIGHTS = LOOK && LOOK.weights;
const texelName = (k) => `(${LOOK.i + k % LOOK.side - (LOOK.side - 1) / 2}, ${LOOK.j + Math.floor(k / LOOK.side) - (LOOK.side - 1) / 2})`;
const readTexels = () => [...LOOK.lit.keys()].filter((k) => WEIGHTS[k] > 0);
const weightedSum = () => LOOK.lit.reduce((sum, lit, k) => sum + WEIGHTS[k] * lit, 0);
const percentOf = (w) => (100 * w < 0.1 ? "<0.1" : fmt(100 * w, 2));
// Says why texels have no weights.
const NO_WEIGHTS = {
  pcss: "With the filter pcss, texels have no fixed weights: how much of the light a texel hides depends on its depth.",
  vsm: "Texels have no weights, because the filter vsm does not compare them one by one: it estimates the factor from the means of their depths and of the squares of their depths.",
  moments: "Texels have no weights, because the filter moments does not compare them one by one: it estimates the factor from the means of four powers of their depths.",
};
const noWeights = () => NO_WEIGHTS[SHADOW.filter] || `The filter ${SHADOW.filter} also reads texels outside this picture, so that their weights are not shown.`;

function weightsText() {
  if (!WEIGHTS) return noWeights();
  const read = readTexels(), hidden = read.filter((k) => !LOOK.lit[k]).length;
  return `The numbers are the weights in the filter ${SHADOW.filter}, in percent; pale texels have none. Of the ${plural(read.length, "texel")} with a weight, ${fmt(hidden)} ${hidden === 1 ? "occludes" : "occlude"} the point.`;
}

// How the factor follows from the result of the filter: empty if they are the same.
const fadeFormula = (filtered) => (LOOK.terminator === 1 ? "" : `${say("The light also fades, because the shading normal faces the light more than the smooth surface does:")}factor = filter · fade = ${fmt(filtered, 6)} · ${fmt(LOOK.terminator, 6)} = <b>${fmt(filtered * LOOK.terminator, 6)}</b>`);

// The sum of the filter, one line per row of texels.
function weightFormula() {
  const n = LOOK.side, read = readTexels(), ordered = (list) => [...new Set(list)].sort((a, b) => a - b);
  const columns = ordered(read.map((k) => k % n)), rows = ordered(read.map((k) => Math.floor(k / n))).reverse();
  const cell = (k) => (WEIGHTS[k] === 0 ? "" : LOOK.lit[k] ? `${WEIGHTS[k].toFixed(5)} ` : `(${WEIGHTS[k].toFixed(5)})`).padStart(10);
  const lines = rows.map((r) => `row ${LOOK.j + r - (n - 1) / 2}`.padEnd(9) + columns.map((c) => cell(r * n + c)).join("") + `  = ${columns.reduce((sum, c) => sum + WEIGHTS[r * n + c] * LOOK.lit[r * n + c], 0).toFixed(5)}`);
  return `filter = sum of weight · lit\n\n${say("The weights of the texels, row by row from the top. Those of texels that occlude the point are in parentheses: there, lit is 0. The weights add up to 1.")}${lines.join("\n")}\n\nsum of the rows = <b>${fmt(weightedSum(), 6)}</b>${fadeFormula(weightedSum())}${say(`The renderer computed the factor ${fmt(LOOK.factor, 6)} in floats.`)}`;
}

function lookupPicture() {
  const n = LOOK.side, reach = (n - 1) / 2, isPale = (k) => WEIGHTS && WEIGHTS[k] === 0, opacity = (k) => (LOOK.lit[k] ? (isPale(k) ? 0.45 : 1) : isPale(k) ? 0.22 : 0.5);
  const g = gridPicture(0, 0, n, n, `The texels around the point; gray texels occlude it${WEIGHTS ? ". The numbers are their weights in percent" : ""}`, (x, y) => ({fill: LOOK.lit[y * n + x] ? "var(--accent-soft)" : "var(--soft)", opacity: opacity(y * n + x)}));
  const [px, py] = g.to((LOOK.x - LOOK.i + reach) * SUB, (LOOK.y - LOOK.j + reach) * SUB);
  g.root.append(svg("circle", {cx: px, cy: py, r: 6, fill: "var(--accent)", stroke: "var(--ink)", "stroke-width": 1.5}));
  const readout = el("div", {class: "readout", "aria-live": "polite"}, "Point at a texel to read its values, or focus the picture and press the arrow keys.");
  if (WEIGHTS) for (const k of readTexels()) {
    const [a, b] = g.to((k % n + 0.5) * SUB, (Math.floor(k / n) + 0.5) * SUB), size = narrowWindow.matches ? 11 : 12, aside = k === (n * n - 1) / 2 ? (py < b ? 9 : -9) : 0;  // not under the dot
    g.root.append(svg("text", {x: a, y: b + 4 + aside, "font-size": size, "text-anchor": "middle"}, document.createTextNode(percentOf(WEIGHTS[k]))));
  }
  const weightOf = (k) => (!WEIGHTS ? "" : WEIGHTS[k] === 0 ? ". The filter gives it no weight." : `. Weight · lit = ${fmt(WEIGHTS[k], 5)} · ${LOOK.lit[k]} = ${fmt(WEIGHTS[k] * LOOK.lit[k], 5)}`);
  const show = (x, y) => { const k = y * n + x; readout.textContent = `texel ${texelName(k)}: depth ${fmt(LOOK.texels[k], 9)} → ${LOOK.lit[k] ? "does not occlude" : "occludes"}${weightOf(k)}`; };
  for (let y = 0; y < n; ++y) for (let x = 0; x < n; ++x) {
    const [a, b] = g.to(x * SUB, (y + 1) * SUB), hit = svg("rect", {x: a, y: b, width: g.size, height: g.size, fill: "transparent"});
    hit.addEventListener("pointermove", () => show(x, y));
    g.root.append(hit);
  }
  pickable(g.root, n, n, [reach, reach], (x, y) => show(x, n - 1 - y));
  return [el("div", {class: "stage"}, g.root), readout];
}

// Asks for the factor after the occluding texel with the largest weight has become lit or, if there is none, after a lit one occludes.
function changedTexel() {
  const read = readTexels(), hidden = read.filter((k) => !LOOK.lit[k]), isLit = hidden.length === 0;
  const k = (isLit ? read : hidden).reduce((best, other) => (WEIGHTS[other] > WEIGHTS[best] ? other : best)), change = WEIGHTS[k] * LOOK.terminator * (isLit ? -1 : 1);
  return {ask: `Texel ${texelName(k)} has the weight ${num(WEIGHTS[k], 5)}, and ${isLit ? "does not occlude" : "occludes"} the point. What would the shadow factor be if it ${isLit ? "did" : "did not"}?`, answer: LOOK.factor + change, decimals: 3, tolerance: 0.0006, hint: "Only one term of the sum of the filter changes.", why: `${fmt(LOOK.factor, 5)} ${isLit ? "−" : "+"} ${fmt(Math.abs(change), 5)}.`};
}

chapter({
  id: "shadows", title: "Shadow map", kicker: "Shading",
  lead: () => "Before the picture is rendered, the scene is rendered as seen from the light, and only depth is stored. The result is the shadow map. A point is in shadow if the map contains something nearer to the light at the same position.",
  absent: () => (SHADOW === null ? `No light of this frame casts shadows. A frame with shadows: ${command("halfspace explain pipeline")}.` : null),
  input: () => [`${SHADOW.views > 1 ? `${SHADOW.views} maps` : "a map"} of ${SHADOW.size} × ${SHADOW.size} texels`, "the position of each pixel"],
  output: () => ["a factor from 0 (in shadow) to 1 (lit)", `filter: ${SHADOW.filter}`],
  steps: () => [
    {name: "Seen from the light", caption: `The shadow map of <i>${escapeHtml(SHADOW.light)}</i>${SHADOW.views > 1 ? `, view ${SHADOW.view + 1} of ${SHADOW.views}` : ""}. Bright texels are near the light, and black texels are empty.${LOOK ? ` The ring marks texel (${LOOK.i}, ${LOOK.j}), which pixel ${px(SHADOW.pixel)} reads.` : ""}`, draw: mapPicture},
    ...(LOOK ? [
      {name: "One pixel", caption: `Its shadow is looked up: the point that it shows is in texel (${LOOK.i}, ${LOOK.j}) of the map.${ringNote(SHADOW.pixel, nearestPixel())}`, draw: () => picture(DATA.pictures.final, "The picture, with a ring around the pixel whose shadow is looked up", {ringed: SHADOW.pixel})},
      {name: "The texels around the point", caption: `${LOOK.lit.every((l) => l) ? "Each square is a texel. None of them is nearer to the light than the plane of the surface, so none occludes the point." : "Each square is a texel. Gray texels are nearer to the light than the plane of the surface, so they occlude the point; the others do not."} The dot marks the point. ${weightsText()} The shadow factor is ${num(LOOK.factor, 5)}.`, draw: lookupPicture}] : []),
  ],
  formula: () => (LOOK ? [`texel (${LOOK.i}, ${LOOK.j}), point at (${fmt(LOOK.x, 7)}, ${fmt(LOOK.y, 7)}):\n\n<em>d</em> = depth + bias = ${fmt(LOOK.depth, 8)} + ${fmt(LOOK.biased - LOOK.depth, 4)} = ${fmt(LOOK.biased, 8)}\nplane: ${fmt(LOOK.dx, 4)} per texel to the right, ${fmt(LOOK.dy, 4)} up\n\n${say("lit = <em>d</em> + slope · distance to the center of the texel ≥ depth in the map")}map: ${fmt(LOOK.texels[(LOOK.side * LOOK.side - 1) / 2], 8)} → <b>${LOOK.lit[(LOOK.side * LOOK.side - 1) / 2] ? "lit" : "in shadow"}</b>      after the filter: <b>${fmt(LOOK.filtered, 6)}</b>`, ...(WEIGHTS ? [weightFormula()] : [fadeFormula(LOOK.filtered)].filter(Boolean))] : []),
  related: ["lighting", "depth"], lessons: ["Shadow map and bias"],
  exercises: () => {
    const texels = {ask: "How many texels does the map have?", answer: SHADOW.size ** 2, hint: "Square its width.", why: `${SHADOW.size} · ${SHADOW.size}.`};
    const ratio = {ask: "How many texels do all maps of the light have per pixel of the picture?", answer: SHADOW.size ** 2 * SHADOW.views / (W * H), decimals: 1, hint: "Divide by the number of pixels.", why: `${SHADOW.views} · ${SHADOW.size}² / (${W} · ${H}).`};
    const bytes = {ask: "How many bytes does the map have, with four bytes per texel?", answer: SHADOW.size ** 2 * 4, hint: "Multiply the number of texels by 4.", why: "Each texel stores one float."};
    const hidden = LOOK ? LOOK.lit.filter((l) => !l).length : 0;
    const count = {ask: "How many of the texels shown occlude the point?", answer: hidden, hint: `Count the gray ones; ${LOOK ? LOOK.lit.length : 0} texels are shown.`, why: "The depth of each texel is compared separately."};
    return [WEIGHTS && readTexels().length > 1 ? changedTexel() : texels, hidden > 1 ? count : bytes, ratio];
  },
});
