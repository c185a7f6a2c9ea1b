// Exercises: predict, then reveal. Answers are kept in the browser and can be saved for a teacher.
//
// An exercise is {ask, answer, decimals | significant, tolerance, unit, hint, why}. The answer is a number or a string in lower case. Numbers
// are asked for as integers, with a number of decimal places, or with a number of significant digits.

const digitWords = ["no", "one", "two", "three", "four", "five", "six"];
function askedDigits(x) {
  if (x.decimals === 0) return " (Rounded to an integer.)";
  if (x.decimals !== undefined) return ` (${capital(digitWords[x.decimals])} decimal place${x.decimals === 1 ? "" : "s"}.)`;
  return x.significant !== undefined ? ` (${capital(digitWords[x.significant])} significant digits.)` : "";
}

// Returns the distance of two numbers that differ in the last digit asked for; 0 for integers.
function lastDigit(x) {
  if (x.decimals !== undefined) return 10 ** -x.decimals;
  if (x.significant === undefined || x.answer === 0) return 0;
  return 10 ** (Math.floor(Math.log10(Math.abs(x.answer))) - x.significant + 1);
}

// Returns the answer with the digits asked for.
function roundedAnswer(x) {
  if (typeof x.answer !== "number") return x.answer;
  if (x.decimals !== undefined) return x.answer.toFixed(x.decimals);
  return x.significant !== undefined ? String(Number(x.answer.toPrecision(x.significant))) : String(x.answer);
}

// Returns the numbers that a text can mean. The decimal separator is a point or a comma; the other one, or a space, groups digits. A unit
// behind the number is ignored.
function numbersOf(text) {
  const plain = text.trim().replace(/(%|[a-z]+)$/i, "").replace(/[\s\u00a0\u202f'_]/g, "").replace(/[−–]/g, "-");
  const point = plain.replace(/,(?=\d{3}(\D|$))/g, ""), comma = plain.replace(/\.(?=\d{3}(\D|$))/g, "").replace(",", ".");
  return [plain, point, comma].filter((t) => /^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i.test(t)).map(Number);
}

// Text answers are compared without spaces, quotation marks and punctuation.
const lettersOf = (text) => text.toLowerCase().replace(/[\s,.()"'“”„«»]/g, "");

// An answer is right if it is the exact value, or the value rounded to the digits asked for. A value halfway may be rounded up or down.
function isRight(x, text) {
  if (typeof x.answer !== "number") return lettersOf(text) === lettersOf(x.answer);
  const unit = lastDigit(x), allowed = Math.max(x.tolerance ?? 0, unit / 2 * (1 + 1e-9));
  return numbersOf(text).some((given) => Math.abs(given - x.answer) <= allowed);
}

// ---- progress -------------------------------------------------------------------------------------------------------------

// Browsers can refuse storage, for example in private windows; then the progress is kept until the page is closed.
// The key contains a hash (FNV-1a) of values of the frame, because a page of a changed scene has other answers.
const frameHash = [...JSON.stringify([DATA.statistics, EX])].reduce((h, c) => Math.imul(h ^ c.codePointAt(0), 16777619) >>> 0, 2166136261);
const STORE = `halfspace explain ${DATA.command} ${PIXEL} ${frameHash}`;
const progress = (() => {
  try {
    return {kept: true, student: "", answers: {}, ...JSON.parse(localStorage.getItem(STORE) || "{}")};
  } catch {
    return {kept: false, student: "", answers: {}};
  }
})();
function saveProgress() {
  try {
    localStorage.setItem(STORE, JSON.stringify({student: progress.student, answers: progress.answers}));
    progress.kept = true;
  } catch {
    progress.kept = false;
  }
  showProgress();
}
const keyOf = (id, number) => `${id}/${number}`;
// The record of an exercise: {given, tries, right, first, revealed}. first: whether the first try was right.
const recordOf = (id, number) => (progress.answers[keyOf(id, number)] ||= {given: "", tries: 0, right: false, first: false, revealed: false});
const isAbsent = (c) => Boolean(c.absent && c.absent());
const countOf = (c) => (isAbsent(c) || !c.exercises ? 0 : c.exercises().length);
const solvedOf = (c) => Array.from({length: countOf(c)}, (_, i) => progress.answers[keyOf(c.id, i + 1)]).filter((r) => r && r.right).length;

function showProgress() {
  document.querySelectorAll("nav .done").forEach((mark, i) => {
    const solved = solvedOf(CHAPTERS[i]);
    mark.textContent = solved > 0 ? `${solved}/${countOf(CHAPTERS[i])}` : "";
    mark.title = solved > 0 ? `${solved} of ${plural(countOf(CHAPTERS[i]), "exercise")} solved` : "";
  });
}

// ---- the form of an exercise ------------------------------------------------------------------------------------------------

function exercise(c, x, number) {
  const verdict = el("p", {class: "verdict", role: "status"}), known = progress.answers[keyOf(c.id, number)];
  const input = el("input", {type: "text", value: known ? known.given : "", "aria-label": `Your answer to exercise ${number}`, autocomplete: "off", inputmode: typeof x.answer === "number" ? "decimal" : null});
  const reveal = el("button", {type: "button", disabled: !known || known.tries === 0, onclick: () => {
    recordOf(c.id, number).revealed = true;
    saveProgress();
    verdict.className = "verdict";
    verdict.innerHTML = `The answer is <span class="n">${escapeHtml(roundedAnswer(x))}</span>${x.unit ? " " + x.unit : ""}. ${x.why}`;
  }}, "Reveal");
  const check = (e) => { e.preventDefault(); if (judge(c, x, number, input.value, verdict)) reveal.disabled = false; };
  if (known && known.right) { verdict.className = "verdict right"; verdict.innerHTML = `✓ Solved. ${x.why}`; }
  return el("div", {class: "exercise"}, el("p", {html: `<b>${number}.</b> ${x.ask}${askedDigits(x)}`}),
    el("form", {onsubmit: check}, input, el("span", {}, x.unit || ""), el("button", {type: "submit"}, "Check"), reveal, verdict));
}

// Judges an answer. Returns false if the text is not an answer, and does not count it as a try.
function judge(c, x, number, text, verdict) {
  const problem = text.trim() === "" ? "Predict a value first; the answer can be revealed afterwards." : typeof x.answer === "number" && numbersOf(text).length === 0 ? "This is not a number." : "";
  if (problem) {
    verdict.className = "verdict wrong";
    verdict.textContent = problem;
    return false;
  }
  const right = isRight(x, text), record = recordOf(c.id, number);
  if (++record.tries === 1) record.first = right;
  if (right || !record.right) record.given = text.trim();
  record.right ||= right;
  saveProgress();
  verdict.className = "verdict " + (right ? "right" : "wrong");
  verdict.innerHTML = right ? `✓ Correct. ${x.why}` : `✗ Not correct yet. ${x.hint}`;
  return true;
}

function exercisesOf(c) {
  const list = c.exercises ? c.exercises() : [];
  return list.length === 0 ? [] : [el("h3", {}, "Exercises"),
    el("p", {class: "keys"}, "Predict, then check. Numbers may have a decimal point or a decimal comma. An answer can be revealed after a try."), ...list.map((x, i) => exercise(c, x, i + 1))];
}

// ---- results ------------------------------------------------------------------------------------------------------------------

const RESULT_COLUMNS = ["student", "page", "pixel", "chapter", "exercise", "question", "given", "expected", "right", "right at first try", "tries", "revealed"];
const plainText = (html) => new DOMParser().parseFromString(html, "text/html").body.textContent;

// The rows of the result file: one per exercise of this page, tried or not.
function resultRows() {
  return CHAPTERS.flatMap((c) => (countOf(c) === 0 ? [] : c.exercises().map((x, i) => {
    const r = progress.answers[keyOf(c.id, i + 1)] || {given: "", tries: 0, right: false, first: false, revealed: false};
    return [progress.student, DATA.command, PIXEL.join(" "), c.title, i + 1, plainText(x.ask + askedDigits(x)), r.given, roundedAnswer(x), r.right ? "yes" : "no", r.first ? "yes" : "no", r.tries, r.revealed ? "yes" : "no"];
  })));
}
// Quotes a cell as in RFC 4180. A text that a spreadsheet would run as a formula gets an apostrophe in front.
const csvCell = (v) => { const text = String(v), safe = /^[=+@\t\r]/.test(text) || (/^-/.test(text) && numbersOf(text).length === 0) ? "'" + text : text; return /[",\n\r]/.test(safe) ? `"${safe.replaceAll('"', '""')}"` : safe; };
const resultsAsCsv = () => "\ufeff" + [RESULT_COLUMNS, ...resultRows()].map((row) => row.map(csvCell).join(",")).join("\r\n") + "\r\n";

function saveFile(name, text, type) {
  const link = el("a", {href: URL.createObjectURL(new Blob([text], {type})), download: name});
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

const resultsName = () => `${[sceneName, progress.student.trim()].filter(Boolean).map((s) => s.replace(/[^\p{L}\p{N}_.-]+/gu, "_")).join("-")}-results.csv`;

function resultsPicture() {
  const with3 = CHAPTERS.filter((c) => countOf(c) > 0), all = with3.reduce((n, c) => n + countOf(c), 0), solved = with3.reduce((n, c) => n + solvedOf(c), 0);
  const name = el("input", {type: "text", value: progress.student, "aria-label": "Name in the result file", oninput: () => { progress.student = name.value; saveProgress(); }});
  const save = el("button", {type: "button", onclick: () => saveFile(resultsName(), resultsAsCsv(), "text/csv;charset=utf-8")}, "Save results as CSV");
  const clear = el("button", {type: "button", onclick: () => { progress.answers = {}; saveProgress(); goToStep(state.step, "keep"); }}, "Forget all answers");
  return [el("div", {class: "results"}, el("p", {html: `<b>${fmt(solved)}</b> of ${fmt(all)} exercises solved.${progress.kept ? "" : " This browser refuses to store the progress, so it is lost when the page is closed."}`}),
    el("form", {onsubmit: (e) => e.preventDefault()}, el("label", {}, "Name ", name), save, clear)),
    tableOf(["chapter", "solved", "tries"], with3.map((c) => [`¶${c.title}`, `${solvedOf(c)}/${countOf(c)}`, c.exercises().reduce((n, _, i) => n + ((progress.answers[keyOf(c.id, i + 1)] || {tries: 0}).tries), 0)]))];
}
