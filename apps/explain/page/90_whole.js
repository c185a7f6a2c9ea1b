// The final picture, overdraw and statistics.

const fragmentsAt = (x, y) => FRAME.fragments[y * W + x];

chapter({
  id: "final", title: "The final picture", kicker: "Output",
  lead: () => "Finished tiles are written to the image. The picture is bit-identical to the one that <code>halfspace render</code> writes.",
  input: () => [plural(DATA.statistics.tiles_touched, "tile with primitives", "tiles with primitives")],
  formula: () => [`picture(x, y) = tile(⌊x / ${TILE}⌋, ⌊(${H} − 1 − y) / ${TILE}⌋)\n\n${say(`Pixel ${px(PIXEL)} comes from tile (${EXTILE}):`)}⌊${PIXEL[0]} / ${TILE}⌋ = <b>${EXTILE[0]}</b>,  ⌊(${H} − 1 − ${PIXEL[1]}) / ${TILE}⌋ = <b>${EXTILE[1]}</b>\nvalue = <b>${TONE.pixel.code.join(", ")}</b>`],
  output: () => [`${W} × ${H} pixels with 8 bits per channel`],
  steps: () => [{name: "The picture", caption: `The 8-bit values of all pixels, as ${command(DATA.render_command)} writes them.`, draw: () => picture(DATA.pictures.final, "The final picture", {read: (x, y) => `pixel ${px([x, y])}: ${plural(fragmentsAt(x, y), "fragment")}`})}],
  related: ["srgb", "history"], lessons: ["Tiles and threads"],
  exercises: () => [
    {ask: "How many bytes does the uncompressed picture have, with one byte each for red, green and blue?", answer: W * H * 3, hint: "A pixel has three bytes.", why: `${W} · ${H} · 3.`},
    {ask: "An image file lists the pixels row by row, from the upper left. How many pixels come before the example pixel?", answer: PIXEL[1] * W + PIXEL[0], hint: `A row has ${W} pixels.`, why: `${PIXEL[1]} · ${W} + ${PIXEL[0]}.`},
    DATA.statistics.tiles_touched === BINS.columns * BINS.rows ? {ask: "How many pixels does the tile in the upper right corner of the window have?", answer: (W - (BINS.columns - 1) * TILE) * (H - (BINS.rows - 1) * TILE), hint: `Tiles have ${TILE} × ${TILE} pixels and start at the lower left; the window cuts off the last ones.`, why: `(${W} − ${BINS.columns - 1} · ${TILE}) · (${H} − ${BINS.rows - 1} · ${TILE}).`}
      : {ask: "What percentage of the tiles had primitives to draw?", answer: DATA.statistics.tiles_touched / (BINS.columns * BINS.rows) * 100, decimals: 0, hint: "The chapter “Binning into tiles” gives the number of tiles.", why: `${fmt(DATA.statistics.tiles_touched)} of ${fmt(BINS.columns * BINS.rows)} tiles; the others were filled with the background color.`},
  ],
});

// A fragment is one sample of one primitive.
const shadedFragments = () => DATA.overdraw.total - DATA.overdraw.unshaded;
chapter({
  id: "overdraw", title: "Overdraw", kicker: "The whole frame",
  lead: () => `How many fragments compete for each pixel? Of the ${fmt(DATA.overdraw.total)} fragments of this frame, ${fmt(shadedFragments())} were shaded${DATA.samples > 1 ? `, in ${fmt(DATA.statistics.fragments_shaded)} runs of a shader, because the samples of a pixel can share one` : ""}${DATA.overdraw.unshaded > 0 ? `, and ${fmt(DATA.overdraw.unshaded)} were rejected, discarded or hidden first` : ""}.`,
  input: () => [plural(DATA.overdraw.total, "fragment")],
  output: () => [plural(shadedFragments(), "shaded fragment"), plural(W * H, "pixel")],
  steps: () => [
    {name: "Fragments per pixel", caption: `A fragment is one sample of one primitive${DATA.samples > 1 ? `, and a pixel has ${DATA.samples} samples` : ""}. The pixels have ${DATA.overdraw.histogram[0] > 0 ? "0" : fmt(DATA.overdraw.least)} to ${fmt(DATA.overdraw.most)} fragments; dark pixels have few, and bright ones the most. Point at the picture to read the numbers.${ringNote()}`, draw: () => [picture(DATA.overdraw.picture, "Number of fragments per pixel as a heat map", {read: (x, y) => `pixel ${px([x, y])}: ${plural(fragmentsAt(x, y), "fragment")}`, ringed: PIXEL}), legend("1", fmt(DATA.overdraw.most))].flat()},
    {name: "Histogram", caption: `Each bar is the number of pixels with as many fragments as the number below it${DATA.overdraw.most > 64 ? "; the last bar is for 64 and more" : ""}.`, draw: () => bars(DATA.overdraw.histogram.map((value, i) => ({value, name: plural(i, "fragment"), label: DATA.overdraw.histogram.length < 25 || i % 8 === 0 ? String(i) : undefined})), "Histogram: number of pixels for each number of fragments", {unit: " pixels"})},
  ],
  formula: () => [`overdraw = fragments / covered pixels = ${fmt(DATA.overdraw.total)} / ${fmt(W * H - DATA.overdraw.histogram[0])} = <b>${fmt(DATA.overdraw.total / Math.max(1, W * H - DATA.overdraw.histogram[0]), 5)}</b>${DATA.samples > 1 ? say(`Divided by ${DATA.samples} samples per pixel: ${fmt(DATA.overdraw.total / Math.max(1, W * H - DATA.overdraw.histogram[0]) / DATA.samples, 3)} surfaces per sample.`) : ""}`],
  related: ["depth", "history"], lessons: ["Depth"],
  exercises: () => {
    // The question is about the smallest number that not nearly all pixels reach, and about the most frequent of the other numbers.
    const pixels = DATA.overdraw.histogram, reach = (n) => pixels.slice(n).reduce((sum, v) => sum + v, 0);
    const least = Math.max(2, pixels.findIndex((_, n) => n > 1 && reach(n) < 0.9 * W * H)), several = reach(least);
    const common = pixels.reduce((best, v, n) => (n !== least - 1 && (best < 0 || v > pixels[best]) ? n : best), -1);
    return [
      {ask: `What percentage of the pixels has at least ${least} fragments?`, answer: several / (W * H) * 100, decimals: 1, hint: "Add the bars of the histogram from this number on.", why: `${fmt(several)} of ${fmt(W * H)} pixels.`},
      {ask: `What percentage of the pixels has ${common === 64 ? "at least 64 fragments" : `exactly ${plural(common, "fragment")}`}?`, answer: pixels[common] / (W * H) * 100, decimals: 1, hint: "Point at the bar of the histogram.", why: `${fmt(pixels[common])} of ${fmt(W * H)} pixels.`},
      {ask: "What is the ratio of shaded fragments to all fragments?", answer: shadedFragments() / Math.max(1, DATA.overdraw.total), decimals: 2, hint: `${fmt(shadedFragments())} were shaded, and there are ${fmt(DATA.overdraw.total)} in all.`, why: `${fmt(DATA.overdraw.unshaded)} fragments were not shaded.`},
    ];
  },
});

// ---- tile times ---------------------------------------------------------------------------------------------------------

const TIMES = DATA.tile_times.ms, slowest = Math.max(...TIMES, 1e-6), allTimes = TIMES.reduce((a, b) => a + b, 0);
// Tiles of a single color have no time.
const untimedTiles = () => (TIMES.includes(0) ? "Tiles of a single color are filled at once and were not timed." : "All tiles were timed, also those without primitives.");
function timePicture() {
  const read = (x, y) => { const tx = Math.floor(x / TILE), ty = Math.floor((H - 1 - y) / TILE), ms = TIMES[ty * BINS.columns + tx]; return `tile (${tx}, ${ty}): ${ms === 0 ? "not timed, filled with one color" : fmt(ms * 1000, 3) + " µs"}, ${plural(binCount(tx, ty), "primitive")}`; };
  return [picture(DATA.pictures.final, "Tiles colored by rendering time", {read, overlay: (pen, s) => eachTile((tx, ty, x, y, w, h) => {
    pen.globalAlpha = 0.85;
    pen.fillStyle = heat(TIMES[ty * BINS.columns + tx] / slowest);
    pen.fillRect(x * s, y * s, w * s - 1, h * s - 1);
    pen.globalAlpha = 1;
  })}), legend("0", `${fmt(slowest * 1000, 3)} µs`)].flat();
}
function timePlot() {
  const width = figureWidth(), height = 380, root = svgFigure(width, height, "Rendering time of each tile over its number of primitives");
  const to = (n, ms) => [60 + n / mostBinned * (width - 90), height - 45 - ms / slowest * (height - 75)];
  root.append(svg("path", {d: `M60 20 V${height - 45} H${width - 20}`, fill: "none", stroke: "var(--line)"}));
  TIMES.forEach((ms, i) => { if (ms === 0) return; const [x, y] = to(BINS.counts[i], ms); root.append(svg("circle", {cx: x, cy: y, r: 5, fill: "var(--accent)", "fill-opacity": 0.55})); });
  const text = (x, y, value, anchor) => root.append(svg("text", {x, y, "font-size": 14, "text-anchor": anchor}, document.createTextNode(value)));
  text(width - 20, height - 15, `${fmt(mostBinned)} primitives`, "end");
  text(60, height - 15, "0", "middle");
  text(66, 30, `${fmt(slowest * 1000, 3)} µs`, "start");
  return el("div", {class: "stage"}, root);
}

chapter({
  id: "times", title: "Tile times", kicker: "The whole frame",
  lead: () => `Which tiles take the most time? Each tile was rendered ${DATA.tile_times.runs} times on one thread of the machine that generated this page, and the shortest time is shown. Unlike most numbers on this page, times differ from machine to machine.`,
  input: () => [plural(BINS.columns * BINS.rows, "tile"), plural(DATA.statistics.bin_entries, "entry", "entries") + " in the bins"],
  output: () => [`${fmt(allTimes, 3)} ms for all timed tiles on one thread`],
  formula: () => { const n = TIMES.filter((t) => t > 0).length; return [`mean = total / tiles = ${fmt(allTimes, 4)} ms / ${fmt(n)} = <b>${fmt(allTimes / Math.max(1, n) * 1000, 4)} µs</b>\nslowest / mean = ${fmt(slowest * 1000, 4)} / ${fmt(allTimes / Math.max(1, n) * 1000, 4)} = <b>${fmt(slowest * n / Math.max(1e-9, allTimes), 4)}</b>`]; },
  steps: () => [
    {name: "Time per tile", caption: `Dark tiles are fast and bright ones slow. All tiles together took ${fmt(allTimes, 3)} ms. ${untimedTiles()}`, draw: timePicture},
    {name: "Time and primitives", caption: "Each dot is a tile: its number of primitives is to the right, and its time up. Primitives take time, but so does shading: a tile with a single triangle can be slow if its shader is slow.", draw: timePlot},
  ],
  related: ["binning", "statistics"], lessons: ["Tiles and threads"],
  exercises: () => {
    const timed = TIMES.filter((t) => t > 0), mean = allTimes / Math.max(1, timed.length), threads = 8, slow = timed.filter((t) => t > mean).length;
    return [
      {ask: `How many milliseconds would ${threads} threads take if they shared the work equally?`, answer: allTimes / threads, significant: 2, hint: "The caption of the first step gives the time of one thread.", why: `${fmt(allTimes, 3)} ms / ${threads}. However many threads there are, a frame takes at least as long as its slowest tile: ${fmt(slowest, 3)} ms.`},
      {ask: "How many frames per second could one thread render if a frame took only the time of these tiles?", answer: 1000 / Math.max(allTimes, 1e-9), significant: 2, hint: "A second has 1000 milliseconds.", why: `1000 / ${fmt(allTimes, 3)}. Vertices, setup and output take time as well.`},
      {ask: "How many tiles took longer than the mean?", answer: slow, tolerance: Math.ceil(timed.length / 50), hint: "Count the dots above the mean in the second step.", why: `The mean is ${fmt(mean * 1000, 4)} µs.`},
    ];
  },
});

const STATISTICS = [
  ["vertices_in", "submitted indices"], ["vertices_shaded", "distinct vertices, each shaded once"], ["primitives_in", "primitives that reach clipping: submitted ones, or those that a geometry function emitted for them"],
  ["culled_non_finite", "culled: a position or clip distance is infinite or NaN"], ["culled_outside", "culled: outside the view, or nothing is left after clipping"], ["culled_face", "culled because of their facing"],
  ["culled_degenerate", "culled: no area"], ["culled_no_sample", "culled: no sample is covered"], ["clipped", "clipped primitives"], ["triangles_binned", "primitives to draw, including the pieces of clipped ones"],
  ["bin_entries", "pairs of a primitive and a tile that the primitive may overlap"], ["samples_tested", "covered samples, except for those rejected with their block"], ["samples_passed", "samples that passed all tests"],
  ["geometry_invocations", "calls of geometry functions"], ["fragments_shaded", "runs of a fragment shader; the samples of a pixel can share one"], ["layers_merged", "transparent fragments beyond 8 layers per sample"], ["tiles_touched", "tiles with at least one primitive"], ["flushes", "number of times that the memory for bins or vertices was full"]];

chapter({
  id: "statistics", title: "Statistics", kicker: "The whole frame",
  lead: () => "These are the counters of the pass that rendered this frame. They are the same on every machine, except for samples_tested, which depends on the number of lanes.",
  input: () => [plural(DATA.statistics.primitives_in, "primitive")],
  output: () => [plural(DATA.statistics.fragments_shaded, "run of a fragment shader", "runs of a fragment shader")],
  formula: () => { const s = DATA.statistics, culled = s.culled_non_finite + s.culled_outside + s.culled_face + s.culled_degenerate + s.culled_no_sample; return [`${say("Each submitted primitive is culled or drawn:")}primitives_in = culled + drawn\n${fmt(s.primitives_in)} = ${[s.culled_non_finite, s.culled_outside, s.culled_face, s.culled_degenerate, s.culled_no_sample].map((n) => fmt(n)).join(" + ")} + ${fmt(DATA.outcomes[0] + DATA.outcomes[1])} = ${fmt(culled)} + <b>${fmt(s.primitives_in - culled)}</b>\n\nshader runs per pixel = ${fmt(s.fragments_shaded)} / ${fmt(W * H)} = <b>${fmt(s.fragments_shaded / (W * H), 4)}</b>`]; },
  steps: () => [{name: "From primitives to pixels", caption: "The number of items that each stage of the pipeline outputs in this frame, from left to right.", draw: () => el("div", {class: "stage"}, pipelineDiagram())}],
  body: () => [tableOf(["counter", "value", "meaning"], STATISTICS.map(([key, text]) => [`<code>${key}</code>`, DATA.statistics[key], "¶" + text]))],
  related: ["culling", "overdraw"], lessons: ["The library"],
  exercises: () => [
    {ask: "How many times was a shaded vertex used on average?", answer: DATA.statistics.vertices_in / Math.max(1, DATA.statistics.vertices_shaded), decimals: 2, hint: "Divide vertices_in by vertices_shaded.", why: DATA.statistics.vertices_in > DATA.statistics.vertices_shaded ? "A vertex that several primitives share is shaded once." : "No vertex of this frame is shared."},
    {ask: "How many tested samples failed?", answer: DATA.statistics.samples_tested - DATA.statistics.samples_passed, hint: "Subtract samples_passed from samples_tested.", why: DATA.statistics.samples_tested > DATA.statistics.samples_passed ? "They were not in front of what was drawn before, or failed another test." : "No tested sample was behind what was drawn before."},
    {ask: "How many times did a fragment shader run per sample that passed?", answer: DATA.statistics.fragments_shaded / Math.max(1, DATA.statistics.samples_passed), decimals: 2, hint: "Divide fragments_shaded by samples_passed.", why: `${fmt(DATA.statistics.fragments_shaded)} / ${fmt(DATA.statistics.samples_passed)}. A later fragment can hide one that passed, before it is shaded${DATA.samples > 1 ? ", and the samples of a pixel can share one run" : ""}.`},
  ],
});
