// Figures: canvases for pixels, SVG for geometry. Every figure has a label for screen readers.

function canvasFigure(width, height, label, pixelated = false) {
  const canvas = el("canvas", {width, height, role: "img", "aria-label": label, class: pixelated ? "pixels" : null});
  return {canvas, pen: canvas.getContext("2d")};
}

function svgFigure(width, height, label, ...children) {
  return svg("svg", {viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": label}, ...children);
}

// Shows a picture of the frame with an optional overlay, and calls read(x, y) for the pixel under the pointer.
function picture(uri, label, {overlay = null, read = null, click = null, scale = 2} = {}) {
  const {canvas, pen} = canvasFigure(W * scale, H * scale, label);
  const box = el("div", {class: "stage"}, canvas);
  const readout = read ? el("div", {class: "readout", "aria-live": "off"}, "Point at the picture to read its values.") : null;
  loadImage(uri).then((image) => {
    pen.imageSmoothingEnabled = false;
    pen.drawImage(image, 0, 0, W * scale, H * scale);
    if (overlay) overlay(pen, scale);
  });
  const pixelOf = (e) => {
    const r = canvas.getBoundingClientRect();
    return [Math.min(W - 1, Math.max(0, Math.floor((e.clientX - r.left) / r.width * W))), Math.min(H - 1, Math.max(0, Math.floor((e.clientY - r.top) / r.height * H)))];
  };
  if (read) canvas.addEventListener("pointermove", (e) => { readout.innerHTML = read(...pixelOf(e)); });
  if (click) canvas.addEventListener("click", (e) => click(...pixelOf(e)));
  return [box, readout].filter(Boolean);
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
function bars(list, label, {width = 720, height = 240, unit = ""} = {}) {
  const sorted = list.map((b) => b.value).sort((a, b) => b - a), top = Math.max(sorted[0], 1), isCut = list.length > 20 && top > 4 * sorted[1];
  const most = isCut ? Math.max(sorted[1] * 1.25, 1) : top, step = (width - 50) / list.length, root = svgFigure(width, height, label);
  list.forEach((b, i) => {
    const h = Math.min(1, b.value / most) * (height - 50), x = 40 + i * step;
    const bar = svg("rect", {x: x + 0.5, y: height - 30 - h, width: Math.max(1, step - 1.5), height: Math.max(h, b.value > 0 ? 1 : 0), fill: b.marked ? "var(--accent)" : "var(--soft)", opacity: b.marked ? 1 : 0.55});
    bar.append(svg("title", {}, document.createTextNode(`${b.name}: ${fmt(b.value)}${unit}`)));
    root.append(bar);
    if (b.value > most) root.append(svg("text", {x: x + step + 3, y: 30, "font-size": 13}, document.createTextNode("↑ " + fmt(b.value))));
    if (b.label !== undefined) root.append(svg("text", {x: x + step / 2, y: height - 10, "font-size": 13, "text-anchor": "middle"}, document.createTextNode(b.label)));
  });
  root.append(svg("line", {x1: 40, x2: width - 10, y1: height - 29.5, y2: height - 29.5, stroke: "var(--line)"}));
  root.append(svg("text", {x: 6, y: 17, "font-size": 13}, document.createTextNode(fmt(Math.round(most)))));
  return el("div", {class: "stage"}, root);
}
