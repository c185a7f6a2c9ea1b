#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Opens pages of `halfspace explain` in headless Chromium. Tests steps, exercises, the names of all controls and pictures, and narrow
windows, and that there are no errors.

  page_test.py PROGRAM [SCREENSHOTS]

Needs the Debian packages chromium, chromium-driver and python3-selenium. If a folder is given, a screenshot of every chapter is written to
it.
"""
import base64
import csv
import io
import json
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SKIPPED = 77  # ctest shows the test as skipped
try:
    from selenium import webdriver
    from selenium.common.exceptions import TimeoutException
    from selenium.webdriver.chrome.options import Options
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
    from selenium.webdriver.common.print_page_options import PrintOptions
    from selenium.webdriver.support.ui import WebDriverWait
except ImportError:
    if sys.executable != "/usr/bin/python3" and os.path.exists("/usr/bin/python3"):
        os.execv("/usr/bin/python3", ["/usr/bin/python3", *sys.argv])
    print("page_test.py: skipped: selenium is absent (Debian: python3-selenium)")
    sys.exit(SKIPPED)

CHROMIUM, DRIVER = shutil.which("chromium"), shutil.which("chromedriver")
PROGRAM = Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else None
SCREENSHOTS = Path(sys.argv[2]) if len(sys.argv) > 2 else None
# Scenes that together use every stage: clipped triangles, shadows, HDR, points, several samples, transparent layers. The last two lack ideas:
# one has no perspective, no light, no shadow and no texture, and the other shows nothing at all.
SCENES = {"pipeline": ["pipeline"], "earth": ["earth"], "day-night": ["day-night", "--camera", "street"], "particles": ["particles"],
          "knot": ["shadow-knot", "--set", "samples=4"], "box": ["box.obj"], "panes": ["panes.json"],
          "flat": ["flat.json"], "empty": ["flat.json", "--set", "plane.visible=false"]}
LONG = "HALFSPACE_LONG_TESTS" in os.environ  # set by scripts/test_full.sh
TOURED = list(SCENES) if LONG else ["pipeline", "particles", "flat", "empty"]
HELMET = Path(__file__).resolve().parents[2].parent / "shared/data/gltf/DamagedHelmet/glTF-Binary/DamagedHelmet.glb"
# Twenty-four squares, one behind the other and drawn from back to front, with two samples per pixel.
PANES = {"version": 1, "samples": 2, "cameras": {"c": {"position": [0, 0, 6], "target": [0, 0, 0]}}, "lights": {"sun": {}},
         "objects": {f"pane{i}": {"shape": "plane", "size": 2, "rotation": [90, 0, 0], "position": [0, 0, 0.25 * i - 6], "color": [0.04 * i, 0.5, 0.5]}
                     for i in range(24)}}
FLAT = {"version": 1, "cameras": {"c": {"type": "orthographic", "position": [0, 0, 6], "target": [0, 0, 0], "height": 3}},
        "objects": {"plane": {"shape": "plane", "size": 2, "rotation": [90, 0, 0], "position": [0.13, 0.07, 0], "shading": "none", "color": [0.2, 0.4, 0.1]}}}
# A floor that begins behind the eye: both of its triangles are clipped.
FLOOR = {"version": 1, "cameras": {"c": {"position": [0.7, 1, 0], "target": [0.2, 0.6, -4]}}, "lights": {"sun": {}},
         "objects": {"floor": {"shape": "plane", "size": 40, "color": [0.5, 0.5, 0.5]}}}
BOX = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"


def browser():
    options = Options()
    options.binary_location = CHROMIUM
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--window-size=1200,900"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(options=options, service=Service(DRIVER))


def set_metrics(driver, width):
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": False})


def set_window(driver, width, dark=False):
    set_metrics(driver, width)
    features = [{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}]
    driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": features})


# Calls look(chapter, step) for every step of every chapter, and returns the results.
TOUR = """
const done = arguments[arguments.length - 1], look = LOOK, results = [];
const pause = async () => { do await new Promise((resolve) => setTimeout(() => requestAnimationFrame(resolve), 25)); while (drawing.isBusy); };
(async () => {
  for (let chapter = 0; chapter < CHAPTERS.length; ++chapter) {
    for (let step = 0; step === 0 || step < CHAPTERS[chapter].stepCount; ++step) {
      if (step === 0) goTo(chapter); else goToStep(step);
      await pause();
      results.push([CHAPTERS[chapter].id, step + 1, look()]);
    }
  }
  done(results);
})();
"""
# Returns the controls and pictures without a name that a screen reader could announce.
NAMELESS = """() => [...document.querySelectorAll('button, input, select, a, summary, canvas, img, svg, [tabindex="0"]')].filter((e) => {
  if (e.closest('[aria-hidden=true]')) return false;
  const name = e.getAttribute('aria-label') || e.getAttribute('alt') || e.textContent.trim();
  const isPicture = ['CANVAS', 'svg'].includes(e.tagName);
  return !name || (isPicture && (e.getAttribute('role') !== 'img' || !e.getAttribute('aria-label')));
}).map((e) => e.outerHTML.slice(0, 120))"""
# Returns a text that changes if the picture of the step changes; null if the chapter is absent.
PICTURE = """() => {
  if (document.querySelector('.absent-note')) return null;
  const text = [...document.querySelectorAll('figure .step canvas')].map((c) => c.toDataURL()).join() + document.querySelector('figure .step').innerHTML;
  let hash = 0;
  for (let i = 0; i < text.length; ++i) hash = (Math.imul(hash, 31) + text.charCodeAt(i)) | 0;
  return `${text.length} ${hash}`;
}"""
# Returns the number of exercises, and those that reject their own answer, have none, or accept a wrong one. For an absent chapter, returns
# its note.
EXERCISES = """() => {
  const c = CHAPTERS[state.chapter], note = document.querySelector('.absent-note');
  if (note) return {note: note.textContent};
  const all = c.exercises ? c.exercises() : [], text = (x) => roundedAnswer(x), shown = document.querySelector('article').cloneNode(true);
  shown.querySelectorAll('.exercise, details.quote, .verdict').forEach((e) => e.remove());
  const printed = new Set(shown.textContent.replace(/(\\d)\\u00a0(?=\\d)/g, '$1').replaceAll('−', '-').match(/-?\\d+(\\.\\d+)?/g) || []);
  // Short numbers are found in any text, also by chance, so only answers of four digits, or of three with a decimal point, are looked for.
  const isPrinted = (x) => typeof x.answer === 'number' && text(x).replace(/\\D/g, '').replace(/^0+/, '').length >= (text(x).includes('.') ? 3 : 4) && printed.has(text(x));
  return {count: document.querySelectorAll('.exercise').length, printed: all.filter(isPrinted).map((x) => x.ask + ' ' + text(x)),
          bad: all.filter((x) => !isRight(x, text(x)) || !isRight(x, text(x).replace('.', ',')) || isRight(x, '-12345.5') || isRight(x, '')).map((x) => x.ask + ' ' + text(x))};
}"""
# Returns the controls that only have a symbol or no text at all, and lack a title.
UNTITLED = """() => [...document.querySelectorAll('button, input')].filter((e) => e.type !== 'text' && !/\\p{L}/u.test(e.textContent) && !/\\p{L}{3}/u.test(e.title))
  .map((e) => e.outerHTML.slice(0, 120))"""
# Returns the caption of a step and the pixels that have a ring in its pictures: [pixel as in captions, is it the example, color of the ring].
RINGS = """() => [document.querySelector('figcaption') ? document.querySelector('figcaption').textContent : '', [...document.querySelectorAll('figure canvas[data-ring]')].map((c) => {
  const pixel = c.dataset.ring.split(',').map(Number), [x, y] = pixel.map((v) => (v + 0.5) * c.width / W);
  return [px(pixel), pixel.join() === PIXEL.join(), c.width === 2 * W && x > 12 ? [...c.getContext('2d').getImageData(Math.round(x - 9), Math.round(y), 1, 1).data] : null]; })]"""
# Words of which the caption of a step has to contain all, because its figure shows them with colors, sizes or positions.
CAPTIONS = {
    ("frame", 1): "displayed", ("frame", 2): "one color per", ("frame", 3): "items", ("spaces", 1): "fainter filled axes", ("spaces", 2): "fainter filled volume",
    ("spaces", 6): "fainter filled faded", ("geometry", 1): "filled numbered", ("geometry", 2): "thick outline", ("geometry", 3): "bars highlighted",
    ("clipping", 1): "gray right upward", ("clipping", 2): "colored dots new", ("culling", 1): "bars highlighted", ("culling", 2): "outlines",
    ("setup", 1): "colored gray", ("setup", 2): "highlighted arrow", ("binning", 1): "lines", ("binning", 2): "dark bright number", ("binning", 3): "colored",
    ("coverage", 1): "strongly faintly gray empty", ("coverage", 2): "thick colored", ("coverage", 3): "colored gray outlined", ("coverage", 4): "colored gray",
    ("depth", 1): "dark bright logarithmic", ("depth", 2): "dark block", ("depth", 3): "bright block", ("stepping", 1): "first second third panel frame",
    ("interpolation", 1): "squares", ("interpolation", 2): "dark bright", ("varyings", 1): "red green blue", ("varyings", 2): "red green blue",
    ("mips", 1): "dark bright", ("lighting", 1): "luminance displayed", ("shadows", 1): "bright black", ("shadows", 3): "gray numbers percent dot",
    ("tone", 1): "bar left right", ("tone", 2): "right up dots", ("srgb", 1): "right up gray dots", ("srgb", 2): "above below", ("samples", 1): "dots",
    ("samples", 2): "color outlined", ("samples", 3): "gray dots", ("overdraw", 1): "dark bright", ("overdraw", 2): "bar", ("times", 1): "dark bright",
    ("times", 2): "dot right up", ("results", 1): "tries"}
# Parts of the quotes of each chapter with several of them, in the order of the renderer's steps.
QUOTES = {
    "spaces": ["clip_from_object", "window_vertex("], "setup": ["at(int64_t x", "z_edge2"], "binning": ["maximum of E", "put_row("],
    "coverage": ["BlockCoverage block_coverage(", "lanes_at", "is_top_left("], "depth": ["CompareOp::greater", "z_edge1"],
    "mips": ["squared_scale_factor(", "level_of_detail(", "size2"], "lighting": ["sum.specular", "reflected("],
    "shadows": ["automatic_depth_offset(", "nearest", "box_pcf("], "layers": ["::add(", "::write("], "history": ["::add(", "::set_shaded("],
    "overdraw": ["CompareOp::greater", "FrameTrace::count("]}
# Lays out the printed page in columns of the size of a page of A4 without its margins, which the browser breaks like pages. Returns the number
# of columns, what is cut, headings that are separated from what follows, and the filled part of each column but the last.
PAGES = """const main = document.getElementById('main'), W_MM = 178, H_MM = 265, gap = 100;
Object.assign(main.style, {width: `${W_MM}mm`, height: `${H_MM}mm`, columnWidth: `${W_MM}mm`, columnGap: `${gap}px`, columnFill: 'auto', margin: 0, overflow: 'visible'});
const box = main.getBoundingClientRect(), of = (r) => Math.floor((r.left - box.left + 1) / (box.width + gap));
const isShown = (e) => e.checkVisibility() && e.getBoundingClientRect().height > 0;
const rects = (e) => [e, ...e.querySelectorAll(':not(svg *)')].flatMap((d) => [...d.getClientRects()]).filter((r) => r.width > 0 && r.height > 0);
const columns = (e) => [...new Set(rects(e).map(of))].sort((a, b) => a - b), name = (e) => `${e.closest('article').querySelector('h2').textContent}: ${e.tagName} ${e.className} ${e.textContent.slice(0, 60)}`;
const all = (selector) => [...main.querySelectorAll(selector)].filter(isShown);
const cut = all('.head, figure:not(:has(.results)), figcaption, .table:not(.fragments *, .results ~ *), tr, .blank, .formula:not(.long), summary').filter((e) => rects(e).length > 0 && columns(e).length > 1);
const next = (e) => { for (let n = e.nextElementSibling; n; n = n.nextElementSibling) if (isShown(n)) return n; return null; };
const alone = all('h2, h3').filter((h) => next(h) === null || columns(next(h))[0] !== columns(h)[0]);
const bottoms = [];
for (const r of all('article > *').flatMap(rects)) bottoms[of(r)] = Math.max(bottoms[of(r)] || 0, (r.bottom - box.top) / box.height);
return {columns: bottoms.length, cut: cut.map(name), alone: alone.map(name), filled: [...bottoms].slice(0, -1).map((b) => b || 0), long: all('.formula.long').length};"""
# Returns the number of pixels with a sample that one of the triangles covers.
COUNT_OF_PIXELS = """(pieces) => {
  const pixels = new Set();
  for (const t of pieces) for (let y = t.box[1]; y < t.box[3]; ++y) for (let x = t.box[0]; x < t.box[2]; ++x) if (covered(t, x, y)) pixels.add(y * W + x);
  return pixels.size;
}"""
WIDTH = "document.documentElement.scrollWidth"
SMALLEST_FONT = """Math.min(99, ...[...document.querySelectorAll('figure svg text')].map((t) => {
  const svg = t.closest('svg'); return parseFloat(t.getAttribute('font-size')) * svg.getBoundingClientRect().width / svg.viewBox.baseVal.width; }))"""


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.driver = browser()
        cls.driver.set_script_timeout(120)
        cls.pages = {}
        (Path(cls.folder.name) / "box.obj").write_text(BOX)
        (Path(cls.folder.name) / "panes.json").write_text(json.dumps(PANES))
        (Path(cls.folder.name) / "flat.json").write_text(json.dumps(FLAT))
        for name, arguments in SCENES.items():
            page = Path(cls.folder.name) / f"{name}.html"
            subprocess.run([PROGRAM, "explain", *arguments, "--size", "320x180", "-o", page], check=True, cwd=cls.folder.name)
            cls.pages[name] = page

    @classmethod
    def tearDownClass(cls):
        cls.driver.quit()
        cls.folder.cleanup()

    def open(self, name, chapter="", width=1200, dark=False):
        set_window(self.driver, width, dark)
        self.driver.get("about:blank")
        self.driver.get(f"file://{self.pages[name]}#{chapter}")
        WebDriverWait(self.driver, 30).until(lambda d: d.execute_script("return document.querySelector('article') !== null"))

    def run_script(self, text):
        return self.driver.execute_script(text)

    def chapters(self):
        return self.run_script("return CHAPTERS.map((c) => c.id)")

    def go_to(self, index, step=0):
        self.run_script(f"goTo({index}, {step})")
        self.wait_for_pictures()

    def wait_for_pictures(self):
        self.driver.execute_async_script("const done = arguments[0]; setTimeout(() => requestAnimationFrame(done), 60)")

    def errors(self):
        return [entry["message"] for entry in self.driver.get_log("browser") if entry["level"] == "SEVERE"]

    def tour(self, look):
        return self.driver.execute_async_script(TOUR.replace("LOOK", look))

    def test_every_step_of_every_chapter(self):
        for name in TOURED:
            self.open(name)
            seen = {}
            for chapter, step, look in self.tour(f"() => [({PICTURE})(), ({NAMELESS})(), ({EXERCISES})(), ({RINGS})(), ({UNTITLED})()]"):
                picture, nameless, exercises, (caption, rings), untitled = look
                where = f"{name}, {chapter}, step {step}"
                self.assertEqual(nameless, [], f"{where}: a control or picture has no name")
                self.assertEqual(untitled, [], f"{where}: a control with a symbol has no title")
                self.check_rings(where, caption, rings)
                if "note" in exercises:
                    self.assertIn("halfspace explain", exercises["note"], where)
                    continue
                self.assertEqual(exercises, {"count": 0 if chapter == "results" else 3, "printed": [], "bad": []}, where)
                self.assertNotIn(picture, seen.setdefault(chapter, []), f"{where} shows what was shown before")
                seen[chapter].append(picture)
            self.assertEqual(self.errors(), [], name)

    def check_rings(self, where, caption, rings):
        """A caption mentions a ring if there is one, and names its pixel if that is not the example."""
        for pixel, is_example, color in rings:
            self.assertIn("ring marks" if is_example else f"pixel {pixel}", caption, where)
            self.assertIn(color, (None, [255, 255, 255, 255]), f"{where}: the ring is white")
        if not rings and not re.search(r", (history), ", where):
            self.assertNotIn("ring marks", caption, where)

    def test_a_ring_on_another_pixel_is_explained(self):
        self.open("pipeline")
        for chapter, step, data in (("mips", 1, "MIP.at"), ("layers", 1, "LAYERS.pixel"), ("shadows", 1, "SHADOW.pixel"), ("shadows", 2, "SHADOW.pixel")):
            own = self.run_script(f"return {data}")
            self.run_script(f"{data} = [W - 20, 7]; goTo(CHAPTERS.findIndex((c) => c.id === '{chapter}'), {step - 1})")
            WebDriverWait(self.driver, 10).until(lambda d: d.execute_script("return !drawing.isBusy"))
            caption, rings = self.run_script(f"return ({RINGS})()")
            self.assertEqual([(pixel, is_example) for pixel, is_example, _ in rings], [("(300, 7) [300, 172]", False)], chapter)
            self.check_rings(chapter, caption, rings)
            self.run_script(f"{data} = {json.dumps(own)}")

    def test_captions_say_what_is_shown(self):
        self.open("pipeline")
        found = set()
        for chapter, step, (caption, _) in self.tour(RINGS):
            name, text = caption.split(". ", 1)
            self.assertGreater(len(text), 60, f"{chapter}, step {step}: {caption}")
            for word in CAPTIONS.get((chapter, step), "").split():
                self.assertIn(word, caption.lower(), f"{chapter}, step {step}")
            found.add((chapter, step))
        self.assertEqual(set(CAPTIONS) - found, set())

    def test_quotes_are_in_the_order_of_the_steps(self):
        self.open("earth")
        quotes = {chapter: list_of for chapter, list_of in self.run_script("return DATA.quotes").items() if len(list_of) > 1}
        self.assertEqual(set(quotes), set(QUOTES))
        for chapter, parts in QUOTES.items():
            self.assertEqual([part for part, quote in zip(parts, quotes[chapter]) if part not in quote["text"]], [], chapter)
            self.assertEqual(len(quotes[chapter]), len(parts), chapter)

    def test_no_answer_of_pipeline_is_trivial(self):
        """No answer is 0, 1 or all. Answers about times are left out: they differ from run to run."""
        self.pages["default"] = Path(self.folder.name) / "default.html"
        subprocess.run([PROGRAM, "explain", "pipeline", "-o", self.pages["default"]], check=True, cwd=self.folder.name)
        for name in ("default", "pipeline"):
            self.open(name)
            for chapter, number, ask, text in self.run_script("return CHAPTERS.flatMap((c) => (c.exercises ? c.exercises() : []).map((x, i) => [c.id, i + 1, plainText(x.ask), roundedAnswer(x)]))"):
                if chapter == "times" or not re.fullmatch(r"-?[\d.e+-]+", text):
                    continue  # a time, or a name
                self.assertNotIn(float(text), (0, 1), f"{name}, {chapter} {number}: {ask}")
                if "percentage" in ask:
                    self.assertLess(float(text), 100, f"{name}, {chapter} {number}: {ask}")

    def test_repetitions_of_a_held_key_do_not_queue(self):
        """Repetitions are ignored from the beginning of a drawing until it is painted, also those that are delivered later."""
        self.open("pipeline", "lighting")
        self.wait_for_pictures()
        steps = self.driver.execute_async_script("""const done = arguments[0], steps = [], note = () => steps.push(state.step);
            const key = (repeat) => new KeyboardEvent('keydown', {key: 'ArrowRight', repeat, bubbles: true, cancelable: true}), press = (e) => document.body.dispatchEvent(e);
            const ready = async () => { while (drawing.isBusy) await new Promise((next) => setTimeout(next, 5)); };
            (async () => {
              await ready();
              note();
              press(key(false));
              const late = key(true);
              for (let i = 0; i < 5; ++i) press(key(true));
              note();
              await ready();
              await new Promise((next) => setTimeout(next, 20));
              press(late);
              note();
              press(key(true));
              note();
              press(key(false));  // pressed again, while the step is drawn
              note();
              done(steps);
            })()""")
        self.assertEqual(steps, [0, 1, 1, 2, 3])
        slider = self.run_script("""const range = document.querySelector('.stepper input'), e = new KeyboardEvent('keydown', {key: 'ArrowRight', repeat: true, bubbles: true, cancelable: true});
            goToStep(0); range.dispatchEvent(e); return e.defaultPrevented""")
        self.assertTrue(slider, "the slider gets no repetition while its step is drawn")

    def test_weights_of_the_shadow_lookup_give_its_factor(self):
        scenes = {"pipeline": "pcf5", "day-night": "pcf3"}
        for method in ("hard", "bilinear", "vogel", "vsm", "pcss"):
            scenes[f"knot-{method}"] = method
            self.pages[f"knot-{method}"] = Path(self.folder.name) / f"knot-{method}.html"
            subprocess.run([PROGRAM, "explain", "shadow-knot", "--size", "96x54", "--set", f"shadow.method={method}", "-o", self.pages[f"knot-{method}"]], check=True, cwd=self.folder.name)
        for name, method in scenes.items():
            text = self.caption(name, "shadows", 3)
            filter_name, look = self.run_script("return [SHADOW.filter, LOOK]")
            self.assertEqual(filter_name, method)
            self.assertAlmostEqual(look["filtered"] * look["terminator"], look["factor"], 6, name)
            if method in ("vsm", "pcss"):
                self.assertIsNone(look["weights"], name)
                self.assertIn("exels have no", text, name)
                self.assertNotIn("sum of the rows", text, name)
                continue
            weights, lit = look["weights"], look["lit"]
            self.assertAlmostEqual(sum(weights), 1, 5, name)
            self.assertAlmostEqual(sum(w * l for w, l in zip(weights, lit)) * look["terminator"], look["factor"], 5, name)
            # The formula: the rows add up to the sum, and the sum is the factor.
            formula = self.run_script("return [...document.querySelectorAll('.formula')].pop().textContent")
            rows = re.findall(r"(?m)row \d+ (.*)  = (\d\.\d{5})$", formula)
            total = float(re.search(r"sum of the rows = ([\d.e−]+)", formula).group(1).replace("e−", "e-"))
            for cells, row in rows:
                shown = [float(v) for v in re.findall(r"(?<![(\d.])\d\.\d{5}", cells)]
                self.assertAlmostEqual(sum(shown), float(row), delta=1e-5 * (len(shown) + 1), msg=name)
            self.assertAlmostEqual(sum(float(row) for _, row in rows), total, delta=1e-5 * (len(rows) + 1), msg=name)
            self.assertEqual(len(re.findall(r"\d\.\d{5}", " ".join(cells for cells, _ in rows))), sum(w > 0 for w in weights), name)
            self.assertEqual(formula.count("("), sum(w > 0 and l == 0 for w, l in zip(weights, lit)), name)
            self.assertAlmostEqual(total * look["terminator"], look["factor"], 5, name)
            # The picture: a number in each texel with a weight. Rounded to two digits, they add up to about 100 %.
            numbers = self.run_script("return [...document.querySelectorAll('figure svg text')].map((t) => t.textContent)")
            self.assertEqual(len(numbers), sum(w > 0 for w in weights), name)
            self.assertAlmostEqual(sum(float(n.replace("<", "")) for n in numbers), 100, delta=2, msg=name)
            self.driver.find_element(By.CSS_SELECTOR, "figure svg").send_keys(Keys.ARROW_RIGHT)
            self.assertRegex(self.driver.find_element(By.CLASS_NAME, "readout").text, r"depth .*(Weight · lit = \S+ · [01] = |gives it no weight)", name)
        partial = {name: self.factor_of(name) for name in ("pipeline", "day-night", "knot-bilinear")}
        self.assertTrue(any(0 < factor < 1 for factor in partial.values()), partial)

    def factor_of(self, name):
        self.open(name, "shadows")
        return self.run_script("return LOOK.factor")

    def test_steps_fit_and_are_readable_on_a_phone(self):
        for name in SCENES if LONG else ["day-night"]:
            self.open(name, width=390)
            for chapter, step, (width, font) in self.tour(f"() => [{WIDTH}, {SMALLEST_FONT}]"):
                self.assertLessEqual(width, 390, f"{name}, {chapter}, step {step}")
                self.assertGreaterEqual(font, 10, f"{name}, {chapter}, step {step}: font size in pixels")

    def test_answers_can_be_typed(self):
        self.open("earth", "frame")
        form = self.driver.find_element(By.CSS_SELECTOR, ".exercise form")
        for text, expected in (("230 400", "right"), ("230401", "wrong")):
            field = form.find_element(By.TAG_NAME, "input")
            field.clear()
            field.send_keys(text + Keys.ENTER)
            self.assertIn(expected, form.find_element(By.CLASS_NAME, "verdict").get_attribute("class"), text)

    def test_arrow_keys_and_slider_change_the_step(self):
        self.open("earth", "spaces")
        body = self.driver.find_element(By.TAG_NAME, "body")
        self.assertEqual(self.run_script("return state.step"), 0)
        body.send_keys(Keys.ARROW_RIGHT)
        self.assertEqual(self.run_script("return state.step"), 1)
        slider = self.driver.find_element(By.CSS_SELECTOR, ".stepper input[type=range]")
        slider.send_keys(Keys.ARROW_RIGHT)
        self.assertEqual(self.run_script("return state.step"), 2)
        self.run_script("document.activeElement.blur()")
        for _ in range(3):
            body.send_keys(Keys.ARROW_LEFT)
        self.assertEqual(self.run_script("return [CHAPTERS[state.chapter].id, state.step]"), ["frame", 2])

    def test_the_values_of_each_page_agree(self):
        absent = {}
        for name in SCENES:
            self.open(name, "history")
            absent[name] = set(self.run_script("return CHAPTERS.filter((c) => c.absent && c.absent()).map((c) => c.id)"))
            for check in (self.check_coverage, self.check_setup_depth, self.check_final_pixel, self.check_luminance_bar,
                          self.check_shown_numbers, self.check_values_of_json):
                with self.subTest(check.__name__, scene=name):
                    check(name)
        for scenes in (SCENES, TOURED):
            self.assertEqual(set.intersection(*(absent[name] for name in scenes)), set(), f"no page of {list(scenes)} shows these chapters")

    def caption(self, name, chapter, step=1):
        self.open(name, f"{chapter}/{step}")
        return self.run_script("return document.querySelector('article').textContent")

    def test_sentences_follow_from_the_frame(self):
        """What a frame does not have is not claimed: the text of scenes without perspective, light, shadow and texture, or with nothing."""
        text = self.caption("flat", "interpolation")
        self.assertIn("A constructed triangle that is not part of this frame, because in this frame the projection is orthographic", text)
        self.assertNotIn("distant ones smaller", self.caption("flat", "spaces", 5))
        self.assertNotIn("relief", self.caption("flat", "varyings", 2))
        self.assertIn("No opaque surface of this frame has a color map", self.caption("flat", "varyings", 5))
        self.assertIn("No light of this frame casts shadows", self.caption("flat", "shadows"))
        self.assertIn("No pixel of this frame reaches 1", self.caption("flat", "tone"))
        self.assertEqual(self.run_script("return TIMES.includes(0)"), "filled at once and were not timed" in self.caption("flat", "times"))
        text = self.caption("earth", "interpolation")
        self.assertRegex(text, r"A constructed triangle .* affine interpolation displaces a value by at most 0\.\d+ pixels")
        self.assertIn("of this page", self.caption("pipeline", "interpolation"), "the example shows the interpolation itself")
        for name in ("flat", "pipeline"):
            text = self.caption(name, "setup")
            dots, others, share, outside = self.run_script("""const x = CHAPTERS.find((c) => c.id === 'final').exercises()[2], svg = document.querySelector('figure svg'), box = svg.viewBox.baseVal;
                const isOutside = (b) => b.x < 0 || b.y < 0 || b.x + b.width > box.width || b.y + b.height > box.height;
                return [svg.querySelectorAll('circle').length - 3, x.why.includes('the others'), x.answer, [...svg.querySelectorAll('text')].filter((t) => isOutside(t.getBBox())).length]""")
            self.assertEqual("The dots are" in text, dots > 0, name)
            self.assertEqual(others, share < 100, name)
            self.assertEqual(outside, 0, f"{name}: labels that are cut off")
        text = self.caption("pipeline", "clipping")
        self.assertIn("It is cut at the near plane.", text, "such triangles come first")
        table, light = self.run_script("return [DATA.choice.shadow, LIGHTING.lights.find((l) => l.name === SHADOW.light).shadow]")
        self.assertAlmostEqual(table, light, 3, "the table of the example, and the chapter on light")
        self.assertIn("relief from the maps of globe", self.caption("pipeline", "varyings", 2))
        self.assertIn("Nothing is drawn in this frame", self.caption("empty", "frame"))
        self.assertEqual(self.run_script("return CHAPTERS.filter((c) => c.id === 'spaces' && !c.absent()).length"), 0)

    def test_pipeline_has_no_empty_chapter(self):
        self.open("pipeline")
        self.assertEqual(self.run_script("return CHAPTERS.filter((c) => c.absent && c.absent()).map((c) => c.id)"), [])

    def test_addresses_and_the_back_button(self):
        self.open("earth", "spaces/3")
        where = "return [CHAPTERS[state.chapter].id, state.step, location.hash]"
        self.assertEqual(self.run_script(where), ["spaces", 2, "#spaces/3"])
        self.open("earth", "nosuch/9")
        self.assertEqual(self.run_script("return [state.chapter, state.step]"), [0, 0], "an unknown chapter")
        self.open("earth", "spaces/3")
        self.run_script("move(1)")
        self.run_script("goTo(CHAPTERS.findIndex((c) => c.id === 'depth'))")
        self.assertEqual(self.run_script(where), ["depth", 0, "#depth"])
        for expected in (["spaces", 3, "#spaces/4"], ["spaces", 2, "#spaces/3"]):
            self.driver.back()
            WebDriverWait(self.driver, 10).until(lambda d: d.execute_script(where) == expected)

    def test_numbers_are_read_with_both_separators(self):
        self.open("earth")
        x = "{answer: 1234.565, decimals: 2}"
        for exercise, text, right in ((x, "1234.57", True), (x, "1234,56", True), (x, "1,234.57", True), (x, "1.234,57", True), (x, "1 234,565", True),
                                      (x, "1234.55", False), (x, "1235", False), ("{answer: 0.5, decimals: 1}", "0,5", True),
                                      ("{answer: 57600}", "57,600", True), ("{answer: 57600}", "57.600", True), ("{answer: 57600}", "57601", False),
                                      ("{answer: -0.001234, significant: 2}", "−0,0012", True), ("{answer: -0.001234, significant: 2}", "-0.0013", False),
                                      ("{answer: 3}", "", False), ("{answer: 3}", "three", False),
                                      ("{answer: 82}", "82 %", True), ("{answer: 82}", "82%", True), ("{answer: 82}", "82 pixels", True), ("{answer: 82}", "83 %", False),
                                      ("{answer: 'diffuse, sun'}", "“diffuse, sun”", True), ("{answer: 'diffuse, sun'}", "'Diffuse (sun)'", True),
                                      ("{answer: 'diffuse, sun'}", "diffuse, moon", False)):
            self.assertEqual(self.run_script(f"return isRight({exercise}, arguments[0])".replace("arguments[0]", json.dumps(text))), right, (exercise, text))

    def exercise_form(self, index=0):
        return self.driver.find_elements(By.CSS_SELECTOR, ".exercise form")[index]

    def test_an_answer_is_revealed_after_a_try_and_kept(self):
        self.open("earth", "frame")
        form = self.exercise_form(1)
        self.assertFalse(form.find_elements(By.TAG_NAME, "button")[1].is_enabled(), "predict first")
        form.find_element(By.TAG_NAME, "input").send_keys("=1+1" + Keys.ENTER)
        self.assertEqual(form.find_element(By.CLASS_NAME, "verdict").text, "This is not a number.")
        self.assertFalse(form.find_elements(By.TAG_NAME, "button")[1].is_enabled(), "this was not a try")
        form.find_element(By.TAG_NAME, "input").clear()
        form.find_element(By.TAG_NAME, "input").send_keys("-1" + Keys.ENTER)
        form.find_elements(By.TAG_NAME, "button")[1].click()
        self.assertIn(self.run_script("return roundedAnswer(CHAPTERS[0].exercises()[1])"), form.find_element(By.CLASS_NAME, "verdict").text)
        for text in ("230.400", "230401"):  # the right answer is kept
            self.exercise_form().find_element(By.TAG_NAME, "input").clear()
            self.exercise_form().find_element(By.TAG_NAME, "input").send_keys(text + Keys.ENTER)
        self.open("earth", "frame")
        self.assertIn("Solved", self.exercise_form().find_element(By.CLASS_NAME, "verdict").text)
        self.assertEqual(self.driver.find_element(By.CSS_SELECTOR, "nav .done").text, "1/3")
        self.assertEqual(self.run_script("return resultsName()"), "earth-results.csv")
        self.run_script("progress.student = 'Zoë, \\u0022Z\\u0022'")
        self.assertEqual(self.run_script("return resultsName()"), "earth-Zoë_Z_-results.csv")
        rows = list(csv.DictReader(io.StringIO(self.run_script("return resultsAsCsv()").lstrip("\ufeff"), newline="")))
        self.assertEqual(len(rows), self.run_script("return CHAPTERS.reduce((n, c) => n + countOf(c), 0)"))
        self.assertEqual([rows[0][k] for k in ("student", "chapter", "given", "expected", "right", "tries", "revealed")],
                         ['Zoë, "Z"', "One frame", "230.400", "230400", "yes", "2", "no"])
        self.assertEqual([rows[1][k] for k in ("given", "right", "tries", "revealed")], ["-1", "no", "1", "yes"])
        self.assertEqual(self.run_script("return csvCell('=1+1')"), "'=1+1", "no cell is a formula")
        self.run_script("localStorage.clear()")

    def test_the_page_works_if_storage_is_refused(self):
        script = "Object.defineProperty(window, 'localStorage', {get() { throw new DOMException('denied', 'SecurityError'); }})"
        added = self.driver.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": script})
        try:
            self.open("earth", "frame")
            self.exercise_form().find_element(By.TAG_NAME, "input").send_keys("230400" + Keys.ENTER)
            self.assertIn("right", self.exercise_form().find_element(By.CLASS_NAME, "verdict").get_attribute("class"))
            self.run_script("goTo(CHAPTERS.findIndex((c) => c.id === 'results'))")
            self.assertIn("refuses to store", self.driver.find_element(By.TAG_NAME, "article").text)
            self.assertEqual(self.errors(), [])
        finally:
            self.driver.execute_cdp_cmd("Page.removeScriptToEvaluateOnNewDocument", added)

    def test_the_loupe_shows_the_pixel_under_the_pointer(self):
        self.open("earth", "final")
        canvas = self.driver.find_element(By.CSS_SELECTOR, "figure canvas")
        ActionChains(self.driver).move_to_element(canvas).perform()
        shown, expected = self.run_script("""const lens = document.querySelector('.loupe canvas'), [, x, y] = document.querySelector('.readout').textContent.match(/\\((\\d+), (\\d+)\\)/).map(Number);
            const copy = document.createElement('canvas'); copy.width = W; copy.height = H;
            copy.getContext('2d').drawImage(IMAGES.get(DATA.pictures.final), 0, 0);
            const color = (c, i, j) => [...c.getContext('2d').getImageData(i, j, 1, 1).data];
            return [[document.querySelector('.loupe').hidden, color(lens, 72, 72), color(lens, 72 + 16 * 4, 72)], [false, color(copy, x, y), color(copy, x + 4, y)]]""")
        self.assertEqual(shown, expected)

    # Tries again, because the browser gives up after 10 s, which is too short next to other tests.
    def printed_page(self, options=None):
        for _ in range(4):
            try:
                return self.driver.print_page(options)
            except TimeoutException:
                pass
        return self.driver.print_page(options)

    def test_printed_pages_are_full_and_cut_nothing(self):
        """Figures, tables, exercises and the beginnings of chapters are whole, no heading is separated from what follows, and no page is
        nearly empty: what follows did not fit, and nothing that is kept together is taller than half a page."""
        a4 = PrintOptions()
        a4.page_width, a4.page_height = 21.0, 29.7
        for name in ("pipeline", "empty"):
            self.open(name)
            show = "const done = arguments[0]; window.print = () => {}; printAll().then(done)"
            self.driver.execute_async_script(show)
            count = len(re.findall(rb"/Type\s*/Page\b(?!s)", base64.b64decode(self.printed_page(a4))))
            try:
                self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
                set_metrics(self.driver, 673)  # 178 mm
                self.driver.execute_async_script(show)  # again, because the page was shown on the screen after it was printed
                pages = self.run_script(PAGES)
            finally:
                self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})
            self.assertEqual([pages["cut"], pages["alone"]], [[], []], name)
            self.assertGreater(min(pages["filled"]), 0.5, f"{name}: {pages['filled']}")
            self.assertLessEqual(abs(pages["columns"] - count), 1, f"{name}: {count} pages")
            self.assertLess(count, len(self.chapters()) * 3, name)
            self.run_script("showOne()")

    def test_long_formulas_may_break(self):
        self.open("pipeline", "lighting")
        classes = self.run_script("""const c = CHAPTERS[state.chapter], own = c.formula;
            c.formula = () => [Array(25).fill('x = 1').join('\\n'), Array(24).fill('x = 1').join('\\n'), 'x'.repeat(70 * 25)];
            const shown = [...printed(c).querySelectorAll('.formula')].map((f) => f.className);
            c.formula = own;
            return shown""")
        self.assertEqual(classes, ["formula long", "formula", "formula long"])

    def test_the_whole_page_can_be_printed(self):
        self.open("pipeline", "depth/2")
        self.driver.execute_async_script("const done = arguments[0]; window.print = () => {}; printAll().then(done)")
        figures, steps, articles = self.run_script("""return [document.querySelectorAll('figure').length, CHAPTERS.reduce((n, c) => n + c.steps().length, 0), document.querySelectorAll('article').length]""")
        self.assertEqual([figures, articles], [steps, len(self.chapters())])
        pdf = base64.b64decode(self.printed_page())
        self.assertGreater(len(re.findall(rb"/Type\s*/Page\b(?!s)", pdf)), len(self.chapters()))
        self.run_script("showOne()")
        # The print command of the browser: the page is prepared some time after it was opened.
        text = self.run_script("dispatchEvent(new Event('beforeprint')); return new Promise((done) => setTimeout(() => done(document.querySelector('main').textContent)))")
        self.assertIn("It contains", text)
        self.assertNotIn("Loading", text)
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
        shown = self.run_script("return [...document.querySelectorAll('main form, main .legend input, main button')].filter((e) => e.checkVisibility()).length")
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})
        self.assertEqual(shown, 0, "controls on paper")
        self.run_script("dispatchEvent(new Event('afterprint'))")
        self.assertEqual(self.run_script("return [CHAPTERS[state.chapter].id, state.step, document.querySelectorAll('article').length]"), ["depth", 1, 1])

    def test_the_steps_of_the_tile_are_those_of_the_run(self):
        """After the last step, the tile has the colors of the picture; and each tested depth was compared with the depth of the steps."""
        self.open("earth", "stepping")
        wrong_colors, wrong_depths, tested = self.driver.execute_async_script("""const done = arguments[0];
            decodeAll().then(unpackTile).then(() => {
              const f = FRAME.tile, {rows} = tileRows(), end = tileAfter(rows, rows.length), copy = document.createElement('canvas'); copy.width = W; copy.height = H;
              copy.getContext('2d').drawImage(IMAGES.get(DATA.pictures.final), 0, 0);
              let colors = 0, depths = 0, tested = 0;
              end.color.forEach((c, i) => { const p = copy.getContext('2d').getImageData(TILE_X + i % TILE_W, H - 1 - TILE_Y - Math.floor(i / TILE_W), 1, 1).data; colors += c === null || c.some((v, k) => v !== p[k]); });
              const depth = new Float32Array(TILE_W * TILE_H);
              for (const i of rows) {
                const at = f.y[i] * TILE_W + f.x[i];
                if (f.outcome[i] > 1 && !Number.isNaN(f.stored[i])) { ++tested; depths += f.stored[i] !== depth[at]; }
                if (passes(f.outcome[i])) depth[at] = f.depth[i];
              }
              done([colors, depths, tested]);
            })""")
        self.assertEqual([wrong_colors, wrong_depths], [0, 0])
        self.assertGreater(tested, 0)
        slider = self.driver.find_element(By.CSS_SELECTOR, "[aria-label='Next triangle']")
        before = self.run_script("return stepping.triangle")
        slider.click()
        self.assertEqual(self.run_script("return stepping.triangle"), before + 1)

    def test_blocks_beyond_an_edge_are_told_from_crossed_ones(self):
        """A sliver that ends at (60, 4): beyond it, both of its long lines cross the blocks, but no edge does."""
        self.open("earth")
        kinds = self.run_script("""const xy = {x: [0, 60 * SUB, 0], y: [0, 4 * SUB, 2 * SUB]}, t = {...xy, edges: edgesOf(xy)};
            return [[0, 0], [56, 0], [64, 0], [72, 0], [0, 8], [-8, 0]].map(([x, y]) => blockKind(t, x, y))""")
        self.assertEqual(kinds, ["some", "some", "extension", "extension", "none", "none"])

    def test_the_switch_changes_the_colors(self):
        self.open("earth")
        background = "return getComputedStyle(document.body).backgroundColor"
        light = self.run_script(background)
        self.driver.find_element(By.ID, "theme").click()
        self.assertNotEqual(self.run_script(background), light)
        self.open("earth", dark=True)
        self.assertNotEqual(self.run_script(background), light, "prefers-color-scheme: dark")

    def check_coverage(self, _):
        """The page computes the same coverage of the example as the renderer."""
        if self.run_script("return TRI === null"):
            return  # nothing is visible at the example pixel
        own, expected, pixels = self.run_script("return [EX.triangles.map((t) => countOfPixels([t])), EX.triangles.map((t) => t.covered), countOfPixels(EX.triangles)]"
                                                .replace("countOfPixels", f"({COUNT_OF_PIXELS})"))
        self.assertEqual(own, expected)
        self.assertEqual([pixels] * 2, self.run_script("return [EX.covered, DATA.choice.covered]"), "all pieces, and the fragments of the primitive")
        own, expected = self.run_script("""const [x0, y0] = WINDOW.map(blockOf);
            return [EX.block.map((_, i) => allSamples.reduce((bits, s) => bits | covers(TRI, x0 + i % 8, y0 + (i >> 3), s) << s, 0)), EX.block]""")
        self.assertEqual(own, expected)
        self.assertTrue(self.run_script("return covers(TRI, ...WINDOW)"), "the example covers the visible sample")

    def check_setup_depth(self, _):
        """The setup chapter computes the depth of the fragment."""
        if self.run_script("return isTriangle"):
            depth, expected = self.run_script("return [depthFromEdges(), VISIBLE.depth]")
            self.assertLessEqual(abs(depth - expected), 1e-6 * abs(expected), "the renderer uses floats")

    def check_final_pixel(self, _):
        """The formulas of the page end in the color of the pixel."""
        page, pixel = self.driver.execute_async_script(
            "const done = arguments[0]; unpackHistory().then(() => done([TONE.pixel, detailsOf(...PIXEL)]))")
        self.assertEqual(page["code"], pixel["code"][:3])
        self.assertEqual(page["light"], pixel["light"][:3])
        if self.run_script("return DATA.mips !== null"):
            size, lod = self.run_script("return [mipSize(), MIP.lod]")
            self.assertAlmostEqual(2 ** lod / size, 1, 5)

    def check_luminance_bar(self, _):
        """The bar of the example in the histogram contains its luminance."""
        light, bins, low, bars, edges = self.run_script(
            "const all = [...TONE.histogram.keys()]; return [TONE.pixel.light, TONE.bins, TONE.low, all.filter(isExampleBin), all.map(binLow)]")
        luminance = 0.2126 * light[0] + 0.7152 * light[1] + 0.0722 * light[2]
        for edge, number in ((edges[0], low), (edges[bins], low + 1)):
            self.assertEqual(edge, 2.0 ** number)
        if edges[0] <= luminance < edges[-1]:
            self.assertEqual(len(bars), 1)
            self.assertLessEqual(edges[bars[0]], luminance)
            self.assertLess(luminance, edges[bars[0] + 1])

    def test_sums_of_layers_match_the_stored_color(self):
        self.open("box")
        end, result = self.run_script("return [blendedSums().pop(), LAYERS.result]")
        for a, b in zip(end, result):  # the stored color is rounded to half floats or to 8 bits, a step of at most 1/255 in sRGB
            self.assertLessEqual(abs(a - b), 0.01 * max(abs(b), 0.01))

    def test_commands_can_be_run(self):
        folder = Path(self.folder.name)
        (folder / "sub folder").mkdir()
        (folder / "sub folder" / "box.obj").write_text(BOX)
        page = folder / "command.html"
        subprocess.run([PROGRAM, "explain", "sub folder/box.obj", "--yaw", "20", "--set", "samples=2", "-o", page], check=True, cwd=folder)
        set_window(self.driver, 1200)
        self.driver.get(f"file://{page}#history")
        WebDriverWait(self.driver, 30).until(lambda d: d.execute_script("return document.querySelector('article') !== null"))
        explain, render, code, (x, y) = self.run_script("return [DATA.command, DATA.render_command, TONE.pixel.code, PIXEL]")

        def run(line):
            line = line.replace("halfspace", str(PROGRAM), 1)
            return subprocess.run(line, shell=True, check=True, capture_output=True, text=True, cwd=folder).stdout

        result = json.loads(run(f"{explain} --pixel {x},{y} --json"))
        self.assertEqual([result["size"], result["code"][:3]], [[640, 360], code])
        run(f"{render} -o command.png")
        run("halfspace render 'sub folder/box.obj' --size 640x360 --yaw 20 --set samples=2 -o expected.png")
        self.assertEqual((folder / "command.png").read_bytes(), (folder / "expected.png").read_bytes())

    @unittest.skipUnless(LONG, "needs HALFSPACE_LONG_TESTS")
    def test_pages_are_smaller_than_25_mb(self):
        folder = Path(self.folder.name)
        names = subprocess.run([PROGRAM, "list", "--names"], check=True, capture_output=True, text=True).stdout.split()
        runs = [[name] for name in names] + [["panes.json", "--set", "samples=8"]] + ([[HELMET]] if HELMET.exists() else [])
        runs += [["particles", "--set", "particles.count=100000", "--set", "particles.arrangement=ball", "--set", "samples=4"]]  # the largest page
        for arguments in runs:
            page = folder / "size.html"
            subprocess.run([PROGRAM, "explain", *arguments, "-o", page], check=True, cwd=folder)
            self.assertLess(page.stat().st_size, 25_000_000, arguments)

    def test_all_fragments_of_the_example_are_listed(self):
        """Scenes with many layers at the example pixel list all of its fragments, with the numbers of --text and with all values."""
        self.open("panes", "history")
        x, y = self.run_script("return PIXEL")
        shown = self.show_pixel(x, y)
        text = self.text_of("panes", [x, y])
        count = int(re.search(r"(\d+) fragments? in", text).group(1))
        self.assertGreater(count, 20)
        self.assertEqual(self.run_script("return document.querySelectorAll('#history-panel .fragments > li > details').length"), count)
        for number in range(1, count + 1):
            self.assertRegex(shown, rf"(?m)^{number}\. ")
        self.assertNotIn("does not list", shown)

    def test_the_geometry_stage_shows_what_is_emitted(self):
        self.assertIn("normal_lines", self.caption("flat", "geometry"), "how to get a geometry stage")
        text = self.caption("pipeline", "geometry", 2)
        self.assertIn("3 lines", text)
        error, lengths, outside, lines, calls = self.run_script("""const pv = multiply(M.clip_from_view, M.view_from_world);
            const errors = EMITTED.emitted.flatMap(([corner, tip], i) => { const offset = transform(pv, [...EMITTED.received[i].normal.map((v) => v * EMITTED.length), 0]);
              return tip.clip.map((v, k) => Math.abs(v - corner.clip[k] - offset[k]) / tip.clip[3]); });
            const all = EMITTED.emitted.flat().map((v) => v.window), lengths = EMITTED.received.map((v) => Math.hypot(...v.normal));
            return [Math.max(...errors), lengths, all.filter(([x, y]) => x < 0 || y < 0 || x >= W || y >= H).length, EMISSION.draws[0].emitted, EMISSION.calls]""")
        self.assertLess(error, 1e-6, "floats")
        for length in lengths:
            self.assertAlmostEqual(length, 1, 5)
        self.assertEqual([outside, lines], [0, 3 * calls])

    def test_wireframes_have_a_loupe(self):
        """The middle of the loupe is what is under the pointer. While the drawing is turned, there is no loupe."""
        self.open("pipeline", "spaces/2")
        drawn, empty, hidden = self.run_script("""const canvas = document.querySelector('figure .stage canvas'), lens = document.querySelector('figure .loupe canvas');
            const r = canvas.getBoundingClientRect(), w = canvas.width, all = canvas.getContext('2d').getImageData(0, 0, w, canvas.height).data;
            const alpha = (x, y) => all[4 * (y * w + x) + 3], reach = 10, isEmpty = (x, y) => { for (let j = -reach; j <= reach; ++j) for (let i = -reach; i <= reach; ++i) if (alpha(x + i, y + j) > 0) return false; return true; };
            const point = (x, y, buttons) => canvas.dispatchEvent(new PointerEvent('pointermove', {clientX: r.left + (x + 0.5) / w * r.width, clientY: r.top + (y + 0.5) / canvas.height * r.height, buttons}));
            const sum = (size) => lens.getContext('2d').getImageData(72 - size / 2, 72 - size / 2, size, size).data.reduce((n, v, i) => n + (i % 4 === 3 ? v : 0), 0);
            const find = (accepts) => { for (let y = 100; y < 460; ++y) for (let x = 100; x < 900; ++x) if (accepts(x, y)) return [x, y]; };
            point(...find((x, y) => alpha(x, y) > 160), 0);
            const drawn = sum(16);
            point(...find(isEmpty), 0);
            const empty = sum(144);
            point(500, 280, 1);
            return [drawn, empty, document.querySelector('figure .loupe').hidden]""")
        self.assertGreater(drawn, 0, "a pixel of an edge")
        self.assertEqual([empty, hidden], [0, True])

    def test_links_to_lessons_need_their_address(self):
        links = "return [...document.querySelectorAll('.related a')].map((a) => a.href).filter((h) => h.endsWith('.md'))"
        self.assertIn("docs/tutorial/lessons", self.caption("flat", "depth"))
        self.assertEqual(self.run_script(links), [])
        self.pages["linked"] = Path(self.folder.name) / "linked.html"
        subprocess.run([PROGRAM, "explain", "flat.json", "--size", "32x18", "--lessons", "course/", "-o", self.pages["linked"]], check=True, cwd=self.folder.name)
        self.open("linked", "depth")
        self.assertEqual(self.run_script(links), [f"file://{self.folder.name}/course/02.md"])

    def test_a_cut_tile_says_so(self):
        self.open("panes", "stepping")
        self.assertEqual(self.run_script("return cutNote()"), "")
        note = self.run_script("Object.assign(STEPS, {left_out: 5, triangles_left_out: 2}); return cutNote()")
        self.assertRegex(note, r"the steps end after \d+ primitives with .* fragments; the tile has 2 more with 5 fragments")

    def test_arrow_keys_select_a_pixel(self):
        self.open("earth", "depth")
        canvas = self.driver.find_element(By.CSS_SELECTOR, "figure canvas")
        canvas.send_keys(Keys.ARROW_RIGHT)
        x, y = self.run_script("return PIXEL")
        self.assertIn(f"pixel ({min(x + 1, 319)}, {y})", self.driver.find_element(By.CLASS_NAME, "readout").text)
        self.assertEqual(self.run_script("return state.step"), 0, "the keys do not change the step")

    def test_links_have_enough_contrast(self):
        for dark in (False, True):
            self.open("earth", dark=dark)
            ratio = self.run_script("""const rgb = (s) => s.match(/[\\d.]+/g).slice(0, 3).map((v) => v / 255).map((v) => (v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4));
                const y = (s) => rgb(s).reduce((n, v, k) => n + v * [0.2126, 0.7152, 0.0722][k], 0);
                const a = document.querySelector('nav a.absent'), l = [y(getComputedStyle(a).color), y(getComputedStyle(document.body).backgroundColor)].sort((p, q) => q - p);
                return getComputedStyle(a).opacity === '1' ? (l[0] + 0.05) / (l[1] + 0.05) : 0""")
            self.assertGreaterEqual(ratio, 4.5, "dark" if dark else "light")  # WCAG 2.1, success criterion 1.4.3

    def show_pixel(self, x, y):
        """Types a pixel into the form of the history, and returns the displayed text, with all details open."""
        fields = self.driver.find_elements(By.CSS_SELECTOR, "form.pixel input")
        for field, value in zip(fields, (x, y)):
            field.clear()
            field.send_keys(str(value))
        fields[0].send_keys(Keys.ENTER)
        self.wait_for_panel(x, y)
        self.run_script("document.querySelectorAll('#history-panel details').forEach((d) => { d.open = true; })")
        return self.run_script("return document.getElementById('history-panel').innerText")

    def wait_for_panel(self, x, y):
        title = f"Pixel {x}, {y}"
        WebDriverWait(self.driver, 30).until(lambda d: d.execute_script("const h = document.querySelector('#history-panel h3'); return h && h.textContent") == title)

    def compared_pixels(self):
        return [self.run_script("return PIXEL")] + ([[160, 88], [8, 16]] if LONG else [])

    def check_shown_numbers(self, name):
        """The history of a pixel shows the numbers of --text."""
        number = re.compile(r"(?<![\w.])-?\d+(?:\.\d+)?(?:e[-+]\d+)?(?![\w.]*\w)")
        for pixel in self.compared_pixels():
            text = self.text_of(name, pixel)
            panel = self.show_pixel(*pixel)
            if not self.driver.execute_script("return detailsOf(...arguments[0]).list.every((f) => f.kind)", pixel):
                self.assertNotEqual(pixel, self.run_script("return PIXEL"), "the example has all values")
                self.assertRegex(panel, r"The page contains all values of [\d,]+ of these fragments\.")
                continue
            shown = set(number.findall(panel))
            missing = [n for n in number.findall(text.replace("8x8", "")) if n not in shown]
            self.assertEqual(missing, [], f"pixel {pixel}: numbers of --text that the page does not show\n{text}")

    def text_of(self, name, pixel, kind="--text"):
        return subprocess.run([PROGRAM, "explain", *SCENES[name], "--size", "320x180", "--pixel", "{},{}".format(*pixel), kind],
                              check=True, capture_output=True, text=True, cwd=self.folder.name).stdout

    def check_values_of_json(self, name):
        """The page has the values of --json."""
        def as_floats(x):
            if isinstance(x, list):
                return [as_floats(v) for v in x]
            return struct.unpack("f", struct.pack("f", x))[0] if isinstance(x, float) else x
        as_list = lambda v: v if isinstance(v, list) else [v]
        for pixel in self.compared_pixels():
            expected = json.loads(self.text_of(name, pixel, "--json"))
            page = self.driver.execute_async_script(
                "const done = arguments[2]; unpackHistory().then(() => done(detailsOf(arguments[0], arguments[1])))", *pixel)
            where = f"pixel {pixel}"
            self.assertEqual(page["others"], expected["fragments_left_out"], where)
            self.assertEqual([f["index"] for f in page["list"]], list(range(len(expected["fragments"]))), where)
            self.assertTrue(any("kind" in f for f in page["list"]) or not page["list"], where)
            for own, f in zip(page["list"], expected["fragments"]):
                rows = [("draw", "draw"), ("instance", "instance"), ("primitive", "primitive"), ("sample", "sample"), ("depth", "depth")]
                if "kind" in own:  # the page has all values
                    rows += [("barycentrics", "barycentrics"), ("invW", "inv_w"), ("color", "color")]
                    rows += [("tested", "tested_depth"), ("stored", "stored_depth")] if "tested_depth" in f else []
                    rows += [("value", "value")] if "value" in f else []
                for key, json_key in rows:
                    self.assertEqual(as_floats(own[key]), as_floats(f[json_key]), f"{where}, {json_key}")
                if "kind" not in own:
                    continue
                self.assertEqual([own["kind"]["front"], own["kind"]["shader"], bool(own["isShaded"])], [f["front_facing"], f["shader"], f["shaded"]], where)
                for key in ("varyings", "terms", "factors"):
                    self.assertEqual({k: as_floats(v) for k, v in own[key]}, {k: as_floats(as_list(v)) for k, v in f[key].items()}, where)
            self.assertEqual(as_floats(page["samples"]), as_floats(expected["samples"]), where)
            self.assertEqual([as_floats(page["light"]), page["code"]], [as_floats(expected["light"]), expected["code"]], where)

    def test_a_click_selects_the_pixel(self):
        self.open("earth", "history")
        self.wait_for_panel(*self.run_script("return PIXEL"))
        canvas = self.driver.find_element(By.CSS_SELECTOR, "figure canvas")
        self.run_script("document.querySelector('figure canvas').scrollIntoView({block: 'center'})")
        ActionChains(self.driver).move_to_element(canvas).click().perform()
        WebDriverWait(self.driver, 30).until(lambda d: d.execute_script("return historyState.pixel.join()") != d.execute_script("return PIXEL.join()"))
        x, y = self.run_script("return historyState.pixel")
        self.assertLessEqual(abs(x - 160), 1)
        self.assertLessEqual(abs(y - 90), 1)

    def test_other_pixels_show_the_nearest_one_and_the_command(self):
        self.pages["large"] = Path(self.folder.name) / "large.html"
        subprocess.run([PROGRAM, "explain", "flat.json", "--size", "400x180", "-o", self.pages["large"]], check=True, cwd=self.folder.name)
        self.open("large", "history")
        shown = self.show_pixel(3, 177)
        self.assertIn("halfspace explain flat.json --size 400x180 --pixel 3,177 --text", shown)
        self.driver.find_element(By.CSS_SELECTOR, "#history-panel button").click()
        WebDriverWait(self.driver, 30).until(lambda d: d.execute_script("return detailsOf(...historyState.pixel) !== null"))

    def test_the_page_follows_a_piece_of_a_clipped_triangle(self):
        (Path(self.folder.name) / "floor.json").write_text(json.dumps(FLOOR))
        self.pages["floor"] = Path(self.folder.name) / "floor.html"
        subprocess.run([PROGRAM, "explain", "floor.json", "--size", "320x180", "-o", self.pages["floor"]], check=True, cwd=self.folder.name)
        self.open("floor", "culling")
        self.assertTrue(self.run_script("return isClipped && EX.triangles.length > 1"))
        self.check_coverage("floor")
        self.check_setup_depth("floor")
        self.assertIn("the page follows the piece", self.run_script("return document.querySelector('article').textContent"))
        coverage, area, pixel = self.run_script("const of = (id, i) => CHAPTERS.find((c) => c.id === id).exercises()[i].answer; return [of('coverage', 0), of('setup', 1), of('spaces', 1)]")
        columns, rows, covered_pixels = self.run_script("""const boxes = EX.triangles.map((t) => t.box), of = (f, k) => f(...boxes.map((b) => b[k]));
            return [of(Math.max, 2) - of(Math.min, 0), of(Math.max, 3) - of(Math.min, 1), DATA.choice.covered]""")
        self.assertAlmostEqual(coverage, 100 * covered_pixels / (columns * rows))
        self.assertEqual(area, self.run_script("return area2(TRI)"))
        self.assertLess(-1, pixel)
        self.assertLess(pixel, 320)
        for chapter, step, (_, nameless, exercises) in self.tour(f"() => [({PICTURE})(), ({NAMELESS})(), ({EXERCISES})()]"):
            self.assertEqual([nameless, exercises.get("bad", []), exercises.get("printed", [])], [[], [], []], f"{chapter}, step {step}")
        self.assertEqual(self.errors(), [])

    def test_small_frames_have_the_values_of_every_pixel(self):
        self.open("earth", "history")
        missing = self.driver.execute_async_script("""const done = arguments[0];
            unpackHistory().then(() => done([...Array(W * H).keys()].filter((i) => detailsOf(i % W, Math.floor(i / W)) === null).length))""")
        self.assertEqual(missing, 0)

    def test_screenshots(self):
        if SCREENSHOTS is None:
            self.skipTest("no folder for screenshots was given")
        SCREENSHOTS.mkdir(parents=True, exist_ok=True)
        for name in SCENES:
            for kind, width, dark in (("light", 1200, False), ("dark", 1200, True), ("narrow", 390, False)):
                self.open(name, width=width, dark=dark)
                for index, chapter in enumerate(self.chapters()):
                    self.go_to(index)
                    self.driver.save_screenshot(str(SCREENSHOTS / f"{name}-{kind}-{index + 1:02}-{chapter}.png"))


if __name__ == "__main__":
    if PROGRAM is None:
        sys.exit("usage: page_test.py PROGRAM [SCREENSHOTS]")
    for path, package in ((CHROMIUM, "chromium"), (DRIVER, "chromium-driver")):
        if path is None:
            print(f"page_test.py: skipped: {package} is absent (Debian: {package})")
            sys.exit(SKIPPED)
    unittest.main(argv=sys.argv[:1])
