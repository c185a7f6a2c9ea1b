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
