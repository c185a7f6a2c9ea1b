// The geometry stage: what its function receives and emits. All vertices were computed by the pipeline's own functions.

const EMISSION = DATA.emission, EMITTED = EMISSION && EMISSION.example;

// Shows the part of the picture around some points, magnified. marks(to, pen): draws on top; to: window coordinates → canvas.
function closeUp(label, points, marks) {
  const width = 1000, height = 560, {canvas, pen} = canvasFigure(width, height, label), [xs, ys] = [0, 1].map((k) => points.map((p) => p[k]));
  const [x0, x1, y0, y1] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)], scale = 0.75 * Math.min(width / Math.max(x1 - x0, 1), height / Math.max(y1 - y0, 1));
  const to = ([x, y]) => [width / 2 + (x - (x0 + x1) / 2) * scale, height / 2 - (y - (y0 + y1) / 2) * scale];
  withImage(DATA.pictures.final, (image) => {
    pen.imageSmoothingEnabled = false;
    pen.drawImage(image, ...to([0, H]), W * scale, H * scale);
    pen.fillStyle = css("--paper");
    pen.globalAlpha = 0.35;
    pen.fillRect(0, 0, width, height);
    pen.globalAlpha = 1;
    marks(to, pen);
  });
  return addLoupe(el("div", {class: "stage"}, canvas), canvas, width, height);
}

function emissionPicture(emitted) {
  const corners = EMITTED.received.map((v) => v.window), all = [...corners, ...EMITTED.emitted.flat().map((v) => v.window)];
  return closeUp(emitted ? "The lines that the geometry function emitted for the triangle" : "The triangle that the geometry function received", all, (to, pen) => {
    polygon(pen, corners.map(to), {fill: emitted ? null : css("--accent"), stroke: css("--accent"), width: 3});
    pen.strokeStyle = css("--ink");
    pen.lineWidth = 4;
    if (emitted) for (const line of EMITTED.emitted) stroke(pen, ...line.map((v) => to(v.window)));
    pen.fillStyle = css("--ink");
    pen.font = `600 ${narrowWindow.matches ? 38 : 24}px system-ui`;
    corners.forEach((c, i) => { const [x, y] = to(c); pen.fillText(String(i), x + 10, y + 26); });
  });
}

// A bar for each number of received and emitted primitives.
const emissionCounts = () => bars(EMISSION.draws.flatMap((d) => { const name = DATA.draws[d.draw].object; return [{value: d.received, name: `${name}: triangles received`, label: "received"}, {value: d.emitted, name: `${name}: lines emitted`, label: "emitted", marked: true}]; }), "Number of primitives before and after the geometry stage");

const emittedText = () => { const [received, emitted] = ["received", "emitted"].map((k) => EMISSION.draws.reduce((n, d) => n + d[k], 0)); return {received, emitted}; };
const isWhole = () => EMITTED !== null && EMITTED !== undefined;
const lineLength = (line) => Math.hypot(line[1].window[0] - line[0].window[0], line[1].window[1] - line[0].window[1]);

chapter({
  id: "geometry", title: "Geometry stage", kicker: "Geometry stage",
  lead: () => "A shader can have a geometry function, which runs between the vertex function and clipping. It receives a whole primitive and emits new ones, also of another kind, up to a limit that the shader states. Draws without such a function skip this stage.",
  absent: () => (EMISSION === null ? `No shader of this frame has a geometry function. The key <code>normal_lines</code> of an object draws its normals with one, as in the scene pipeline: ${command("halfspace explain pipeline")}.` : null),
  input: () => [plural(emittedText().received, "triangle"), "for each corner: the outputs of the vertex function"],
  output: () => [plural(emittedText().emitted, "line"), "clip-space positions and varyings, as if the vertex function had computed them"],
  steps: () => [
    ...(isWhole() ? [
      {name: "A triangle before the stage", caption: `Triangle ${fmt(EMITTED.primitive)} of <i>${escapeHtml(EMITTED.object)}</i>, filled, over the magnified and faded picture; its corners are numbered. The vertex function has computed the position of its corners in clip space, and their normals in world space. Objects of the picture may hide parts of it.`, draw: () => emissionPicture(false)},
      {name: "What the function emits for it", caption: `${capital(plural(EMITTED.emitted.length, "line"))}, drawn thick over the outline of the triangle. Each starts at a corner and is ${fmt(EMITTED.length, 4)} units long, unless the corner has no normal. Corners that triangles share get equal lines from each of them.`, draw: () => emissionPicture(true)}] : []),
    {name: "Primitives before and after", caption: `The bars are numbers of primitives: the triangles that the function received, and, highlighted, the lines that it emitted. The function ran once for each triangle: ${fmt(EMISSION.calls)} times. From here on, the lines are primitives like all others: they are clipped, set up and sorted into bins.${isWhole() ? "" : " No triangle that this stage receives lies in the window with all of its lines, so the page shows none."}`, draw: emissionCounts},
  ],
  formula: () => (isWhole() ? [emissionFormula()] : []),
  body: () => (isWhole() ? [el("h3", {}, "Emitted vertices"), tableOf(["line", "end", "x", "y", "z", "w"], EMITTED.emitted.flatMap((line, i) => line.map((v, k) => [String(i), `¶${k === 0 ? "corner" : "tip"}`, ...v.clip.map((c) => fmt(c, 6))])))] : []),
  related: ["spaces", "clipping", "statistics"], lessons: ["The geometry stage"],
  exercises: () => {
    const shown = isWhole() ? EMITTED.emitted[0] : null;
    return [
      {ask: `A call can emit at most ${EMISSION.max_vertices} vertices. How many vertices could a mesh of 1,250 triangles get?`, answer: 1250 * EMISSION.max_vertices, hint: "The function runs once per triangle.", why: `1250 · ${EMISSION.max_vertices}.`},
      shown === null ? {ask: "A line goes from (10, 20) to (13, 24) in the window. How long is it?", answer: 5, hint: "Use the theorem of Pythagoras.", why: "√(3² + 4²)."}
        : {ask: `In the window, line 0 goes from ${vec(shown[0].window, 5)} to ${vec(shown[1].window, 5)}. How long is it in pixels?`, answer: lineLength(shown), decimals: 1, tolerance: 0.051, hint: "Use the theorem of Pythagoras.", why: `√(${operand(shown[1].window[0] - shown[0].window[0], 4)}² + ${operand(shown[1].window[1] - shown[0].window[1], 4)}²).`},
      {ask: "How many strips does a function emit that emits 12 vertices, if each strip is a line from one point to another?", answer: 6, hint: "A line has two ends.", why: "12 / 2. After each pair of vertices, it ends the strip."},
    ];
  },
});

function emissionFormula() {
  const [corner, tip] = EMITTED.emitted[0], n = EMITTED.received[0].normal, offset = n.map((v) => v * EMITTED.length), column = transform(multiply(M.clip_from_view, M.view_from_world), [...offset, 0]);
  return `tip = corner + P · V · (<em>length</em> · <em>n</em>, 0)\n\n${say("For line 0, with the normal of its corner:")}<em>length</em> · <em>n</em> = ${fmt(EMITTED.length, 4)} · ${vec(n, 4)} = ${vec(offset, 4)}\nP · V · (…, 0) = ${vec(column, 5)}\ntip = ${vec(corner.clip, 5)} + ${vec(column, 5)} = <b>${vec(tip.clip, 5)}</b>`;
}
