// From linear light to pixel values: tone curve, sRGB, samples and transparent layers.

const TONE = DATA.tone;

function histogramPicture() {
  const list = TONE.histogram, first = list.findIndex((n) => n > 0), last = list.length - 1 - [...list].reverse().findIndex((n) => n > 0);
  if (first < 0) return el("div", {class: "stage"}, svgFigure(720, 60, "All pixels are black", svg("text", {x: 360, y: 35, "text-anchor": "middle", "font-size": 15}, document.createTextNode("All pixels are black."))));
  const from = Math.max(0, first - 4), shown = list.slice(from, last + 5);
  const label = (bin) => (bin % (TONE.bins * 2) === 0 ? stopName(TONE.low + bin / TONE.bins) : undefined);
  return bars(shown.map((value, i) => ({value, name: binName(from + i), label: label(from + i), marked: isExampleBin(from + i)})), `Histogram of the luminance of all pixels, with ${TONE.bins} bars per stop`, {unit: " pixels"});
}
// A stop has TONE.bins bins of equal width.
const binLow = (bin) => 2 ** (TONE.low + Math.floor(bin / TONE.bins)) * (1 + bin % TONE.bins / TONE.bins);
const binName = (bin) => `luminance from ${fmt(binLow(bin), 4)} to ${fmt(binLow(bin + 1), 4)}`;
const stopName = (s) => (s < 0 ? (s < -6 ? `2^${s}` : `1/${2 ** -s}`) : String(2 ** s));
function isExampleBin(bin) {
  const y = mean3(TONE.pixel.light), exponent = Math.floor(Math.log2(y));
  return y > 0 && (exponent - TONE.low) * TONE.bins + Math.floor((y / 2 ** exponent - 1) * TONE.bins) === bin;
}

function curvePicture() {
  const width = 720, height = 380, root = svgFigure(width, height, `The tone curve ${TONE.curve}: light to the right on a logarithmic axis, display light from 0 to 1 upwards`);
  const list = TONE.points.filter(([x]) => x * TONE.exposure > 2 ** -9 && x * TONE.exposure < 2 ** 7), [a, b] = [Math.log2(list[0][0]), Math.log2(list[list.length - 1][0])];
  const to = ([x, y]) => [50 + (Math.log2(x) - a) / (b - a) * (width - 70), height - 40 - y * (height - 70)];
  for (const y of [0, 0.5, 1]) { const p = to([list[0][0], y])[1]; root.append(svg("line", {x1: 50, x2: width - 20, y1: p, y2: p, stroke: "var(--line)"}), svg("text", {x: 42, y: p + 5, "font-size": 13, "text-anchor": "end"}, document.createTextNode(String(y)))); }
  for (let s = Math.ceil(a); s <= b; s += 2) root.append(svg("text", {x: to([2 ** s, 0])[0], y: height - 14, "font-size": 13, "text-anchor": "middle"}, document.createTextNode(stopName(s))));
  root.append(svg("polyline", {points: list.map((p) => to(p).map((v) => v.toFixed(1)).join(",")).join(" "), fill: "none", stroke: "var(--accent)", "stroke-width": 2.5}));
  TONE.pixel.light.forEach((x, k) => { if (x < list[0][0] || x > list[list.length - 1][0]) return; const [px, py] = to([x, TONE.pixel.display[k]]); root.append(svg("circle", {cx: px, cy: py, r: 6, fill: ["#d33", "#2a2", "#36f"][k], stroke: "var(--paper)", "stroke-width": 1.5})); });
  return el("div", {class: "stage"}, root);
}

chapter({
  id: "tone", title: "High dynamic range and tone curve", kicker: "Output",
  lead: () => (TONE.hdr ? "Light has no upper limit, but the brightness of a display does. The exposure scales the light, and the tone curve maps it to the range from 0 to 1." : "This scene is displayed without a tone curve: light above 1 is clamped. The histogram shows how many pixels this affects."),
  input: () => ["linear light per pixel"],
  output: () => ["display light from 0 to 1"],
  steps: () => [
    {name: "Histogram of the light", caption: `The luminance of all pixels, with ${TONE.bins} bars per stop. ${fmt(TONE.dark)} pixels are darker than 2<sup>${TONE.low}</sup>. The bar that contains the example pixel is highlighted.`, draw: histogramPicture},
    {name: "Tone curve", caption: `${TONE.curve === "none" ? "Without a curve, values are only clamped to 1. The line looks curved because the horizontal axis is logarithmic." : `The tone curve <i>${TONE.curve}</i>.`} The dots are red, green and blue of the example pixel.`, draw: curvePicture},
  ],
  formula: () => {
    const p = TONE.pixel;
    const exposure = TONE.auto ? `exposure = key / mean = ${fmt(TONE.key)} / ${fmt(TONE.log_average, 6)} → <b>${fmt(TONE.exposure, 7)}</b>\n(mean: the geometric mean of the luminance of all pixels)\n\n` : `exposure = ${fmt(TONE.exposure, 7)}\n\n`;
    return [`${exposure}at pixel (${PIXEL}):\n\nlight      ${p.light.map((v) => fmt(v, 6).padStart(12)).join("")}\n· exposure ${p.exposed.map((v) => fmt(v, 6).padStart(12)).join("")}\ncurve      <b>${p.display.map((v) => fmt(v, 6).padStart(12)).join("")}</b>`];
  },
  exercises: () => [
    {ask: "What is the exposure of this frame? (Three significant digits.)", answer: TONE.exposure, tolerance: TONE.exposure * 0.006, hint: "See the formula.", why: TONE.auto ? "It was computed from the luminance of the frame." : "It is a constant of the scene."},
    {ask: "If the exposure is increased by one stop, by what factor does the light increase?", answer: 2, hint: "Stops are powers of two.", why: "A stop doubles the light."},
    {ask: "How many pixels are too dark for the histogram?", answer: TONE.dark, hint: "See the caption of the histogram.", why: `Their luminance is below 2<sup>${TONE.low}</sup>.`},
  ],
});

// ---- sRGB -----------------------------------------------------------------------------------------------------------------

const encodeSrgb = (x) => (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055);
function srgbPicture() {
  const width = 720, height = 400, root = svgFigure(width, height, "The sRGB curve: linear light to the right, encoded value up"), to = (x, y) => [50 + x * (width - 70), height - 40 - y * (height - 60)];
  root.append(svg("polyline", {points: Array.from({length: 129}, (_, i) => to(i / 128, i / 128).join(",")).join(" "), fill: "none", stroke: "var(--line)"}));
  root.append(svg("polyline", {points: Array.from({length: 257}, (_, i) => to((i / 256) ** 2, encodeSrgb((i / 256) ** 2)).join(",")).join(" "), fill: "none", stroke: "var(--accent)", "stroke-width": 2.5}));
  TONE.pixel.display.forEach((x, k) => { const [a, b] = to(x, TONE.pixel.encoded[k]); root.append(svg("circle", {cx: a, cy: b, r: 6, fill: ["#d33", "#2a2", "#36f"][k], stroke: "var(--paper)", "stroke-width": 1.5})); });
  for (const v of [0, 0.5, 1]) root.append(svg("text", {x: to(v, 0)[0], y: height - 14, "font-size": 13, "text-anchor": "middle"}, document.createTextNode(String(v))), svg("text", {x: 42, y: to(0, v)[1] + 5, "font-size": 13, "text-anchor": "end"}, document.createTextNode(String(v))));
  return el("div", {class: "stage"}, root);
}
function rampPicture() {
  const root = svgFigure(720, 200, "Two gray ramps: equal steps of linear light above, equal steps of the encoded value below");
  for (let i = 0; i < 16; ++i) for (const [row, code] of [encodeSrgb(i / 15), i / 15].entries()) root.append(svg("rect", {x: 20 + i * 42.5, y: 20 + row * 85, width: 42, height: 75, fill: `rgb(${[0, 1, 2].map(() => Math.round(code * 255)).join(" ")})`}));
  return el("div", {class: "stage"}, root);
}

chapter({
  id: "srgb", title: "Encoding as sRGB", kicker: "Output",
  lead: () => "The eye distinguishes dark shades much better than bright ones. The sRGB curve therefore assigns more of the 256 values to dark shades.",
  input: () => ["display light from 0 to 1"],
  output: () => ["three 8-bit values from 0 to 255"],
  steps: () => [
    {name: "The curve", caption: "Close to 0, the curve is a straight line; beyond that, it is a power function with the exponent 1/2.4. The dots are red, green and blue of the example pixel.", draw: srgbPicture},
    {name: "Equal steps", caption: "Above: 16 equal steps of linear light, most of which look almost white. Below: 16 equal steps of the encoded value, which look evenly spaced.", draw: rampPicture},
  ],
  formula: () => [`${TONE.gamma ? `encoded = x<sup>1/${fmt(TONE.gamma)}</sup>` : "encoded = 12.92 x                   if x ≤ 0.0031308\n          1.055 x<sup>1/2.4</sup> − 0.055      otherwise"}\nvalue   = round(255 · encoded)\n\nat pixel (${PIXEL}):\n\n${["red", "green", "blue"].map((n, k) => `${n.padEnd(6)} ${fmt(TONE.pixel.display[k], 6).padStart(10)} → ${fmt(TONE.pixel.encoded[k], 6).padStart(10)} → <b>${TONE.pixel.code[k]}</b>`).join("\n")}${TONE.dither ? "\n\nThis scene is dithered: a pattern determines whether values are rounded up or down." : ""}`],
  exercises: () => [
    {ask: "What is the 8-bit value of the example pixel's green channel?", answer: TONE.pixel.code[1], tolerance: TONE.dither ? 1 : 0, hint: "See the last column of the second row.", why: TONE.dither ? "Rounded up or down by the dither pattern." : "Rounded to the nearest integer."},
    {ask: "What 8-bit sRGB value encodes a linear value of 0.5?", answer: Math.round(encodeSrgb(0.5) * 255), hint: "1.055 · 0.5^(1/2.4) − 0.055, times 255.", why: "The darker half of the range uses about three quarters of the values."},
    {ask: "What linear value does the 8-bit sRGB value 128 encode? (Two decimal places.)", answer: ((128 / 255 + 0.055) / 1.055) ** 2.4, tolerance: 0.0051, hint: "Invert the formula.", why: "The value 128 encodes about a fifth of the light of the value 255."},
  ],
});

// ---- samples and layers -------------------------------------------------------------------------------------------------------

function patternPicture() {
  const size = 360, root = svgFigure(size + 20, size + 20, "Positions of the samples in a pixel");
  for (let i = 0; i <= 16; ++i) root.append(svg("path", {d: `M${10 + i * size / 16} 10 v${size} M10 ${10 + i * size / 16} h${size}`, stroke: "var(--line)", "stroke-width": i % 8 ? 0.6 : 1.4}));
  DATA.sample_positions.forEach(([x, y], i) => { const [a, b] = [10 + x / 256 * size, 10 + size - y / 256 * size]; root.append(svg("circle", {cx: a, cy: b, r: 9, fill: "var(--accent)"}), svg("text", {x: a + 13, y: b + 5, "font-size": 15}, document.createTextNode(String(i)))); });
  root.style.maxWidth = "420px";
  return el("div", {class: "stage"}, root);
}

// Draws the coverage of the samples around the example pixel.
function sampleCoverage() {
  const [x0, y0] = WINDOW.map(blockOf), list = DATA.sample_positions, hits = (x, y) => list.filter(([sx, sy]) => inside(TRI, x * SUB + sx, y * SUB + sy)).length;
  const g = gridPicture(x0, y0, 8, 8, "The fraction of covered samples of each pixel", (x, y) => ({fill: "var(--accent)", opacity: hits(x, y) / list.length * 0.8}));
  for (let y = y0; y < y0 + 8; ++y) for (let x = x0; x < x0 + 8; ++x) for (const [sx, sy] of list) { const [a, b] = g.to(x * SUB + sx, y * SUB + sy); g.root.append(svg("circle", {cx: a, cy: b, r: 2.6, fill: inside(TRI, x * SUB + sx, y * SUB + sy) ? "var(--ink)" : "var(--soft)"})); }
  return el("div", {class: "stage"}, g.root);
}

chapter({
  id: "samples", title: "Samples and resolve", kicker: "Output",
  lead: () => "With several samples per pixel, coverage and depth are computed for each sample. At the end, the color of a pixel is the mean of its samples, which makes edges look smooth.",
  absent: () => (DATA.samples === 1 ? `This frame has one sample per pixel, at its center. The same frame with four samples per pixel: ${command(`${DATA.command} --set samples=4`)}.` : null),
  input: () => [`${DATA.samples} samples per pixel`],
  output: () => ["one color per pixel"],
  steps: () => [
    {name: "Sample positions", caption: "No two samples are in the same row or column of the grid, so that nearly horizontal and nearly vertical edges get as many steps as possible.", draw: patternPicture},
    ...(isTriangle ? [{name: "Coverage", caption: "The block of the example pixel. The stronger the color of a pixel, the more of its samples the example triangle covers.", draw: sampleCoverage}] : []),
  ],
  formula: () => [`color = (s<sub>0</sub> + … + s<sub>${DATA.samples - 1}</sub>) / ${DATA.samples}`],
  exercises: () => [
    {ask: "A white triangle covers one sample of a black pixel. What is the pixel's light, from 0 to 1?", answer: 1 / DATA.samples, tolerance: 1e-9, hint: "Compute the mean of all samples.", why: `1 / ${DATA.samples}.`},
    {ask: "How many samples does the whole frame have?", answer: W * H * DATA.samples, hint: "Multiply the number of pixels by the number of samples per pixel.", why: `${W} · ${H} · ${DATA.samples}.`},
    {ask: "How many different shades can the pixels at the edge of a white triangle on a black background have, including black and white?", answer: DATA.samples + 1, hint: "How many samples can be covered?", why: `From 0 to ${DATA.samples} samples can be covered.`},
  ],
});

const LAYERED = DATA.draws.filter((d) => d.layered);
chapter({
  id: "layers", title: "Transparent layers", kicker: "Output",
  lead: () => "Transparent surfaces do not hide what is behind them, so they must be blended in the right order. Each sample keeps the fragments of transparent surfaces as layers, sorted by depth. When all layers are known, they are blended from the farthest to the nearest.",
  absent: () => (LAYERED.length === 0 ? `No surface of this frame is transparent. The floor that receives the shadow of a model file is a transparent layer: ${command("halfspace explain MODEL")} with any .glb, .gltf, .obj, .ply or .stl file.` : null),
  input: () => [plural(LAYERED.length, "transparent draw")],
  output: () => [`${plural(DATA.statistics.layers_merged, "merge")} of the two farthest layers of a sample (a sample can store 8 layers)`],
  steps: () => [{name: "Transparent draws", caption: `These objects are blended over the opaque picture: ${LAYERED.map((d) => `<i>${escapeHtml(d.object)}</i>`).join(", ")}.`, draw: () => picture(DATA.pictures.final, "The picture with its transparent surfaces", {overlay: (pen, s) => ring(pen, s, PIXEL)})}],
  formula: () => ["for each layer, from the farthest to the nearest:\n\ncolor = α · layer + (1 − α) · color"],
  exercises: () => [
    {ask: "A white layer with α = 0.25 is blended over black. What is the resulting light value?", answer: 0.25, tolerance: 1e-9, hint: "α · 1 + (1 − α) · 0.", why: "0.25 · 1 + 0.75 · 0."},
    {ask: "A second white layer with α = 0.25 is blended over the result. What is the light value now?", answer: 0.4375, tolerance: 1e-9, hint: "0.25 + 0.75 · 0.25.", why: "0.25 · 1 + 0.75 · 0.25."},
    {ask: "How many draws of this frame are transparent?", answer: LAYERED.length, hint: "See “Input”.", why: "They are drawn after all opaque draws."},
  ],
});
