// The data of the page, number formatting, and helpers to create elements.
const DATA = JSON.parse(document.getElementById("data").textContent);
const W = DATA.width, H = DATA.height, SUB = 256;

// Creates an element: el("p", {class: "lead"}, "text", child).
function el(tag, attributes = {}, ...children) {
  const e = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) e.addEventListener(name.slice(2), value);
    else if (name === "html") e.innerHTML = value;
    else if (value !== null && value !== undefined && value !== false) e.setAttribute(name, value === true ? "" : value);
  }
  e.append(...children.filter((c) => c !== null && c !== undefined));
  return e;
}

function svg(tag, attributes = {}, ...children) {
  const e = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) e.setAttribute(name, value);
  e.append(...children);
  return e;
}

const escapeHtml = (text) => String(text).replace(/[&<>"]/g, (c) => ({"&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;"})[c]);

// Formats a number with up to `digits` significant digits.
function fmt(x, digits = 6) {
  if (x === null || x === undefined || Number.isNaN(x)) return "–";
  if (!Number.isFinite(x)) return x > 0 ? "∞" : "−∞";
  if (Number.isInteger(x) && Math.abs(x) < 1e15) return group(x);
  const text = String(Number(x.toPrecision(digits)));
  return text.replace("-", "−").replace("e+", "e").replace("e-", "e−");
}
const group = (x) => (x < 0 ? "−" : "") + String(Math.abs(x)).replace(/\B(?=(\d{3})+$)/g, "\u00a0");
const num = (x, digits) => `<span class="n">${fmt(x, digits)}</span>`;
// A number as a term or factor of a formula: in parentheses if it is negative.
const operand = (x, digits) => (x < 0 ? `(${fmt(x, digits)})` : fmt(x, digits));
const vec = (v, digits = 5) => `(${v.map((x) => fmt(x, digits)).join(", ")})`;
const plural = (n, one, many = one + "s") => `${fmt(n)} ${n === 1 ? one : many}`;
// Prose inside a formula, which wraps.
const say = (html) => `<span class="prose">${html}</span>`;
// A pixel counted from the upper left, as in image files, and in brackets from the lower left, as in OpenGL's window coordinates.
const px = ([x, y]) => `(${x}, ${y}) [${x}, ${H - 1 - y}]`;
const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

// Decodes the PNG files in which a page stores its arrays (page_encode.h).
async function unpack(base64, bytes) {
  const file = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  const view = new DataView(file.buffer), parts = [];
  let width = 0, height = 0;
  for (let at = 8; at < file.length;) {
    const length = view.getUint32(at), type = String.fromCharCode(...file.subarray(at + 4, at + 8));
    if (type === "IHDR") [width, height] = [view.getUint32(at + 8), view.getUint32(at + 12)];
    if (type === "IDAT") parts.push(file.subarray(at + 8, at + 8 + length));
    at += length + 12;
  }
  const stream = new Blob(parts).stream().pipeThrough(new DecompressionStream("deflate"));
  return unfilter(new Uint8Array(await new Response(stream).arrayBuffer()), width * 3, height).subarray(0, bytes);
}

// Reverses the filters of PNG rows with three bytes per pixel (PNG specification, section 9).
function unfilter(raw, row, height) {
  const out = new Uint8Array(row * height);
  for (let y = 0; y < height; ++y) {
    const filter = raw[y * (row + 1)], from = y * (row + 1) + 1, to = y * row;
    for (let i = 0; i < row; ++i) {
      const left = i >= 3 ? out[to + i - 3] : 0, up = y > 0 ? out[to + i - row] : 0, corner = i >= 3 && y > 0 ? out[to + i - row - 3] : 0;
      out[to + i] = raw[from + i] + predicted(filter, left, up, corner);
    }
  }
  return out;
}
function predicted(filter, left, up, corner) {
  if (filter === 0) return 0;
  if (filter === 1) return left;
  if (filter === 2) return up;
  if (filter === 3) return (left + up) >> 1;
  const p = left + up - corner, a = Math.abs(p - left), b = Math.abs(p - up), c = Math.abs(p - corner);
  return a <= b && a <= c ? left : b <= c ? up : corner;
}

// Decodes an array of `count` elements that is stored as byte planes. size: bytes per element.
async function unpackArray(base64, Type, count, size = Type.BYTES_PER_ELEMENT) {
  if (!base64 || count === 0) return new Type(0);
  const planes = await unpack(base64, count * size), bytes = new Uint8Array(count * size);
  for (let k = 0; k < size; ++k) for (let i = 0; i < count; ++i) bytes[i * size + k] = planes[k * count + i];
  return new Type(bytes.buffer);
}

// Calls f(image) when the picture is decoded: at once if it has been decoded before.
const IMAGES = new Map();
function withImage(uri, f) {
  const known = IMAGES.get(uri) || Object.assign(new Image(), {src: uri});
  IMAGES.set(uri, known);
  if (known.complete && known.naturalWidth > 0) return f(known);
  known.addEventListener("load", () => f(known), {once: true});
  drawing.pictures.push(new Promise((resolve) => ["load", "error"].forEach((type) => known.addEventListener(type, resolve, {once: true}))));
}

// A step is being drawn until its pictures are decoded and the browser has painted it. end: when the last step was ready, in the time of
// events.
const drawing = {number: 0, isBusy: false, end: 0, pictures: []};
function drawStep(draw) {
  const number = ++drawing.number;
  drawing.isBusy = true;
  drawing.pictures = [];
  draw();
  const isPainted = () => { if (number === drawing.number) Object.assign(drawing, {isBusy: false, end: performance.now()}); };
  Promise.all(drawing.pictures).then(() => requestAnimationFrame(() => setTimeout(isPainted)));
}
// A held arrow key repeats faster than some steps are drawn. Repetitions from that time are ignored: in the queue of the browser, they would
// change the step after the key was released.
function dropLateKey(e) {
  if (!e.repeat || !e.key.startsWith("Arrow") || !(drawing.isBusy || e.timeStamp < drawing.end)) return;
  e.preventDefault();
  e.stopPropagation();
}

// Decodes all pictures of the page.
const allUris = () => [...Object.values(DATA.pictures), ...DATA.terms.flatMap((t) => [t.picture, t.shadow]), DATA.depth.picture, DATA.overdraw.picture, DATA.mips && DATA.mips.picture, DATA.shadow && DATA.shadow.map].filter(Boolean);
const decodeAll = () => Promise.all(allUris().map((uri) => new Promise((resolve) => withImage(uri, resolve))));

// ---- matrices, stored column by column -----------------------------------------------------------------------------

const transform = (m, [x, y, z, w = 1]) => [0, 1, 2, 3].map((r) => m[r] * x + m[4 + r] * y + m[8 + r] * z + m[12 + r] * w);
const multiply = (a, b) => [0, 1, 2, 3].flatMap((c) => transform(a, b.slice(4 * c, 4 * c + 4)));

// Inverse of an affine transform.
function inverseAffine(m) {
  const [a, b, c, , d, e, f, , g, h, i, , x, y, z] = m;
  const det = a * (e * i - f * h) - d * (b * i - c * h) + g * (b * f - c * e);
  const r = [e * i - f * h, c * h - b * i, b * f - c * e, 0, f * g - d * i, a * i - c * g, c * d - a * f, 0, d * h - e * g, b * g - a * h, a * e - b * d, 0]
    .map((v) => v / det);
  const t = [0, 1, 2].map((k) => -(r[k] * x + r[4 + k] * y + r[8 + k] * z));
  return [...r, ...t, 1];
}
