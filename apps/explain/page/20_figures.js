// Figures: canvases for pixels, SVG for geometry. Every figure has a label for screen readers.

function canvasFigure(width, height, label, pixelated = false) {
  const canvas = el("canvas", {width, height, role: "img", "aria-label": label, class: pixelated ? "pixels" : null});
  return {canvas, pen: canvas.getContext("2d")};
}

// SVG figures are drawn in a narrower coordinate system on a phone, so that their labels stay readable.
const narrowWindow = matchMedia("(max-width: 620px)");
const figureWidth = () => (narrowWindow.matches ? 380 : 720);

function svgFigure(width, height, label, ...children) {
  return svg("svg", {viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": label}, ...children);
}

// Makes the cells of a figure selectable with the arrow keys while the figure has the focus. start: the first selected cell, from the upper
// left. pick(x, y) shows the values of a cell.
function pickable(element, columns, rows, start, pick) {
  let [x, y] = start;
  const arrows = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]};
  element.setAttribute("tabindex", 0);
  element.setAttribute("data-pick", "");
  element.setAttribute("aria-label", `${element.getAttribute("aria-label")}. The arrow keys select a ${columns === W ? "pixel" : "cell"}.`);
  element.addEventListener("keydown", (e) => {
    const by = arrows[e.key];
    if (!by || e.altKey || e.ctrlKey || e.metaKey) return;
    const step = e.shiftKey ? 8 : 1;
    e.preventDefault();
    e.stopPropagation();
    [x, y] = [Math.min(columns - 1, Math.max(0, x + by[0] * step)), Math.min(rows - 1, Math.max(0, y + by[1] * step))];
    pick(x, y);
  });
  return (px, py) => { [x, y] = [px, py]; };
}

// Shows a picture of the frame with an optional overlay, and calls read(x, y) for the pixel under the pointer. ringed: a pixel that gets a
// ring; the caption says which one it is (ringNote).
function picture(uri, label, {overlay = null, ringed = null, read = pixelRead, click = null, scale = 2} = {}) {
  const {canvas, pen} = canvasFigure(W * scale, H * scale, label);
  if (ringed) canvas.dataset.ring = ringed.join();
  const box = el("div", {class: "stage"}, canvas);
  const readout = el("div", {class: "readout", "aria-live": "polite"}, "Point at the picture to magnify it and read its values, or focus it and press the arrow keys.");
  const loupe = loupeOf(canvas, W, H);
  const mark = el("div", {class: "mark", "aria-hidden": "true", hidden: true});
  withImage(uri, (image) => {
    pen.imageSmoothingEnabled = false;
    pen.drawImage(image, 0, 0, W * scale, H * scale);
    loupe.source = image;
    if (overlay) overlay(pen, scale);
    if (ringed) ring(pen, scale, ringed);
  });
  const pixelOf = (e) => {
    const r = canvas.getBoundingClientRect();
    return [Math.min(W - 1, Math.max(0, Math.floor((e.clientX - r.left) / r.width * W))), Math.min(H - 1, Math.max(0, Math.floor((e.clientY - r.top) / r.height * H)))];
  };
  const describe = (x, y) => { loupe.show(x, y); readout.innerHTML = read(x, y, loupe.color); };
  const show = (x, y) => {
    describe(x, y);
    if (click) return click(x, y);
    mark.hidden = false;
    placeMark(mark, x, y);
  };
  const moveTo = pickable(canvas, W, H, click ? historyState.pixel : PIXEL, show);
  box.append(mark, loupe.element);
  canvas.addEventListener("pointermove", (e) => { const at = pixelOf(e); moveTo(...at); mark.hidden = true; describe(...at); });
  canvas.addEventListener("pointerleave", loupe.hide);
  canvas.addEventListener("blur", loupe.hide);
  if (click) canvas.addEventListener("click", (e) => { const at = pixelOf(e); moveTo(...at); click(...at); });
  return [box, readout];
}

// The default text of a pixel: its place, and its color in the picture, from 0 to 255.
const pixelRead = (x, y, color) => `pixel ${px([x, y])}: ${colorText(color)}`;
const colorText = (color) => (color === null ? "" : color[3] === 0 ? "nothing is drawn here" : `red ${color[0]}, green ${color[1]}, blue ${color[2]} in this picture`);

const LOUPE_REACH = 4, LOUPE_SCALE = 16;
// Returns a loupe that magnifies 9 x 9 cells of loupe.source 16 times. columns, rows: cells of the source. loupe.color is the color of the
// cell in the middle.
function loupeOf(canvas, columns, rows) {
  const side = 2 * LOUPE_REACH + 1, size = side * LOUPE_SCALE, lens = el("canvas", {width: size, height: size, class: "pixels"}), pen = lens.getContext("2d", {willReadFrequently: true});
  const element = el("div", {class: "loupe", "aria-hidden": "true", hidden: true}, lens), loupe = {source: null, color: null, element, hide: () => { element.hidden = true; }};
  loupe.show = (x, y) => {
    if (loupe.source === null) return;
    const cell = loupe.source.width / columns;
    pen.imageSmoothingEnabled = false;
    pen.clearRect(0, 0, size, size);
    pen.drawImage(loupe.source, (x - LOUPE_REACH) * cell, (y - LOUPE_REACH) * cell, side * cell, side * cell, 0, 0, size, size);
    loupe.color = [...pen.getImageData(size / 2, size / 2, 1, 1).data];
    pen.strokeStyle = "#000";
    pen.strokeRect(LOUPE_REACH * LOUPE_SCALE - 1.5, LOUPE_REACH * LOUPE_SCALE - 1.5, LOUPE_SCALE + 3, LOUPE_SCALE + 3);
    pen.strokeStyle = "#fff";
    pen.strokeRect(LOUPE_REACH * LOUPE_SCALE - 0.5, LOUPE_REACH * LOUPE_SCALE - 0.5, LOUPE_SCALE + 1, LOUPE_SCALE + 1);
    element.hidden = false;
    element.classList.toggle("left", x > columns / 2);
  };
  return loupe;
}

// Gives a canvas of columns x rows cells a loupe that follows the pointer.
function addLoupe(box, canvas, columns, rows) {
  const loupe = loupeOf(canvas, columns, rows);
  loupe.source = canvas;
  canvas.addEventListener("pointermove", (e) => { const r = canvas.getBoundingClientRect(); loupe.show(Math.floor((e.clientX - r.left) / r.width * columns), Math.floor((e.clientY - r.top) / r.height * rows)); });
  canvas.addEventListener("pointerleave", loupe.hide);
  box.append(loupe.element);
  return box;
}

// Gives a drawing a loupe that draws the part under the pointer again, magnified. paint(pen, k, isNear): draws with lines of 1/k of their
// width. isNear(a, b): whether a line from a to b can be in the loupe.
function addDrawnLoupe(box, canvas, paint) {
  const size = (2 * LOUPE_REACH + 1) * LOUPE_SCALE, lens = el("canvas", {width: size, height: size}), pen = lens.getContext("2d");
  const element = el("div", {class: "loupe", "aria-hidden": "true", hidden: true}, lens), hide = () => { element.hidden = true; };
  canvas.addEventListener("pointermove", (e) => {
    if (e.buttons !== 0) return hide();  // the drawing is being turned
    const r = canvas.getBoundingClientRect(), x = (e.clientX - r.left) / r.width * canvas.width, y = (e.clientY - r.top) / r.height * canvas.height;
    const reach = size / LOUPE_SCALE;
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.clearRect(0, 0, size, size);
    pen.setTransform(LOUPE_SCALE, 0, 0, LOUPE_SCALE, size / 2 - x * LOUPE_SCALE, size / 2 - y * LOUPE_SCALE);
    paint(pen, LOUPE_SCALE, ([ax, ay], [bx, by]) => Math.max(ax, bx) > x - reach && Math.min(ax, bx) < x + reach && Math.max(ay, by) > y - reach && Math.min(ay, by) < y + reach);
    element.hidden = false;
    element.classList.toggle("left", x > canvas.width / 2);
  });
  canvas.addEventListener("pointerleave", hide);
  box.append(element);
  return box;
}

function placeMark(mark, x, y) {
  mark.style.left = `${(x + 0.5) / W * 100}%`;
  mark.style.top = `${(y + 0.5) / H * 100}%`;
}

const legend = (low, high) => el("div", {class: "legend"}, el("span", {html: low}), el("i", {"aria-hidden": "true"}), el("span", {html: high}));

// Marks a pixel of the frame with a ring.
function ring(pen, scale, [x, y], radius = 9) {
  for (const [color, width] of [["#000", 5], ["#fff", 2.5]]) {
    pen.strokeStyle = color;
    pen.lineWidth = width;
    pen.beginPath();
    pen.arc((x + 0.5) * scale, (y + 0.5) * scale, radius * scale / 2, 0, 7);
    pen.stroke();
  }
}

// Strokes a line.
function stroke(pen, [ax, ay], [bx, by]) {
  pen.beginPath();
  pen.moveTo(ax, ay);
  pen.lineTo(bx, by);
  pen.stroke();
}

// Strokes or fills a polygon of points.
function polygon(pen, points, {stroke = null, fill = null, width = 1} = {}) {
  pen.beginPath();
  points.forEach(([x, y], i) => (i ? pen.lineTo(x, y) : pen.moveTo(x, y)));
  pen.closePath();
  if (fill) { pen.fillStyle = fill; pen.fill(); }
  if (stroke) { pen.strokeStyle = stroke; pen.lineWidth = width; pen.stroke(); }
}

// Cells that start with ¶ are text; the others are numbers.
const isText = (cell) => typeof cell === "string" && cell.startsWith("¶");
const tableOf = (head, rows, mark = -1) => el("div", {class: "table"}, el("table", {},
  el("thead", {}, el("tr", {}, ...head.map((h, i) => el("th", {scope: "col", html: h, class: isText(rows[0] && rows[0][i]) ? "text" : null})))),
  el("tbody", {}, ...rows.map((r, i) => el("tr", {class: i === mark ? "mark" : null}, ...r.map((c) => el("td", {class: isText(c) ? "text" : null, html: typeof c === "number" ? fmt(c) : c.replace("¶", "")})))))));

// A bar chart. bars: [{value, label, name, marked}].
function bars(list, label, {width = figureWidth(), height = 240, unit = ""} = {}) {
  const sorted = list.map((b) => b.value).sort((a, b) => b - a), top = Math.max(sorted[0], 1), isCut = list.length > 20 && top > 4 * sorted[1];
  const most = isCut ? Math.max(sorted[1] * 1.25, 1) : top, step = (width - 50) / list.length, root = svgFigure(width, height, label);
  const labeled = list.flatMap((b, i) => (b.label === undefined ? [] : [i])), spacing = step * (labeled.length > 1 ? labeled[1] - labeled[0] : list.length);
  const isStaggered = spacing < 60 && list.some((b) => b.label !== undefined && b.label.length > 5), every = isStaggered ? 1 : Math.ceil(26 / spacing);
  list.forEach((b, i) => {
    const h = Math.min(1, b.value / most) * (height - 50), x = 40 + i * step;
    const bar = svg("rect", {x: x + 0.5, y: height - 30 - h, width: Math.max(1, step - 1.5), height: Math.max(h, b.value > 0 ? 1 : 0), fill: b.marked ? "var(--accent)" : "var(--soft)", opacity: b.marked ? 1 : 0.55});
    bar.append(svg("title", {}, document.createTextNode(`${b.name}: ${fmt(b.value)}${unit}`)));
    root.append(bar);
    if (b.value > most) root.append(svg("text", {x: x + step + 3, y: 30, "font-size": 13}, document.createTextNode("↑ " + fmt(b.value))));
    if (b.label !== undefined && labeled.indexOf(i) % every === 0) root.append(svg("text", {x: x + step / 2, y: height - (isStaggered ? (i % 2 ? 3 : 17) : 10), "font-size": 13, "text-anchor": "middle"}, document.createTextNode(b.label)));
  });
  root.append(svg("line", {x1: 40, x2: width - 10, y1: height - 29.5, y2: height - 29.5, stroke: "var(--line)"}));
  root.append(svg("text", {x: 6, y: 17, "font-size": 13}, document.createTextNode(fmt(Math.round(most)))));
  return el("div", {class: "stage"}, root);
}
