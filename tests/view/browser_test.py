#!/usr/bin/env python3
"""The page of `voxmelt view` in a real browser: browser_test.py VOXMELT [FOLDER for screenshots]

Gestures of mouse, wheel, keys and panel change what they say; nothing is cut off from 320 x 480 to 3840 x 2160, light and
dark; there is no error in the console. Skipped (77) without chromium, chromium-driver and python3-selenium."""
import sys
import time
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent))
import browser
from browser import InBrowser
from page import Page, Server

if browser.webdriver:
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.actions.wheel_input import ScrollOrigin
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys


class BrowserTest(InBrowser):
    def changes_picture(self, gesture):
        """The gesture, and that the picture at rest is another one then."""
        before, step = self.pixels(), self.data("step")
        gesture()
        self.wait(lambda: self.pixels() != before and self.data("digest"))
        self.assertEqual(self.data("step"), step)

    def test_six_scenes_open(self):
        for scene in ("cello", "goblet_viscous", "ice", "lava", "bunny_small", "lesson_sun"):
            self.open(scene)
            self.assertGreater(len(self.pixels()), 20000, scene)
            self.assertIn(scene, self.driver.title)
            self.shot(f"scene_{scene}")
            self.no_errors()
            self.driver.quit()
            self.server.__exit__()

    def test_gestures_turn_move_and_come_nearer(self):
        self.open("bunny_small")
        canvas = self.element("picture")
        hand = lambda: ActionChains(self.driver, duration=50)
        self.changes_picture(lambda: hand().move_to_element_with_offset(canvas, -250, 150).click_and_hold()
                             .move_by_offset(90, 30).release().perform())
        self.changes_picture(lambda: hand().key_down(Keys.SHIFT).move_to_element_with_offset(canvas, -250, 150)
                             .click_and_hold().move_by_offset(40, 60).release().key_up(Keys.SHIFT).perform())
        self.changes_picture(lambda: hand().scroll_from_origin(ScrollOrigin.from_element(canvas), 0, -300).perform())
        for key in (Keys.ARROW_LEFT, Keys.ARROW_UP, "+", "-", "h"):
            self.changes_picture(lambda: hand().send_keys(key).perform())
        self.no_errors()

    def test_time_goes_by_buttons_and_keys(self):
        self.open("bunny_small")
        first = self.data("digest")
        self.element("single").click()
        self.wait(lambda: self.data("step") == "1" and self.data("digest"))
        ActionChains(self.driver).send_keys(".").perform()
        self.wait(lambda: self.data("step") == "2" and self.data("digest"))
        self.element("play").click()
        self.wait(lambda: int(self.data("step")) > 40)
        self.assertEqual(self.element("play").text, "Pause")
        ActionChains(self.driver).send_keys(" ").perform()
        self.wait(lambda: self.data("digest") and self.element("play").text == "Play")
        self.shot("played")
        self.element("restart").click()
        self.wait(lambda: self.data("step") == "0" and self.data("digest"))
        self.assertEqual(self.data("digest"), first)
        self.element("best").click()
        self.wait(lambda: self.data("quality") == "best")
        self.no_errors()

    def world(self):
        """What the server says of sources and vents, by a page of its own."""
        with Page(self.server) as page:
            return page.text("world")

    def test_sources_and_vents_by_hand(self):
        self.open("bunny_small")
        before = self.world()["heat_sources"][0]["keyframes"][0]
        ring = self.wait(lambda: self.driver.find_elements(By.CSS_SELECTOR, "#handles .ring"))[0]
        hand = ActionChains(self.driver, duration=50)
        hand.move_to_element(ring).click_and_hold().move_by_offset(-120, 40).release().perform()
        moved = self.wait(lambda: (now := self.world()["heat_sources"][0]["keyframes"][0]) != before and now)
        self.assertEqual(moved["at"][1], before["at"][1], "along the floor")
        slider = self.driver.find_element(By.CSS_SELECTOR, "#sources input")
        self.driver.execute_script("arguments[0].value = 0.5; arguments[0].dispatchEvent(new Event('input'))", slider)
        self.wait(lambda: abs(self.world()["heat_sources"][0]["keyframes"][0]["power"] / before["power"] - 10**0.5) < 1e-3)
        self.element("add-source").click()
        self.wait(lambda: len(self.world()["heat_sources"]) == 2)
        self.wait(lambda: len(self.driver.find_elements(By.CSS_SELECTOR, "#sources button[title$='.remove']")) == 2)
        self.driver.find_elements(By.CSS_SELECTOR, "#sources button[title$='.remove']")[1].click()
        self.wait(lambda: len(self.world()["heat_sources"]) == 1)
        self.element("add-vent").click()
        canvas = self.element("picture")
        ActionChains(self.driver, duration=50).move_to_element_with_offset(canvas, -60, -30).click().perform()
        self.shot("vent")
        self.wait(lambda: len(self.world()["vents"]) == 1)
        self.assertIn("cell", self.element("probe").text)
        self.shot("by_hand")
        self.no_errors()

    def test_switches_and_kinds(self):
        self.open("bunny_small")
        first = self.world()["heat_sources"][0]["keyframes"][0]
        press = lambda title: self.wait(lambda: self.driver.find_elements(By.CSS_SELECTOR, f"#panel button[title^='{title}']"))[0].click()
        power = lambda: self.world()["heat_sources"][0]["keyframes"][0]["power"]
        press("heat_source.0.power")
        self.wait(lambda: power() == 0)
        self.shot("source_off")
        self.driver.refresh()  # a page that is loaded again still knows the power
        self.settle()
        press("heat_source.0.power")
        self.wait(lambda: power() == first["power"])
        choose = lambda kind: self.driver.execute_script(
            "const s = document.querySelector('#sources select'); s.value = arguments[0]; s.dispatchEvent(new Event('change'))", kind)
        for kind in ("directional", "sky", "sphere", "point"):
            choose(kind)
            self.wait(lambda: self.world()["heat_sources"][0]["kind"] == kind)
            self.wait(lambda: self.driver.execute_script("return document.querySelector('#sources select').value") == kind)
        grid = self.world()["grid"]
        choose("directional")
        self.wait(lambda: self.world()["heat_sources"][0]["kind"] == "directional")
        choose("point")
        self.wait(lambda: self.world()["heat_sources"][0]["kind"] == "point")
        back = self.world()["heat_sources"][0]["keyframes"][0]
        self.assertGreater(back["power"] / max(grid)**2, 0)
        with Page(self.server) as page:
            page.send("save scene")
            self.assertIn("[[change]]", page.file()[1].decode())
        self.element("add-vent").click()
        ActionChains(self.driver, duration=50).move_to_element_with_offset(self.element("picture"), -60, -30).click().perform()
        self.wait(lambda: [one["open"] for one in self.world()["vents"]] == [True])
        for word, is_open in (("off", False), ("on", True)):
            press(f"vent.0.{word}")
            self.wait(lambda: self.world()["vents"][0]["open"] == is_open)
        self.shot("switches")
        self.no_errors()

    def journal(self):
        with Page(self.server) as page:
            page.send("save journal")
            return page.file()[1].decode().splitlines()[1:]

    def test_a_ball_pours_and_carves(self):
        self.open("bunny_small")
        canvas = self.element("picture")
        camera = self.driver.execute_script("return document.querySelector('#handles .ring').getAttribute('cx')")
        for key, numbers in (("p", ["5", "0.9"]), ("c", ["5"])):
            before, lines = self.pixels(), len(self.journal())
            ActionChains(self.driver, duration=50).send_keys(key).move_to_element_with_offset(canvas, -80, -60).perform()
            ring = self.driver.find_element(By.CSS_SELECTOR, "#handles .ball")
            self.wait(lambda: ring.is_displayed() and abs(float(ring.get_attribute("cx")) - 420) < 2)
            self.shot(f"ball_{key}")
            ActionChains(self.driver, duration=50).click_and_hold().release().perform()
            self.wait(lambda: len(self.journal()) > lines)
            words = self.journal()[-1].split()
            self.assertEqual(words[:2] + words[5:], ["0", {"p": "pour", "c": "carve"}[key], *numbers])
            self.wait(lambda: self.pixels() != before and self.data("digest"))
        after = self.driver.execute_script("return document.querySelector('#handles .ring').getAttribute('cx')")
        self.assertEqual(after, camera, "the camera stays")
        ActionChains(self.driver).send_keys("c").perform()
        self.wait(lambda: self.element("carve").get_attribute("aria-pressed") == "false")
        self.no_errors()

    def test_sliders_suns_and_drains(self):
        self.open("bunny_small")
        said = self.world()["numbers"]
        slider = self.driver.find_element(By.CSS_SELECTOR, "#said input[title='heat.gamma']")
        self.driver.execute_script("arguments[0].value = -1; arguments[0].dispatchEvent(new Event('input'))", slider)
        self.wait(lambda: abs(self.world()["numbers"]["heat.gamma"] / said["heat.gamma"] - 0.1) < 1e-4)
        self.element("add-sun").click()
        self.wait(lambda: [one["kind"] for one in self.world()["heat_sources"]] == ["point", "directional"])
        self.element("add-sky").click()
        self.wait(lambda: len(self.world()["heat_sources"]) == 3)
        self.element("add-drain").click()
        ActionChains(self.driver, duration=50).move_to_element_with_offset(self.element("picture"), -60, -30).click().perform()
        self.wait(lambda: len(self.world()["drains"]) == 1)
        self.assertIn("the drift is 0", self.element("drift").text)
        self.shot("panel")
        self.no_errors()

    def colour(self, x, y):
        """Of the picture, at a share of its width and height."""
        return self.driver.execute_script("""
            const canvas = document.getElementById('picture');
            const at = [Math.floor(arguments[0] * canvas.width), Math.floor(arguments[1] * canvas.height)];
            return [...canvas.getContext('2d').getImageData(...at, 1, 1).data].slice(0, 3);""", x, y)

    def test_false_colours_and_a_cut(self):
        self.open("lesson_sun")
        hand = lambda key: ActionChains(self.driver).send_keys(key).perform()
        exact = self.pixels()
        shown = lambda: self.driver.execute_script("return ['colours', 'cut-axis'].map((id) => document.getElementById(id).value)")
        self.assertFalse(self.element("legend").is_displayed())
        for colours in ("phase", "temperature", "sleep"):
            self.changes_picture(lambda: hand("f"))
            self.assertEqual(shown(), [colours, "none"])
            self.assertIn("not the exact picture", self.element("legend").text)
            self.shot(f"cells_{colours}")
        self.assertIn("asleep", self.element("legend").text)
        hand("f")
        self.wait(lambda: self.pixels() == exact and self.data("digest"))
        self.assertEqual(shown(), ["none", "none"])
        # A cut alone wants cells, too.
        self.changes_picture(lambda: hand("x"))
        self.assertEqual(shown(), ["phase", "x"])
        self.shot("cells_cut")
        slider, most = self.element("cut-at"), int(self.element("cut-at").get_attribute("max"))
        self.assertEqual(self.element("cut-place").text, f"{most // 2} of {most}")
        move = lambda to: self.driver.execute_script(
            "arguments[0].value = arguments[1]; arguments[0].dispatchEvent(new Event('input'))", slider, to)
        self.changes_picture(lambda: move(most // 4))
        hand("]")
        self.wait(lambda: self.element("cut-place").text == f"{most // 4 + 1} of {most}")
        self.changes_picture(lambda: move(0))
        self.assertEqual(self.colour(0.5, 0.5), [232, 236, 240], "all is cut off")
        # Another page may show something else.
        with self.with_hands() as page:
            page.send("cells sleep y 9")
            self.wait(lambda: shown() == ["sleep", "y"] and self.element("cut-at").get_attribute("value") == "9")
            hand("f")
            self.assertEqual(shown(), ["sleep", "y"], "who looks on chooses nothing")
        self.no_errors()

    def test_back_in_time(self):
        self.open("bunny_small")
        first = self.data("digest")
        for key, step in ((".", "1"), (".", "2"), (".", "3"), (",", "2")):
            ActionChains(self.driver).send_keys(key).perform()
            self.wait(lambda: self.data("step") == step and self.data("digest"))
        slider = self.element("past")
        self.driver.execute_script("arguments[0].value = 0; arguments[0].dispatchEvent(new Event('change'))", slider)
        self.wait(lambda: self.data("step") == "0" and self.data("digest") == first)
        self.no_errors()

    def test_a_second_page_looks_on(self):
        self.open("bunny_small")
        with Page(self.server) as page:
            page.send("hands")
            self.wait(lambda: "asks for the hands" in self.element("hands-text").text)
            self.element("hands-button").click()
            self.wait(lambda: "You look on" in self.element("hands-text").text)
            self.shot("looks_on")
            self.element("single").click()
            time.sleep(0.5)
            self.assertEqual((self.data("step"), self.element("notice").text), ("0", ""))
            page.send("step 2")
            self.wait(lambda: self.data("step") == "2")
        self.wait(lambda: not self.element("hands").is_displayed())
        self.no_errors()

    def test_numbers_are_set_and_refused(self):
        self.open("bunny_small")
        key = self.element("key")
        key.find_element(By.CSS_SELECTOR, "option[value='heat.gamma']").click()
        self.element("value").send_keys("7" + Keys.ENTER)
        self.wait(lambda: "heat.gamma = 7" in self.element("notice").text)
        self.shot("refused")
        self.element("value").clear()
        self.element("value").send_keys("0.2" + Keys.ENTER)
        self.wait(lambda: self.data("digest"))
        self.no_errors()

    def test_a_server_that_goes_is_said_and_one_that_comes_is_found(self):
        self.open("bunny_small")
        port = self.server.port
        self.server.__exit__()
        self.wait(lambda: "server is not there" in self.element("notice").text)
        self.shot("gone")
        self.server = Server(browser.PROGRAM, "bunny_small", "--port", port)
        self.addCleanup(self.server.__exit__)
        self.wait(lambda: self.element("notice").text == "", 30)

    def test_every_window(self):
        for width, height in ((320, 480), (390, 844), (1280, 800), (1920, 1080), (3840, 2160)):
            for dark in (False, True):
                self.open("lesson_sun", width, height, dark)
                over = self.driver.execute_script("""
                    const wide = document.documentElement.scrollWidth - document.documentElement.clientWidth;
                    const cut = [...document.querySelectorAll('#panel button, #panel input, #panel h1, #panel p')]
                      .filter((e) => e.offsetParent && e.scrollWidth > e.clientWidth + 2).map((e) => e.id || e.textContent);
                    return [wide, cut];""")
                self.assertEqual(over, [0, []], f"{width} x {height}")
                picture = self.element("picture").size
                self.assertGreater(min(picture["width"], picture["height"]), 190)
                self.shot(f"window_{width}x{height}{'_dark' if dark else ''}")
                self.no_errors()
                self.driver.quit()
                self.server.__exit__()


if __name__ == "__main__":
    browser.main()
