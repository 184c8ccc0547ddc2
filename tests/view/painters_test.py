#!/usr/bin/env python3
"""The page's own painter in a real browser: painters_test.py VOXMELT [FOLDER for screenshots]

Its picture is that of the server's painter, on 20 views of 6 scenes. What the graphics processor holds after many
uploads is what the server has. Skipped (77) without chromium, chromium-driver and python3-selenium."""
import base64
import re
import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent))
import browser
from browser import InBrowser
from page import Page, Server
from textures import TEXEL, Textures

# Scene, steps, and views: azimuth, elevation, distance in diagonals of the grid, field of view stays.
VIEWS = {
    "cello": (200, [None, (-60, 10, 1.1), (150, 60, 0.8)]),
    "bunny_small": (60, [None, (20, 0, 0.9), (-130, -30, 1.2), (80, 89, 1.0)]),
    "goblet": (600, [None, (10, 5, 0.5), (200, 40, 1.5)]),
    "lava": (300, [None, (-100, 12, 0.45), (60, 75, 0.9), (0, -20, 1.3)]),
    "ice": (100, [None, (70, 20, 0.7), (-20, 50, 1.1)]),
    "candle": (200, [None, (-45, 8, 0.6), (130, 35, 1.0)]),
}
LEAST = 38  # dB
MESSAGE = re.compile(r"(\d+) pixels differ, by (\d+) at most: PSNR ([\d.]+) dB")


class PaintersTest(InBrowser):
    def pressed(self, name):
        self.driver.execute_script(f"document.getElementById('{name}').click()")

    def own(self, name):
        return self.driver.execute_script(f"return document.getElementById('textures').dataset.{name}")

    def text(self, name):
        return self.driver.execute_script(f"return document.getElementById('{name}').textContent")

    def compared(self, line, azimuth):
        """How the painters differ from a camera: pixels, the most, PSNR."""
        self.page.send(line)
        self.wait(lambda: self.driver.execute_script(
            "return document.getElementById('textures').own.compared?.azimuth") == azimuth, 300)
        said = self.text("psnr")
        found = MESSAGE.match(said)
        if found:
            return int(found[1]), int(found[2]), float(found[3])
        self.assertEqual(said, "Both painters give the same bytes.")
        return 0, 0, float("inf")

    def go_to(self, scene):
        """Another scene in the same browser, which takes long to start."""
        if not hasattr(self, "driver"):
            return self.open(scene, 720, 340, webgl=True)
        self.driver.get("about:blank")
        self.server.__exit__()
        self.server = Server(browser.PROGRAM, scene, "--threads", 2)
        self.addCleanup(self.server.__exit__)
        self.driver.get(self.server.url)
        self.settle()

    def test_it_draws_the_same_picture(self):
        views = 0
        for scene, (steps, cameras) in VIEWS.items():
            with self.subTest(scene):
                self.go_to(scene)
                with Page(self.server) as looking:
                    world, home = looking.text("world"), looking.rest()[0]["camera"]["azimuth"]
                with self.with_hands() as self.page:
                    self.page.send("speed 100")
                    self.page.send(f"step {steps}")
                    self.page.rest(steps)
                    self.wait(lambda: self.data("step") == str(steps) and self.data("digest"), 120)
                    self.pressed("painter")
                    self.wait(lambda: self.own("fine") == "1", 120)
                    self.pressed("compare")
                    long = sum(n * n for n in world["grid"]) ** 0.5
                    middle = " ".join(str(n / 2) for n in world["grid"])
                    for view in cameras:
                        line = f"camera {view[0]} {view[1]} {view[2] * long} {middle}" if view else "home"
                        different, most, psnr = self.compared(line, view[0] if view else home)
                        print(f"{scene} {steps} {view or 'home'}: {different} pixels differ, by {most}; PSNR {psnr:.1f}", flush=True)
                        self.assertGreater(psnr, LEAST, f"{scene}, {view}")
                        views += 1
                    self.shot(f"difference_{scene}")
                    self.pressed("compare")
                    self.shot(f"own_{scene}")
                self.no_errors()
        self.assertEqual(views, 20)

    def test_the_graphics_processor_holds_what_the_server_has(self):
        self.open("cello", 720, 340, webgl=True)
        self.pressed("painter")
        self.wait(lambda: self.own("step") == "0", 120)
        with self.with_hands() as page:
            page.send("exact 0")
            for step in range(20, 201, 20):
                page.send("step 20")
                self.wait(lambda: self.own("step") == str(step), 120)
            updates = self.driver.execute_script("return document.getElementById('textures').own.updates")
            self.assertGreater(updates, 10)
            textures = Textures(page)
            self.assertEqual(textures.update()["step"], 200)
        for name, shape in textures.shapes.items():
            # A page of the browser gives numbers of 32 bits. Those of the server are of the format's width.
            part = {"u16": 2, "u8x4": 1}.get(shape["format"], 4)
            for z, wanted in enumerate(textures.slices(name)):
                got = base64.b64decode(self.driver.execute_script("""
                    const numbers = document.getElementById('textures').own.painter.textures.slice(arguments[0], arguments[1]);
                    const all = new Uint8Array(numbers.length * arguments[2]);
                    numbers.forEach((v, i) => { for (let b = 0; b < arguments[2]; ++b) all[arguments[2] * i + b] = v >> (8 * b); });
                    let text = '';
                    for (let i = 0; i < all.length; i += 8192) text += String.fromCharCode(...all.subarray(i, i + 8192));
                    return btoa(text);""", name, z, part))
                self.assertEqual(len(got), len(wanted))
                self.assertEqual(got, wanted, f"{name}, slice {z}")
            self.assertEqual(len(wanted), shape["size"][0] * shape["size"][1] * TEXEL[shape["format"]])
        self.no_errors()

    def test_the_camera_is_the_pages_own(self):
        self.open("bunny_small", 720, 340, webgl=True)
        self.pressed("painter")
        self.wait(lambda: self.own("fine") == "1", 60)
        before = self.driver.execute_script("return document.getElementById('textures').toDataURL()")
        self.driver.execute_script("WebSocket.prototype.send = () => {}")  # the server hears nothing any more
        key = "new KeyboardEvent('keydown', { key: 'ArrowLeft', bubbles: true })"
        self.driver.execute_script(f"document.body.dispatchEvent({key})")
        self.wait(lambda: self.driver.execute_script("return document.getElementById('textures').toDataURL()") != before, 60)
        self.assertEqual(self.own("step"), "0")
        self.no_errors()

    def test_keys_choose_the_painter(self):
        self.open("bunny_small", 720, 340, webgl=True)
        key = lambda k: self.driver.execute_script(
            f"document.body.dispatchEvent(new KeyboardEvent('keydown', {{ key: '{k}', bubbles: true }}))")
        shown = lambda name: not self.driver.execute_script(f"return document.getElementById('{name}').hidden")
        self.assertEqual((shown("textures"), shown("difference")), (False, False))
        key("t")
        self.wait(lambda: self.own("fine") == "1", 60)
        self.assertTrue(shown("textures"))
        with self.with_hands() as page:
            page.send("step 3")
            page.rest(3)
            self.wait(lambda: self.own("step") == "3", 60)
            self.assertNotEqual(self.data("digest"), "", "a page at rest knows its digest")
        key("d")
        self.wait(lambda: self.text("psnr") == "Both painters give the same bytes.", 60)
        key("d")
        key("t")
        self.assertEqual((shown("textures"), shown("difference")), (False, False))
        self.no_errors()


if __name__ == "__main__":
    browser.main()
