// Arrays of the frame, and values that several chapters use.
const FRAME = {};

async function unpackFrame() {
  const n = DATA.wire.count;
  FRAME.positions = await unpackArray(DATA.wire.positions, Float32Array, n * 3, 12);
  FRAME.wireDraws = await unpackArray(DATA.wire.draws, Uint16Array, n);
  FRAME.outcomes = await unpackArray(DATA.wire.outcomes, Uint8Array, n);
  FRAME.depth = await unpackArray(DATA.depth.values, Float32Array, W * H);
  const blocks = Math.ceil(W / 8) * Math.ceil(H / 8);
  FRAME.blockLow = await unpackArray(DATA.depth.block_low, Float32Array, blocks);
  FRAME.blockHigh = await unpackArray(DATA.depth.block_high, Float32Array, blocks);
  FRAME.fragments = await unpackArray(DATA.overdraw.counts, Uint32Array, W * H);
  FRAME.lods = DATA.mips ? await unpackArray(DATA.mips.values, Float32Array, W * H) : null;
}

// Says which pixel the ring of a picture marks. why: what it shows, if it is not the example pixel.
const ringNote = (pixel = PIXEL, why = "") => (pixel.join() === PIXEL.join() ? " The ring marks the example pixel." : ` The ring marks pixel ${px(pixel)}, ${why}.`);

const EX = DATA.example, PIXEL = DATA.pixel, VISIBLE = DATA.visible, SAMPLE = VISIBLE.sample;
// The triangle after setup that covers the visible sample of the example pixel.
const TRI = EX && EX.triangles ? EX.triangles[EX.shown] : null;
const sceneName = DATA.scene.split("/").pop();
const isTriangle = EX !== null && EX.corners === 3 && TRI !== null;
// A clipped triangle was replaced by the pieces of its polygon. The page then follows the piece that covers the example pixel.
const isClipped = isTriangle && TRI.clipped;
const isPoint = EX !== null && EX.corners === 1 && TRI !== null;
// The example pixel in window coordinates, whose origin is at the lower left.
const WINDOW = [PIXEL[0], H - 1 - PIXEL[1]];
const exampleName = EX === null ? "nothing" : `${EX.corners === 3 ? "triangle" : EX.corners === 2 ? "line" : "point"} ${fmt(EX.primitive)} of <i>${escapeHtml(EX.object)}</i>`;
const pieceNote = isClipped ? `${exampleName[0].toUpperCase() + exampleName.slice(1)} was clipped. From here on, the page follows the piece that covers the example pixel.` : "";
const capital = (text) => text[0].toUpperCase() + text.slice(1);
const listed = (names) => names.map(escapeHtml).map((n, i, all) => (i === 0 ? n : i === all.length - 1 ? ` and ${n}` : `, ${n}`)).join("");
const command = (rest) => `<code>${escapeHtml(rest)}</code>`;
const shellName = (file) => (/^[\w.,:#%@/+-]+$/.test(file) ? file : `'${file.replaceAll("'", "'\\''")}'`);

// Returns the edge function in (1/256 px)². The result is exact, because all products are below 2^53.
const edgeAt = (e, x, y) => e.ex * (y - e.y0) - e.ey * (x - e.x0);
const inside = (t, x, y) => t.edges.every((e) => edgeAt(e, x, y) - e.bias >= 0);
// The position of a sample of a pixel in 1/256 pixel. The default is the visible sample of the example pixel.
const sampleX = (x, s = SAMPLE) => x * SUB + DATA.sample_positions[s][0];
const sampleY = (y, s = SAMPLE) => y * SUB + DATA.sample_positions[s][1];
const allSamples = DATA.sample_positions.map((_, s) => s);
const sampleName = DATA.samples === 1 ? "the center" : `sample ${SAMPLE}`;

const inBox = ([x0, y0, x1, y1], x, y) => x >= x0 && x < x1 && y >= y0 && y < y1;
// Returns true if a sample is covered. A line of one sample has no edge functions; its coverage in the block of the example pixel is stored.
function covers(t, x, y, s = SAMPLE) {
  if (!inBox(t.boxes[s], x, y)) return false;
  if (t.edges) return inside(t, sampleX(x, s), sampleY(y, s));
  const [i, j] = [x - blockOf(WINDOW[0]), y - blockOf(WINDOW[1])];
  return isPoint || i < 0 || j < 0 || i > 7 || j > 7 || (EX.block[8 * j + i] >> s & 1) === 1;
}
const covered = (t, x, y) => allSamples.some((s) => covers(t, x, y, s));
const blockOf = (v) => Math.floor(v / 8) * 8;

// Outcomes of primitives in the order of StageOutcome, for use after "primitives" or a number.
const OUTCOMES = ["kept unchanged", "clipped", "outside the view", "culled by facing", "without area", "covering no sample", "with infinite or NaN positions"];
