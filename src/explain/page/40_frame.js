// Arrays of the frame, and values that several chapters use.
const FRAME = {};

async function unpackFrame() {
  const n = DATA.wire.count;
  FRAME.positions = await unpackArray(DATA.wire.positions, Float32Array, n * 3, 12);
  FRAME.wireDraws = await unpackArray(DATA.wire.draws, Uint16Array, n);
  FRAME.outcomes = await unpackArray(DATA.wire.outcomes, Uint8Array, n);
  FRAME.depth = await unpackArray(DATA.depth.values, Float32Array, W * H);
  FRAME.fragments = await unpackArray(DATA.overdraw.counts, Uint32Array, W * H);
  FRAME.lods = DATA.mips ? await unpackArray(DATA.mips.values, Float32Array, W * H) : null;
}

const EX = DATA.example, PIXEL = DATA.pixel, TRI = EX && EX.triangles ? EX.triangles[0] : null;
const sceneName = DATA.scene.split("/").pop();
const isTriangle = EX !== null && EX.corners === 3 && TRI !== null;
// The example pixel in window coordinates, whose origin is at the lower left.
const WINDOW = [PIXEL[0], H - 1 - PIXEL[1]];
const exampleName = EX === null ? "nothing" : `${EX.corners === 3 ? "triangle" : EX.corners === 2 ? "line" : "point"} ${fmt(EX.primitive)} of <i>${escapeHtml(EX.object)}</i>`;
const command = (rest) => `<code>${escapeHtml(rest)}</code>`;

// Returns the edge function in (1/256 px)². The result is exact, because all products are below 2^53.
const edgeAt = (e, x, y) => e.ex * (y - e.y0) - e.ey * (x - e.x0);
const inside = (t, x, y) => t.edges.every((e) => edgeAt(e, x, y) - e.bias >= 0);
const center = (pixel) => pixel * SUB + SUB / 2;
const covered = (t, x, y) => x >= t.box[0] && x < t.box[2] && y >= t.box[1] && y < t.box[3] && (t.edges ? inside(t, center(x), center(y)) : true);

// Outcomes of primitives in the order of StageOutcome, for use after "primitives" or a number.
const OUTCOMES = ["kept unchanged", "clipped", "outside the view", "culled by facing", "without area", "covering no sample", "with infinite or NaN positions"];
