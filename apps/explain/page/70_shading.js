// Interpolation, varyings, mip levels and light.

// The triangle that shows the interpolation: the example, another triangle of the frame, or a constructed one.
const P = DATA.perspective;
const CORNERS = P.xy.map(([x, y]) => [x / SUB, y / SUB]);

// Returns the linear and the perspective-correct weights of a point of triangle P. x and y are pixels from the lower left.
function weightsAt(x, y) {
  const [[ax, ay], [bx, by], [cx, cy]] = CORNERS, [qa, qb, qc] = P.inv_w;
  const area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
  const a = ((cx - bx) * (y - by) - (cy - by) * (x - bx)) / area;
  const b = ((ax - cx) * (y - cy) - (ay - cy) * (x - cx)) / area;
  const c = ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / area;
  const sum = a * qa + b * qb + c * qc;
  return {linear: [a, b, c], perspective: [a * qa / sum, b * qb / sum, c * qc / sum]};
}

// Draws triangle P with affine and perspective-correct interpolation, next to each other or, on a phone, one above the other.
function checkeredPair() {
  const panel = (kind, name) => { const box = checkered(kind); box.prepend(el("div", {class: "panel-name"}, name)); return box; };
  return el("div", {class: "pair"}, panel("linear", "affine"), panel("perspective", "perspective-correct"));
}

// Draws triangle P, magnified, with a checkerboard in barycentric coordinates.
function checkered(kind) {
  const xs = CORNERS.map((p) => p[0]), ys = CORNERS.map((p) => p[1]), x0 = Math.min(...xs), y0 = Math.min(...ys), w = Math.max(...xs) - x0, h = Math.max(...ys) - y0;
  const width = 900, height = 460, scale = Math.min((width - 40) / w, (height - 40) / h), {canvas, pen} = canvasFigure(width, height, kind === "difference" ? "Difference between affine and perspective-correct interpolation" : `A triangle with a checkerboard and ${kind === "linear" ? "affine" : "perspective-correct"} interpolation`);
  const image = pen.createImageData(width, height), ox = (width - w * scale) / 2, oy = (height - h * scale) / 2;
  for (let j = 0; j < height; ++j) for (let i = 0; i < width; ++i) {
    const {linear, perspective} = weightsAt(x0 + (i - ox) / scale, y0 + (height - 1 - j - oy) / scale);
    if (linear[0] < 0 || linear[1] < 0 || linear[2] < 0) continue;
    const color = kind === "difference" ? differenceColor(linear, perspective) : squareColor(kind === "linear" ? linear : perspective);
    const at = 4 * (j * width + i);
    for (let k = 0; k < 3; ++k) image.data[at + k] = color[k];
    image.data[at + 3] = 255;
  }
  pen.putImageData(image, 0, 0);
  return addLoupe(el("div", {class: "stage"}, canvas), canvas, width, height);
}
const squareColor = (b) => ((Math.floor(b[1] * 10) + Math.floor(b[2] * 10)) % 2 ? [194, 65, 12] : [250, 236, 226]);
function differenceColor(a, b) {
  const d = Math.max(...a.map((v, i) => Math.abs(v - b[i])));
  return heat(d / P.difference).match(/\d+/g).map(Number);
}
const middle = () => weightsAt(...[0, 1].map((k) => (CORNERS[0][k] + CORNERS[1][k] + CORNERS[2][k]) / 3));

// Names the triangle, and says why it is shown.
function interpolatedName() {
  if (P.kind === "example") return `${capital(exampleName)}, the example of this page; vertices in the order of the chapter “Triangle setup”.`;
  const errors = [P.example_error, P.largest_error].filter((e) => e !== undefined), own = P.example_error === undefined ? "" : ` In ${exampleName}, affine interpolation displaces a value by at most ${fmt(P.example_error, 3)} pixels.`;
  if (P.kind === "frame") return `Triangle ${fmt(P.primitive)} of <i>${escapeHtml(P.object)}</i>.${own}`;
  const why = !M.perspective ? "the projection is orthographic, so that w is 1 everywhere and both interpolations agree" : errors.length === 0 ? "no triangle lies entirely inside the window" : `affine interpolation displaces a value by at most ${fmt(Math.max(...errors), 3)} pixels in the triangles inside the window`;
  return `A constructed triangle that is not part of this frame, because in this frame ${why}.`;
}

chapter({
  id: "interpolation", title: "Perspective-correct interpolation", kicker: "Shading",
  lead: () => "Vertices have values such as texture coordinates, normals and positions. These values are interpolated between the vertices. The interpolation cannot be linear on the screen: where a surface is farther away, its values change faster from pixel to pixel.",
  input: () => ["edge functions at a sample", "1/w of the three vertices"],
  output: () => ["three weights that add up to 1"],
  steps: () => [
    {name: "Affine and perspective-correct", caption: `${interpolatedName()} Affine: the weights are the normalized edge functions, so all squares have the same size on the screen. Perspective-correct: the weights are divided by w and normalized. 1/w is ${P.inv_w.map((v) => fmt(v, 4)).join(", ")} at the vertices. The squares have ten steps of each weight along an edge.`, draw: checkeredPair},
    {name: "Difference", caption: `The largest difference of the three weights at each point: dark is none, and bright is the most. Along an edge, it is at most ${fmt(P.difference, 3)}: affine interpolation displaces a value by up to ${fmt(P.error, 3)} pixels.`, draw: () => [checkered("difference"), legend("0", fmt(P.difference, 3))]},
  ],
  formula: () => {
    const m = middle();
    return [`<em>p</em><sub>i</sub> = E<sub>i</sub> q<sub>i</sub> / (E<sub>0</sub> q<sub>0</sub> + E<sub>1</sub> q<sub>1</sub> + E<sub>2</sub> q<sub>2</sub>)      q<sub>i</sub> = 1/w<sub>i</sub>\n\n${say("at the centroid of the triangle on the screen, where the linear weights are ⅓, ⅓, ⅓:")}${[0, 1, 2].map((i) => `p<sub>${i}</sub> = ⅓ · ${fmt(P.inv_w[i], 6)} / (⅓ · ${fmt(P.inv_w[0] + P.inv_w[1] + P.inv_w[2], 6)}) = <b>${fmt(m.perspective[i], 6)}</b>`).join("\n")}`];
  },
  related: ["setup", "varyings"], lessons: ["Perspective"],
  exercises: () => {
    const m = middle().perspective, near = P.inv_w.indexOf(Math.max(...P.inv_w)), far = P.inv_w.indexOf(Math.min(...P.inv_w));
    const q0 = P.inv_w[near], q1 = P.inv_w[far];
    return [
      {ask: `What is the perspective-correct weight of vertex ${near} in the middle of the edge from vertex ${near} to vertex ${far} on the screen?`, answer: q0 / (q0 + q1), decimals: 3, hint: "There, two of the linear weights are ½, and the third is 0.", why: `${fmt(q0, 5)} / (${fmt(q0, 5)} + ${fmt(q1, 5)}).`},
      {ask: "By how much is the largest of the three weights at the centroid larger than with affine interpolation?", answer: Math.max(...m) - 1 / 3, decimals: 3, hint: "With affine interpolation, all weights are ⅓.", why: "The vertex nearest to the eye gets the largest weight."},
      {ask: "How many times as far from the eye as the nearest vertex is the farthest one, measured along the view axis?", answer: q0 / q1, significant: 3, hint: "w is this distance. The first step gives 1/w at the vertices.", why: `${fmt(q0, 5)} / ${fmt(q1, 5)}.`},
    ];
  },
});

// The values of the visible fragment that the shader computes. They are evaluated at the pixel center or, with sample shading, at the sample.
const VARYINGS = VISIBLE.varyings || [];
const shadedWhere = DATA.samples === 1 || !VISIBLE.shaded_at || (VISIBLE.shaded_at[0] === 128 && VISIBLE.shaded_at[1] === 128) ? "center" : `sample ${SAMPLE}`;
// The vertices of the example triangle relative to the eye, and the interpolated position; null if there is no such varying.
const POSITION = (() => {
  const found = VARYINGS.find(([name]) => name === "position_rws");
  return found && isTriangle && EX.vertices[0].ws ? {value: found[1], corners: EX.vertices.map((v) => v.ws.map((x, k) => x - DATA.transforms.eye[k])), weights: VISIBLE.barycentrics} : null;
})();

function interpolationFormula() {
  const p = POSITION, [, p1, p2] = p.weights;
  const line = (k) => `${"xyz"[k]} = ${fmt(p.corners[0][k], 6)} + ${fmt(p1, 6)} · (${fmt(p.corners[1][k] - p.corners[0][k], 6)}) + ${fmt(p2, 6)} · (${fmt(p.corners[2][k] - p.corners[0][k], 6)}) = <b>${fmt(p.corners[0][k] * p.weights[0] + p.corners[1][k] * p1 + p.corners[2][k] * p2, 6)}</b>`;
  return `\n\n${say(`The position relative to the eye at ${shadedWhere === "center" ? "the center" : shadedWhere} of pixel ${px(PIXEL)}, where ${exampleName} is visible:`)}${[0, 1, 2].map(line).join("\n")}${say(`The shader received ${vec(p.value, 6)}.`)}${outsideNote()}`;
}
// A pixel center can be outside a triangle that covers a sample of the pixel.
function outsideNote() {
  if (!isTriangle || shadedWhere !== "center" || !VISIBLE.barycentrics.some((b) => b < 0)) return "";
  const inside = allSamples.filter((s) => covers(TRI, ...WINDOW, s));
  return say(`A weight is negative, because the pixel center is outside the triangle; only ${inside.length === 1 ? `its sample ${inside[0]} is` : `its samples ${listed(inside)} are`} inside.`);
}
function varyingTable() {
  if (VARYINGS.length === 0) return null;
  return [el("h3", {}, `Varyings at pixel ${px(PIXEL)}`), tableOf(["name", "value"], VARYINGS.map(([name, v]) => [`<code>${name}</code>`, vec(v, 6)]))];
}

// ---- varyings -------------------------------------------------------------------------------------------------------------

chapter({
  id: "varyings", title: "Varyings", kicker: "Shading",
  lead: () => "Varyings are the interpolated values that the fragment shader receives at each pixel. Each picture shows a varying, or a value computed from varyings, as colors.",
  input: () => ["weights per pixel", "values at three vertices"],
  output: () => ["interpolated values, one lane per pixel", "analytic derivatives, from the plane of the triangle"],
  steps: () => [
    ["barycentrics", "Barycentric coordinates", "Red, green and blue are the weights of the three vertices of each triangle, from 0 to 1."],
    ["normal", "Normal", `The unit normal used for lighting${DATA.surfaces.relief.length ? `, with the relief from the maps of ${listed(DATA.surfaces.relief)}` : ""}. x, y and z from −1 to 1 are shown as red, green and blue.`],
    ["uv", "Texture coordinates", DATA.surfaces.uv_low.every((v, k) => v === DATA.surfaces.uv_high[k]) ? "No visible surface of this frame has texture coordinates that vary." : `u is red and v is green. u is from ${fmt(DATA.surfaces.uv_low[0], 4)} to ${fmt(DATA.surfaces.uv_high[0], 4)}, and v from ${fmt(DATA.surfaces.uv_low[1], 4)} to ${fmt(DATA.surfaces.uv_high[1], 4)}; the picture shows their fractions.`],
    ["position", "Position in world space", "Red, green and blue are x, y and z, scaled to the range of their values in this frame."],
    ["albedo", "Surface color", `The color before lighting${DATA.mips === null ? ". No opaque surface of this frame has a color map" : ": the color of the material times the color map"}.`],
  ].map(([key, name, caption]) => ({name, caption: caption + ringNote(), draw: () => picture(DATA.pictures[key], `${name} as colors`, {ringed: PIXEL})})),
  formula: () => ["value = a<sub>0</sub> + p<sub>1</sub> · (a<sub>1</sub> − a<sub>0</sub>) + p<sub>2</sub> · (a<sub>2</sub> − a<sub>0</sub>)" + (POSITION ? interpolationFormula() : isPoint ? `\n\n${say("The varyings of a point are constant: all fragments of the rectangle receive the values of its vertex.")}` : "")],
  body: () => [varyingTable()].flat().filter(Boolean),
  related: ["interpolation", "mips", "lighting"], lessons: ["Flat, Gouraud and Phong shading", "Normal and bump maps"],
  exercises: () => [
    POSITION ? {ask: `x of the position is ${POSITION.corners.map((c) => num(c[0], 5)).join(", ")} at the three vertices. What is it where all three weights are ⅓?`, answer: POSITION.corners.reduce((s, c) => s + c[0], 0) / 3, significant: 3, tolerance: 1e-4 * Math.max(...POSITION.corners.map((c) => Math.abs(c[0]))), hint: "It is the mean of the three values.", why: "Each value is multiplied by ⅓."}
      : {ask: `How many numbers does the shader receive as varyings at pixel ${px(PIXEL)}?`, answer: VARYINGS.reduce((n, [, v]) => n + v.length, 0), hint: "Count the components of all varyings in the table.", why: VARYINGS.map(([name, v]) => `${name}: ${v.length}`).join(", ") + "."},
    VISIBLE.normal ? {ask: `The normal at the example pixel is ${vec(VISIBLE.normal, 4)}. What is the red value of the pixel in the picture of the normals, from 0 to 255?`, answer: Math.floor((Math.min(1, Math.max(-1, VISIBLE.normal[0])) + 1) / 2 * 255 + 0.5), tolerance: 1, hint: "(x + 1) / 2, times 255, rounded.", why: `(${fmt(VISIBLE.normal[0], 4)} + 1) / 2 · 255.`}
      : {ask: "What red value, from 0 to 255, shows the x component 0.5 of a normal?", answer: 191, tolerance: 1, hint: "(x + 1) / 2, times 255, rounded.", why: "(0.5 + 1) / 2 · 255."},
    {ask: "What percentage of the fragments of this frame were shaded?", answer: shadedFragments() / Math.max(1, DATA.overdraw.total) * 100, decimals: 0, hint: "See the chapter “Overdraw”.", why: `${fmt(shadedFragments())} of ${fmt(DATA.overdraw.total)} fragments.`},
  ],
});

// ---- mip levels -----------------------------------------------------------------------------------------------------------

const lodAt = (x, y) => FRAME.lods[y * W + x];
// The example pixel or, if it has no color map, the first pixel with one.
const MIP = DATA.mips ? DATA.mips.pixel : null;
// The size of a probe in texels.
const mipSize = () => (MIP.anisotropic ? Math.max(MIP.axes[1], MIP.axes[0] / MIP.probes) : Math.max(...MIP.axes));
function mipFormula() {
  const [a, b] = MIP.axes, where = say(`at pixel ${px(MIP.at)}${MIP.at.join() === PIXEL.join() ? "" : ", the first pixel with a color map, because the example pixel has none"}, in texels of level 0:`);
  const result = `λ = log<sub>2</sub>(${fmt(mipSize(), 6)}) = <b>${fmt(Math.log2(mipSize()), 6)}</b>`;
  if (!MIP.anisotropic) return [`λ = log<sub>2</sub> max(|∂(s,t)/∂x|, |∂(s,t)/∂y|)\n\n${where}max(${fmt(a, 6)}, ${fmt(b, 6)}) = ${fmt(mipSize(), 6)}\n${result}`];
  return [`${say("A pixel covers an ellipse of the texture. Probes of the same size are placed along its major axis.")}N    = min(⌈major / minor⌉, limit)      minor ≥ 1\nsize = max(minor, major / N)\nλ    = log<sub>2</sub>(size)\n\n${where}major = ${fmt(a, 6)}, minor = ${fmt(b, 6)}, N = ${fmt(MIP.probes)}\nsize = max(${fmt(b, 6)}, ${fmt(a, 6)} / ${fmt(MIP.probes)}) = ${fmt(mipSize(), 6)}\n${result}`];
}

chapter({
  id: "mips", title: "Mip levels", kicker: "Shading",
  lead: () => "A pixel that covers many texels should show their average. Textures are therefore also stored at 1/2, 1/4, 1/8 of their size, and so on. The renderer samples the level whose texels are about as large as the pixel.",
  absent: () => (DATA.mips === null ? `No opaque surface of this frame has a color map. A frame with textures: ${command("halfspace explain pipeline")}.` : null),
  input: () => ["texture coordinates and their derivatives"],
  output: () => ["the level of detail, which selects the two mip levels to sample"],
  steps: () => [
    {name: "Level of detail", caption: `Dark pixels read ${DATA.mips.low < 0 ? "a magnified texture" : "low levels"}, bright ones high levels. Level 0 is the full texture, and each level has half the width and height of the previous one. ${fmt(DATA.mips.pixels)} pixels use a color map; the others are empty. Point at the picture to read the levels.${ringNote(MIP.at, "the first one with a color map, because the example pixel has none")}`, draw: () => [picture(DATA.mips.picture, "The mip level of each pixel as a heat map", {read: (x, y) => `pixel ${px([x, y])}: ${lodAt(x, y) < -50 ? "no color map" : "level " + fmt(lodAt(x, y), 4) + (lodAt(x, y) < 0 ? " (magnified)" : "")}`, ringed: MIP.at}), legend(DATA.mips.low < 0 ? "magnified" : "level −1", `level ${fmt(DATA.mips.high, 3)}`)].flat()},
  ],
  formula: mipFormula,
  related: ["interpolation", "varyings"], lessons: ["Texture and mipmaps"],
  exercises: () => [
    {ask: `What would the level of detail at pixel ${px(MIP.at)} be if the texture had twice the width and height${MIP.anisotropic ? ", and the number of probes were the same" : ""}?`, answer: MIP.lod + 1, decimals: 2, hint: "All distances in texels double.", why: `The logarithm increases by 1: ${fmt(MIP.lod, 5)} + 1.`},
    {ask: "How many texels of level 0 is a texel of the highest level of this frame wide, if fractions of levels are allowed?", answer: 2 ** DATA.mips.high, significant: 2, hint: "Each level doubles the width of a texel.", why: `2<sup>${fmt(DATA.mips.high, 4)}</sup>.`},
    {ask: "How many levels does a texture of 1024 × 1024 texels have?", answer: 11, hint: "The last level has a single texel.", why: "1024, 512, 256, …, 2, 1: log<sub>2</sub>(1024) + 1."},
  ],
});

// ---- lighting ---------------------------------------------------------------------------------------------------------------

const TERMS = DATA.terms;
const sumOf = (list) => list.reduce((a, v) => a.map((x, k) => x + v[k]), [0, 0, 0]);
const mean3 = (v) => 0.2126 * v[0] + 0.7152 * v[1] + 0.0722 * v[2];

// The terms of each light at the visible fragment, as products of their factors.
const LIGHTING = VISIBLE.lighting || null;
const MODEL_NAMES = {lambert: "Lambert", phong: "Phong", blinn_phong: "Blinn–Phong", metallic: "metallic-roughness"};
// How often the shader of the example lights its surface: per pixel, vertex or triangle.
const shadingRate = () => { const rate = VISIBLE.shader.match(/ per \w+/); return rate ? `${rate[0]}, ` : " "; };
// Names the transparent layers that cover the example pixel.
function exampleLayers() {
  const n = LAYERS !== null && LAYERS.pixel.join() === PIXEL.join() ? LAYERS.list.length : 0;
  return n > 0 ? ` The pixel is also covered by ${plural(n, "transparent layer")}; the sum below includes ${n === 1 ? "it" : "them"} (chapter “Transparent layers”).` : "";
}
const triple = (v, digits = 5) => v.map((x) => fmt(x, digits).padStart(10)).join(" ");
function lightFormulas() {
  if (LIGHTING === null) return [];
  const isMetallic = LIGHTING.model === "metallic", isLit = (l) => Math.max(...l.diffuse_color, ...l.specular_color) > 0;
  const cosine = {phong: "(r · v)", blinn_phong: "(n · h)"}[LIGHTING.model];
  const head = isMetallic ? "diffuse  = light · (n · l) · shadow · albedo · (1 − metallic) · (1 − F)\nspecular = light · shadow · reflectance of the microfacets"
    : `diffuse  = light · (n · l) · shadow · albedo · k<sub>d</sub>${cosine ? `\nspecular = light · ${cosine}<sup>${fmt(LIGHTING.shininess, 4)}</sup> · shadow · k<sub>s</sub>` : ""}`;
  const blocks = LIGHTING.lights.filter(isLit).slice(0, 4).map((l) => `${say(`Light ${escapeHtml(l.name)}:`)}${isMetallic ? metallicLight(l) : modelLight(l, cosine)}`);
  return [`${say(`The visible opaque fragment of pixel ${px(PIXEL)} is shaded${shadingRate()}with the ${MODEL_NAMES[LIGHTING.model]} model, evaluated at ${shadedWhere === "center" ? "its center" : shadedWhere} (red, green, blue).${exampleLayers()} n · l includes the attenuation of the light.`)}${head}\n\nalbedo      ${triple(LIGHTING.albedo)}\n${isMetallic ? "" : `k<sub>d</sub>          ${triple(LIGHTING.diffuse)}\n${cosine ? `k<sub>s</sub>          ${triple(LIGHTING.specular)}\n` : ""}`}\n${blocks.join("\n\n")}`];
}
function modelLight(l, cosine) {
  const d = LIGHTING.albedo.map((a, k) => l.diffuse_color[k] * l.n_l * l.shadow * a * LIGHTING.diffuse[k]);
  const s = LIGHTING.specular.map((a, k) => l.specular_color[k] * l.highlight * l.shadow * a);
  const factors = `light ${vec(l.diffuse_color, 4)} · n·l ${fmt(l.n_l, 6)} · shadow ${shadowOf(l)}`;
  return `${factors}\n→ diffuse   <b>${triple(d)}</b>${cosine ? `\n${cosine}<sup>${fmt(LIGHTING.shininess, 4)}</sup> = ${fmt(l.highlight, 6)}\n→ specular  <b>${triple(s)}</b>` : ""}`;
}
const shadowOf = (l) => (l.n_l > 0 || l.highlight > 0 ? fmt(l.shadow, 5) : "–, because the surface faces away from the light");
// The remaining factors are the quotient of the term and the other factors.
function metallicLight(l) {
  const rest = l.diffuse.map((d, k) => d / (l.diffuse_color[k] * l.n_l * l.shadow * LIGHTING.albedo[k])), shine = l.specular.map((s, k) => s / (l.specular_color[k] * l.shadow));
  const known = (v) => (v.every(Number.isFinite) ? triple(v) : "–");
  return `light ${vec(l.diffuse_color, 4)} · n·l ${fmt(l.n_l, 6)} · shadow ${shadowOf(l)}\n(1 − metallic) · (1 − F)  ${known(rest)}\n→ diffuse   <b>${triple(l.diffuse)}</b>\nreflectance ${known(shine)}\n→ specular  <b>${triple(l.specular)}</b>`;
}

chapter({
  id: "lighting", title: "Light, term by term", kicker: "Shading",
  lead: () => "The color of a surface is a sum of terms. Each picture shows one term, rendered by the same shaders with all other terms set to zero.",
  input: () => ["position, normal and material per pixel", plural(DATA.terms.filter((t) => t.name.startsWith("diffuse")).length, "light")],
  output: () => ["linear light, without an upper limit"],
  steps: () => [...TERMS.flatMap((t) => [
    {name: t.name[0].toUpperCase() + t.name.slice(1), caption: `${mean3(t.mean) > 0 ? `The mean luminance is ${num(mean3(t.mean), 4)}` : "This term is zero in the whole picture"}, and the luminance at the example pixel is ${num(mean3(t.value), 4)}. The picture is displayed like the sum.${ringNote()}`, draw: () => picture(t.picture, `The term “${t.name}”`, {ringed: PIXEL})},
    ...(t.shadow ? [{name: `Shadow factor of ${t.name.split(", ")[1]}`, caption: `The fraction of this light that reaches the surface: white is all, black is none. Surfaces that face away from the light are transparent in this picture. ${plural(t.shadowed[0], "pixel is", "pixels are")} in full shadow, and ${fmt(t.shadowed[1])} partly in shadow.${ringNote()}`, draw: () => picture(t.shadow, `The shadow factor of ${t.name.split(", ")[1]}`, {ringed: PIXEL})}] : []),
  ]), {name: "Sum", caption: `The sum of all terms, after exposure, tone curve and encoding, is the final picture.${ringNote()}`, draw: () => picture(DATA.pictures.final, "The sum of all terms", {ringed: PIXEL})}],
  formula: () => [...lightFormulas(), `${say(`color = sum of the terms, at pixel ${px(PIXEL)}${DATA.samples > 1 ? ", as the mean of its samples" : ""}:`)}${TERMS.map((t) => `${t.name.padEnd(22)} ${t.value.map((v) => fmt(v, 5).padStart(11)).join(" ")}`).join("\n")}\n${"sum".padEnd(22)} <b>${sumOf(TERMS.map((t) => t.value)).map((v) => fmt(v, 5).padStart(11)).join(" ")}</b>\n${"stored".padEnd(22)} ${DATA.tone.pixel.light.map((v) => fmt(v, 5).padStart(11)).join(" ")}${say(`The frame stores light as ${DATA.tone.stored_as}, so the last row is rounded.`)}`],
  related: ["shadows", "tone"], lessons: ["Flat, Gouraud and Phong shading"],
  exercises: () => {
    const best = TERMS.reduce((a, b) => (mean3(b.mean) > mean3(a.mean) ? b : a)), sum = mean3(sumOf(TERMS.map((t) => t.value))), most = Math.max(...TERMS.map((t) => mean3(t.value)));
    return [
      {ask: `Which term contributes most to the picture: ${TERMS.map((t) => `“${escapeHtml(t.name)}”`).join(", ")}?`, answer: best.name, hint: "Compare the mean luminances.", why: `Its mean luminance is ${fmt(mean3(best.mean), 4)}.`},
      {ask: "What percentage of the luminance at the example pixel comes from its largest term?", answer: sum > 0 ? most / sum * 100 : 0, decimals: 0, hint: "Divide the largest luminance of the steps by their sum.", why: sum > 0 ? `${fmt(most, 4)} / ${fmt(sum, 4)}.` : "The example pixel is black."},
      {ask: "What is the luminance of the sum of all terms at the example pixel?", answer: sum, significant: 3, hint: "It is 0.2126 · red + 0.7152 · green + 0.0722 · blue of the row “sum”.", why: "The luminance of a sum is the sum of the luminances."},
    ];
  },
});
