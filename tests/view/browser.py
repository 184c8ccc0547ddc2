"""A page of `voxmelt view` in a real browser, for tests: PROGRAM [FOLDER for screenshots] are their arguments."""
import shutil
import sys
import time
import unittest
from pathlib import Path

sys.path.append("/usr/lib/python3/dist-packages")  # where Debian has selenium, whichever Python this is
try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.by import By
except ImportError:
    webdriver = None
from page import Page, Server

PROGRAM = str(Path(sys.argv[1]).resolve())
SHOTS = Path(sys.argv[2]) if len(sys.argv) > 2 and sys.argv[2] else None


def main():
    if webdriver is None or not shutil.which("chromium") or not shutil.which("chromedriver"):
        print("skipped: there is no chromium, chromium-driver or python3-selenium")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])


def browser(width, height, dark=False, webgl=False):
    """A browser without a screen. Its WebGL is a program's, which any machine can run."""
    drawing = ("--use-angle=swiftshader", "--enable-unsafe-swiftshader") if webgl else ("--disable-gpu",)
    options = webdriver.ChromeOptions()
    for word in ("--headless=new", "--no-sandbox", *drawing, f"--window-size={width},{height}",
                 "--force-dark-mode" if dark else "--disable-dark-mode"):
        options.add_argument(word)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    driver = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)
    # The window's inside shall be that large, whatever its frame takes.
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                           {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 500})
    if dark:
        driver.execute_cdp_cmd("Emulation.setEmulatedMedia",
                               {"features": [{"name": "prefers-color-scheme", "value": "dark"}]})
    return driver


class InBrowser(unittest.TestCase):
    def open(self, scene, width=1280, height=800, dark=False, webgl=False):
        self.server = Server(PROGRAM, scene, "--threads", 2)
        self.addCleanup(self.server.__exit__)
        self.driver = browser(width, height, dark, webgl)
        self.addCleanup(self.driver.quit)
        self.driver.set_script_timeout(300)
        self.driver.get(self.server.url)
        self.settle()

    def wait(self, what, seconds=20):
        end = time.monotonic() + seconds
        while not (found := what()):
            self.assertLess(time.monotonic(), end, "it does not come")
            time.sleep(0.05)
        return found

    def settle(self):
        """A page may get a picture before the server knows how large its window is."""
        seen = []
        self.wait(lambda: self.data("digest") and (seen.append(self.pixels()) or seen[-2:-1] == seen[-1:] or time.sleep(0.3)), 60)

    def with_hands(self):
        """A page of its own that has the hands: the one in the browser gives them, and looks on."""
        page = Page(self.server)
        page.send("hands")
        self.wait(lambda: self.driver.execute_script("return !document.getElementById('hands').hidden"))
        self.driver.execute_script("document.getElementById('hands-button').click()")
        while not page.text("hands")["yours"]:
            pass
        return page

    def data(self, name):
        return self.driver.execute_script(f"return document.getElementById('picture').dataset.{name}")

    def element(self, name):
        return self.driver.find_element(By.ID, name)

    def pixels(self):
        return self.driver.execute_script("return document.getElementById('picture').toDataURL()")

    def no_errors(self):
        wrong = [line for line in self.driver.get_log("browser") if line["level"] == "SEVERE"]
        self.assertEqual(wrong, [])

    def shot(self, name):
        if SHOTS:
            SHOTS.mkdir(parents=True, exist_ok=True)
            self.driver.save_screenshot(str(SHOTS / f"{name}.png"))
