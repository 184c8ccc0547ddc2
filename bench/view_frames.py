#!/usr/bin/env python3
"""How many frames a second `voxmelt view` sends: bench/view_frames.py [VOXMELT] [SCENE...]

A page without a browser plays each scene from the middle of its melting, at 640 x 480 and three steps a frame, and takes every
frame. So this is what the server alone gives, on the exact painter. Each row is the best of three seconds-long plays. With
--browser a headless Chromium shows the page on the same processors: what is left is what a user sees. The second table is of
pages that draw by themselves, from textures: what the server does for a frame, and what it sends. What --browser prints of
all scenes stays in bench/performance_view.md."""
import os
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "tests" / "view"))
from page import Page, Server
from textures import Textures

SCENES = {"cello": 1000, "goblet": 600, "lava": 600}
PLAYS, SECONDS, UPDATES, STEPS = 3, 4.0, 40, 3


def processor_seconds(server):
    """What the server has used."""
    words = Path(f"/proc/{server.process.pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(words[11]) + int(words[12])) / os.sysconf("SC_CLK_TCK")


def played(server, page):
    """Frames a second, mean bytes of a frame, mean milliseconds of its parts, and busy processors, of one play."""
    page.send("play 1")
    while page.hear()[0] != "frame":
        pass
    frames, size, parts, begin, used = 0, 0, {}, time.monotonic(), processor_seconds(server)
    while time.monotonic() - begin < SECONDS:
        heard = page.hear()
        if heard[0] != "frame" or not heard[1]["playing"]:
            continue
        frames += 1
        size += len(heard[2])
        for part, ms in heard[1]["ms"].items():
            parts[part] = parts.get(part, 0) + ms
    seconds, used = time.monotonic() - begin, processor_seconds(server) - used
    page.send("play 0")
    page.rest()
    return frames / seconds, size / frames, {part: ms / frames for part, ms in parts.items()}, used / seconds


def updates(page, step):
    """Of frames from textures: the least milliseconds of the update and of packing, and the mean bytes, packed and as a share of all textures."""
    textures = Textures(page)
    page.send("exact 0")
    textures.update()
    volume = textures.bytes(*textures.shapes)
    heads, packed, raw = [], 0, 0
    for _ in range(UPDATES):
        page.send(f"step {STEPS}")
        step += STEPS
        while (head := textures.update())["step"] != step:
            pass
        heads.append(head["ms"])
        packed += textures.packed
        raw += sum(len(data) for data in textures.sent.values())
    least = lambda part: min(ms[part] for ms in heads)
    return least("step"), least("draw"), least("encode"), packed / UPDATES, raw / UPDATES / volume


def in_browser(server):
    """Frames a second that a headless Chromium shows."""
    sys.argv[1:] = [server.process.args[0]]  # what the module of the tests wants to know
    import browser
    driver = browser.browser(1200, 900)
    try:
        driver.get(server.url)
        wide, high = driver.execute_script("const box = document.getElementById('stage').getBoundingClientRect(); return [box.width, box.height]")
        driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {"width": round(1200 + 640 - wide), "height": round(900 + 480 - high),
                                                                      "deviceScaleFactor": 1, "mobile": False})
        driver.execute_script("""window.shown = 0;
            new MutationObserver(() => ++window.shown).observe(document.getElementById('picture'),
                                                               {attributes: true, attributeFilter: ['data-step']});""")
        shown = lambda: driver.execute_script("return window.shown")
        seen = "return document.getElementById('picture').dataset.step"
        while not driver.execute_script(seen):  # the first picture may have come before anyone looked
            time.sleep(0.1)
        driver.execute_script("document.getElementById('play').click()")
        time.sleep(1.5)
        first, begin = shown(), time.monotonic()
        time.sleep(SECONDS)
        return (shown() - first) / (time.monotonic() - begin)
    finally:
        driver.quit()


def main():
    browsed, words = "--browser" in sys.argv, [word for word in sys.argv[1:] if word != "--browser"]
    program = str(Path(words[0] if words else ROOT / "build/release/app/voxmelt").resolve())
    drawn, sent = [], []
    for scene in words[1:] or SCENES:
        first = SCENES.get(scene, 300)
        with Server(program, scene, cwd=ROOT) as server:
            with Page(server) as page:
                page.rest(0)
                page.send("size 640 480")
                page.send("speed 100")
                page.send(f"step {first}")
                page.rest(first)
                page.send(f"speed {STEPS}")
                least = updates(page, first)
                page.send("exact 1")
                page.rest()
                rate, size, ms, busy = max((played(server, page) for _ in range(PLAYS)), key=lambda play: play[0])
            parts = ", ".join(f"{ms[part]:.1f}" for part in ("step", "draw", "encode"))
            shown = f", {in_browser(server):.1f} in Chromium" if browsed else ""
            drawn.append(f"| `{scene}` | {first} | {rate:.1f}{shown} | {size / 1000:.1f} | {parts} | {busy:.2f} |\n")
            sent.append(f"| `{scene}` | {first} | {least[0]:.2f} | {least[1]:.2f} | {least[2]:.2f} | {least[3] / 1000:.1f} | {least[4]:.1%} |\n")
    tables = "| scene | from step | frames a second | KB a frame | ms a frame: step, draw, encode | processors busy |\n"
    tables += "|---|--:|--:|--:|--:|--:|\n" + "".join(drawn)
    tables += "\n| scene | from step | step, ms | update, ms | pack, ms | KB a frame | of all textures, unpacked |\n"
    tables += "|---|--:|--:|--:|--:|--:|--:|\n" + "".join(sent)
    print(tables, end="")
    if browsed and not words[1:]:
        (ROOT / "bench" / "performance_view.md").write_text(tables)


main()
