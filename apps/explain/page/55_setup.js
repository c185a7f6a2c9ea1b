// Clipping, culling and triangle setup.

const CLIPPED = DATA.clipped;

// The limits of the integer grid that cut a triangle: {plane, axis, ratio}. On the limit, the coordinate is ratio · w.
function gridLimits(c) {
  const axes = {left: 0, right: 0, bottom: 1, top: 1}, limits = new Map();
  for (const a of c.after) if (a.plane in axes) limits.set(a.plane, {plane: a.plane, axis: axes[a.plane], ratio: a.clip[axes[a.plane]] / a.clip[3]});
  return [...limits.values()];
}
const isCutByNear = (c) => c.after.some((a) => a.plane === "near");
// The axis of the plot: x, or y if only limits of y cut the triangle and it is not a line in the plot of w and y.
function plottedAxis(c) {
  const [a, b, d] = c.before.map((p) => [p[3], p[1]]), sides = [[a, b], [b, d], [d, a]].map(([p, q]) => Math.hypot(q[0] - p[0], q[1] - p[1]));
  const height = Math.abs((b[0] - a[0]) * (d[1] - a[1]) - (b[1] - a[1]) * (d[0] - a[0])) / Math.max(...sides);
  return gridLimits(c).length > 0 && gridLimits(c).every((l) => l.axis === 1) && height > 0.05 * Math.max(...sides) ? 1 : 0;
}
function cutText(c) {
  const limits = gridLimits(c);
  if (limits.length === 0) return isCutByNear(c) ? "It is cut at the near plane." : "";
  const pixels = ({axis, ratio}) => Math.round(Math.abs((ratio + 1) / 2 * [W, H][axis])), from = (l) => `${fmt(pixels(l))} pixels from the ${l.axis === 0 ? "left" : "lower"} edge of the window`;
  return `It is cut at ${limits.map((l) => `${"xy"[l.axis]} = ${fmt(l.ratio, 4)} w`).join(" and ")}, ${limits.length === 1 ? "a limit" : "limits"} of the integer grid (${from(limits[0])})${isCutByNear(c) ? ", and at the near plane" : ", not at the near plane"}.${limits.every((l) => l.axis !== plottedAxis(c)) ? " The plot cannot show this limit, because in w and y, the triangle is a line." : ""}`;
}

// Plots a triangle and the clip planes: w (the distance along the view axis) to the right, x or y up.
function clipPicture(c, axis, after) {
  const name = "xy"[axis], points = [...c.before.map((p) => [p[3], p[axis]]), [0, 0]], shown = c.after.map((a) => [a.clip[3], a.clip[axis]]);
  const width = figureWidth(), height = 400, span = (k) => { const v = points.map((p) => p[k]); return [Math.min(...v), Math.max(...v)]; };
  const [[w0, w1], [y0, y1]] = [span(0), span(1)], scale = Math.min((width - 90) / Math.max(w1 - w0, 1e-9), (height - 60) / Math.max(y1 - y0, 1e-9));
  const to = ([w, y]) => [50 + (w - w0) * scale, 30 + (y1 - y) * scale], path = (list) => list.map(to).map((p) => p.map((v) => v.toFixed(1)).join(",")).join(" ");
  const root = svgFigure(width, height, `A clipped triangle in clip space, ${after ? "after" : "before"} clipping: w to the right, ${name} up`);
  const line = (a, b, color, dash) => { const [p, q] = [to(a), to(b)]; root.append(svg("line", {x1: p[0], y1: p[1], x2: q[0], y2: q[1], stroke: color, "stroke-width": 1.5, "stroke-dasharray": dash || "none"})); };
  const far = Math.max(w1, Math.abs(w0));
  line([0, 0], [far, far], "var(--soft)", "5 4");
  line([0, 0], [far, -far], "var(--soft)", "5 4");
  for (const {ratio} of gridLimits(c).filter((l) => l.axis === axis)) line([0, 0], [far, ratio * far], "var(--accent)", "9 4");
  const near = M.perspective ? M.near : 1;
  line([near, y0 - 9e3], [near, y1 + 9e3], "var(--accent)");
  root.append(svg("polygon", {points: path(c.before.map((p) => [p[3], p[axis]])), fill: "var(--soft)", "fill-opacity": after ? 0.08 : 0.22, stroke: "var(--soft)", "stroke-width": 1.5}));
  if (after) root.append(svg("polygon", {points: path(shown), fill: "var(--accent)", "fill-opacity": 0.25, stroke: "var(--accent)", "stroke-width": 2}));
  if (after) c.after.forEach((a) => { const [x, y] = to([a.clip[3], a.clip[axis]]); root.append(svg("circle", {cx: x, cy: y, r: a.vertex < 0 ? 6 : 4, fill: a.vertex < 0 ? "var(--accent)" : "var(--ink)"})); });
  const label = (at, text) => { const [x, y] = to(at); root.append(svg("text", {x: Math.min(x, width - 120), y: Math.max(18, Math.min(y, height - 8)), "font-size": 14}, document.createTextNode(text))); };
  label([near, y1], " near plane");
  for (const {ratio} of gridLimits(c).filter((l) => l.axis === axis)) { const up = ratio > 0 ? y1 - 24 / scale : y0 + 24 / scale; label([up / ratio, up], ` ${name} = ${fmt(ratio, 4)} w`); }
  // The name of a side of the view volume is written where the side crosses the figure.
  const up = Math.min(w1, y1), down = Math.min(w1, -y0);
  if (up >= down && up > 0) label([up * 0.7, up * 0.7], ` ${name} = w`);
  else if (down > 0) label([down * 0.7, -down * 0.7], ` ${name} = −w`);
  return el("div", {class: "stage"}, root);
}

function clipFormula(c) {
  const cut = c.after.find((a) => a.vertex < 0);
  if (!cut) return [];
  const used = [0, 1, 2].filter((k) => cut.weights[k] !== 0);
  return [`${say("A new vertex on a clip plane is a weighted sum of the original vertices. The first new vertex of this polygon:")}<em>p</em> = ${used.map((k) => `${operand(cut.weights[k], 6)} · <em>v</em><sub>${k}</sub>`).join(" + ")}\n  = ${used.map((k) => `${fmt(cut.weights[k], 6)} · ${vec(c.before[k], 5)}`).join("\n  + ")}\n  = <b>${vec(cut.clip, 6)}</b>`];
}

chapter({
  id: "clipping", title: "Clipping", kicker: "Primitive setup",
  lead: () => "Dividing by w gives wrong positions for points behind the eye. Triangles that cross the near plane, the far plane or the limits of the integer grid are therefore clipped to polygons first. Triangles that only cross the edges of the window are not clipped: the rasterizer skips the pixels outside.",
  absent: () => (CLIPPED.length === 0 ? `No triangle of this frame crosses the near or far plane: ${fmt(DATA.outcomes[2])} of ${fmt(DATA.statistics.primitives_in)} primitives are entirely outside the view, and the others need no clipping. A frame with clipped triangles: ${command("halfspace explain pipeline")}.` : null),
  input: () => [plural(DATA.statistics.primitives_in, "primitive"), "outcodes: for each vertex, one bit per clip plane, which is set if the vertex is outside"],
  output: () => [`${plural(DATA.statistics.clipped, "primitive")} clipped`, `${plural(DATA.statistics.culled_outside, "primitive")} entirely outside the view, and therefore culled`],
  steps: () => CLIPPED.slice(0, 4).flatMap((c, i) => [
    {name: `Triangle ${fmt(c.primitive)} of ${escapeHtml(c.object)}, before clipping`, caption: `Clip space seen from ${plottedAxis(c) === 0 ? "above" : "the side"}: w increases to the right, and ${"xy"[plottedAxis(c)]} upward. The gray triangle is the one to be clipped. The eye is at w = 0, where the dashed lines meet; gray ones are the sides of the view volume. ${cutText(c)} Vertices with w below ${fmt(M.near)} are on the eye's side of the near plane, and vertices with negative w are behind the eye.`, draw: () => clipPicture(c, plottedAxis(c), false)},
    {name: "After clipping", caption: `The colored polygon is what is left. It has ${c.after.length} vertices, ${c.after.filter((a) => a.vertex < 0).length} of them new; new vertices are the large colored dots. It is drawn as a fan of ${plural(c.after.length - 2, "triangle")}.`, draw: () => clipPicture(c, plottedAxis(c), true)}]),
  formula: () => clipFormula(CLIPPED[0]),
  body: () => [el("h3", {}, "Vertices of the first polygon"), tableOf(["vertex", "x", "y", "z", "w", "weights of the original vertices"], CLIPPED[0].after.map((a, i) => [String(i), ...a.clip.map((v) => fmt(v, 6)), a.vertex >= 0 ? `¶vertex ${a.vertex}` : `¶${a.weights.map((w) => fmt(w, 4)).join(", ")}`]))],
  related: ["spaces", "culling"], lessons: ["Projection, w and clipping"],
  exercises: () => {
    // The last edge of the first triangle that the near plane cuts; without one, an edge that is not part of the frame.
    const c = CLIPPED[0], cut = c.after.filter((v) => v.plane === "near" && v.weights.filter((w) => w !== 0).length === 2).pop();
    const [a, b] = cut ? [0, 1, 2].filter((k) => cut.weights[k] !== 0).map((k) => c.before[k]) : [[0, 0, 2, 1.5], [0, 0, 1, 3.5]];
    return [
      {ask: "A triangle has one vertex behind the near plane, and crosses no other plane. How many vertices does it have after clipping?", answer: 4, hint: "Two of its edges are cut.", why: "Two vertices are kept, and two edges get a new vertex each."},
      {ask: "How many triangles is a polygon with 7 vertices split into?", answer: 5, hint: "A fan starts at one vertex; each further edge that does not touch it gives a triangle.", why: "A fan with n vertices has n − 2 triangles."},
      {ask: `An edge of ${cut ? "the first triangle" : "a triangle"} goes from z = ${num(a[2])}, w = ${num(a[3])} to z = ${num(b[2])}, w = ${num(b[3])}. It crosses the near plane where z = w. At which fraction of the edge is that, counted from its first end?`, answer: (a[2] - a[3]) / (a[2] - a[3] - b[2] + b[3]), decimals: 2, hint: "z − w changes linearly along the edge. Where is it 0?", why: `z − w is ${fmt(a[2] - a[3], 5)} at the first end and ${fmt(b[2] - b[3], 5)} at the second.`},
    ];
  },
});

// ---- culling ----------------------------------------------------------------------------------------------------------

function cullPicture(outcome) {
  return picture(DATA.pictures.final, `The picture with outlines of the primitives ${OUTCOMES[outcome]}`, {overlay: (pen, s) => {
    pen.fillStyle = css("--paper");
    pen.globalAlpha = 0.75;
    pen.fillRect(0, 0, W * s, H * s);
    pen.globalAlpha = 0.8;
    const stroke = css(outcome === 0 ? "--ink" : "--accent");
    for (const t of wireIn((p) => toPixels(toNdc(toClip(p))))) {
      if (t.outcome === outcome) polygon(pen, t.corners.map(([x, y]) => [x * s, y * s]), {stroke});
    }
    pen.globalAlpha = 1;
  }});
}

// The rectangle of the example point. Its coordinates include the last covered position, in 1/256 pixel.
const pointRectangle = () => `x: ${fmt(TRI.x[0])} … ${fmt(TRI.x[1])}, y: ${fmt(TRI.y[0])} … ${fmt(TRI.y[1])} in 1/256 pixel\n\n${say(`The rectangle around ${exampleName} covers the pixels with a sample in it:`)}⌈(${fmt(TRI.x[0])} − ${sampleX(0)}) / 256⌉ ≤ x ≤ ⌊(${fmt(TRI.x[1])} − ${sampleX(0)}) / 256⌋ → <b>${TRI.boxes[SAMPLE][0]} … ${TRI.boxes[SAMPLE][2] - 1}</b>\n⌈(${fmt(TRI.y[0])} − ${sampleY(0)}) / 256⌉ ≤ y ≤ ⌊(${fmt(TRI.y[1])} − ${sampleY(0)}) / 256⌋ → <b>${TRI.boxes[SAMPLE][1]} … ${TRI.boxes[SAMPLE][3] - 1}</b>`;

const percent = (part, all) => `${fmt(Math.round(part / Math.max(1, all) * 1000) / 10)} %`;
const area2 = (t) => (t.x[1] - t.x[0]) * (t.y[2] - t.y[0]) - (t.y[1] - t.y[0]) * (t.x[2] - t.x[0]);
// The vertices whose order decides about the facing: those of the submitted triangle or, if it was clipped, of the piece of the page.
const submitted = () => (isClipped ? TRI : {x: EX.vertices.map((v) => v.x), y: EX.vertices.map((v) => v.y)});

chapter({
  id: "culling", title: "Culling", kicker: "Primitive setup",
  lead: () => "Invisible triangles are culled before any pixel is processed: those outside the view, those that face away, those without area, and those that cover no sample.",
  absent: () => (DATA.statistics.primitives_in === 0 ? `This frame has no primitives. A frame with triangles: ${command("halfspace explain pipeline")}.` : null),
  input: () => [plural(DATA.statistics.primitives_in, "primitive"), "the winding of front faces"],
  output: () => [`${plural(DATA.statistics.triangles_binned, "primitive")} to draw, including the pieces of clipped ones`],
  steps: () => [
    {name: "Outcomes", caption: "The bars are numbers of primitives; the highlighted one is of those that were kept unchanged: " + OUTCOMES.map((name, i) => [name, DATA.outcomes[i]]).filter(([, n]) => n > 0).map(([name, n]) => `${fmt(n)} ${name}`).join(", ") + ".",
      draw: () => bars(OUTCOMES.map((name, i) => ({value: DATA.outcomes[i], name, label: ["kept", "clipped", "outside", "facing", "no area", "no sample", "∞ or NaN"][i], marked: i === 0})), "Number of primitives by outcome: " + OUTCOMES.map((name, i) => `${DATA.outcomes[i]} ${name}`).join(", "))},
    ...[0, 3, 5].filter((i) => DATA.outcomes[i] > 0 && FRAME.outcomes.includes(i)).map((i) => ({name: `Primitives ${OUTCOMES[i]}`, caption: `Outlines over the faded picture. ${i === 3 ? `These primitives face away from the eye. They are ${percent(DATA.outcomes[3], DATA.statistics.primitives_in)} of the submitted primitives.` : i === 5 ? "These primitives are so small or thin that they cover no sample." : "These primitives are passed to the rasterizer."}${DATA.wire.step > 1 || DATA.wire.own_step > 1 ? " A random sample of them is shown." : ""}`, draw: () => cullPicture(i)})),
  ],
  formula: () => (isPoint ? [pointRectangle(), `${say("A point is culled if its rectangle is empty, outside the window, or covers no sample.")}${fmt(TRI.box[2] - TRI.box[0])} × ${fmt(TRI.box[3] - TRI.box[1])} pixels &gt; 0 → <b>kept</b>`] : isTriangle ? [`2 · area = (<em>x</em><sub>1</sub> − <em>x</em><sub>0</sub>)(<em>y</em><sub>2</sub> − <em>y</em><sub>0</sub>) − (<em>y</em><sub>1</sub> − <em>y</em><sub>0</sub>)(<em>x</em><sub>2</sub> − <em>x</em><sub>0</sub>)\n\n${say(`${isClipped ? `${pieceNote} For this piece` : `for ${exampleName}`}, in 1/256 pixel:`)}= (${fmt(submitted().x[1] - submitted().x[0])}) · (${fmt(submitted().y[2] - submitted().y[0])}) − (${fmt(submitted().y[1] - submitted().y[0])}) · (${fmt(submitted().x[2] - submitted().x[0])}) = <b>${fmt(area2(submitted()))}</b>\n\n${say(`${isClipped ? "Setup has ordered the vertices of the piece counter-clockwise." : area2(submitted()) > 0 ? "Positive: counter-clockwise." : "Negative: clockwise."} The area is ${fmt(Math.abs(area2(submitted())) / 131072, 6)} pixels.`)}`] : []),
  related: ["clipping", "setup"], lessons: ["A triangle"],
  exercises: () => {
    const o = DATA.outcomes, all = Math.max(1, DATA.statistics.primitives_in), inView = DATA.statistics.primitives_in - o[2];
    return [
      o[3] > 0 && o[3] < inView ? {ask: "What percentage of the primitives that are not outside the view was culled because of their facing?", answer: o[3] / inView * 100, decimals: 0, hint: "Leave out the bar “outside”.", why: `${fmt(o[3])} of ${fmt(inView)}.`}
        : {ask: "A closed mesh of 1,250 triangles is seen from outside, and 42 % of its triangles face away. How many are left after culling by facing?", answer: 725, hint: "58 % of them face the eye.", why: "1250 · 0.58."},
      {ask: "What percentage of the submitted primitives is drawn?", answer: (o[0] + o[1]) / all * 100, decimals: 0, hint: "Divide the number of kept and clipped primitives by the number of all primitives.", why: `${fmt(o[0] + o[1])} of ${fmt(DATA.statistics.primitives_in)}.`},
      isTriangle ? {ask: `The same view is rendered with twice the width and height. How many pixels is the area of ${isClipped ? "the piece of the example triangle" : "the example triangle"} then?`, answer: 4 * Math.abs(area2(submitted())) / 131072, significant: 3, hint: "Both directions double.", why: `4 · ${fmt(Math.abs(area2(submitted())) / 131072, 6)} pixels.`}
        : isPoint ? {ask: "How many pixels does the rectangle of the example point have?", answer: (TRI.box[2] - TRI.box[0]) * (TRI.box[3] - TRI.box[1]), hint: "Multiply its width by its height.", why: `${TRI.box[2] - TRI.box[0]} · ${TRI.box[3] - TRI.box[1]}.`}
          : {ask: "What percentage of the submitted primitives covers no sample?", answer: o[5] / all * 100, decimals: 0, hint: "See the bar “no sample”.", why: `${fmt(o[5])} of ${fmt(DATA.statistics.primitives_in)}.`},
    ];
  },
});

// ---- setup ------------------------------------------------------------------------------------------------------------

// The pixels around the example triangle and their size in the picture of its edges, which has a border for labels.
function edgeFrame() {
  const margin = 1.2, border = 26, [x0, y0] = [TRI.x, TRI.y].map((v) => Math.min(...v) / SUB - margin), [x1, y1] = [TRI.x, TRI.y].map((v) => Math.max(...v) / SUB + margin);
  return {x0, x1, y0, y1, border, scale: (figureWidth() - 2 * border) / Math.max(x1 - x0, (y1 - y0) * 1.6)};
}
// Pixels and samples are drawn if they are large enough to be told apart.
const showsSamples = () => edgeFrame().scale > 5;

// Draws the example triangle and its edges on the surrounding pixel grid.
function edgePicture(highlight) {
  const t = TRI, box = t.box, {x0, x1, y0, y1, scale, border} = edgeFrame(), width = figureWidth(), height = Math.max(240, (y1 - y0) * scale + 2 * border), left = (width - (x1 - x0) * scale) / 2, top = (height - (y1 - y0) * scale) / 2;
  const to = (x, y) => [left + (x / SUB - x0) * scale, top + (y1 - y / SUB) * scale];
  const root = svgFigure(width, height, "The example triangle and its three edges on the pixel grid");
  if (showsSamples()) gridLines(root, to, Math.floor(x0), Math.ceil(x1), Math.floor(y0), Math.ceil(y1));
  root.append(svg("polygon", {points: t.x.map((x, i) => to(x, t.y[i]).join(",")).join(" "), fill: "var(--accent)", "fill-opacity": 0.16}));
  t.edges.forEach((e, i) => edgeArrow(root, to, e, i, highlight === i || highlight === 3));
  t.x.forEach((x, i) => { const [a, b] = to(x, t.y[i]); root.append(svg("circle", {cx: a, cy: b, r: 4.5, fill: "var(--ink)"}), svg("text", {x: a + 8, y: b - 8, "font-size": 15, "font-weight": 650}, document.createTextNode("v" + i))); });
  if (showsSamples()) for (let y = box[1]; y < box[3]; ++y) for (let x = box[0]; x < box[2]; ++x) { const [a, b] = to(sampleX(x), sampleY(y)); root.append(svg("circle", {cx: a, cy: b, r: Math.min(3.5, scale / 8), fill: covers(t, x, y) ? "var(--accent)" : "var(--soft)"})); }
  return el("div", {class: "stage"}, root);
}

function gridLines(root, to, x0, x1, y0, y1) {
  const line = (a, b) => root.append(svg("line", {x1: a[0], y1: a[1], x2: b[0], y2: b[1], stroke: "var(--line)"}));
  for (let x = x0; x <= x1; ++x) line(to(x * SUB, y0 * SUB), to(x * SUB, y1 * SUB));
  for (let y = y0; y <= y1; ++y) line(to(x0 * SUB, y * SUB), to(x1 * SUB, y * SUB));
}

function edgeArrow(root, to, e, i, strong) {
  const a = to(e.x0, e.y0), b = to(e.x0 + e.ex, e.y0 + e.ey), length = Math.hypot(b[0] - a[0], b[1] - a[1]) || 1, d = [(b[0] - a[0]) / length, (b[1] - a[1]) / length];
  const color = strong ? "var(--accent)" : "var(--soft)", m = [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
  root.append(svg("line", {x1: a[0], y1: a[1], x2: b[0], y2: b[1], stroke: color, "stroke-width": strong ? 3 : 1.5}));
  const tip = (s, t) => [m[0] + d[0] * s - d[1] * t, m[1] + d[1] * s + d[0] * t].join(",");
  root.append(svg("polygon", {points: `${tip(8, 0)} ${tip(-5, 6)} ${tip(-5, -6)}`, fill: color}));
  root.append(svg("text", {x: m[0] - d[1] * 20 - 8, y: m[1] + d[0] * 20 + 5, "font-size": 15, "font-weight": 650, style: `fill:${color}`}, document.createTextNode("E" + i)));
}

const edgeLine = (e, i) => `E<sub>${i}</sub>(x, y) = ${fmt(e.ex)} · (y − ${operand(e.y0)}) − ${operand(e.ey)} · (x − ${operand(e.x0)})`;
const edgesAtPixel = () => TRI.edges.map((e) => edgeAt(e, sampleX(WINDOW[0]), sampleY(WINDOW[1])));
const depthFromEdges = () => { const at = edgesAtPixel(); return TRI.z0 + at[1] * TRI.z_edge1 + at[2] * TRI.z_edge2; };

chapter({
  id: "setup", title: "Triangle setup", kicker: "Primitive setup",
  lead: () => "Three lines bound a triangle. Each line has an edge function that is positive inside, zero on the line and negative outside. Because positions are integers, the values are exact: where triangles meet, no pixel is missed or drawn twice.",
  absent: () => (isTriangle ? null : `${EX === null ? "No primitive is visible at the example pixel" : "The primitive that is visible at the example pixel is not a triangle, so it has no edge functions"}. A frame with triangles: ${command("halfspace explain pipeline")}.`),
  input: () => ["three window positions in 1/256 pixel", "three depths"],
  output: () => ["three edge functions", "depth as z₀ + E₁ · a + E₂ · b", TRI && TRI.small ? "a small triangle: all values fit into 32 bits" : "a large triangle: values are shifted to fit into 32 bits"],
  steps: () => [
    {name: "Three edges", caption: `${exampleName[0].toUpperCase() + exampleName.slice(1)}. ${isClipped ? "It was clipped, and the picture shows the piece that covers the example pixel. " : ""}Its vertices are in counter-clockwise order, starting with the farthest one (v0).${showsSamples() ? ` The dots are ${DATA.samples === 1 ? "pixel centers" : `sample ${SAMPLE} of each pixel, the one at which the triangle is visible in the example pixel`}; colored dots are covered, gray ones are not.` : ""}`, draw: () => edgePicture(3)},
    ...TRI.edges.map((e, i) => ({name: `Edge E${i}`, caption: `The highlighted edge goes from v${(i + 1) % 3} to v${(i + 2) % 3}, opposite v${i}; the arrow shows its direction. ${e.bias ? `Samples exactly on this edge belong to the neighboring triangle, so E${i} must be at least 1 inside.` : `Samples exactly on this edge belong to this triangle, so E${i} may be 0.`}`, draw: () => edgePicture(i)})),
  ],
  formula: () => {
    const at = edgesAtPixel();
    return [`${TRI.edges.map(edgeLine).join("\n")}\n\n${say(`at ${sampleName} of pixel ${px(PIXEL)}, which is at (${fmt(sampleX(WINDOW[0]))}, ${fmt(sampleY(WINDOW[1]))}) in units of 1/256 pixel:`)}${TRI.edges.map((e, i) => `E<sub>${i}</sub> = ${fmt(at[i])} ≥ ${e.bias} → <b>${at[i] - e.bias >= 0 ? "inside" : "outside"}</b>`).join("\n")}`,
      `<em>z</em>(x, y) = z<sub>0</sub> + E<sub>1</sub> · ${operand(TRI.z_edge1, 9)} + E<sub>2</sub> · ${operand(TRI.z_edge2, 9)}\n     = ${fmt(TRI.z0, 9)} + ${operand(at[1])} · ${operand(TRI.z_edge1, 5)} + ${operand(at[2])} · ${operand(TRI.z_edge2, 5)} = <b>${fmt(depthFromEdges(), 8)}</b>${say(`The renderer computed the depth ${fmt(VISIBLE.depth, 8)} in floats.`)}`];
  },
  related: ["coverage", "depth"], lessons: ["A triangle"],
  exercises: () => {
    const at = edgesAtPixel(), i = TRI.edges.findIndex((e) => e.ey !== 0), e = TRI.edges[i], name = `E${"₀₁₂"[i]}`, right = at.includes(at[i] - e.ey * SUB) ? 2 : 1;
    return [
      {ask: `What is ${name} at ${sampleName} of the ${right === 1 ? "pixel" : "second pixel"} to the right of the example pixel, before the fill rule?`, answer: at[i] - e.ey * SUB * right, hint: `x increases by ${SUB * right}; only the second product changes.`, why: `${fmt(at[i])} − ${operand(e.ey)} · ${SUB * right}.`},
      {ask: `What is E₀ + E₁ + E₂ at ${sampleName} of the example pixel?`, answer: at[0] + at[1] + at[2], hint: "It is the same at every point of the plane.", why: `The sum is twice the area of the triangle${isClipped ? ", here of the piece," : ""} at every point.`},
      {ask: `What is the barycentric weight of v1 at ${sampleName} of the example pixel, without perspective?`, answer: at[1] / area2(TRI), decimals: 3, hint: "Divide E₁ by the sum from the previous exercise.", why: "The values of the edge functions are unnormalized barycentric coordinates."},
    ];
  },
});
