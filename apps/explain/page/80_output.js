// From linear light to pixel values: tone curve, sRGB, samples and transparent layers.

const TONE = DATA.tone;
TONE.highest = Math.max(...TONE.histogram);

function histogramPicture() {
  const list = TONE.histogram, first = list.findIndex((n) => n > 0), last = list.length - 1 - [...list].reverse().findIndex((n) => n > 0);
  if (first < 0) return el("div", {class: "stage"}, svgFigure(figureWidth(), 60, "All pixels are black", svg("text", {x: figureWidth() / 2, y: 35, "text-anchor": "middle", "font-size": 15}, document.createTextNode("All pixels are black."))));
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
  const width = figureWidth(), height = 380, root = svgFigure(width, height, `The tone curve ${TONE.curve}: light to the right on a logarithmic axis, display light from 0 to 1 upwards`);
  const list = TONE.points.filter(([x]) => x * TONE.exposure > 2 ** -9 && x * TONE.exposure < 2 ** 7), [a, b] = [Math.log2(list[0][0]), Math.log2(list[list.length - 1][0])];
  const to = ([x, y]) => [50 + (Math.log2(x) - a) / (b - a) * (width - 70), height - 40 - y * (height - 70)];
  for (const y of [0, 0.5, 1]) { const p = to([list[0][0], y])[1]; root.append(svg("line", {x1: 50, x2: width - 20, y1: p, y2: p, stroke: "var(--line)"}), svg("text", {x: 42, y: p + 5, "font-size": 13, "text-anchor": "end"}, document.createTextNode(String(y)))); }
  for (let s = Math.ceil(a); s <= b; s += narrowWindow.matches ? 4 : 2) root.append(svg("text", {x: to([2 ** s, 0])[0], y: height - 14, "font-size": 13, "text-anchor": "middle"}, document.createTextNode(stopName(s))));
  root.append(svg("polyline", {points: list.map((p) => to(p).map((v) => v.toFixed(1)).join(",")).join(" "), fill: "none", stroke: "var(--accent)", "stroke-width": 2.5}));
  TONE.pixel.light.forEach((x, k) => { if (x < list[0][0] || x > list[list.length - 1][0]) return; const [px, py] = to([x, TONE.pixel.display[k]]); root.append(svg("circle", {cx: px, cy: py, r: 6, fill: ["#d33", "#2a2", "#36f"][k], stroke: "var(--paper)", "stroke-width": 1.5})); });
  return el("div", {class: "stage"}, root);
}

// The formula of the tone curve.
const curveFormula = {none: "", reinhard: "curve(x) = x / (1 + x)\n", reinhard_extended: `curve(x) = x · (1 + x / ${fmt(TONE.white)}²) / (1 + x)\n`, exponential: "curve(x) = 1 − e<sup>−x</sup>\n", aces: "curve(x) = x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14)\n"}[TONE.curve] + (TONE.curve === "none" ? "" : "\n");

// How the colors of the samples became the light of the pixel.
function storageFormula() {
  const row = (name, v) => `${name.padEnd(11)}${v.slice(0, 3).map((x) => fmt(x, 6).padStart(12)).join("")}`;
  const rounding = TONE.is_8_bit ? `Rounding: a tile of this frame stores colors as ${TONE.stored_as}. A shaded color is encoded, rounded to a multiple of 1/255 and stored; this is the linear value of the stored color.` : `A tile of this frame stores colors as ${TONE.stored_as}, so a shaded color is rounded to this format.`;
  const one = `${say(`${rounding} At pixel ${px(PIXEL)}:`)}${row("stored", TONE.samples[0])}`;
  const many = `${say(`${rounding} The mean of the samples is rounded in the same way. At pixel ${px(PIXEL)}:`)}${TONE.samples.map((s, i) => row(`sample ${i}`, s)).join("\n")}\n${row("mean", meanSample())}\n<b>${row("resolved", TONE.pixel.light)}</b>`;
  return [DATA.samples === 1 ? one : many];
}
const meanSample = () => [0, 1, 2].map((k) => TONE.samples.reduce((n, s) => n + s[k], 0) / TONE.samples.length);

chapter({
  id: "tone", title: "High dynamic range and tone curve", kicker: "Output",
  lead: () => (TONE.hdr ? "Light has no upper limit, but the brightness of a display does. The exposure scales the light, and the tone curve maps it to the range from 0 to 1." : `This scene is displayed without a tone curve: light above 1 is clamped when it is stored. ${TONE.clamped === 0 ? "No pixel of this frame reaches 1." : `${plural(TONE.clamped, "pixel has", "pixels have")} the largest value in red, green or blue.`}`),
  input: () => [`linear light per pixel, stored as ${TONE.stored_as}`],
  output: () => ["display light from 0 to 1"],
  steps: () => [
    {name: "Histogram of the light", caption: `The luminance of all pixels: each bar is the number of pixels with a luminance in its range, from dark on the left to bright on the right, with ${TONE.bins} bars per stop. ${fmt(TONE.dark)} pixels are darker than 2<sup>${TONE.low}</sup>. The bar that contains the example pixel is highlighted.`, draw: histogramPicture},
    {name: "Tone curve", caption: `Light before exposure is to the right, on a logarithmic axis, and display light is up. ${TONE.curve === "none" ? "Without a curve, values are only clamped to 1; the line looks curved because of the axis." : `The tone curve <i>${TONE.curve}</i>.`} The dots are red, green and blue of the example pixel.`, draw: curvePicture},
  ],
  formula: () => {
    const p = TONE.pixel;
    const exposure = TONE.auto ? `exposure = key / mean = ${fmt(TONE.key)} / ${fmt(TONE.log_average, 6)} → <b>${fmt(TONE.exposure, 7)}</b>${say("mean: the geometric mean of the luminance of all pixels")}\n` : `exposure = ${fmt(TONE.exposure, 7)}\n\n`;
    return [...storageFormula(), `${exposure}${say(`at pixel ${px(PIXEL)}:`)}${curveFormula}light      ${p.light.map((v) => fmt(v, 6).padStart(12)).join("")}\n· exposure ${p.exposed.map((v) => fmt(v, 6).padStart(12)).join("")}\ncurve      <b>${p.display.map((v) => fmt(v, 6).padStart(12)).join("")}</b>`];
  },
  related: ["srgb", "lighting"], lessons: ["High dynamic range"],
  exercises: () => [
    TONE.exposure === 1 ? {ask: "Which exposure makes the light of a frame three stops brighter than the exposure 1?", answer: 8, hint: "A stop doubles the light.", why: "2 · 2 · 2."}
      : {ask: "By how many stops does the exposure of this frame change the light?", answer: Math.log2(TONE.exposure), decimals: 2, hint: "A stop doubles the light: take the logarithm to the base 2 of the exposure.", why: `log<sub>2</sub>(${fmt(TONE.exposure, 6)}).`},
    {ask: "The exposure is increased by one stop. What is the exposed light of the example pixel's green channel then?", answer: 2 * TONE.pixel.exposed[1], significant: 3, hint: "Double the second number in the row “· exposure”.", why: `2 · ${fmt(TONE.pixel.exposed[1], 6)}.`},
    TONE.highest > 0 ? {ask: "What percentage of the pixels is in the highest bar of the histogram?", answer: TONE.highest / (W * H) * 100, decimals: 1, hint: `Point at the bar. The frame has ${fmt(W * H)} pixels.`, why: `${fmt(TONE.highest)} of ${fmt(W * H)}.`}
      : {ask: "A histogram has 4 bars per stop. How many bars are between the luminances 1/8 and 4?", answer: 20, hint: "How many times does the luminance double?", why: "2<sup>5</sup> = 32, so that there are 5 stops."},
  ],
});

// ---- sRGB -----------------------------------------------------------------------------------------------------------------

// The encoding of the picture: sRGB or, if the scene selects it, a power function.
const encodeDisplay = (x) => (TONE.gamma ? x ** (1 / TONE.gamma) : encodeSrgb(x));
const decodeDisplay = (x) => (TONE.gamma ? x ** TONE.gamma : x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4);
const curveName = TONE.gamma ? `power function x^(1/${fmt(TONE.gamma)})` : "sRGB curve";
const encodeSrgb = (x) => (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055);
function srgbPicture() {
  const width = figureWidth(), height = 400, root = svgFigure(width, height, `The ${curveName}: linear light to the right, encoded value up`), to = (x, y) => [50 + x * (width - 70), height - 40 - y * (height - 60)];
  root.append(svg("polyline", {points: Array.from({length: 129}, (_, i) => to(i / 128, i / 128).join(",")).join(" "), fill: "none", stroke: "var(--line)"}));
  root.append(svg("polyline", {points: Array.from({length: 257}, (_, i) => to((i / 256) ** 2, encodeDisplay((i / 256) ** 2)).join(",")).join(" "), fill: "none", stroke: "var(--accent)", "stroke-width": 2.5}));
  TONE.pixel.display.forEach((x, k) => { const [a, b] = to(x, TONE.pixel.encoded[k]); root.append(svg("circle", {cx: a, cy: b, r: 6, fill: ["#d33", "#2a2", "#36f"][k], stroke: "var(--paper)", "stroke-width": 1.5})); });
  for (const v of [0, 0.5, 1]) root.append(svg("text", {x: to(v, 0)[0], y: height - 14, "font-size": 13, "text-anchor": "middle"}, document.createTextNode(String(v))), svg("text", {x: 42, y: to(0, v)[1] + 5, "font-size": 13, "text-anchor": "end"}, document.createTextNode(String(v))));
  return el("div", {class: "stage"}, root);
}
function rampPicture() {
  const width = figureWidth(), step = (width - 40) / 16, root = svgFigure(width, 200, "Two gray ramps: equal steps of linear light above, equal steps of the encoded value below");
  for (let i = 0; i < 16; ++i) for (const [row, code] of [encodeDisplay(i / 15), i / 15].entries()) root.append(svg("rect", {x: 20 + i * step, y: 20 + row * 85, width: step - 0.5, height: 75, fill: `rgb(${[0, 1, 2].map(() => Math.round(code * 255)).join(" ")})`}));
  return el("div", {class: "stage"}, root);
}

chapter({
  id: "srgb", title: "Encoding as sRGB", kicker: "Output",
  lead: () => "The eye distinguishes dark shades much better than bright ones. The sRGB curve therefore assigns more of the 256 values to dark shades.",
  input: () => ["display light from 0 to 1"],
  output: () => ["three 8-bit values from 0 to 255"],
  steps: () => [
    {name: "The curve", caption: `Linear light is to the right and the encoded value up, both from 0 to 1; the gray line is light that is not encoded. ${TONE.gamma ? `This scene is encoded with a power function with the exponent 1/${fmt(TONE.gamma)} instead of the sRGB curve.` : "Close to 0, the curve is a straight line; beyond that, it is a power function with the exponent 1/2.4."} The dots are red, green and blue of the example pixel.`, draw: srgbPicture},
    {name: "Equal steps", caption: "Above: 16 equal steps of linear light, most of which look almost white. Below: 16 equal steps of the encoded value, which look evenly spaced.", draw: rampPicture},
  ],
  formula: () => [`${TONE.gamma ? `encoded = x<sup>1/${fmt(TONE.gamma)}</sup>` : "encoded = 12.92 x                   if x ≤ 0.0031308\n          1.055 x<sup>1/2.4</sup> − 0.055      otherwise"}\nvalue   = round(255 · encoded)\n\n${say(`at pixel ${px(PIXEL)}:`)}${["red", "green", "blue"].map((n, k) => `${n.padEnd(6)} ${fmt(TONE.pixel.display[k], 6).padStart(10)} → ${fmt(TONE.pixel.encoded[k], 6).padStart(10)} → round(${fmt(255 * TONE.pixel.encoded[k], 6)}) = <b>${TONE.pixel.code[k]}</b>`).join("\n")}${say(TONE.dither ? "This scene is dithered: a pattern determines whether values are rounded up or down." : "This is the pixel of the picture.")}`],
  related: ["tone", "final"], lessons: ["High dynamic range"],
  exercises: () => {
    const code = (TONE.pixel.code[2] + 64) % 256;
    return [
      {ask: "What 8-bit value encodes a display light of 0.5?", answer: Math.round(encodeDisplay(0.5) * 255), hint: "Apply the formula, and multiply by 255.", why: `255 · ${fmt(encodeDisplay(0.5), 5)}, rounded. It is more than half of 255.`},
      {ask: "What 8-bit value encodes half of the display light of the example pixel's red channel?", answer: Math.round(encodeDisplay(TONE.pixel.display[0] / 2) * 255), tolerance: 1, hint: `Apply the formula to ${fmt(TONE.pixel.display[0] / 2, 6)}, and multiply by 255.`, why: `The full light is encoded as ${TONE.pixel.code[0]}.`},
      {ask: `What linear value does the 8-bit value ${code} encode?`, answer: decodeDisplay(code / 255), decimals: 3, hint: "Divide by 255, and invert the formula.", why: `The inverse of the ${curveName} at ${fmt(code / 255, 5)}.`},
    ];
  },
});

// ---- samples and layers -------------------------------------------------------------------------------------------------------

function patternPicture() {
  const size = 340, root = svgFigure(size + 20, size + 20, "Positions of the samples in a pixel");
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

const hasEqualSamples = () => TONE.samples.every((s) => s.slice(0, 3).join() === TONE.samples[0].slice(0, 3).join());
chapter({
  id: "samples", title: "Samples and resolve", kicker: "Output",
  lead: () => "With several samples per pixel, coverage and depth are computed for each sample. At the end, the color of a pixel is the mean of its samples, which makes edges look smooth.",
  absent: () => (DATA.samples === 1 ? `This frame has one sample per pixel, at its center. The same frame with four samples per pixel: ${command(`${DATA.command} --set samples=4`)}.` : null),
  input: () => [`${DATA.samples} samples per pixel`],
  output: () => ["one color per pixel"],
  steps: () => [
    {name: "Sample positions", caption: `The square is a pixel, and the numbered dots are the positions of its samples, on a grid of 16 × 16.${new Set(DATA.sample_positions.map((p) => p[0])).size === DATA.samples && new Set(DATA.sample_positions.map((p) => p[1])).size === DATA.samples ? " No two samples are in the same row or column, so that nearly horizontal and nearly vertical edges get as many steps as possible." : ""}`, draw: patternPicture},
    {name: "Colors of the samples", caption: `The block of the example pixel. Each sample is drawn with the color that the renderer stored for it. The outlined pixel is the example.`, draw: sampleColors},
    ...(isTriangle ? [{name: "Coverage", caption: "The block of the example pixel. The stronger the color of a pixel, the more of its samples the example triangle covers. Gray dots are samples that it does not cover.", draw: sampleCoverage}] : []),
  ],
  formula: () => [`color = (s<sub>0</sub> + … + s<sub>${DATA.samples - 1}</sub>) / ${DATA.samples}\n\n${say(`at pixel ${px(PIXEL)}, in linear light:`)}${["red", "green", "blue"].map((name, k) => `${name.padEnd(6)}(${TONE.samples.map((s) => fmt(s[k], 5)).join(" + ")}) / ${DATA.samples} = ${fmt(meanSample()[k], 6)} → <b>${fmt(TONE.pixel.light[k], 6)}</b>`).join("\n")}${say(`The last number is the mean, rounded to ${TONE.stored_as}.${hasEqualSamples() ? " All samples of this pixel have the same color, so the mean is that color." : ""}`)}`],
  related: ["coverage", "layers"], lessons: ["Antialiasing"],
  exercises: () => [
    {ask: `What would be the red light of pixel ${px(PIXEL)} if its sample 0 were black, before rounding to the format?`, answer: meanSample()[0] - TONE.samples[0][0] / DATA.samples, significant: 3, tolerance: 1e-4 * Math.abs(meanSample()[0]) + 1e-9, hint: "Compute the mean of all samples, with 0 for sample 0.", why: `The mean decreases by ${fmt(TONE.samples[0][0], 5)} / ${DATA.samples}.`},
    {ask: "How many samples does the whole frame have?", answer: W * H * DATA.samples, hint: "Multiply the number of pixels by the number of samples per pixel.", why: `${W} · ${H} · ${DATA.samples}.`},
    {ask: "How many different shades can the pixels at the edge of a white triangle on a black background have, including black and white?", answer: DATA.samples + 1, hint: "How many samples can be covered?", why: `From 0 to ${DATA.samples} samples can be covered.`},
  ],
});

// Draws the stored colors of the samples around the example pixel. Each sample is a dot at its position.
function sampleColors() {
  const [x0, y0] = WINDOW.map(blockOf), g = gridPicture(x0, y0, 8, 8, "The stored colors of the samples of one block", () => ({}));
  const radius = Math.max(3, g.size / (2.4 * Math.sqrt(DATA.samples) + 1));
  for (const [i, j, s, ...code] of DATA.sample_block) {
    const [a, b] = g.to(sampleX(x0 + i, s), sampleY(y0 + j, s)), dot = svg("circle", {cx: a, cy: b, r: radius, fill: `rgb(${code.join(" ")})`, stroke: "var(--line)"});
    dot.append(svg("title", {}, document.createTextNode(`pixel (${x0 + i}, ${y0 + j}), sample ${s}: ${code.join(", ")}`)));
    g.root.append(dot);
  }
  const [x, y] = WINDOW;
  outline(g.root, g.to, [[x * SUB, y * SUB], [(x + 1) * SUB, y * SUB], [(x + 1) * SUB, (y + 1) * SUB], [x * SUB, (y + 1) * SUB]], 2.5);
  return el("div", {class: "stage"}, g.root);
}

// The layers of a pixel, from the farthest to the nearest, and the sums after each of them.
const LAYERS = DATA.layers, alphaOf = (l) => Math.min(1, Math.max(0, l.color[3]));
const blendedSums = () => LAYERS.list.reduce((sums, l) => [...sums, sums[sums.length - 1].map((c, k) => alphaOf(l) * l.color[k] + (1 - alphaOf(l)) * c)], [LAYERS.under.slice(0, 3)]);
function layerFormula() {
  const sums = blendedSums(), row = (v) => v.slice(0, 3).map((x) => fmt(x, 5).padStart(10)).join(" ");
  const lines = LAYERS.list.map((l, i) => `α = ${fmt(alphaOf(l), 5)}, layer ${vec(l.color.slice(0, 3), 5)}\n  ${fmt(alphaOf(l), 5)} · layer + ${fmt(1 - alphaOf(l), 5)} · color = <b>${row(sums[i + 1])}</b>`);
  return [`${say("for each layer, from the farthest to the nearest:")}color = α · layer + (1 − α) · color\n\n${say(`at pixel ${px(LAYERS.pixel)}${DATA.samples > 1 ? `, sample ${LAYERS.sample}` : ""}:`)}opaque color  ${row(LAYERS.under)}\n\n${lines.join("\n")}${say(`The sample stores ${vec(LAYERS.result.slice(0, 3), 6)}, rounded to ${TONE.stored_as}.${LAYERS.list.length > 8 ? " Because it has more than 8 layers, the farthest ones were merged." : ""}`)}`];
}

const LAYERED = DATA.draws.filter((d) => d.layered);
chapter({
  id: "layers", title: "Transparent layers", kicker: "Output",
  lead: () => "Transparent surfaces do not hide what is behind them, so they must be blended in the right order. Each sample keeps the fragments of transparent surfaces as layers, sorted by depth. When all layers are known, they are blended from the farthest to the nearest.",
  absent: () => (LAYERED.length > 0 && LAYERS === null ? `The transparent surfaces of this frame are not visible. Another view may show them: ${command(`${DATA.command} --yaw 120`)}.` : LAYERED.length === 0 ? `No surface of this frame is transparent. A frame with glass: ${command("halfspace explain pipeline")}.` : null),
  input: () => [plural(LAYERED.length, "transparent draw")],
  output: () => [`${plural(DATA.statistics.layers_merged, "merge")} of the two farthest layers of a sample (a sample can store 8 layers)`],
  steps: () => [{name: "Transparent draws", caption: `These objects are blended over the opaque picture: ${LAYERED.map((d) => `<i>${escapeHtml(d.object)}</i>`).join(", ")}.${ringNote(LAYERS.pixel, "the first one with the most layers, because the example pixel has none")} The formula blends ${DATA.samples > 1 ? `its sample ${LAYERS.sample}` : "it"}, which has ${plural(LAYERS.list.length, "layer")}.`, draw: () => picture(DATA.pictures.final, "The picture with its transparent surfaces", {ringed: LAYERS.pixel})}],
  formula: layerFormula,
  related: ["depth", "samples"], lessons: ["Blending and order"],
  exercises: () => {
    const nearest = 1 - alphaOf(LAYERS.list[LAYERS.list.length - 1]), all = LAYERS.list.reduce((t, l) => t * (1 - alphaOf(l)), 1), isSingle = LAYERS.list.length === 1;
    return [
      {ask: `Two layers like the nearest one at pixel ${px(LAYERS.pixel)} lie one behind the other. How much light do they let through, from 0 to 1?`, answer: nearest ** 2, decimals: 2, hint: "Each lets through 1 − α of the light.", why: `(1 − α)² = ${fmt(nearest, 5)}².`},
      {ask: isSingle ? "How much do three such layers let through, from 0 to 1?" : `How much of the opaque color do all layers of that ${DATA.samples > 1 ? "sample" : "pixel"} let through together, from 0 to 1?`, answer: isSingle ? nearest ** 3 : all, decimals: 2, hint: "Multiply 1 − α of all layers.", why: isSingle ? `${fmt(nearest, 5)}³.` : LAYERS.list.map((l) => `(1 − ${fmt(alphaOf(l), 4)})`).join(" · ") + "."},
      {ask: `A layer has a color of four floats, of 4 bytes each, and a depth of 4 bytes. How many bytes do 8 layers need for all samples of one tile of ${TILE} × ${TILE} pixels?`, answer: TILE * TILE * DATA.samples * 8 * 20, hint: "Multiply the number of samples of the tile by 8 and by 20.", why: `${TILE} · ${TILE} · ${DATA.samples} · 8 · 20.`},
    ];
  },
});
