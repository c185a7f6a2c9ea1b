// The final picture, overdraw and statistics.

const fragmentsAt = (x, y) => FRAME.fragments[y * W + x];

chapter({
  id: "final", title: "The final picture", kicker: "Output",
  lead: () => "The tiles are stored to the image. This is the same picture that <code>halfspace render</code> writes, bit for bit.",
  arrives: () => [`${plural(DATA.statistics.tiles_touched, "tile")} with something drawn in them`],
  leaves: () => [`${W} × ${H} pixels with 8 bits per channel`],
  steps: () => [{name: "The picture", caption: `Rendered with ${command(DATA.command.replace("explain", "render"))}.`, draw: () => picture(DATA.pictures.final, "The final picture", {read: (x, y) => `pixel (${x}, ${y}), OpenGL window (${x}, ${H - 1 - y}): ${plural(fragmentsAt(x, y), "fragment")}`})}],
  exercises: () => [
    {ask: "How many bytes has the picture before it is compressed, with red, green and blue?", answer: W * H * 3, hint: "Three bytes per pixel.", why: `${W} · ${H} · 3.`},
    {ask: `The example pixel is in row ${PIXEL[1]} from above. Which row is it in OpenGL's window coordinates, counted from below?`, answer: H - 1 - PIXEL[1], hint: `There are ${H} rows, and both counts start at 0.`, why: `${H} − 1 − ${PIXEL[1]}.`},
    {ask: "How many tiles had something to draw?", answer: DATA.statistics.tiles_touched, hint: "See “What arrives”.", why: "The others were filled with one color."},
  ],
});

chapter({
  id: "overdraw", title: "Overdraw", kicker: "The whole frame",
  lead: () => "How many fragments compete for each pixel? Most of them are rejected by their depth before they are shaded.",
  steps: () => [
    {name: "Fragments per pixel", caption: "Bright pixels are covered by many primitives. Point at the picture to read the number.", draw: () => [picture(DATA.overdraw.picture, "Number of fragments per pixel as a heat map", {read: (x, y) => `pixel (${x}, ${y}): ${plural(fragmentsAt(x, y), "fragment")}`, overlay: (pen, s) => ring(pen, s, PIXEL)}), legend("1", fmt(DATA.overdraw.most))].flat()},
    {name: "Histogram", caption: `Number of pixels by their number of fragments${DATA.overdraw.most > 64 ? "; the last bar is 64 and more" : ""}.`, draw: () => bars(DATA.overdraw.histogram.map((value, i) => ({value, name: plural(i, "fragment"), label: DATA.overdraw.histogram.length < 25 || i % 8 === 0 ? String(i) : undefined})), "Histogram of the number of fragments per pixel", {unit: " pixels"})},
  ],
  formula: () => [`overdraw = fragments / covered pixels = ${fmt(DATA.overdraw.total)} / ${fmt(W * H - DATA.overdraw.histogram[0])} = <b>${fmt(DATA.overdraw.total / Math.max(1, W * H - DATA.overdraw.histogram[0]), 5)}</b>`],
  exercises: () => [
    {ask: "How many fragments has the busiest pixel?", answer: DATA.overdraw.most, hint: "See the legend.", why: "It is the example pixel, unless another one was chosen."},
    {ask: "How many pixels have no fragment at all?", answer: DATA.overdraw.histogram[0], hint: "The first bar of the histogram.", why: "They show the background color."},
    {ask: "How many fragments were shaded for each fragment that was drawn? (Two digits after the point.)", answer: DATA.statistics.fragments_shaded / Math.max(1, DATA.overdraw.total), tolerance: 0.0051, hint: `${fmt(DATA.statistics.fragments_shaded)} shaded, ${fmt(DATA.overdraw.total)} in all.`, why: "The rest was hidden before shading."},
  ],
});

// ---- tile times ---------------------------------------------------------------------------------------------------------

const TIMES = DATA.tile_times.ms, slowest = Math.max(...TIMES, 1e-6), allTimes = TIMES.reduce((a, b) => a + b, 0);
function timePicture() {
  const read = (x, y) => { const tx = Math.floor(x / TILE), ty = Math.floor((H - 1 - y) / TILE), ms = TIMES[ty * BINS.columns + tx]; return `tile (${tx}, ${ty}): ${ms === 0 ? "filled with one color" : fmt(ms * 1000, 3) + " µs"}, ${plural(binCount(tx, ty), "primitive")}`; };
  return [picture(DATA.pictures.final, "Tiles colored by the time that they took", {read, overlay: (pen, s) => eachTile((tx, ty, x, y, w, h) => {
    pen.globalAlpha = 0.85;
    pen.fillStyle = heat(TIMES[ty * BINS.columns + tx] / slowest);
    pen.fillRect(x * s, y * s, w * s - 1, h * s - 1);
    pen.globalAlpha = 1;
  })}), legend("0", `${fmt(slowest * 1000, 3)} µs`)].flat();
}
function timePlot() {
  const width = 720, height = 380, root = svgFigure(width, height, "Time of each tile against its number of primitives");
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
  lead: () => `Where does the time go? Each tile was timed on one thread of the machine that made this page, ${DATA.tile_times.runs} times; the shortest time counts. They differ from machine to machine, unlike the other numbers of this page.`,
  steps: () => [
    {name: "Time per tile", caption: `All tiles together: ${fmt(allTimes, 3)} ms. Tiles with a single color are filled together and not timed.`, draw: timePicture},
    {name: "Time against primitives", caption: "One dot per tile. Primitives cost time, but so do shaded pixels: a tile with a single triangle can be slow if its shader is.", draw: timePlot},
  ],
  exercises: () => [
    {ask: "How many tiles were timed?", answer: TIMES.filter((t) => t > 0).length, hint: `${TIMES.length} tiles, without those that are filled with one color.`, why: "The dots of the second step."},
    {ask: "Which percentage of the time did the slowest tile take? (Rounded to a whole number.)", answer: Math.round(slowest / Math.max(allTimes, 1e-9) * 100), tolerance: 0.51, hint: "Its time is in the legend, the sum in the caption.", why: "The frame cannot be faster than its slowest tile, with any number of threads."},
    {ask: "If all tiles were equally slow, how many threads could work at the same time?", answer: TIMES.filter((t) => t > 0).length, hint: "One thread takes one tile.", why: "More threads than tiles have nothing to do."},
  ],
});

const STATISTICS = [
  ["vertices_in", "submitted indices"], ["vertices_shaded", "distinct vertices that the vertex function ran for"], ["primitives_in", "submitted primitives"],
  ["culled_non_finite", "dropped: a position is not a number"], ["culled_outside", "dropped: outside the view, or nothing left after clipping"], ["culled_face", "dropped: faces away"],
  ["culled_degenerate", "dropped: no area"], ["culled_no_sample", "dropped: covers no sample"], ["clipped", "cut by a plane"], ["triangles_binned", "drawn, with the pieces of clipped ones"],
  ["bin_entries", "pairs of a primitive and a tile"], ["samples_tested", "samples whose depth was tested one by one"], ["samples_passed", "samples that passed all tests"],
  ["fragments_shaded", "calls of the fragment function"], ["layers_merged", "transparent fragments beyond 8 layers"], ["tiles_touched", "tiles with at least one primitive"], ["flushes", "times the bins were full"]];

chapter({
  id: "statistics", title: "Statistics", kicker: "The whole frame",
  lead: () => "The counters of the pass that drew this frame. They are the same on every machine, except for the tested samples, which depend on the number of lanes.",
  steps: () => [{name: "From primitives to pixels", caption: "Each stage passes on fewer primitives, and then many more samples.", draw: () => el("div", {class: "stage"}, pipelineDiagram())}],
  body: () => [tableOf(["counter", "value", "meaning"], STATISTICS.map(([key, text]) => [`<code>${key}</code>`, DATA.statistics[key], "¶" + text]))],
  exercises: () => [
    {ask: "How often was a shaded vertex used on average? (Two digits after the point.)", answer: DATA.statistics.vertices_in / Math.max(1, DATA.statistics.vertices_shaded), tolerance: 0.0051, hint: "Indices divided by distinct vertices.", why: "In a closed mesh of triangles, a vertex belongs to six triangles on average."},
    {ask: "How many tested samples failed?", answer: DATA.statistics.samples_tested - DATA.statistics.samples_passed, tolerance: 0, hint: "Tested minus passed.", why: "Something nearer was already there."},
    {ask: "How many bits differ between the pictures of 1 and of 16 threads?", answer: 0, hint: "Threads share no pixels.", why: "One thread owns a tile and draws its primitives in submission order."},
  ],
});
