#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Opens pages of `halfspace explain` in headless Chromium. Tests steps, exercises, the names of all controls and pictures, and narrow
windows, and that there are no errors.

  page_test.py PROGRAM [SCREENSHOTS]

Needs the Debian packages chromium, chromium-driver and python3-selenium. If a folder is given, a screenshot of every chapter is written to
it.
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SKIPPED = 77  # ctest shows the test as skipped
try:
    from selenium import webdriver
    from selenium.webdriver.chrome.options import Options
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
    from selenium.webdriver.support.ui import WebDriverWait
except ImportError:
    if sys.executable != "/usr/bin/python3" and os.path.exists("/usr/bin/python3"):
        os.execv("/usr/bin/python3", ["/usr/bin/python3", *sys.argv])
    print("page_test.py: skipped: selenium is absent (Debian: python3-selenium)")
    sys.exit(SKIPPED)

CHROMIUM, DRIVER = shutil.which("chromium"), shutil.which("chromedriver")
PROGRAM = Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else None
SCREENSHOTS = Path(sys.argv[2]) if len(sys.argv) > 2 else None
# Scenes that together use every stage: clipped triangles, shadows, HDR, points, several samples, transparent layers.
SCENES = {"earth": ["earth"], "day-night": ["day-night", "--camera", "street"], "particles": ["particles"],
          "knot": ["shadow-knot", "--set", "samples=4"], "box": ["box.obj"]}
BOX = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"


def browser():
    options = Options()
    options.binary_location = CHROMIUM
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--window-size=1200,900"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(options=options, service=Service(DRIVER))


def set_window(driver, width, dark=False):
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": False})
    features = [{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}]
    driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": features})


# Calls look(chapter, step) for every step of every chapter, and returns the results.
TOUR = """
const done = arguments[arguments.length - 1], look = LOOK, results = [];
const pause = () => new Promise((resolve) => setTimeout(() => requestAnimationFrame(resolve), 25));
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
  const accepts = (x, text) => { const p = document.createElement('p'); judge(x, text, p); return p.className.includes('right'); };
  const all = c.exercises();
  return {count: document.querySelectorAll('.exercise').length, bad: all.filter((x) => !accepts(x, String(x.answer)) || accepts(x, '-12345.5') || accepts(x, '')).map((x) => x.ask)};
}"""
WIDTH = "() => document.documentElement.scrollWidth"


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.driver = browser()
        cls.driver.set_script_timeout(120)
        cls.pages = {}
        (Path(cls.folder.name) / "box.obj").write_text(BOX)
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
        for name in SCENES:
            self.open(name)
            seen = {}
            for chapter, step, look in self.tour(f"() => [({PICTURE})(), ({NAMELESS})(), ({EXERCISES})()]"):
                picture, nameless, exercises = look
                where = f"{name}, {chapter}, step {step}"
                self.assertEqual(nameless, [], f"{where}: a control or picture has no name")
                if "note" in exercises:
                    self.assertIn("halfspace explain", exercises["note"], where)
                    continue
                self.assertEqual(exercises, {"count": 3, "bad": []}, where)
                self.assertNotIn(picture, seen.setdefault(chapter, []), f"{where} shows what was shown before")
                seen[chapter].append(picture)
            self.assertEqual(self.errors(), [], name)

    def test_nothing_is_wider_than_a_phone(self):
        for name in SCENES:
            self.open(name, width=390)
            for chapter, step, width in self.tour(WIDTH):
                self.assertLessEqual(width, 390, f"{name}, {chapter}, step {step}")

    def test_answers_can_be_typed(self):
        self.open("earth", "frame")
        form = self.driver.find_element(By.CSS_SELECTOR, ".exercise form")
        for text, expected in (("57 600", "right"), ("57601", "wrong")):
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

    def test_together_the_scenes_show_every_chapter(self):
        absent = None
        for name in SCENES:
            self.open(name)
            here = set(self.run_script("return CHAPTERS.filter((c) => c.absent && c.absent()).map((c) => c.id)"))
            absent = here if absent is None else absent & here
        self.assertEqual(absent, set())

    def test_the_switch_changes_the_colors(self):
        self.open("earth")
        background = "return getComputedStyle(document.body).backgroundColor"
        light = self.run_script(background)
        self.driver.find_element(By.ID, "theme").click()
        self.assertNotEqual(self.run_script(background), light)
        self.open("earth", dark=True)
        self.assertNotEqual(self.run_script(background), light, "prefers-color-scheme: dark")

    def test_coverage_on_the_page_matches_the_renderer(self):
        self.open("earth")
        own, expected = self.run_script("return [countCovered(), DATA.example.triangles[0].covered]")
        self.assertEqual(own, expected)

    def test_the_bar_of_the_example_contains_its_luminance(self):
        for name in SCENES:
            self.open(name)
            light, bins, low, bars, edges = self.run_script(
                "const all = [...TONE.histogram.keys()]; return [TONE.pixel.light, TONE.bins, TONE.low, all.filter(isExampleBin), all.map(binLow)]")
            luminance = 0.2126 * light[0] + 0.7152 * light[1] + 0.0722 * light[2]
            for edge, number in ((edges[0], low), (edges[bins], low + 1)):
                self.assertEqual(edge, 2.0 ** number, name)
            if not edges[0] <= luminance < edges[-1]:
                continue
            self.assertEqual(len(bars), 1, name)
            self.assertLessEqual(edges[bars[0]], luminance, name)
            self.assertLess(luminance, edges[bars[0] + 1], name)

    def show_pixel(self, x, y):
        """Types a pixel into the form of the history, and returns the displayed text, with all details open."""
        fields = self.driver.find_elements(By.CSS_SELECTOR, "form.pixel input")
        for field, value in zip(fields, (x, y)):
            field.clear()
            field.send_keys(str(value))
        fields[0].send_keys(Keys.ENTER)
        self.wait_for_panel(x, y)
        self.run_script("document.querySelectorAll('#history-panel details').forEach((d) => { d.open = true; })")
        return self.driver.find_element(By.ID, "history-panel").text

    def wait_for_panel(self, x, y):
        title = f"Pixel {x}, {y}"
        WebDriverWait(self.driver, 30).until(lambda d: d.execute_script("const h = document.querySelector('#history-panel h3'); return h && h.textContent") == title)

    def test_a_pixel_shows_the_numbers_of_the_text(self):
        number = re.compile(r"-?\d+\.\d+(?:e[-+]\d+)?|-?\d+e[-+]\d+")
        for name, arguments in SCENES.items():
            self.open(name, "history")
            for pixel in (self.run_script("return PIXEL"), [160, 88], [8, 16]):
                text = subprocess.run([PROGRAM, "explain", *arguments, "--size", "320x180", "--pixel", "{},{}".format(*pixel), "--text"],
                                      check=True, capture_output=True, text=True, cwd=self.folder.name).stdout
                shown = set(number.findall(self.show_pixel(*pixel)))
                missing = [n for n in number.findall(text) if n not in shown]
                self.assertEqual(missing, [], f"{name}, pixel {pixel}: numbers of --text that the page does not show\n{text}")

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
        self.open("earth", "history")
        x, y = self.run_script("return [...Array(W).keys()].map((x) => [x, H - 3]).find(([x]) => x % 8 === 3 && Math.abs(x - PIXEL[0]) > 80)")
        shown = self.show_pixel(x, y)
        self.assertIn(f"halfspace explain earth --size 320x180 --pixel {x},{y} --text", shown)
        self.driver.find_element(By.CSS_SELECTOR, "#history-panel button").click()
        WebDriverWait(self.driver, 30).until(lambda d: d.execute_script("return detailsOf(...historyState.pixel) !== null"))

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
