// Chapters: registration, steps, exercises and navigation.
//
// A chapter is {id, title, kicker, lead, input, output, steps, formula, body, exercises, absent}. Texts are HTML. steps: a list of
// {name, caption, draw}, where draw() returns elements. absent() returns null, or HTML that explains why this frame has no such stage.
const CHAPTERS = [];
const chapter = (c) => CHAPTERS.push(c);
const state = {chapter: 0, step: 0};

function quotesOf(id) {
  const quotes = DATA.quotes[id] || [];
  if (quotes.length === 0) return [];
  return [el("h3", {}, "Source code"), ...quotes.map((q, i) => el("details", {class: "quote", open: i === 0},
    el("summary", {}, `${q.file}, line ${q.line}`), el("pre", {tabindex: 0, "aria-label": `Source lines of ${q.file}`, html: colored(q.text)})))];
}

// Highlights C++ comments and keywords.
function colored(text) {
  return escapeHtml(text).split("\n").map((line) => {
    const at = line.indexOf("//"), code = at < 0 ? line : line.slice(0, at), comment = at < 0 ? "" : `<span class="c">${line.slice(at)}</span>`;
    return code.replace(/\b(const|return|for|if|else|switch|case|int|int64_t|float|double|bool|template|class|struct|inline|constexpr|static|auto|void|continue|while)\b/g, '<span class="k">$1</span>') + comment;
  }).join("\n");
}

// An exercise is {ask, answer, tolerance, unit, hint, why}. The answer is a number or a string in lower case.
function exercise(x, number) {
  const verdict = el("p", {class: "verdict", role: "status"});
  const input = el("input", {type: "text", "aria-label": `Your answer to exercise ${number}`, autocomplete: "off", inputmode: typeof x.answer === "number" ? "decimal" : null});
  const check = (e) => { e.preventDefault(); judge(x, input.value, verdict); };
  const show = el("button", {type: "button", onclick: () => { verdict.className = "verdict"; verdict.innerHTML = `${typeof x.answer === "number" ? num(x.answer, 9) : x.answer}${x.unit ? " " + x.unit : ""}. ${x.why}`; }}, "Show answer");
  return el("div", {class: "exercise"}, el("p", {html: `<b>${number}.</b> ${x.ask}`}),
    el("form", {onsubmit: check}, input, el("span", {}, x.unit || ""), el("button", {type: "submit"}, "Check"), show, verdict));
}

function isRight(x, text) {
  const given = text.trim().toLowerCase().replace(/[\s ,]/g, "").replace("−", "-");
  if (typeof x.answer !== "number") return given === x.answer.toLowerCase().replace(/[\s,]/g, "");
  return given !== "" && Math.abs(Number(given) - x.answer) <= (x.tolerance ?? 0);
}

function judge(x, text, verdict) {
  const right = isRight(x, text);
  verdict.className = "verdict " + (right ? "right" : "wrong");
  verdict.innerHTML = right ? `✓ Correct. ${x.why}` : `✗ Not correct yet. ${x.hint}`;
}

function exercisesOf(c) {
  const list = c.exercises ? c.exercises() : [];
  return list.length === 0 ? [] : [el("h3", {}, "Exercises"), ...list.map((x, i) => exercise(x, i + 1))];
}

const listOf = (title, items) => el("div", {}, el("h4", {}, title), el("ul", {}, ...items.map((i) => el("li", {html: i}))));

// The figure with its stepper. show(n) draws step n.
function stepsOf(c) {
  const steps = c.steps();
  const stage = el("div", {class: "step"}), caption = el("figcaption", {"aria-live": "polite"});
  const range = el("input", {type: "range", min: 1, max: steps.length, value: 1, "aria-label": `Step of chapter “${c.title}”`, oninput: () => goToStep(Number(range.value) - 1)});
  const output = el("output");
  const back = el("button", {type: "button", "aria-label": "Previous step", onclick: () => move(-1)}, "←");
  const next = el("button", {type: "button", "aria-label": "Next step", onclick: () => move(1)}, "→");
  c.stepCount = steps.length;
  c.showStep = (n) => {
    range.value = n + 1;
    output.textContent = `${n + 1} / ${steps.length}`;
    stage.replaceChildren(...[steps[n].draw()].flat());
    stage.dataset.step = n + 1;
    caption.innerHTML = `<b>${steps[n].name}.</b> ${steps[n].caption}`;
  };
  return el("figure", {}, stage, steps.length > 1 ? el("div", {class: "stepper"}, back, range, next, output) : null, caption);
}

function turnButtons(index) {
  const to = (i, name) => (CHAPTERS[i] ? el("button", {type: "button", onclick: () => goTo(i)}, el("small", {}, name), CHAPTERS[i].title) : null);
  return el("div", {class: "turn"}, to(index - 1, "Previous chapter"), to(index + 1, "Next chapter"));
}

function build(c, index) {
  const absent = c.absent ? c.absent() : null;
  const parts = [el("p", {class: "kicker"}, c.kicker), el("h2", {id: "title"}, c.title), el("p", {class: "lead", html: c.lead()})];
  if (absent) {
    parts.push(el("p", {class: "absent-note", html: absent}));
    c.stepCount = 1;
    c.showStep = () => {};
  } else {
    if (c.input) parts.push(el("div", {class: "flow"}, listOf("Input", c.input()), listOf("Output", c.output())));
    parts.push(stepsOf(c));
    for (const block of c.formula ? c.formula() : []) parts.push(el("div", {class: "formula", tabindex: 0, role: "math", "aria-label": "Formula with the numbers of this frame", html: block}));
    if (c.body) parts.push(...[c.body()].flat());
  }
  parts.push(...quotesOf(c.id), ...(absent ? [] : exercisesOf(c)), turnButtons(index));
  return el("article", {"aria-labelledby": "title", id: "chapter-" + c.id}, ...parts);
}

function goTo(index, step = 0, focus = true) {
  state.chapter = index;
  const main = document.getElementById("main"), c = CHAPTERS[index];
  main.replaceChildren(build(c, index));
  document.querySelectorAll("nav a").forEach((a, i) => (i === index ? a.setAttribute("aria-current", "page") : a.removeAttribute("aria-current")));
  if (location.hash !== "#" + c.id) history.replaceState(null, "", "#" + c.id);
  document.title = `${c.title} · Halfspace`;
  goToStep(step < 0 ? c.stepCount - 1 : step);
  if (!focus) return;
  scrollTo(0, 0);
  main.focus({preventScroll: true});
}

function goToStep(step) {
  state.step = step;
  CHAPTERS[state.chapter].showStep(step);
}

// Goes to the next or previous step, and beyond the ends to the next or previous chapter.
function move(by) {
  const step = state.step + by;
  if (step >= 0 && step < CHAPTERS[state.chapter].stepCount) return goToStep(step);
  const index = state.chapter + by;
  if (CHAPTERS[index]) goTo(index, by < 0 ? -1 : 0);
}

function onKey(e) {
  if (e.altKey || e.ctrlKey || e.metaKey || e.target.closest("[data-pick], input, textarea, select, pre, .formula, .table")) return;
  if (e.key === "ArrowRight") move(1);
  else if (e.key === "ArrowLeft") move(-1);
  else return;
  e.preventDefault();
}

function setTheme(theme) {
  document.documentElement.dataset.theme = theme;
  if (CHAPTERS[state.chapter].showStep) goToStep(state.step);
}

function startTheme() {
  const dark = matchMedia("(prefers-color-scheme: dark)");
  document.documentElement.dataset.theme = dark.matches ? "dark" : "light";
  dark.addEventListener("change", () => setTheme(dark.matches ? "dark" : "light"));
  document.getElementById("theme").addEventListener("click", () => setTheme(document.documentElement.dataset.theme === "dark" ? "light" : "dark"));
}

function startNavigation() {
  const list = document.getElementById("chapters"), contents = document.getElementById("contents");
  CHAPTERS.forEach((c, i) => {
    const open = (e) => { e.preventDefault(); if (narrow.matches) contents.open = false; goTo(i); };
    list.append(el("li", {}, el("a", {href: "#" + c.id, class: c.absent && c.absent() ? "absent" : null, onclick: open}, c.title)));
  });
  const narrow = matchMedia("(max-width: 900px)");
  const fold = () => { contents.open = !narrow.matches; };
  narrow.addEventListener("change", fold);
  narrowWindow.addEventListener("change", () => goToStep(state.step));
  fold();
  document.addEventListener("keydown", onKey);
  addEventListener("hashchange", () => goTo(indexOfHash()));
}

const indexOfHash = () => Math.max(0, CHAPTERS.findIndex((c) => "#" + c.id === location.hash));

async function start() {
  document.getElementById("scene-name").textContent = sceneName;
  startTheme();
  await unpackFrame();
  startNavigation();
  goTo(indexOfHash(), 0, false);
}
