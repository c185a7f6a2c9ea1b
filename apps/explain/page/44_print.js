// Printing of the whole page: all chapters with all steps, one below the other.

// Formulas of more lines than this may continue on the next page. A line on paper has about 70 characters.
const LONG_FORMULA = 24;
const printedLines = (html) => plainText(html.replaceAll('<span class="prose">', "\n")).split("\n").reduce((n, line) => n + Math.max(1, Math.ceil(line.length / 70)), 0);

// Returns a chapter as it is printed: without controls, and with an empty line for each answer.
function printed(c) {
  const absent = isAbsent(c) ? c.absent() : null;
  const head = el("div", {class: "head"}, el("p", {class: "kicker"}, c.kicker), el("h2", {}, c.title), el("p", {class: "lead", html: c.lead()})), parts = [head];
  if (absent) head.append(el("p", {class: "absent-note", html: absent}));
  if (absent) return el("article", {}, head);
  if (c.input) head.append(el("div", {class: "flow"}, listOf("Input", c.input()), listOf("Output", c.output())));
  for (const step of c.steps()) parts.push(el("figure", {}, el("div", {class: "step"}, ...[step.draw()].flat()), el("figcaption", {html: `<b>${step.name}.</b> ${step.caption}`})));
  for (const block of c.formula ? c.formula() : []) parts.push(el("div", {class: printedLines(block) > LONG_FORMULA ? "formula long" : "formula", html: block}));
  if (c.body) parts.push(...[c.body()].flat().filter(Boolean));
  const exercises = c.exercises ? c.exercises() : [];
  if (exercises.length > 0) parts.push(el("h3", {}, "Exercises"), ...exercises.map((x, i) => el("p", {class: "blank", html: `<b>${i + 1}.</b> ${x.ask}${askedDigits(x)}`})));
  return el("article", {}, ...parts);
}

let isPrinting = false, canPrint = false, screenTheme = "light";
function showAll() {
  if (isPrinting) return;
  isPrinting = true;
  screenTheme = document.documentElement.dataset.theme;
  document.documentElement.dataset.theme = "light";
  document.body.classList.add("printing");
  document.getElementById("main").replaceChildren(...(canPrint ? CHAPTERS.map(printed) : [el("p", {}, "The page was still being prepared for printing. Print it again, or use its button “Print”.")]));
}
function showOne() {
  if (!isPrinting) return;
  isPrinting = false;
  document.documentElement.dataset.theme = screenTheme;
  document.body.classList.remove("printing");
  goTo(state.chapter, state.step, false, "keep");
}

// Decodes the pictures and arrays of all chapters, because the browser does not wait for them when it prints.
async function prepareToPrint() {
  await Promise.all([decodeAll(), unpackHistory(), unpackTile()]);
  canPrint = true;
}
async function printAll() {
  await prepareToPrint();
  showAll();
  await new Promise((done) => setTimeout(done));  // chapters with unpacked data fill their panels in a task of their own
  print();
}
