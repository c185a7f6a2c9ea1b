// Binning, coverage and depth.

const BINS = DATA.bins, TILE = BINS.tile;
const binCount = (tx, ty) => BINS.counts[ty * BINS.columns + tx];
const emptyTiles = () => BINS.counts.filter((n) => n === 0).length;
const mostBinned = Math.max(...BINS.counts, 1);
// Tile of the example pixel, in window coordinates.
const EXTILE = [Math.floor(WINDOW[0] / TILE), Math.floor(WINDOW[1] / TILE)];
const heat = (t) => { const stops = [[24, 18, 62], [42, 56, 128], [28, 106, 146], [34, 152, 134], [112, 190, 92], [230, 216, 88], [255, 250, 214]], x = Math.max(0, Math.min(1, t)) * 6, i = Math.min(5, Math.floor(x)), f = x - i; return `rgb(${stops[i].map((v, k) => Math.round(v + (stops[i + 1][k] - v) * f)).join(" ")})`; };

function eachTile(f) {
  for (let ty = 0; ty < BINS.rows; ++ty) for (let tx = 0; tx < BINS.columns; ++tx) f(tx, ty, tx * TILE, H - Math.min(H, (ty + 1) * TILE), Math.min(TILE, W - tx * TILE), Math.min(TILE, H - ty * TILE));
}

// Returns the font size of labels of tiles in a picture that is scaled by s: at least 9 pixels on the screen.
const tileFont = (s) => Math.max(Math.round(TILE / 8 * s), Math.ceil(9 * W * s / Math.min(innerWidth - 40, 880)));

// Tiles over the picture. mode: "grid", "heat" or "example".
function tilePicture(mode) {
  const read = (x, y) => { const tx = Math.floor(x / TILE), ty = Math.floor((H - 1 - y) / TILE); return `tile (${tx}, ${ty}): ${plural(binCount(tx, ty), "primitive")}`; };
  return picture(DATA.pictures.final, `The picture divided into tiles${mode === "heat" ? ", colored by their number of primitives" : mode === "example" ? ", with the tiles of the example highlighted" : ""}`, {read, overlay: (pen, s) => {
    eachTile((tx, ty, x, y, w, h) => {
      const n = binCount(tx, ty), marked = mode === "example" && touches(tx, ty);
      pen.globalAlpha = mode === "heat" ? 0.86 : 1;
      if (mode === "heat") { pen.fillStyle = heat(n / mostBinned); pen.fillRect(x * s, y * s, w * s, h * s); }
      pen.globalAlpha = marked ? 0.45 : 1;
      if (marked) { pen.fillStyle = css("--accent"); pen.fillRect(x * s, y * s, w * s, h * s); }
      pen.globalAlpha = 1;
      pen.strokeStyle = "rgb(255 255 255 / .45)";
      pen.lineWidth = 1;
      pen.strokeRect(x * s + 0.5, y * s + 0.5, w * s - 1, h * s - 1);
      if (mode !== "heat") return;
      pen.fillStyle = n / mostBinned > 0.55 ? "#111" : "#fff";
      const size = tileFont(s);
      pen.font = `${size}px system-ui`;
      pen.textAlign = "center";
      if (pen.measureText(fmt(n)).width + size / 2 < w * s && size < h * s) pen.fillText(fmt(n), (x + w / 2) * s, (y + h / 2) * s + size / 3);
    });
    if (mode === "example" && isTriangle) for (const t of EX.triangles) polygon(pen, windowCorners(t, s), {stroke: "#fff", fill: css("--accent"), width: 2});
  }});
}

// Returns the largest value of an edge function over the sample positions of a tile, like bin.cpp.
function maxInTile(e, tx, ty) {
  const px = tx * TILE + (e.ey < 0 ? TILE - 1 : 0), py = ty * TILE + (e.ex > 0 ? TILE - 1 : 0);
  const at = DATA.sample_positions.flat(), low = Math.min(...at), high = Math.max(...at);
  return edgeAt(e, px * SUB + (e.ey < 0 ? high : low), py * SUB + (e.ex > 0 ? high : low));
}
// The vertices of a triangle after setup, in a picture that is scaled by s.
const windowCorners = (t, s) => t.x.map((v, i) => [v / SUB * s, (H - t.y[i] / SUB) * s]);
const tileBox = (t) => [Math.floor(t.box[0] / TILE), Math.floor(t.box[1] / TILE), Math.floor((t.box[2] - 1) / TILE), Math.floor((t.box[3] - 1) / TILE)];
function touches(tx, ty) {
  return TRI === null ? tx === EXTILE[0] && ty === EXTILE[1] : EX.triangles.some((t) => isInBin(t, tx, ty));
}
function isInBin(t, tx, ty) {
  const [x0, y0, x1, y1] = tileBox(t);
  if (tx < x0 || ty < y0 || tx > x1 || ty > y1) return false;
  if (!t.edges || x0 === x1 || y0 === y1) return true;
  return t.edges.every((e) => maxInTile(e, tx, ty) - e.bias >= 0);
}
function touchedTiles() { const list = []; eachTile((tx, ty) => { if (touches(tx, ty)) list.push([tx, ty]); }); return list; }

chapter({
  id: "binning", title: "Binning into tiles", kicker: "Tiles",
  lead: () => `The window is divided into tiles of ${TILE} × ${TILE} pixels. Each tile has a bin: the list of the primitives that may overlap it. From here on, tiles are independent. A thread draws one tile at a time, and the pixels of the tile fit into its cache.`,
  input: () => [plural(DATA.statistics.triangles_binned, "primitive")],
  output: () => [`${BINS.columns} × ${BINS.rows} bins`, plural(DATA.statistics.bin_entries, "entry", "entries") + ", in submission order"],
  steps: () => [
    {name: "Tiles", caption: `${plural(BINS.columns * BINS.rows, "tile covers", "tiles cover")} the window. ${W % TILE || H % TILE ? "Those at the top and right edges are cut off. " : ""}Thin lines separate them. Rows are counted from the bottom, as in OpenGL.`, draw: () => tilePicture("grid")},
    {name: "Primitives per tile", caption: `Dark tiles have few primitives and bright ones many; the number in a tile counts them. The fullest tile has ${fmt(mostBinned)} primitives, and ${emptyTiles() === 0 ? "no tile is empty" : `${plural(emptyTiles(), "tile has", "tiles have")} none. Empty tiles are filled with the background color without processing their pixels one by one`}.`, draw: () => [tilePicture("heat"), legend("0", fmt(mostBinned))].flat()},
    {name: "The tiles of the example", caption: EX === null ? "No primitive is visible at the example pixel." : `${exampleName[0].toUpperCase() + exampleName.slice(1)} is listed in the bins of ${plural(touchedTiles().length, "tile")}, which ${touchedTiles().length === 1 ? "is" : "are"} colored.`, draw: () => tilePicture("example")},
  ],
  formula: () => (isPoint ? [`tiles = ⌊x<sub>0</sub> / ${TILE}⌋ … ⌊x<sub>1</sub> / ${TILE}⌋ × ⌊y<sub>0</sub> / ${TILE}⌋ … ⌊y<sub>1</sub> / ${TILE}⌋\n\n${say(`${exampleName[0].toUpperCase() + exampleName.slice(1)} covers the pixels x = ${TRI.box[0]} … ${TRI.box[2] - 1} and y = ${TRI.box[1]} … ${TRI.box[3] - 1}:`)}x: ⌊${TRI.box[0]} / ${TILE}⌋ … ⌊${TRI.box[2] - 1} / ${TILE}⌋ = <b>${tileBox(TRI)[0]} … ${tileBox(TRI)[2]}</b>\ny: ⌊${TRI.box[1]} / ${TILE}⌋ … ⌊${TRI.box[3] - 1} / ${TILE}⌋ = <b>${tileBox(TRI)[1]} … ${tileBox(TRI)[3]}</b>`] : isTriangle ? [`${say(`A tile is skipped if the maximum of an edge function over the samples of the tile is less than its bias. Tile (${EXTILE}), which contains the example pixel:`)}${TRI.edges.map((e, i) => `max E<sub>${i}</sub> = ${fmt(maxInTile(e, ...EXTILE))} ≥ ${e.bias} → <b>${maxInTile(e, ...EXTILE) - e.bias >= 0 ? "may overlap" : "cannot overlap"}</b>`).join("\n")}`] : []),
  related: ["coverage", "times"], lessons: ["Tiles and threads"],
  exercises: () => {
    const filled = BINS.columns * BINS.rows - emptyTiles();
    return [
      {ask: "How many primitives does a tile that is not empty have on average?", answer: DATA.statistics.bin_entries / Math.max(1, filled), decimals: 1, hint: "Divide the number of entries by the number of tiles that have some.", why: `${fmt(DATA.statistics.bin_entries)} / ${fmt(filled)}.`},
      {ask: "How many tiles does a primitive overlap on average?", answer: DATA.statistics.bin_entries / Math.max(1, DATA.statistics.triangles_binned), decimals: 2, hint: "Divide the number of entries by the number of primitives.", why: `${fmt(DATA.statistics.bin_entries)} entries for ${fmt(DATA.statistics.triangles_binned)} primitives.`},
      {ask: "How many tiles would a window of 1920 × 1080 pixels have with tiles of this size?", answer: Math.ceil(1920 / TILE) * Math.ceil(1080 / TILE), hint: "Round up the number of columns and the number of rows.", why: `⌈1920 / ${TILE}⌉ · ⌈1080 / ${TILE}⌉.`},
    ];
  },
});

// ---- coverage -----------------------------------------------------------------------------------------------------------

const PACKET = DATA.build.packet;

// Returns true if a segment has a point in a rectangle, by clipping it to the rectangle (Liang and Barsky).
function meets([ax, ay], [bx, by], x0, y0, x1, y1) {
  let from = 0, to = 1;
  for (const [p, q] of [[ax - bx, ax - x0], [bx - ax, x1 - ax], [ay - by, ay - y0], [by - ay, y1 - ay]]) {
    if (p === 0 && q < 0) return false;
    if (p < 0) from = Math.max(from, q / p);
    if (p > 0) to = Math.min(to, q / p);
  }
  return from <= to;
}

// Tells blocks that an edge of the triangle crosses from those that only the extension of its line crosses. The block test compares lines,
// so it cannot tell them apart.
function blockKind(t, x, y) {
  const kind = blockCoverage(t, x, y), at = [x * SUB, y * SUB, (x + 8) * SUB, (y + 8) * SUB], points = corners(t);
  return kind !== "some" || [0, 1, 2].some((i) => meets(points[i], points[(i + 1) % 3], ...at)) ? kind : "extension";
}

// Returns the coverage of the 8x8 block whose lower left pixel is (x, y), from the edge functions at the visible
// sample of its corner pixels: "none", "some" or "whole".
function blockCoverage(t, x, y) {
  let whole = true;
  for (const e of t.edges) {
    const values = [[0, 0], [7, 0], [0, 7], [7, 7]].map(([i, j]) => edgeAt(e, sampleX(x + i), sampleY(y + j)) - e.bias);
    if (Math.max(...values) < 0) return "none";
    if (Math.min(...values) < 0) whole = false;
  }
  return whole ? "whole" : "some";
}

function gridPicture(x0, y0, columns, rows, label, cell) {
  const size = Math.min(figureWidth() / columns, 460 / rows), width = figureWidth(), height = rows * size + 8, left = (width - columns * size) / 2;
  const root = svgFigure(width, height, label);
  const to = (x, y) => [left + (x / SUB - x0) * size, 4 + (y0 + rows - y / SUB) * size];
  for (let y = y0; y < y0 + rows; ++y) for (let x = x0; x < x0 + columns; ++x) {
    const [px, py] = to(x * SUB, (y + 1) * SUB), c = cell(x, y);
    root.append(svg("rect", {x: px, y: py, width: size, height: size, fill: c.fill || "transparent", "fill-opacity": c.opacity ?? 1, stroke: "var(--line)", "stroke-width": size > 6 ? 0.7 : 0}));
  }
  return {root, to, size};
}

function outline(root, to, points, width = 2) {
  root.append(svg("polygon", {points: points.map(([x, y]) => to(x, y).join(",")).join(" "), fill: "none", stroke: "var(--ink)", "stroke-width": width, "stroke-linejoin": "round"}));
}
const corners = (t) => (t.edges ? t.x.map((x, i) => [x, t.y[i]]) : [[t.x[0], t.y[0]], [t.x[1], t.y[0]], [t.x[1], t.y[1]], [t.x[0], t.y[1]]]);

function blocksPicture() {
  const [x0, y0] = EXTILE.map((t) => t * TILE), n = {none: 0, some: 0, extension: 0, whole: 0};
  const look = {none: ["transparent", 0], extension: ["var(--soft)", 0.3], some: ["var(--accent)", 0.3], whole: ["var(--accent)", 0.75]};
  const g = gridPicture(x0 / 8, y0 / 8, TILE / 8, TILE / 8, "The blocks of the tile: outside the triangle, crossed by an edge, crossed only by the extension of an edge, or fully covered", (bx, by) => {
    const kind = blockKind(TRI, bx * 8, by * 8);
    ++n[kind];
    return {fill: look[kind][0], opacity: look[kind][1]};
  });
  const scaled = (x, y) => g.to(x / 8, y / 8), clip = svg("clipPath", {id: "tile"}, svg("rect", {x: scaled(x0 * SUB, 0)[0], y: 4, width: g.size * TILE / 8, height: g.size * TILE / 8}));
  const inner = svg("g", {"clip-path": "url(#tile)"});
  outline(inner, scaled, corners(TRI));
  g.root.append(clip, inner);
  return [el("div", {class: "stage"}, g.root), el("div", {class: "readout"}, `${n.none} blocks outside · ${n.some} crossed by an edge · ${n.extension} crossed only by the extension of an edge (gray) · ${n.whole} fully covered`)];
}

function packetPicture() {
  const [x0, y0] = WINDOW.map(blockOf), [pw, ph] = PACKET;
  const g = gridPicture(x0, y0, 8, 8, "One block of 8 by 8 pixels with its packets", (x, y) => ({fill: covers(TRI, x, y) ? "var(--accent)" : "transparent", opacity: 0.55}));
  for (let y = y0; y < y0 + 8; y += ph) for (let x = x0; x < x0 + 8; x += pw) {
    const [a, b] = g.to(x * SUB, (y + ph) * SUB);
    g.root.append(svg("rect", {x: a, y: b, width: g.size * pw, height: g.size * ph, fill: "none", stroke: "var(--ink)", "stroke-width": 1.8}));
  }
  const block = svg("clipPath", {id: "block"}, svg("rect", {x: g.to(x0 * SUB, 0)[0], y: 4, width: g.size * 8, height: g.size * 8})), inner = svg("g", {"clip-path": "url(#block)"});
  outline(inner, g.to, corners(TRI));
  g.root.append(block, inner);
  return el("div", {class: "stage"}, g.root);
}

// Shows the values of the edge functions at the pixel under the pointer.
function samplePicture() {
  const [x0, y0] = WINDOW.map((v) => blockOf(v));
  const readout = el("div", {class: "readout", "aria-live": "polite"});
  const show = (x, y) => { readout.innerHTML = `pixel ${px([x, H - 1 - y])}, ${sampleName}: ` + (TRI.edges ? TRI.edges.map((e, i) => `E${i} = ${fmt(edgeAt(e, sampleX(x), sampleY(y)))} ${edgeAt(e, sampleX(x), sampleY(y)) >= e.bias ? "≥" : "<"} ${e.bias}`).join(" · ") : `(${fmt(sampleX(x))}, ${fmt(sampleY(y))}) in 1/256 pixel`) + ` → ${covers(TRI, x, y) ? "covered" : "not covered"}`; };
  const g = gridPicture(x0, y0, 8, 8, "The samples of one block", (x, y) => ({fill: covers(TRI, x, y) ? "var(--accent)" : "transparent", opacity: 0.3}));
  for (let y = y0; y < y0 + 8; ++y) for (let x = x0; x < x0 + 8; ++x) {
    const [a, b] = g.to(sampleX(x), sampleY(y)), example = x === WINDOW[0] && y === WINDOW[1];
    const dot = svg("circle", {cx: a, cy: b, r: example ? 9 : 6, fill: covers(TRI, x, y) ? "var(--accent)" : "var(--soft)", stroke: example ? "var(--ink)" : "none", "stroke-width": 2.5});
    const [left, top] = g.to(x * SUB, (y + 1) * SUB), hit = svg("rect", {x: left, y: top, width: g.size, height: g.size, fill: "transparent"});
    for (const type of ["pointermove", "click"]) hit.addEventListener(type, () => show(x, y));
    g.root.append(dot, hit);
  }
  outline(g.root, g.to, corners(TRI), 1.5);
  g.root.setAttribute("overflow", "hidden");
  show(...WINDOW);
  pickable(g.root, 8, 8, [WINDOW[0] - x0, 7 - (WINDOW[1] - y0)], (x, y) => show(x0 + x, y0 + 7 - y));
  return [el("div", {class: "stage"}, g.root), readout];
}

// Two triangles whose common edge passes through sample positions, to demonstrate the fill rule.
const SHARED = (() => {
  const p = [[128, 128], [1664, 128], [1664, 1664], [128, 1664]], make = (a, b, c) => ({x: [a, b, c].map((i) => p[i][0]), y: [a, b, c].map((i) => p[i][1])});
  return [make(0, 1, 2), make(0, 2, 3)].map((t) => ({...t, box: [0, 0, 7, 7], edges: [0, 1, 2].map((i) => { const a = (i + 1) % 3, b = (i + 2) % 3, ex = t.x[b] - t.x[a], ey = t.y[b] - t.y[a]; return {x0: t.x[a], y0: t.y[a], ex, ey, bias: ey < 0 || (ey === 0 && ex > 0) ? 0 : 1}; })}));
})();
const inShared = (i, x, y) => inside(SHARED[i], x * SUB + SUB / 2, y * SUB + SUB / 2);
function sharedPicture() {
  const g = gridPicture(0, 0, 7, 7, "Two triangles that share an edge through pixel centers; each center inside the square belongs to exactly one of the triangles", (x, y) => ({fill: inShared(0, x, y) ? "var(--accent)" : inShared(1, x, y) ? "var(--soft)" : "transparent", opacity: 0.55}));
  for (const t of SHARED) outline(g.root, g.to, corners(t));
  for (let y = 0; y < 7; ++y) for (let x = 0; x < 7; ++x) { const [a, b] = g.to(x * SUB + SUB / 2, y * SUB + SUB / 2); g.root.append(svg("circle", {cx: a, cy: b, r: 4.5, fill: "var(--ink)"})); }
  return el("div", {class: "stage"}, g.root);
}

// The size of the rectangle of pixels around all pieces of the example.
const boxSize = () => [0, 1].map((k) => Math.max(...EX.triangles.map((t) => t.box[k + 2])) - Math.min(...EX.triangles.map((t) => t.box[k])));
const inBlock = () => { let n = 0; const [x0, y0] = WINDOW.map(blockOf); for (let y = y0; y < y0 + 8; ++y) for (let x = x0; x < x0 + 8; ++x) n += covers(TRI, x, y); return n; };

chapter({
  id: "coverage", title: "Coverage", kicker: "Tiles",
  lead: () => "Which samples are inside the triangle? The rasterizer proceeds from coarse to fine: tile, block of 8 × 8 pixels, packet, sample. Blocks that are entirely inside or outside need no test per sample.",
  absent: () => (TRI === null ? `No primitive is visible at the example pixel. A frame with triangles: ${command("halfspace explain pipeline")}.` : null),
  input: () => ["the bin of the tile", isPoint ? "the rectangle of each point" : "three edge functions per triangle"],
  output: () => [`packets of ${PACKET[0]} × ${PACKET[1]} pixels with a coverage mask, one bit per lane`, `this build has ${DATA.build.lanes} lanes (${escapeHtml(DATA.build.description)})`],
  steps: () => [
    ...(TRI.edges ? [{name: "Blocks of the tile", caption: `The tile of the example pixel, divided into blocks of 8 × 8 pixels, with the outline of ${exampleName}. Strongly colored blocks are fully covered, faintly colored ones are crossed by an edge, gray ones only by the extension of an edge, and empty ones are outside. Only blocks that the line of an edge crosses are tested further. Where the line crosses a block beyond the end of the edge, the block is tested in vain.${DATA.samples > 1 ? ` The picture is for sample ${SAMPLE}; each of the ${DATA.samples} samples is processed like a picture of its own.` : ""}`, draw: blocksPicture}] : []),
    {name: "Packets", caption: `The block of the example pixel. This build (${escapeHtml(DATA.build.description)}) processes ${DATA.build.lanes} pixels at once, in packets of ${PACKET[0]} × ${PACKET[1]}, because a register holds ${DATA.build.lanes} floats. Thick frames are packets, and colored pixels are covered${DATA.samples > 1 ? ` at sample ${SAMPLE}` : ""}.`, draw: packetPicture},
    {name: "Samples", caption: "A sample is covered if no edge function is negative after the fill rule has been applied. Colored dots are covered, gray ones are not, and the outlined dot belongs to the example pixel. Point at a sample to see its values, or focus the picture and press the arrow keys." + (DATA.samples > 1 ? ` The dots are sample ${SAMPLE} of each pixel, the one at which ${exampleName} is visible in the example pixel.` : ""), draw: samplePicture},
    {name: "A shared edge", caption: "Two triangles that form a square (not part of this frame). The dots are pixel centers; the pixels of one triangle are colored, those of the other are gray. Their common edge passes exactly through pixel centers. Each center inside the square belongs to exactly one triangle: the one for which the edge is a left edge, or a horizontal edge with the inside above it. The center at the upper right corner belongs to neither, because the right and the top side of the square are not covered.", draw: sharedPicture},
  ],
  formula: () => (isPoint ? [pointRectangle(), `${say(`${sampleName === "the center" ? "The center" : `Sample ${SAMPLE}`} of pixel ${px(PIXEL)}:`)}${fmt(TRI.x[0])} ≤ ${fmt(sampleX(WINDOW[0]))} ≤ ${fmt(TRI.x[1])}  and  ${fmt(TRI.y[0])} ≤ ${fmt(sampleY(WINDOW[1]))} ≤ ${fmt(TRI.y[1])} → <b>covered</b>${say("The shader then discards the fragments of the rectangle that are outside the sphere.")}`] : isTriangle ? [`covered = E<sub>0</sub> ≥ bias<sub>0</sub>  and  E<sub>1</sub> ≥ bias<sub>1</sub>  and  E<sub>2</sub> ≥ bias<sub>2</sub>\n\n${say(`at ${sampleName} of pixel ${px(PIXEL)}:`)}${TRI.edges.map((e, i) => `E<sub>${i}</sub> = ${fmt(edgesAtPixel()[i])} ≥ ${e.bias} → <b>${edgesAtPixel()[i] >= e.bias}</b>`).join("\n")}\n\n${say("bias = 0 if the edge goes down (e<sub>y</sub> &lt; 0), or to the right (e<sub>y</sub> = 0, e<sub>x</sub> &gt; 0); otherwise 1")}`] : []),
  related: ["setup", "samples", "stepping"], lessons: ["A triangle", "SIMD lanes"],
  exercises: () => [
    isPoint ? {ask: `${DATA.samples === 1 ? "How many pixel centers" : "Of how many pixels"} does ${exampleName} cover${DATA.samples === 1 ? "" : " at least one sample"}?`, answer: EX.covered, hint: "Count the filled pixels. The point may extend beyond the block that is shown.", why: "They are the pixels with a sample inside the rectangle of the point."}
      : {ask: `The rectangle of pixels around ${exampleName} has ${boxSize().join(" × ")} pixels. ${DATA.samples === 1 ? "Of what percentage of them is the center" : "What percentage of them has a sample that is"} covered?`, answer: EX.covered / (boxSize()[0] * boxSize()[1]) * 100, decimals: 0, hint: "The chapter “One frame” gives the number of covered pixels.", why: `${fmt(EX.covered)} of ${fmt(boxSize()[0] * boxSize()[1])}. The renderer counted them${isTriangle ? ` with the exact edge functions${EX.triangles.length > 1 ? ` of all ${EX.triangles.length} pieces` : ""}` : ""}.`},
    {ask: "How many pixels of the block in the “Packets” step are covered?", answer: inBlock(), hint: "Count the filled pixels in that step.", why: "At most 64 are possible."},
    {ask: "How many packets would a block of 8 × 8 pixels have if a register held 16 floats?", answer: 4, hint: "A packet has one pixel per float.", why: `64 / 16. In this build, a block has 64 / ${DATA.build.lanes} packets.`},
  ],
});

// ---- depth --------------------------------------------------------------------------------------------------------------

// The smallest and the largest depth of each block of 8x8 pixels at the end of the frame. Blocks start at the lower left, like tiles.
const hierarchicalZ = () => ({columns: Math.ceil(W / 8), rows: Math.ceil(H / 8), low: FRAME.blockLow, high: FRAME.blockHigh});
const depthHeat = (z) => (z <= 0 ? "transparent" : heat((Math.log2(z) - Math.log2(DATA.depth.low)) / Math.max(1e-6, Math.log2(DATA.depth.high) - Math.log2(DATA.depth.low))));

function hizPicture(which) {
  const z = hierarchicalZ(), {canvas, pen} = canvasFigure(W * 2, H * 2, `The ${which === "low" ? "farthest" : "nearest"} depth of each block of 8 by 8 pixels`);
  for (let by = 0; by < z.rows; ++by) for (let bx = 0; bx < z.columns; ++bx) {
    pen.fillStyle = depthHeat(z[which][by * z.columns + bx]);
    pen.fillRect(bx * 16, H * 2 - (by + 1) * 16, 15.5, 15.5);
  }
  return [addLoupe(el("div", {class: "stage"}, canvas), canvas, W, H), legend(`far, ${fmt(DATA.depth.low, 4)}`, `near, ${fmt(DATA.depth.high, 4)}`)];
}
const depthAt = (x, y) => FRAME.depth[y * W + x];
const exampleBlock = () => { const z = hierarchicalZ(), b = Math.floor(WINDOW[1] / 8) * z.columns + Math.floor(WINDOW[0] / 8); return {low: z.low[b], high: z.high[b]}; };
// Returns the number of pixels in the block of the example pixel whose depth is below a value.
function fartherInBlock(z) {
  let n = 0;
  for (let y = blockOf(WINDOW[1]); y < Math.min(H, blockOf(WINDOW[1]) + 8); ++y) for (let x = blockOf(WINDOW[0]); x < Math.min(W, blockOf(WINDOW[0]) + 8); ++x) n += depthAt(x, H - 1 - y) < z;
  return n;
}
// The pixel of the exercise: the example pixel or, if too few or all other pixels of the block are farther away, the one that has about as
// many pixels in front of it as behind it.
function askedDepthPixel() {
  const [x0, y0] = WINDOW.map(blockOf), list = [], own = fartherInBlock(depthAt(...PIXEL));
  for (let y = y0; y < Math.min(H, y0 + 8); ++y) for (let x = x0; x < Math.min(W, x0 + 8); ++x) list.push([x, H - 1 - y]);
  if (own > 1 && own < list.length - 1) return PIXEL;
  const error = list.map((p) => Math.abs(fartherInBlock(depthAt(...p)) - list.length / 2)), best = error.indexOf(Math.min(...error));
  return error[best] < list.length / 2 - 1 ? list[best] : PIXEL;
}
const ofSample0 = DATA.samples > 1 ? " of sample 0" : "";

chapter({
  id: "depth", title: "Depth", kicker: "Tiles",
  lead: () => "Of all surfaces at a sample, the nearest one is visible. The depth buffer stores its depth. Depth is reversed: 1 is at the near plane and 0 is far away. Distant surfaces therefore benefit from the higher precision of floats near 0.",
  absent: () => (DATA.depth.high <= 0 ? `Nothing in this frame writes depth. A frame that does: ${command("halfspace explain pipeline")}.` : null),
  input: () => ["covered packets", "a depth plane per triangle"],
  output: () => [`${fmt(DATA.statistics.samples_passed)} of ${fmt(DATA.statistics.samples_tested)} tested samples passed`, "the id of the visible triangle for each sample"],
  steps: () => [
    {name: "The depth buffer", caption: `The depth buffer${ofSample0} of the finished frame, on a logarithmic scale: dark pixels are far away and bright ones near.${FRAME.depth.some((z) => z <= 0) ? " Where no surface has written a depth, the picture is empty." : ""} Point at the picture to read the exact values.${ringNote()}`, draw: () => [picture(DATA.depth.picture, "The depth buffer as a heat map", {read: (x, y) => `pixel ${px([x, y])}: depth${ofSample0} ${fmt(depthAt(x, y), 9)}`, ringed: PIXEL}), legend(`far, ${fmt(DATA.depth.low, 4)}`, `near, ${fmt(DATA.depth.high, 4)}`)].flat()},
    {name: "Farthest depth of each block", caption: "Each square is a block of 8 × 8 pixels with the color of its farthest depth, on the same scale: dark is far away. Hierarchical Z: if the nearest point of a triangle is behind the farthest depth of a block, the triangle is hidden in all 64 pixels of the block. One comparison rejects them all." + (DATA.samples > 1 ? " All samples are taken into account." : ""), draw: () => hizPicture("low")},
    {name: "Nearest depth of each block", caption: "The opposite bound; each square has the color of the nearest depth in its block, and bright is near. A triangle that is entirely in front of the nearest depth of a block passes the test in the whole block, without a depth test per pixel.", draw: () => hizPicture("high")},
  ],
  formula: () => {
    const b = exampleBlock(), v = VISIBLE, failed = v.failed;
    const test = v.is_tested ? `${say(`The visible fragment of pixel ${px(PIXEL)}${DATA.samples > 1 ? ` at sample ${SAMPLE}` : ""}, which belongs to ${exampleName}:`)}${fmt(v.depth, 9)} &gt; ${fmt(v.stored_depth, 9)} → <b>pass</b>\n` : v.depth === undefined ? "" : `${say(`The depth of the visible fragment of pixel ${px(PIXEL)} is ${fmt(v.depth, 9)}. It was not compared: the block was known to be farther away.`)}`;
    const fail = failed ? `${say(`The first fragment there that ${failed.outcome.startsWith("rejected") ? `was ${escapeHtml(failed.outcome)}` : escapeHtml(failed.outcome)}:`)}${fmt(failed.tested, 9)} &gt; ${fmt(failed.stored, 9)} → <b>${failed.tested > failed.stored}</b>\n` : "";
    return [`pass = <em>z</em><sub>fragment</sub> &gt; <em>z</em><sub>stored</sub>\n\n${test}${fail}`,
      `${say("The 8 × 8 block of the example pixel at the end of the frame:")}farthest depth <b>${fmt(b.low, 9)}</b>\nnearest depth  <b>${fmt(b.high, 9)}</b>\n\n${say(`A triangle with <em>z</em><sub>max</sub> ≤ ${fmt(b.low, 7)} is rejected with the whole block. A triangle with <em>z</em><sub>0</sub> &gt; ${fmt(b.high, 7)} passes in the whole block.`)}`];
  },
  related: ["stepping", "overdraw"], lessons: ["Depth"],
  exercises: () => {
    const b = exampleBlock(), at = askedDepthPixel(), farther = fartherInBlock(depthAt(...at));
    return [
      {ask: `A triangle at the constant depth of ${at === PIXEL ? "the example pixel" : `pixel ${px(at)}`} is drawn over the whole 8 × 8 block of the example pixel, after all other primitives. At how many pixels does it pass the depth test${DATA.samples > 1 ? " of sample 0" : ""}?`, answer: farther, hint: `It passes where the stored depth is smaller. The block is x = ${blockOf(WINDOW[0])} … ${blockOf(WINDOW[0]) + 7}, y = ${H - 1 - blockOf(WINDOW[1]) - 7} … ${H - 1 - blockOf(WINDOW[1])} in the first step.`, why: farther > 0 ? "There, the stored depth is smaller." : "No pixel of the block is farther away."},
      b.low > 0 ? {ask: "By what factor is the nearest depth in the block of the example pixel larger than the farthest one?", answer: b.high / b.low, significant: 3, hint: "See the second formula.", why: `${fmt(b.high, 7)} / ${fmt(b.low, 7)}. ${M.perspective ? "Depth is a + b / distance." : "Depth is a + b · distance."}`}
        : {ask: "At how many pixels of the block of the example pixel is nothing drawn (a stored depth of 0)?", answer: fartherInBlock(1e-38), hint: "Read the depths in the first step.", why: "There, the depth buffer still has the value that it was cleared to."},
      {ask: "How many blocks of 8 × 8 pixels does one tile have?", answer: (TILE / 8) ** 2, hint: `A tile has ${TILE} × ${TILE} pixels.`, why: `${TILE / 8} · ${TILE / 8}.`},
    ];
  },
});
