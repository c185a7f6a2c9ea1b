// The history of a pixel: what the renderer did with each fragment.

const HISTORY = DATA.history;
let historyReady = null;

async function unpackColumns(c) {
  const n = c.count, of = (key, Type) => unpackArray(c[key], Type, n);
  return {index: await of("index", Uint8Array), draw: await of("draw", Uint16Array), instance: await of("instance", Uint32Array), primitive: await of("primitive", Uint32Array), sample: await of("sample", Uint8Array), outcome: await of("outcome", Uint8Array), depth: await of("depth", Float32Array)};
}

// Unpacks the fragments of all pixels when they are needed for the first time.
function unpackHistory() {
  historyReady ||= (async () => {
    const d = HISTORY.details, counts = await unpackArray(HISTORY.counts, Uint8Array, W * H);
    FRAME.history = {counts, first: offsets(counts), others: await unpackArray(HISTORY.others, Uint32Array, W * H), fragments: await unpackColumns(HISTORY.fragments)};
    const full = {counts: await unpackArray(d.counts, Uint8Array, d.pixels), index: await unpackArray(d.index, Uint8Array, d.fragments), kind: await unpackArray(d.kind, Uint16Array, d.fragments), values: await unpackArray(d.values, Float32Array, d.numbers), at: new Map()};
    placeDetails(full, await unpackArray(d.place, Uint32Array, d.pixels));
    FRAME.details = full;
  })();
  return historyReady;
}

function offsets(counts) {
  const first = new Uint32Array(counts.length + 1);
  for (let i = 0; i < counts.length; ++i) first[i + 1] = first[i] + counts[i];
  return first;
}

// The number of values that precede those of the shader in each fragment, and the number of values per pixel (page_history.cpp).
const FIXED = 16, PIXEL_NUMBERS = 4 + 4 * DATA.samples + 12;
const sizeOf = (kind) => FIXED + ["varyings", "terms", "factors"].flatMap((key) => kind[key]).reduce((n, [, size]) => n + size, 0);

// Finds the offset of the values of each detailed pixel.
function placeDetails(full, place) {
  const sizes = HISTORY.details.kinds.map(sizeOf);
  let at = 0, fragment = 0;
  place.forEach((xy, i) => {
    full.at.set((xy >>> 16) * W + (xy & 0xffff), {index: i, at, fragment});
    at += PIXEL_NUMBERS;
    for (let k = 0; k < full.counts[i]; ++k) at += sizes[full.kind[fragment++]];
  });
}

const rowOf = (columns, i) => ({index: columns.index[i], draw: columns.draw[i], instance: columns.instance[i], primitive: columns.primitive[i], sample: columns.sample[i], outcome: HISTORY.outcomes[columns.outcome[i]], depth: columns.depth[i]});

// Returns the fragments of a pixel, without details.
function fragmentsOf(x, y) {
  const h = FRAME.history, p = y * W + x, list = [];
  for (let i = h.first[p]; i < h.first[p + 1]; ++i) list.push(rowOf(h.fragments, i));
  return {list, others: h.others[p]};
}

// Returns the fragments of a pixel and all values, or null if the page does not contain them. If the pixel has very many fragments, some of
// them have no values; their `kind` is undefined.
function detailsOf(x, y) {
  const full = FRAME.details, found = full.at.get(y * W + x);
  if (!found) return null;
  let at = found.at;
  const take = (n) => [...full.values.subarray(at, at += n)];
  const pixel = {clear: take(4), samples: Array.from({length: DATA.samples}, () => take(4)), light: take(4), exposure: take(1)[0], toneMapped: take(3), code: take(4), ...fragmentsOf(x, y)};
  const byIndex = new Map(pixel.list.map((f) => [f.index, f]));
  for (let k = 0; k < full.counts[found.index]; ++k) {
    const i = found.fragment + k, kind = HISTORY.details.kinds[full.kind[i]], [tested, stored, isTested, isShaded] = take(4);
    const f = Object.assign(byIndex.get(full.index[i]), {kind, tested, stored, isTested, isShaded, barycentrics: take(3), invW: take(1)[0], color: take(4), value: take(4)});
    for (const key of ["varyings", "terms", "factors"]) f[key] = kind[key].map(([name, size]) => [name, take(size)]);
  }
  return pixel;
}

function nearestDetailed(x, y) {
  let best = null, nearest = Infinity;
  for (const p of FRAME.details.at.keys()) {
    const d = (p % W - x) ** 2 + (Math.floor(p / W) - y) ** 2;
    if (d < nearest) { nearest = d; best = [p % W, Math.floor(p / W)]; }
  }
  return best;
}

const objectOf = (f) => { const d = DATA.draws[f.draw]; return escapeHtml(d.object) + (d.copy ? `, copy ${d.copy}` : ""); };
const primitiveName = (f) => `${{triangles: "triangle", points: "point", lines: "line"}[DATA.draws[f.draw].kind]} ${f.primitive}`;
// Formats a number like %.6g in C, as --text does.
function shortest(x) {
  if (!Number.isFinite(x)) return String(x);
  if (x === 0) return Object.is(x, -0) ? "-0" : "0";
  const trimmed = (digits) => (digits.includes(".") ? digits.replace(/\.?0+$/, "") : digits);
  const [digits, exponent] = x.toExponential(5).split("e"), e = Number(exponent);
  if (e < -4 || e >= 6) return `${trimmed(digits)}e${e < 0 ? "-" : "+"}${String(Math.abs(e)).padStart(2, "0")}`;
  return trimmed(x.toPrecision(6));
}
const exact = (v) => v.map(shortest).join(", ");
const exactNumber = (x) => `<span class="n">${shortest(x)}</span>`;
const swatch = (c) => `<span class="swatch" style="background: rgb(${c.slice(0, 3).map((v) => Math.round(255 * Math.min(1, Math.max(0, encodeSrgb(Math.max(0, v)))))).join(" ")})"></span>`;

function testText(f) {
  if (!f.isTested) return "not tested";
  const words = f.outcome.includes("block") || f.outcome.includes("tile") ? ["nearest depth of the primitive", `farthest depth in the ${f.outcome.includes("block") ? "block" : "tile"}`] : ["depth", "stored depth"];
  return `${words[0]} ${exactNumber(f.tested)}, ${words[1]} ${exactNumber(f.stored)}`;
}

function valueTable(f) {
  const rows = [["barycentrics", f.barycentrics], ["1/w", [f.invW]], ...f.varyings, ...f.terms, ...f.factors, ["color and alpha", f.color]];
  if (f.isShaded) rows.push(["sample after this fragment", f.value]);
  return el("div", {class: "table"}, el("table", {}, el("tbody", {}, ...rows.map(([name, v]) => el("tr", {}, el("th", {scope: "row"}, name), el("td", {html: exact(v)}))))));
}

function fragmentItem(f, open) {
  const head = `${f.index + 1}. ${primitiveName(f)} of <i>${objectOf(f)}</i> (draw ${f.draw}${f.instance ? `, instance ${f.instance}` : ""}${f.kind && !f.kind.front ? ", seen from behind" : ""})${DATA.samples > 1 ? `, sample ${f.sample}` : ""}: <b>${f.outcome}</b> at depth ${exactNumber(f.depth)}`;
  if (!f.kind) return el("li", {html: head});
  return el("li", {}, el("details", {class: "quote", open}, el("summary", {html: (f.isShaded ? swatch(f.color) : "") + head}),
    el("div", {class: "values"}, el("p", {html: `${f.kind.shader}. Depth test: ${testText(f)}.${f.kind.blend ? ` Blended: ${escapeHtml(f.kind.blend)}.` : ""}`}),
      f.isShaded ? null : el("p", {class: "keys"}, "This fragment was not shaded in this frame. The values below were computed afterwards by the same shader code."), valueTable(f))));
}

function displayText(p) {
  const samples = p.samples.length > 1 ? p.samples.map((s, i) => `sample ${i}    ${exact(s)}\n`).join("") : "";
  return `clear color ${exact(p.clear)}\n${samples}light       ${exact(p.light)}\nexposure    ${shortest(p.exposure)}\ndisplayed   ${exact(p.toneMapped)}\n<b>8-bit value ${p.code.slice(0, p.code[3] === 255 ? 3 : 4).join(", ")}</b>`;
}

function historyPanel(x, y, go) {
  const full = detailsOf(x, y), {list, others} = full || fragmentsOf(x, y), nearest = full ? null : nearestDetailed(x, y);
  const last = list.map((f) => Boolean(f.isShaded)).lastIndexOf(true);
  return [
    el("h3", {}, `Pixel ${x}, ${y}`),
    el("p", {html: `Counted from the upper left. In OpenGL window coordinates, its center is at (${x + 0.5}, ${H - y - 0.5}). ${plural(list.length + others, "fragment")}${list.length + others ? ", in drawing order" : ""}. Colors are stored as ${HISTORY.stored_as}.${DATA.samples > 1 ? ` A pixel has ${DATA.samples} samples, and each covered sample of a primitive is a fragment.` : ""}`}),
    el("ol", {class: "fragments"}, ...list.map((f, i) => fragmentItem(f, i === last))),
    others ? el("p", {}, `… and ${plural(others, "more fragment")} that this page does not list.`) : null,
    full && list.some((f) => !f.kind) ? el("p", {class: "keys", html: `The page contains all values of ${fmt(list.filter((f) => f.kind).length)} of these fragments. To print those of the others: ${command(`${DATA.command} --pixel ${x},${y} --text`)}`}) : null,
    full ? el("div", {class: "formula", tabindex: 0, role: "group", "aria-label": "From the samples of the pixel to its 8-bit value", html: displayText(full)}) : null,
    full ? null : el("p", {html: `To print all values of this pixel: ${command(`${DATA.command} --pixel ${x},${y} --text`)}`}),
    nearest ? el("p", {}, el("button", {type: "button", onclick: () => go(...nearest)}, `Show pixel ${nearest.join(", ")}, the nearest pixel with all values`)) : null,
  ];
}

function pixelForm(go) {
  const field = (label, max, value) => el("input", {type: "number", min: 0, max, value, "aria-label": label, title: label});
  const x = field("x of the pixel, counted from the left", W - 1, PIXEL[0]), y = field("y of the pixel, counted from the top", H - 1, PIXEL[1]);
  const submit = (e) => { e.preventDefault(); go(Math.min(W - 1, Math.max(0, Number(x.value))), Math.min(H - 1, Math.max(0, Number(y.value)))); };
  return {form: el("form", {class: "pixel", onsubmit: submit}, el("span", {}, "x"), x, el("span", {}, "y"), y, el("button", {type: "submit"}, "Show pixel")), set: (px, py) => { x.value = px; y.value = py; }};
}

// The pixel with the most fragments in the last row of the picture.
const busiestInLastRow = () => { const row = FRAME.fragments.subarray((H - 1) * W); return [row.indexOf(row.reduce((most, n) => Math.max(most, n), 0)), H - 1]; };

const historyState = {pixel: PIXEL};
function historyPicture() {
  const mark = el("div", {class: "mark", "aria-hidden": "true"});
  const go = (x, y) => {
    historyState.pixel = [x, y];
    form.set(x, y);
    placeMark(mark, x, y);
    unpackHistory().then(() => {
      const panel = document.getElementById("history-panel");  // null if the reader has left the chapter
      if (panel && historyState.pixel.join() === [x, y].join()) panel.replaceChildren(...historyPanel(x, y, go).filter(Boolean));
    });
  };
  const form = pixelForm(go), [box, readout] = picture(DATA.pictures.final, "The final picture. Click a pixel to see its history.", {click: go, read: (x, y) => `pixel ${px([x, y])}: ${plural(fragmentsAt(x, y), "fragment")}`});
  box.append(mark);
  queueMicrotask(() => go(...historyState.pixel));
  return [box, readout, form.form];
}

chapter({
  id: "history", title: "Pixel history", kicker: "Output",
  lead: () => "Click a pixel to see all of its fragments in drawing order, and what the renderer did with each of them. A fragment can be rejected together with its block, fail the depth test, be hidden before it is shaded, or be shaded.",
  input: () => [`${fmt(DATA.overdraw.total)} fragments of the whole frame`],
  output: () => [`${W} × ${H} pixels, whose colors are stored as ${HISTORY.stored_as}`],
  steps: () => [{name: "Choose a pixel", caption: `The final picture. The ring marks the pixel whose history is listed below: ${px(PIXEL)}, the example of this page, until another one is selected. This page contains the draw, primitive, depth and outcome of the fragments of all pixels${HISTORY.most < 64 ? `, up to ${HISTORY.most} fragments per pixel` : ""}. ${HISTORY.details.pixels === W * H && HISTORY.details.most.every((n) => n === 64) ? "It contains all values of all of them." : `It contains all values ${HISTORY.details.most.some((n) => n < 64) ? `of up to ${HISTORY.details.most.join(", ")} fragments per pixel for the example pixel, ` : "for "}the 64 × 64 pixels around ${HISTORY.details.most.some((n) => n < 64) ? "it" : "the example pixel"} and ${HISTORY.details.most.some((n) => n < 64) ? "" : "for "}${HISTORY.details.pixels === W * H ? "all other pixels" : "every eighth pixel in x and y"}.`}`, draw: historyPicture}],
  body: () => el("div", {id: "history-panel", "aria-live": "polite"}, el("p", {class: "loading"}, "Loading the fragments …")),
  related: ["overdraw", "stepping"], lessons: ["Depth"],
  exercises: () => [
    {ask: "How many fragments more than an average pixel of this frame does the example pixel have?", answer: fragmentsAt(...PIXEL) - DATA.overdraw.total / (W * H), decimals: 1, hint: "Divide the number of all fragments by the number of pixels.", why: `${fmt(fragmentsAt(...PIXEL))} − ${fmt(DATA.overdraw.total / (W * H), 4)}.`},
    {ask: `How many fragments does pixel ${px(busiestInLastRow())} have?`, answer: fragmentsAt(...busiestInLastRow()), hint: `Enter the coordinates ${busiestInLastRow().join(", ")}.`, why: "Its history lists them."},
    {ask: "What is the x coordinate of the center of the rightmost pixels in OpenGL window coordinates?", answer: W - 0.5, decimals: 1, hint: "Pixel centers are at half-integers.", why: `${W} − 0.5.`},
  ],
});
