// The frame as a whole, and the spaces that a vertex passes through.

chapter({
  id: "frame", title: "One frame", kicker: "Start",
  lead: () => `This page explains how Halfspace rendered one frame of the scene <b>${escapeHtml(sceneName)}</b>${DATA.title && DATA.title !== sceneName.replace(/\.[^.]*$/, "") ? ` (${escapeHtml(DATA.title)})` : ""} with ${W} × ${H} pixels. All numbers were computed by the renderer for this frame. Follow one ${isTriangle ? "triangle" : "primitive"} from its mesh to the screen.`,
  steps: () => [
    {name: "The picture", caption: `The frame as it is displayed. The ring marks pixel ${px(PIXEL)}, the example of this page. ${DATA.overdraw.most === 0 ? "Nothing is drawn in this frame." : `${plural(FRAME.fragments[PIXEL[1] * W + PIXEL[0]], "fragment competes", "fragments compete")} for it. A fragment is one sample of one primitive${DATA.samples > 1 ? `; this frame has ${DATA.samples} samples per pixel` : ""}. The visible opaque fragment belongs to ${exampleName}.`}`,
      draw: () => picture(DATA.pictures.final, "The rendered picture, with a ring around the example pixel", {ringed: PIXEL})},
    {name: "The primitives", caption: `The opaque surfaces of the picture, with one color per ${KINDS.length === 1 ? KINDS[0] : "primitive"}. The colors have no other meaning. The background and transparent surfaces are left out.${ringNote()}`,
      draw: () => picture(DATA.pictures.triangles, "The picture with one color per primitive", {ringed: PIXEL})},
    {name: "The pipeline", caption: "The stages of the pipeline in order, and how many items each of them outputs in this frame. Each tile is drawn by one thread, so pixels need no locks, and the picture does not depend on the number of threads.",
      draw: () => el("div", {class: "stage"}, pipelineDiagram())},
  ],
  body: () => [
    el("p", {class: "keys", html: "Press <kbd>←</kbd> or <kbd>→</kbd> for the previous or next step. The last step of a chapter is followed by the first step of the next chapter. The slider selects a step of the chapter. While a picture has the focus, the arrow keys select a pixel; press <kbd>Tab</kbd> to leave it."}),
    el("p", {class: "keys", html: `To explain another pixel: ${command(`${DATA.command} --pixel X,Y`)}`}),
    ...(EX === null ? [] : choiceTable()),
    el("h3", {}, "Draw calls"),
    tableOf(["object", "kind", "vertices", "primitives", "culled faces"], DATA.draws.slice(0, 12).map((d) => [escapeHtml(d.object) + (d.copy ? ` (${d.copy})` : ""), `¶${d.kind}${d.layered ? ", transparent" : ""}`, d.vertices, d.primitives, `¶${d.cull}`])),
    DATA.draws.length > 12 ? el("p", {}, `… and ${DATA.draws.length - 12} more draws.`) : null],
  related: ["statistics", "history"], lessons: ["Rotation, view and look-at", "The library"],
  exercises: () => {
    const s = DATA.statistics, culled = s.culled_non_finite + s.culled_outside + s.culled_face + s.culled_degenerate + s.culled_no_sample;
    return [
      {ask: "How many samples would this frame have with twice the width and twice the height, over all pixels?", answer: 4 * W * H * DATA.samples, hint: "Multiply the new width, the new height and the number of samples per pixel.", why: `${2 * W} · ${2 * H} · ${DATA.samples}.`},
      {ask: "How many fragments does a pixel have on average?", answer: DATA.overdraw.total / (W * H), decimals: 2, hint: `The frame has ${fmt(DATA.overdraw.total)} fragments.`, why: `${fmt(DATA.overdraw.total)} fragments for ${fmt(W * H)} pixels.`},
      {ask: "What percentage of the submitted primitives never reached a tile?", answer: culled / Math.max(1, s.primitives_in) * 100, decimals: 0, hint: "The chapter “Culling” shows the number for each reason.", why: `${fmt(culled)} of ${fmt(s.primitives_in)} were culled.`},
    ];
  },
});

// Why the example pixel was chosen, in measured values (apps/explain/example_pixel.cpp).
function choiceTable() {
  const c = DATA.choice, rows = [["primitives with a fragment in the pixel", c.primitives], [`pixels at which this ${isTriangle ? "triangle" : "primitive"} is visible`, c.visible], ["pixels that it covers, visible or not", c.covered]];
  if (c.affine_error !== undefined) rows.push(["error of affine interpolation along its edges, in pixels", fmt(c.affine_error, 3)]);
  if (c.cosine !== undefined) rows.push(["largest n · l of the lights", fmt(c.cosine, 3)]);
  if (c.shadow !== undefined) rows.push(["shadow factor of the first light with a shadow", fmt(c.shadow, 3)]);
  return [el("h3", {}, "The example"), el("p", {}, c.by_user ? "The pixel was chosen with --pixel. What it can show:" : "The page chooses a visible triangle of about 10 to 2000 pixels, where the frame has one, at a pixel with several fragments that is partly lit, partly in shadow, and where perspective matters. Measured at this pixel:"), tableOf(["measured", "value"], rows)];
}
const KINDS = ["triangle", "line", "point"].filter((k) => DATA.draws.some((d) => d.kind === k + "s"));

function pipelineDiagram() {
  const s = DATA.statistics;
  const stages = [["vertices", s.vertices_shaded, "shaded"], ["primitives", s.primitives_in, "submitted"], ["setup", s.triangles_binned, "kept"], ["bins", s.bin_entries, "entries"], ["samples", s.samples_passed, "passed"], ["shader runs", s.fragments_shaded, "of fragments"]];
  const narrow = narrowWindow.matches, columns = narrow ? 3 : 6, root = svgFigure(24 + columns * 118, narrow ? 260 : 150, "Pipeline. " + stages.map(([name, count, what]) => `${name}: ${fmt(count)} ${what}`).join(", "));
  stages.forEach(([name, count, what], i) => {
    const x = 12 + i % columns * 118, top = Math.floor(i / columns) * 116;
    root.append(svg("rect", {x, y: top + 32, width: 100, height: 84, rx: 10, fill: "var(--card)", stroke: i === 0 ? "var(--accent)" : "var(--line)", "stroke-width": 1.5}));
    const text = (y, size, weight, value, color = "var(--ink)") => root.append(svg("text", {x: x + 50, y: top + y, "font-size": size, "font-weight": weight, "text-anchor": "middle", style: `fill:${color}`}, document.createTextNode(value)));
    text(56, 13, 400, name, "var(--soft)");
    text(80, 17, 650, fmt(count));
    text(102, 12.5, 400, what, "var(--soft)");
    if (i < 5) root.append(svg("path", {d: `M${x + 102} ${top + 74} h12 m-4 -4 l4 4 l-4 4`, fill: "none", stroke: "var(--accent)", "stroke-width": 1.8}));
  });
  return root;
}

// ---- wireframes ------------------------------------------------------------------------------------------------------

// Returns the edges of the wireframe's triangles, each edge once: {ends, outcome, draw, w}. The ends are in view space, where edges are
// clipped at the near plane, so that an edge is whole up to there. w: distance of the middle of the edge along the view axis.
function wireEdges(keeps = () => true) {
  const seen = new Set(), out = [], near = M.perspective ? M.near : -Infinity;
  for (let t = 0; t < DATA.wire.count; ++t) {
    if (!keeps(FRAME.outcomes[t])) continue;
    const p = [0, 1, 2].map((k) => FRAME.positions.subarray(9 * t + 3 * k, 9 * t + 3 * k + 3));
    for (const k of [0, 1, 2]) {
      const names = [p[k].join(), p[(k + 1) % 3].join()].sort().join(" ");
      if (seen.has(names)) continue;
      seen.add(names);
      const a = toView(p[k]), b = toView(p[(k + 1) % 3]), [da, db] = [-a[2], -b[2]];
      if (Math.max(da, db) < near) continue;
      const cut = (inside, outside) => { const f = (near + inside[2]) / (inside[2] - outside[2]); return inside.map((v, i) => v + (outside[i] - v) * f); };
      const ends = da < near ? [cut(b, a), b] : db < near ? [a, cut(a, b)] : [a, b];
      out.push({ends, outcome: FRAME.outcomes[t], draw: FRAME.wireDraws[t], w: -(ends[0][2] + ends[1][2]) / 2});
    }
  }
  return out;
}

// Returns the opacity of an edge: near edges are strong, and distant ones fade.
function distanceFade(edges) {
  const sorted = edges.map((e) => e.w).sort((a, b) => a - b), near = sorted[Math.floor(sorted.length * 0.02)] ?? 1, far = sorted[Math.floor(sorted.length * 0.98)] ?? 1;
  const dense = Math.max(0.35, Math.min(1, 3000 / Math.max(edges.length, 1)));
  return (w) => dense * (0.12 + 0.88 * (1 - Math.min(1, Math.max(0, (w - near) / Math.max(far - near, 1e-9)))));
}

// Returns the wireframe's triangles in one space. to(position, triangle) returns three coordinates, or null.
function wireIn(to) {
  const out = [];
  for (let t = 0; t < DATA.wire.count; ++t) {
    const corners = [0, 1, 2].map((k) => to([...FRAME.positions.subarray(9 * t + 3 * k, 9 * t + 3 * k + 3)], t));
    if (corners.every((c) => c !== null && c.every(Number.isFinite))) out.push({corners, draw: FRAME.wireDraws[t], outcome: FRAME.outcomes[t]});
  }
  return out;
}

const M = DATA.transforms;
const toView = (p) => transform(M.view_from_world, p);
const toClip = (p) => transform(M.clip_from_view, toView(p));
const toNdc = (c) => (c[3] > 1e-9 ? [c[0] / c[3], c[1] / c[3], c[2] / c[3]] : null);
const toPixels = (n) => (n === null ? null : [(n[0] + 1) / 2 * W, (1 - n[1]) / 2 * H, 0]);

// Returns the range of values that a drawing shows: all of them or, if a few values are far away from the others, those of the others.
function shownRange(values) {
  const sorted = Float64Array.from(values).sort(), at = (q) => sorted[Math.round(q * (sorted.length - 1))], all = [sorted[0], sorted[sorted.length - 1]];
  const most = [at(0.03), at(0.97)], margin = 0.15 * (most[1] - most[0]);
  return all[1] - all[0] > 4 * (most[1] - most[0]) && most[1] > most[0] ? [most[0] - margin, most[1] + margin] : all;
}

// Returns a function that projects points to the canvas, as seen from the front right and above. Dragging changes ORBIT.
const ORBIT = {yaw: 0.6, pitch: 0.42};
function projector(points, width, height) {
  const [cy, sy, cp, sp] = [Math.cos(ORBIT.yaw), Math.sin(ORBIT.yaw), Math.cos(ORBIT.pitch), Math.sin(ORBIT.pitch)];
  const turn = ([x, y, z]) => [cy * x - sy * z, cp * y - sp * (sy * x + cy * z), sp * y + cp * (sy * x + cy * z)];
  const turned = points.map(turn), ranges = [0, 1].map((k) => shownRange(turned.map((p) => p[k]))), box = [0, 1].map((end) => ranges.map((r) => r[end]));
  const scale = 0.86 * Math.min(width / Math.max(box[1][0] - box[0][0], 1e-9), height / Math.max(box[1][1] - box[0][1], 1e-9));
  const [cx, cyy] = [0, 1].map((k) => (box[0][k] + box[1][k]) / 2);
  return (p) => { const q = turn(p); return [width / 2 + (q[0] - cx) * scale, height / 2 - (q[1] - cyy) * scale, q[2]]; };
}

// Draws triangles and lines in 3D. The example triangle is filled.
function wireCanvas(label, triangles, lines, example, points = []) {
  const width = 1000, height = 560, {canvas, pen} = canvasFigure(width, height, label);
  const all = [...triangles.flatMap((t) => t.corners), ...lines.flatMap((l) => l.points), ...points, ...(example || [])];
  let to = null, edges = [];
  // k: magnification. isNear(a, b): whether a line from a to b has to be drawn.
  const paint = (pen, k, isNear) => {
    pen.lineJoin = "round";
    const ink = css("--ink");
    pen.strokeStyle = ink;
    pen.lineWidth = 1 / k;
    for (const e of edges) {
      if (!isNear(...e.ends)) continue;
      pen.globalAlpha = e.alpha;
      stroke(pen, ...e.ends);
    }
    pen.globalAlpha = 0.7;
    pen.fillStyle = ink;
    for (const p of points) { const [x, y] = to(p); pen.fillRect(x - 1 / k, y - 1 / k, 2 / k, 2 / k); }
    pen.globalAlpha = 1;
    for (const l of lines) {
      pen.setLineDash((l.dash || []).map((d) => d / k));
      pen.strokeStyle = css(l.color || "--soft");
      pen.lineWidth = (l.width || 1.5) / k;
      pen.beginPath();
      l.points.map(to).forEach(([x, y], i) => (i ? pen.lineTo(x, y) : pen.moveTo(x, y)));
      pen.stroke();
      pen.setLineDash([]);
      if (l.name && k === 1) { const [x, y] = to(l.points[l.points.length - 1]); pen.fillStyle = css(l.color || "--soft"); pen.font = `600 ${narrowWindow.matches ? 34 : 19}px system-ui`; pen.fillText(l.name, x + 7, y + 5); }
    }
    if (example) markExample(pen, example.map(to), k);
  };
  const draw = () => {
    to = projector(all, width, height);
    edges = drawnEdges(triangles, to);
    pen.clearRect(0, 0, width, height);
    paint(pen, 1, () => true);
  };
  draggable(canvas, draw);
  draw();
  return [addDrawnLoupe(el("div", {class: "stage"}, canvas), canvas, paint), turnControl(draw)];
}

// Returns each edge of the triangles once: {ends, alpha}. Edges that are farther from the viewer of the drawing are fainter.
function drawnEdges(triangles, to) {
  const seen = new Set(), edges = [];
  for (const t of triangles) for (const k of [0, 1, 2]) {
    const ends = [t.corners[k], t.corners[(k + 1) % 3]], name = ends.map((p) => p.join()).sort().join(" ");
    if (seen.has(name)) continue;
    seen.add(name);
    edges.push(ends.map(to));
  }
  const depths = edges.map(([a, b]) => a[2] + b[2]), low = depths.reduce((m, d) => Math.min(m, d), Infinity), high = depths.reduce((m, d) => Math.max(m, d), -Infinity);
  const dense = Math.max(0.3, Math.min(0.9, 2000 / Math.max(edges.length, 1)));
  return edges.map((ends, i) => ({ends, alpha: dense * (0.15 + 0.85 * (depths[i] - low) / Math.max(high - low, 1e-9))}));
}

// k: magnification of the pen.
function markExample(pen, points, k = 1) {
  if (points.length === 3) polygon(pen, points, {fill: css("--accent"), stroke: css("--accent"), width: 2 / k});
  const [x, y] = points[0];
  pen.strokeStyle = css("--accent");
  pen.lineWidth = 3 / k;
  pen.beginPath();
  pen.arc(x, y, 14, 0, 7);
  pen.stroke();
}

function draggable(canvas, draw) {
  let last = null;
  canvas.style.cursor = "grab";
  canvas.style.touchAction = "pan-y";
  canvas.addEventListener("pointerdown", (e) => { last = [e.clientX, e.clientY]; canvas.setPointerCapture(e.pointerId); });
  canvas.addEventListener("pointerup", () => { last = null; });
  canvas.addEventListener("pointermove", (e) => {
    if (!last) return;
    ORBIT.yaw -= (e.clientX - last[0]) * 0.008;
    ORBIT.pitch = Math.max(-1.5, Math.min(1.5, ORBIT.pitch + (e.clientY - last[1]) * 0.008));
    last = [e.clientX, e.clientY];
    draw();
  });
}

function turnControl(draw) {
  const range = el("input", {type: "range", min: -180, max: 180, value: Math.round(ORBIT.yaw * 180 / Math.PI), "aria-label": "Rotate the view, in degrees", title: "Rotate the view (keys ← and →)"});
  range.addEventListener("input", () => { ORBIT.yaw = range.value * Math.PI / 180; draw(); });
  return el("div", {class: "legend"}, el("span", {}, "rotate"), range, el("span", {}, "or drag the picture"));
}

const axes = (length, at = [0, 0, 0]) => [["x", [1, 0, 0]], ["y", [0, 1, 0]], ["z", [0, 0, 1]]].map(([name, d]) => ({name, color: "--soft", points: [at, at.map((v, k) => v + d[k] * length)]}));

// The edges of the view volume in view space.
function frustumLines() {
  const inverse = (x, y, depth) => { const s = 1 / M.clip_from_view[0], t = 1 / M.clip_from_view[5]; return M.perspective ? [x * s * depth, y * t * depth, -depth] : [x * s, y * t, -depth]; };
  const far = Math.min(M.far, visibleDepth() * 1.05), rect = (d) => [[-1, -1], [1, -1], [1, 1], [-1, 1], [-1, -1]].map(([x, y]) => inverse(x, y, d));
  const sides = [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([x, y]) => ({color: "--accent", points: [M.perspective ? [0, 0, 0] : inverse(x, y, M.near), inverse(x, y, far)]}));
  return [{color: "--accent", points: rect(M.near)}, {color: "--accent", points: rect(far)}, ...sides];
}
function visibleDepth() {
  let depth = M.near * 2;
  for (let i = 0; i < FRAME.positions.length; i += 3) {
    const v = toView(FRAME.positions.subarray(i, i + 3)), c = transform(M.clip_from_view, v);
    if (Math.abs(c[0]) <= c[3] && Math.abs(c[1]) <= c[3]) depth = Math.max(depth, -v[2]);
  }
  return Math.min(depth, M.far);
}

const viewToWorld = () => { const i = inverseAffine(M.view_from_world); return (p) => transform(i, p).slice(0, 3); };
// Whether the example is a primitive that a geometry function emitted.
const isEmitted = () => EX !== null && EMISSION !== null && EMISSION.draws.some((d) => d.draw === EX.draw);
const exampleCorners = (to) => (EX && EX.vertices[0].ws ? EX.vertices.map((v) => to(v.ws)).filter((p) => p !== null) : null);

// Says how the drawings mark the example. count: of the vertices that are drawn.
const exampleCircle = (count) => (count === 3 ? "The example is filled, with a circle around its first vertex." : "The circle marks the example.");
const wireNote = (corners) => ` Lines that are farther away in the drawing are fainter.${corners ? ` ${exampleCircle(corners.length)}` : ""}`;
const clipPlot = (p) => { const c = toClip(p); return [c[0], c[1], -c[3]]; };

function spaceSteps() {
  const some = (step) => (step > 1 ? ` A random sample of about one in ${step} primitives is shown.` : "");
  const back = viewToWorld(), object = EX ? DATA.draws[EX.draw].world_from_object : null;
  const toObject = (p) => transform(inverseAffine(object), p).slice(0, 3);
  const size = (list) => Math.max(...list.flatMap((t) => t.corners).flat().map(Math.abs), 0.1);
  return [
    {name: "Object space", caption: `The mesh of <i>${escapeHtml(EX.object)}</i> in its own coordinates, as it was modeled. Gray lines are the axes.${some(DATA.wire.own_step)}${wireNote(exampleCorners(toObject))}`,
      draw: () => { const own = wireIn(toObject).filter((t) => t.draw === EX.draw); return wireCanvas("Wireframe of the mesh in object space", own, axes(size(own) * 1.2), exampleCorners(toObject)); }},
    {name: "World space", caption: `Every object is scaled, rotated and moved to its position. The colored lines show the view volume of the camera at ${vec(M.eye, 4)}.${some(Math.max(DATA.wire.step, DATA.wire.own_step))}${wireNote(exampleCorners((p) => p))}`,
      draw: () => wireCanvas("Wireframe of all objects in world space, with the camera", wireIn((p) => p), frustumLines().map((l) => ({...l, points: l.points.map(back)})), exampleCorners((p) => p))},
    {name: "View space", caption: `The same scene, transformed so that the camera is at the origin and looks along −z. x points to the right and y up. Gray lines are the axes, and colored lines show the view volume.${wireNote(exampleCorners((p) => toView(p).slice(0, 3)))}`,
      draw: () => wireCanvas("Wireframe in view space, with the camera at the origin", wireIn((p) => toView(p).slice(0, 3)), [...frustumLines(), ...axes(visibleDepth() / 4)], exampleCorners((p) => toView(p).slice(0, 3)))},
    {name: "Clip space", caption: `Positions have four coordinates. The plot shows x, y and −w. ${M.perspective ? "w is the distance along the view axis, and the visible part is the pyramid |x| ≤ w, |y| ≤ w" : "w is 1 for all vertices in an orthographic view"}. Colored lines show its edges.${wireNote(exampleCorners(clipPlot))}`,
      draw: () => wireCanvas("Wireframe in clip space, with w as the third axis", wireIn(clipPlot), clipCone(), exampleCorners(clipPlot))},
    {name: "Normalized device coordinates", caption: "After the division by w, the view volume is a box: x and y from −1 to 1, depth from 0 (far) to 1 (near). " + (M.perspective ? "Near objects have become larger and distant ones smaller." : "The projection of this frame is orthographic, so w is 1 and the division changes nothing.") + ` Colored lines show the box.${wireNote(exampleCorners((p) => toNdc(toClip(p))))}`,
      draw: () => wireCanvas("Wireframe in normalized device coordinates", wireIn((p) => toNdc(toClip(p))).filter(isInBox), boxLines(), exampleCorners((p) => toNdc(toClip(p))))},
    {name: "Window space", caption: `The box is scaled to the size of the window, and positions are rounded to 1/256 pixel. From here on, x and y are integers. The wireframe is drawn over the faded picture; lines that are farther from the camera are fainter. ${isClipped ? "The pieces of the example, which was clipped, are filled, each with a circle around its first vertex." : exampleCircle(EX.vertices.length)}`,
      draw: () => picture(DATA.pictures.final, "The picture with the wireframe on top", {overlay: windowWires})},
  ];
}
const isInBox = (t) => t.corners.every(([x, y, z]) => Math.abs(x) < 1.6 && Math.abs(y) < 1.6 && z > -0.2 && z < 1.2);
function clipCone() {
  const w = M.perspective ? visibleDepth() : 1.2, at = (x, y, d) => [x * d, y * d, -d];
  return [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([x, y], i, all) => ({color: "--accent", points: [[0, 0, 0], at(x, y, w), at(...all[(i + 1) % 4], w)]}));
}
function boxLines() {
  const rect = (z) => ({color: "--accent", points: [[-1, -1, z], [1, -1, z], [1, 1, z], [-1, 1, z], [-1, -1, z]]});
  return [rect(0), rect(1), ...[[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([x, y]) => ({color: "--accent", points: [[x, y, 0], [x, y, 1]]})), {name: "near, z = 1", color: "--accent", points: [[1, 1, 1]]}, {name: "far, z = 0", color: "--accent", points: [[1, -1, 0]]}];
}
function windowWires(pen, s) {
  pen.fillStyle = css("--paper");
  pen.globalAlpha = 0.72;
  pen.fillRect(0, 0, W * s, H * s);
  const scaled = ([x, y]) => [x * s, y * s], edges = wireEdges((outcome) => outcome < 2 || outcome > 3), fade = distanceFade(edges);
  pen.strokeStyle = css("--ink");
  pen.lineWidth = 1.25;
  for (const e of edges) {
    const [a, b] = e.ends.map((v) => toPixels(toNdc(transform(M.clip_from_view, v))));
    if (a === null || b === null) continue;
    pen.globalAlpha = fade(e.w);
    stroke(pen, scaled(a), scaled(b));
  }
  pen.globalAlpha = 1;
  if (isClipped) for (const t of EX.triangles) markExample(pen, windowCorners(t, s));
  else if (EX) markExample(pen, EX.vertices.map((v) => scaled([v.x / SUB, H - v.y / SUB])));
}

// The vertex whose transforms the chapter shows: one inside the window or, if there is none, one in front of the near plane. The window
// position of a vertex outside the integer grid has no meaning.
const OUT_GUARD = 64;  // see pipeline_data.h
const isInWindow = (v) => v.clip[3] > 0 && v.outcode === 0 && v.x >= 0 && v.x < W * SUB && v.y >= 0 && v.y < H * SUB;
const isInGrid = (v) => v.clip[3] > 0 && (v.outcode & OUT_GUARD) === 0;
const bestVertex = (indices) => indices.find((i) => isInWindow(EX.vertices[i])) ?? indices.find((i) => isInGrid(EX.vertices[i]));
const shownVertex = () => bestVertex([...EX.vertices.keys()]) ?? 0;
// The vertex of the exercises: another one, or undefined.
const askedVertex = () => { const n = EX.vertices.length, shown = shownVertex(); return bestVertex([1, 2].slice(0, n - 1).map((k) => (shown + k) % n)); };
const vertexName = (i) => (EX.vertices.length > 1 ? `${["first", "second", "third"][i]} vertex` : "vertex");

const column = (name, values, digits = 6) => `${name.padEnd(8)}${values.map((v) => fmt(v, digits).padStart(14)).join("")}`;
// Elements that are merely rounding errors are shown as 0.
const matrixRows = (m) => {
  const negligible = 1e-14 * Math.max(...m.map(Math.abs));
  return [0, 1, 2, 3].map((r) => [0, 1, 2, 3].map((c) => fmt(Math.abs(m[4 * c + r]) < negligible ? 0 : m[4 * c + r], 5).padStart(11)).join(" "));
};

function spaceFormulas() {
  const shown = shownVertex(), v = EX.vertices[shown], rows = (v.ws ? [["object", [...v.os, 1]], ["world", [...v.ws, 1]], ["view", [...v.vs, 1]]] : []).concat([["clip", v.clip], ["NDC", v.ndc]]);
  const chain = rows.map(([n, values]) => column(n, values)).join("\n") + "\n" + column("window", [v.x / SUB, v.y / SUB, v.z], 9);
  const formula = `<em>p</em><sub>clip</sub> = P · V · M · <em>p</em><sub>object</sub>        <em>p</em><sub>ndc</sub> = (<em>x</em>, <em>y</em>, <em>z</em>) / <em>w</em>\n\n${say(`The ${vertexName(shown)} of ${exampleName}:`)}`;
  const own = EX.vertices[0].ws ? `\n\n${say(`<em>p</em><sub>world</sub> = M · <em>p</em><sub>object</sub>, row by row:`)}${productRows(DATA.draws[EX.draw].world_from_object, v.os, v.ws)}` : "";
  const x = `\n\n<em>x</em><sub>window</sub> = round(256 · (<em>x</em>/<em>w</em> · ${fmt(W / 2)} + ${fmt(W / 2)})) / 256\n         = round(256 · (${fmt(v.ndc[0], 7)} · ${fmt(W / 2)} + ${fmt(W / 2)})) / 256 = <b>${fmt(v.x)}/256 = ${fmt(v.x / SUB, 9)}</b>`;
  const matrices = EX.vertices[0].ws ? [`M (world from object)\n${matrixRows(DATA.draws[EX.draw].world_from_object).join("\n")}\n\nV (view from world)\n${matrixRows(M.view_from_world).join("\n")}\n\nP (clip from view)\n${matrixRows(M.clip_from_view).join("\n")}`] : [];
  const ndc = `\n\n<em>x</em><sub>ndc</sub> = <em>x</em><sub>clip</sub> / <em>w</em> = ${fmt(v.clip[0], 7)} / ${fmt(v.clip[3], 7)} = <b>${fmt(v.ndc[0], 7)}</b>`;
  return [formula + chain + own + ndc + x, ...matrices];
}

// The first three rows of a matrix times a point, with numbers.
const productRows = (m, p, result) => [0, 1, 2].map((r) => `${[0, 1, 2].map((c) => `${(c === 0 ? fmt : operand)(m[4 * c + r], 5)} · ${operand(p[c], 5)}`).join(" + ")} + ${operand(m[12 + r], 5)} = <b>${fmt(result[r], 6)}</b>`).join("\n");

chapter({
  id: "spaces", title: "From the mesh to the window", kicker: "Vertex stage",
  lead: () => "The position of a vertex is given in the coordinates of its mesh. Three matrices and one division transform it to the window. The renderer multiplies the matrices once per object, in double precision, and transforms each vertex with the product.",
  absent: () => (EX === null ? `Nothing is visible at the example pixel of this frame. Try ${command("halfspace explain pipeline")}.` : DATA.wire.count === 0 ? `This frame has no mesh: ${EX.corners === 1 ? "it consists of points, and each point is drawn as a sphere inside a rectangle" : "the background is a single triangle that covers the window"}. A scene with meshes: ${command("halfspace explain pipeline")}.` : isEmitted() ? `The example pixel shows a line that a geometry function emitted, so its vertices do not come from a mesh. The chapter <a href="#geometry">Geometry stage</a> shows where they come from.` : null),
  input: () => [plural(DATA.statistics.vertices_in, "index", "indices"), plural(DATA.draws.length, "draw with a matrix", "draws, each with a matrix")],
  output: () => [plural(DATA.statistics.vertices_shaded, "shaded vertex", "shaded vertices"), "for each: x and y in 1/256 pixel, depth, 1/w"],
  steps: spaceSteps,
  formula: spaceFormulas,
  related: ["clipping", "interpolation"], lessons: ["Perspective"],
  exercises: () => {
    const asked = askedVertex(), v = EX.vertices[asked], which = vertexName(asked);
    return [
      v === undefined ? {ask: "A vertex has the clip coordinates x = −1.5 and w = 6. What is x in normalized device coordinates?", answer: -0.25, decimals: 2, hint: "Divide by w.", why: "−1.5 / 6."}
        : M.perspective ? {ask: `The ${which} has clip coordinates x = ${num(v.clip[0])} and w = ${num(v.clip[3])}. What is x in normalized device coordinates?`, answer: v.ndc[0], decimals: 3, hint: "Divide by w.", why: "x / w."}
        : {ask: `The ${which} has y = ${num(v.ndc[1])} in normalized device coordinates. How many pixels is it above the lower edge of the window?`, answer: (v.ndc[1] + 1) / 2 * H, decimals: 1, hint: `From −1 to 1, there are ${H} pixels.`, why: `(${fmt(v.ndc[1], 6)} + 1) / 2 · ${H}.`},
      v === undefined || !isInWindow(v) ? {ask: "A vertex has x = 0.3 in normalized device coordinates. Which pixel column is it in?", answer: Math.floor(0.65 * W), hint: `From −1 to 1, there are ${W} columns.`, why: `(0.3 + 1) / 2 · ${W} = ${fmt(0.65 * W, 7)}, rounded down.`}
        : {ask: `The window position of the ${which} is x = ${num(v.x)}, in units of 1/256 pixel. Which pixel column is it in?`, answer: Math.floor(v.x / SUB), hint: "Divide by 256 and round down.", why: `${fmt(v.x)} / 256 = ${fmt(v.x / SUB, 9)}.`},
      {ask: `The ${fmt(DATA.statistics.vertices_in)} indices refer to ${fmt(DATA.statistics.vertices_shaded)} vertices, each of which is shaded once. How many times is a vertex used on average?`, answer: DATA.statistics.vertices_in / Math.max(1, DATA.statistics.vertices_shaded), decimals: 2, hint: "Divide the number of indices by the number of vertices.", why: DATA.statistics.vertices_shaded < DATA.statistics.vertices_in ? "A vertex that several triangles share is shaded only once." : "No vertex of this frame is shared."},
    ];
  },
});
