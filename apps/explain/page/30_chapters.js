// Chapters: registration, steps and navigation.
//
// A chapter is {id, title, kicker, lead, input, output, steps, formula, body, exercises, absent, related, lessons}. Texts are HTML. steps: a list of
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

const listOf = (title, items) => el("div", {}, el("h4", {}, title), el("ul", {}, ...items.map((i) => el("li", {html: i}))));

// The figure with its stepper. show(n) draws step n.
function stepsOf(c) {
  const steps = c.steps();
  const stage = el("div", {class: "step"}), caption = el("figcaption", {"aria-live": "polite"});
  const range = el("input", {type: "range", min: 1, max: steps.length, value: 1, "aria-label": `Step of chapter “${c.title}”`, title: "Step of the chapter (keys ← and →)", oninput: () => goToStep(Number(range.value) - 1, "replace")});
  const output = el("output");
  const back = el("button", {type: "button", "aria-label": "Previous step", title: "Previous step (key ←)", onclick: () => move(-1)}, "←");
  const next = el("button", {type: "button", "aria-label": "Next step", title: "Next step (key →)", onclick: () => move(1)}, "→");
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

// The lessons in order: the first one is 01.md.
const LESSONS = ["A triangle", "Depth", "Perspective", "Rotation, view and look-at", "Projection, w and clipping", "The library", "Texture and mipmaps",
  "Flat, Gouraud and Phong shading", "Normal and bump maps", "Shadow map and bias", "Point-sprite spheres", "High dynamic range", "SIMD lanes",
  "Tiles and threads", "The geometry stage", "Tessellation", "Antialiasing", "Blending and order", "A model file", "Render to texture and bloom",
  "Cube map", "Deferred shading", "Instancing", "Your own renderer"];
// A link to a lesson if the page knows the address of the lessons (--lessons), otherwise its title.
function lessonLink(title) {
  const file = `${String(LESSONS.indexOf(title) + 1).padStart(2, "0")}.md`;
  return DATA.lessons === "" ? `“${title}”` : el("a", {href: `${DATA.lessons.replace(/\/$/, "")}/${file}`}, title);
}

// Links to related chapters, and the lessons that build the stage.
function relatedTo(c) {
  const chapters = (c.related || []).map((id) => CHAPTERS.find((other) => other.id === id));
  const links = chapters.flatMap((other, i) => [i > 0 ? ", " : null, el("a", {href: "#" + other.id, onclick: (e) => { e.preventDefault(); goTo(CHAPTERS.indexOf(other)); }}, other.title)]);
  const lessons = (c.lessons || []).flatMap((title, i) => [i > 0 ? " and " : null, lessonLink(title)]);
  return el("p", {class: "related"}, ...(links.length > 0 ? ["Related chapters: ", ...links, ". "] : []),
    ...(lessons.length > 0 ? [`Lessons that write this stage in C++${DATA.lessons === "" ? " (docs/tutorial/lessons)" : ""}: `, ...lessons, "."] : []));
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
  parts.push(...quotesOf(c.id), ...(absent ? [] : exercisesOf(c)), relatedTo(c), turnButtons(index));
  return el("article", {"aria-labelledby": "title", id: "chapter-" + c.id}, ...parts);
}

// The address of a chapter and step: "#depth" for the first step, "#depth/2" for the second.
const addressOf = (index, step) => `#${CHAPTERS[index].id}${step > 0 ? `/${step + 1}` : ""}`;

// Writes the address of the current step. how: "push" adds an entry for the Back button, "replace" does not, "keep" leaves the address.
function setAddress(how) {
  const address = addressOf(state.chapter, state.step);
  if (how === "keep" || location.hash === address) return;
  history[how === "push" ? "pushState" : "replaceState"](null, "", address);
}

// Returns the chapter and step of the address of the page. Unknown ones are the first.
function addressed() {
  const [id, step] = location.hash.slice(1).split("/"), index = CHAPTERS.findIndex((c) => c.id === id);
  return index < 0 ? [0, 0] : [index, Math.max(0, (Math.trunc(Number(step)) || 1) - 1)];
}

function goTo(index, step = 0, focus = true, how = "push") {
  state.chapter = index;
  const main = document.getElementById("main"), c = CHAPTERS[index];
  main.replaceChildren(build(c, index));
  document.querySelectorAll("nav a").forEach((a, i) => (i === index ? a.setAttribute("aria-current", "page") : a.removeAttribute("aria-current")));
  document.querySelector("nav [aria-current]").scrollIntoView({block: "nearest"});
  document.title = `${c.title} · Halfspace`;
  goToStep(step < 0 ? c.stepCount - 1 : Math.min(step, c.stepCount - 1), how);
  if (!focus) return;
  scrollTo(0, 0);
  main.focus({preventScroll: true});
}

function goToStep(step, how = "push") {
  state.step = step;
  drawStep(() => CHAPTERS[state.chapter].showStep(step));
  setAddress(how);
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
  if (CHAPTERS[state.chapter].showStep) goToStep(state.step, "keep");
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
    list.append(el("li", {}, el("a", {href: "#" + c.id, class: c.absent && c.absent() ? "absent" : null, onclick: open}, el("span", {}, c.title), el("small", {class: "done"}))));
  });
  const narrow = matchMedia("(max-width: 900px)");
  const fold = () => { contents.open = !narrow.matches; };
  narrow.addEventListener("change", fold);
  narrowWindow.addEventListener("change", () => goToStep(state.step, "keep"));
  fold();
  document.addEventListener("keydown", dropLateKey, true);
  document.addEventListener("keydown", onKey);
  const follow = () => { const [index, step] = addressed(); goTo(index, step, index !== state.chapter, "keep"); };
  addEventListener("popstate", follow);
  document.getElementById("print").addEventListener("click", printAll);
  addEventListener("beforeprint", showAll);
  addEventListener("afterprint", showOne);
  showProgress();
}

async function start() {
  document.getElementById("scene-name").textContent = sceneName;
  startTheme();
  await unpackFrame();
  startNavigation();
  goTo(...addressed(), false, "replace");
  setTimeout(prepareToPrint, 2000);  // for the print command of the browser, which does not wait
}
