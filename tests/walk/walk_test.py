#!/usr/bin/python3
"""The walk-through page in a headless Chromium, as a visitor meets it: its light against `enfilade probe`.

walk_test.py ENFILADE [unittest arguments]. Ends with status 77 (skipped) where there is no Chromium or no page."""
import json
import math
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "cli"))
import browser  # noqa: E402
from room_scenes import block, box, lamp, prism, scene  # noqa: E402

ENFILADE = os.environ.get("ENFILADE", "")
READY = "!!document.body && document.body.dataset.ready !== undefined"
# Half floats: 1 part in 2048 at each corner. The value between corners cannot be further off than that of the worst.
KEPT = 6e-4


def enfilade(*args):
    result = subprocess.run([ENFILADE, *map(str, args)], capture_output=True, text=True, timeout=240)
    if result.returncode != 0:
        raise AssertionError(f"enfilade {args}: {result.stderr}")
    return result


def shell(x0, y0, x1, y1, z0, z1, name):
    """The outside of a storey, so that what lies beyond the rooms is outside."""
    return block(x0, y0, z0, x1, y1, z1, name, reflectance=0.3)


def building():
    """Two storeys: below, a large red-and-blue room with a table and a small room; above, one room. No door: each room
    has its own lamp, so that the light of one is none of the others'."""
    warm, cold = [0.7, 0.5, 0.3], [0.3, 0.4, 0.6]
    surfaces = prism(box(0, 0, 6, 4), 0, 2.6, warm, 0.0, "hall") + block(2.5, 1.5, 0, 3.5, 2.5, 0.8, "table")
    surfaces += prism(box(6.2, 0, 9, 4), 0, 2.6, cold, 0.0, "store")
    surfaces += prism(box(0, 0, 9, 4), 3.0, 5.6, 0.6, 0.0, "attic")
    surfaces += shell(-0.3, -0.3, 9.3, 4.3, -0.3, 5.9, "shell")
    surfaces += [lamp(1.5, 2, 2.59, 0.6, 9000, "hall lamp"), lamp(7.6, 2, 2.59, 0.4, [2000, 3000, 4000], "store lamp"),
                 lamp(4, 2, 5.59, 0.5, 5000, "attic lamp")]
    rooms = [{"name": "1.01", "longName": "Hall </script><b>", "storey": "Ground", "outline": box(0, 0, 6, 4), "z": [0, 2.6]},
             {"name": "1.02", "longName": "Store", "storey": "Ground", "outline": box(6.2, 0, 9, 4), "z": [0, 2.6]},
             {"name": "2.01", "longName": "Attic", "storey": "Upper", "outline": box(0, 0, 9, 4), "z": [3.0, 5.6]}]
    spot = {"type": "point", "p": [5, 3, 1.5], "intensity": 60, "name": "spot"}
    return scene(surfaces, rooms=rooms, lights=[spot])


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = Path(tempfile.mkdtemp(prefix="enfilade-walk-"))
        cls.addClassCleanup(shutil.rmtree, cls.scratch, ignore_errors=True)
        (cls.scratch / "scene.json").write_text(json.dumps(building()))
        cls.run_directory = cls.scratch / "run"
        enfilade("solve", cls.scratch / "scene.json", "-o", cls.run_directory, "--target-error", "0.02", *cls.options)
        cls.browser = browser.Browser()
        cls.addClassCleanup(cls.browser.close)
        cls.browser.open(cls.run_directory / "walk.html", READY)

    options = ()

    def reading(self):
        """What the page says of the place under the pointer: value, place and normal."""
        data = self.browser.evaluate("({...document.getElementById('reading').dataset})")
        if "value" not in data:
            return None
        numbers = {key: [float(x) for x in data[key].split(",")] for key in ("p", "n")}
        return {"value": float(data["value"]), **numbers}

    def readings(self, step=90):
        found = []
        for x in range(40, 620, step):
            for y in range(60, 620, step):
                self.browser.move(x, y)
                reading = self.reading()
                if reading:
                    found.append({**reading, "pixel": (x, y)})
        return found

    def probed(self, readings, *options):
        """The same places as `enfilade probe` has them, weighted as ITU-R BT.709 weights red, green and blue."""
        points, answers = self.scratch / "points.json", self.scratch / "answers.json"
        points.write_text(json.dumps({"probes": [{"p": [a + 1e-6 * b for a, b in zip(r["p"], r["n"])], "n": r["n"]}
                                                 for r in readings]}))
        enfilade("probe", self.run_directory, "--points", points, "-o", answers, *options)
        probes = json.loads(answers.read_text())["probes"]
        return [sum(w * e for w, e in zip((0.2126, 0.7152, 0.0722), probe["E"])) for probe in probes]

    def enter(self, name):
        rows = self.browser.evaluate("[...document.querySelectorAll('#rooms tbody tr')].map(r => [r.dataset.room, r.cells[0].textContent])")
        number = next(number for number, text in rows if text.startswith(name))
        self.browser.click_on(f"#rooms tr[data-room='{number}'] button")
        return number


class Light(Page):
    def test_value_under_the_pointer_is_that_of_the_patches(self):
        for room in ("1.01", "1.02", "2.01"):
            self.enter(room)
            readings = self.readings()
            self.assertGreater(len(readings), 15, room)
            for reading, e in zip(readings, self.probed(readings, "--from", "patches")):
                self.assertAlmostEqual(reading["value"], e, delta=KEPT * abs(e) + 1e-3, msg=f"{room} {reading}")

    def test_value_is_the_light_at_the_place(self):
        """Against gathers at the points, which owe nothing to the patch there: within three times what the run says that its
        patches are wrong by on average, and nowhere off by a third."""
        stats = json.loads((self.run_directory / "stats.json").read_text())
        self.enter("1.01")
        readings = self.readings()
        true = self.probed(readings)
        off = [abs(r["value"] - e) / max(e, 1.0) for r, e in zip(readings, true)]
        self.assertLess(sum(off) / len(off), 3 * stats["estimated_patch_error"], off)
        self.assertLess(sorted(off)[int(0.9 * len(off))], 0.33)

    def test_false_colour_is_that_of_the_value(self):
        """The picture against the legend's colours at the value that the page names, with patches shown as they are."""
        self.enter("1.01")
        self.browser.click_on("#colours")
        self.browser.evaluate("document.getElementById('patches').click()")
        scale = json.loads(self.browser.evaluate("document.getElementById('model').textContent"))["palette"]
        low, high = (float(self.browser.evaluate(f"document.getElementById('{i}').value")) for i in ("lowest", "highest"))
        readings = self.readings(120)
        self.browser.frame()
        picture = self.browser.screenshot()
        wrong = []
        for reading in readings:
            t = min(max(math.log(max(reading["value"], low) / low) / math.log(high / low), 0), 1) * (len(scale) - 1)
            i = min(int(t), len(scale) - 2)
            wanted = [a + (t - i) * (b - a) for a, b in zip(scale[i], scale[i + 1])]
            x, y = reading["pixel"]
            if max(abs(a - b) for a, b in zip(wanted, picture[y][x])) > 6:
                wrong.append((reading, wanted, picture[y][x]))
        self.browser.evaluate("document.getElementById('patches').click()")
        self.browser.click_on("#light")
        # A pixel on an edge is a mixture of two surfaces.
        self.assertLessEqual(len(wrong), len(readings) // 10, wrong)
        self.assertGreater(len(readings), 8)


class Lamps(Page):
    """A run with shares: the page dims its lamps, against probes of the run with the same lamp dimmed."""
    options = ("--shares",)

    def dim(self, name, factor):
        self.browser.evaluate(f"""(() => {{ const label = [...document.querySelectorAll('#lamps label')].find(l => l.textContent.startsWith({json.dumps(name)}));
            const input = label.querySelector('input'); input.value = {factor}; input.dispatchEvent(new Event('input', {{bubbles: true}})); }})()""")
        self.browser.frame()

    def test_a_dimmed_lamp_is_dimmed(self):
        names = self.browser.evaluate("[...document.querySelectorAll('#lamps label')].map(l => l.childNodes[0].textContent)")
        self.assertEqual(sorted(names), ["attic lamp", "hall lamp", "spot", "store lamp"])
        self.enter("1.01")
        self.dim("hall lamp", 0.25)
        readings = self.readings(130)
        dimmed = self.probed(readings, "--from", "patches", "--switch", "hall lamp=0.25")
        whole = self.probed(readings, "--from", "patches")
        for reading, e in zip(readings, dimmed):
            self.assertAlmostEqual(reading["value"], e, delta=2 * KEPT * abs(e) + 2e-3, msg=reading)
        # The hall has a second light, so that it is not simply a quarter everywhere.
        shares = [e / w for e, w in zip(dimmed, whole) if w > 1]
        self.assertLess(min(shares), 0.4)
        self.assertGreater(max(shares), 0.5)
        self.dim("hall lamp", 1)
        for reading, e in zip(self.readings(130), whole):
            self.assertAlmostEqual(reading["value"], e, delta=KEPT * abs(e) + 1e-3, msg=reading)

    def marks(self, colour=(255, 211, 77)):
        """The pixels of the picture that have a marker's colour; full light has the one given."""
        self.browser.frame()
        picture = self.browser.screenshot()
        return picture, [(x, y) for y in range(640) for x in range(620)
                         if max(abs(a - b) for a, b in zip(picture[y][x], colour)) < 8]

    def test_a_lamp_without_a_surface_has_a_marker_that_is_dimmed(self):
        """Only the spot has none. Its marker stands in the picture, with its name, and has the brightness of the dimmer."""
        lights = json.loads(self.browser.evaluate("document.getElementById('model').textContent"))["lights"]
        self.assertEqual([light["name"] for light in lights], ["spot"])
        self.enter("1.01")
        picture, marks = self.marks()
        x, y = (sum(c) // len(marks) for c in zip(*marks))
        self.assertTrue(all(math.hypot(a - x, b - y) < 9 for a, b in marks), marks)
        self.assertGreater(len(marks), 40)
        self.assertTrue(any(min(picture[b][a]) > 220 for a in range(max(0, x - 90), x + 90) for b in range(max(0, y - 60), y - 8)),
                        "its name stands above it")
        self.browser.move(x, y)
        reading = "document.getElementById('reading').textContent"
        self.assertEqual(self.browser.evaluate(reading), "spot: 100%")
        self.dim("spot", 0)
        self.browser.move(x, y)
        self.assertEqual(self.browser.evaluate(reading), "spot: 0%")
        picture, marks = self.marks()
        self.assertEqual(marks, [])
        self.assertLess(max(picture[y][x]), 90)
        self.dim("spot", 1)
        # A wall hides it from the room beside.
        self.enter("1.02")
        self.assertEqual(self.marks()[1], [])

    def test_a_lamp_that_is_off_is_dark_itself(self):
        """The lamp's own face: its luminance follows the slider."""
        self.enter("1.02")
        # Dragging downwards looks up.
        self.browser.mouse("mousePressed", 300, 200, button="left", buttons=1, clickCount=1)
        self.browser.mouse("mouseMoved", 300, 440, button="left", buttons=1)
        self.browser.mouse("mouseReleased", 300, 440, button="left", clickCount=1)
        value = "parseFloat(document.getElementById('reading').dataset.radiosity)"
        self.browser.frame()
        picture = self.browser.screenshot()
        places = [(x, y) for y in range(0, 560, 4) for x in range(0, 600, 4)]
        light = {at: sum(picture[at[1]][at[0]]) for at in places}
        brightest_places = [at for at in places if light[at] == max(light.values())]
        at = brightest_places[len(brightest_places) // 2]
        self.browser.move(*at)
        brightest = self.browser.evaluate(value)
        self.assertAlmostEqual(brightest, 2000 * 0.2126 + 3000 * 0.7152 + 4000 * 0.0722, delta=5)
        self.dim("store lamp", 0.5)
        self.browser.move(*at)
        self.assertAlmostEqual(self.browser.evaluate(value), 0.5 * brightest, delta=3)
        self.dim("store lamp", 1)


class Rooms(Page):
    def test_a_row_and_the_plan_take_the_camera_into_the_room(self):
        for click in ("#rooms tr[data-room='1'] button", "#plan path[data-room='0']", "#rooms tr[data-room='2'] button"):
            self.browser.click_on(click)
            here = self.browser.evaluate("document.querySelector('#rooms tr.here')?.dataset.room")
            self.assertIn(f"data-room='{here}'", click)
            low, high = {"0": (0, 2.6), "1": (0, 2.6), "2": (3.0, 5.6)}[here]
            for reading in self.readings(150):
                self.assertTrue(low - 1e-3 < reading["p"][2] < high + 1e-3, f"{click}: {reading}")

    def test_storeys_are_left_out(self):
        """From above the upper storey hides the lower one, until it is left out."""
        self.browser.click_on("#overview")
        floors = [r for r in self.readings() if r["n"][2] > 0.9]
        self.assertGreater(len(floors), 5)
        # At its near sides, whose walls show their backs and are left out, one sees below it.
        upper = [r for r in floors if r["p"][2] > 2.9]
        self.assertGreater(len(upper), 0.7 * len(floors), floors)
        names = self.browser.evaluate("[...document.querySelectorAll('#storeys button')].map(b => b.textContent)")
        self.assertEqual(names, ["Ground", "Upper"])
        self.browser.click_on("#storeys button:nth-child(2)")
        self.browser.click_on("#overview")
        below = self.readings(100)
        self.assertGreater(len(below), 5)
        self.assertTrue(all(r["p"][2] < 2.7 for r in below), below)
        # A click on what lies there enters the room.
        x, y = next(r["pixel"] for r in below if 0.5 < r["p"][0] < 2 and r["p"][2] < 0.01)
        self.browser.click(x, y)
        self.assertEqual(self.browser.evaluate("document.querySelector('#rooms tr.here')?.dataset.room"), "0")
        self.browser.click_on("#storeys button:nth-child(2)")

    def test_keys_walk(self):
        self.enter("1.01")
        before = self.browser.evaluate("document.querySelector('#plan .eye').getAttribute('transform')")
        self.browser.evaluate("document.getElementById('view').focus()")
        self.browser.call("Input.dispatchKeyEvent", type="keyDown", code="KeyS", key="s")
        self.browser.evaluate("new Promise(done => setTimeout(() => done(true), 300))")
        self.browser.call("Input.dispatchKeyEvent", type="keyUp", code="KeyS", key="s")
        self.assertNotEqual(before, self.browser.evaluate("document.querySelector('#plan .eye').getAttribute('transform')"))


class Whole(Page):
    def test_asks_for_nothing_and_complains_of_nothing(self):
        self.enter("1.02")
        self.browser.click_on("#overview")
        own = (self.run_directory / "walk.html").resolve().as_uri()
        self.assertEqual([url for url in self.browser.requests if url != own and not url.startswith("data:")], [])
        self.assertEqual(self.browser.complaints, [])
        self.assertEqual(self.browser.evaluate("performance.getEntriesByType('resource').length"), 0)

    def test_loads_soon(self):
        milliseconds = int(self.browser.evaluate("document.body.dataset.ready"))
        print(f"\nloaded in {milliseconds} ms, {(self.run_directory / 'walk.html').stat().st_size / 1e6:.2f} MB")
        self.assertLess(milliseconds, 3000 * float(os.environ.get("ENFILADE_SLOW_MACHINE", "3")))

    def test_fits_a_phone(self):
        self.browser.resize(390, 844, mobile=True)
        self.browser.frame()
        self.assertLessEqual(self.browser.evaluate("document.documentElement.scrollWidth"), 390)
        panel = self.browser.evaluate("(b => [b.left, b.right, b.top, b.bottom])(document.getElementById('panel').getBoundingClientRect())")
        self.assertTrue(panel[0] >= 0 and panel[1] <= 390 and panel[3] <= 844, panel)
        self.assertGreater(panel[2], 300, "most of the screen shows the building")
        small = self.browser.evaluate("""[...document.querySelectorAll('button')].filter(b => b.getClientRects().length)
            .filter(b => b.getBoundingClientRect().height < 24).map(b => b.textContent)""")
        self.assertEqual(small, [])
        self.browser.resize(1000, 640)

    def test_names_from_the_scene_are_text(self):
        rows = self.browser.evaluate("[...document.querySelectorAll('#rooms tbody tr')].map(r => r.cells[0].textContent)")
        self.assertIn("1.01 Hall </script><b>", rows)

    def test_holds_the_licence_of_three(self):
        text = (self.run_directory / "walk.html").read_text(encoding="utf-8")
        self.assertRegex(text, r"Three\.js Authors\s+\*? ?SPDX-License-Identifier: MIT")

    def test_is_left_out_where_asked(self):
        run = self.scratch / "without"
        enfilade("solve", self.scratch / "scene.json", "-o", run, "--target-error", "0.3", "--no-walk")
        self.assertFalse((run / "walk.html").exists())
        report = ("report", run, "-o", self.scratch / "report.html", "--no-rooms")
        enfilade(*report, "--no-walk")
        self.assertFalse((run / "walk.html").exists())
        enfilade(*report)
        self.assertTrue((run / "walk.html").exists())
        self.assertIn('href="without/walk.html"', (self.scratch / "report.html").read_text(encoding="utf-8"))
        enfilade("walk", run, "-o", self.scratch / "own.html")
        self.assertIn("application/json", (self.scratch / "own.html").read_text(encoding="utf-8"))


if __name__ == "__main__":
    ENFILADE = str(Path(sys.argv.pop(1)).resolve())
    if browser.executable() is None:
        print("skipped: there is no Chromium (apt-get install chromium)")
        sys.exit(77)
    if not (Path(ENFILADE).parent.parent / "share/enfilade/walk/walk.html").exists():
        print("skipped: this build has no walk-through page (it needs npm)")
        sys.exit(77)
    unittest.main()
