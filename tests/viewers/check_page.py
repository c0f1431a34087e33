"""Uses the page of `suture view` in a headless Chromium as a person would: load, play, scrub, click, keys, themes.

python3 check_page.py VIEW.html [FOLDER FOR SCREENSHOTS]; exits 77 when there is no Chromium or no python3-websocket."""

import os
import sys
import time

try:
    from browser import Browser, find_chromium
except ImportError as missing:
    print(f"SKIPPED: {missing} (Debian: python3-websocket)")
    sys.exit(77)

program = find_chromium()
if program is None:
    print("SKIPPED: no Chromium here (Debian: chromium)")
    sys.exit(77)

page = "file://" + os.path.abspath(sys.argv[1])
pictures = sys.argv[2] if len(sys.argv) > 2 else None
problems = []


def expect(condition, text):
    if not condition:
        problems.append(text)
        print("FAILED: " + text)


def wait(browser, expression, seconds=60):
    deadline = time.monotonic() + seconds
    while not browser.evaluate(f"Boolean({expression})"):
        if time.monotonic() > deadline:
            return False
        time.sleep(0.05)
    return True


def photograph(browser, name):
    if pictures:
        wait(browser, "!suture.dirty")
        browser.screenshot(os.path.join(pictures, name))


def pixels(browser):
    """A number that changes with the picture."""
    return browser.evaluate("""(() => { const c = document.getElementById('stage');
        const d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;
        let sum = 0; for (let i = 0; i < d.length; i += 4) sum = (sum * 31 + d[i] + 7 * d[i + 1] + 13 * d[i + 2]) % 1000003;
        return sum; })()""")


def check_loading(browser):
    browser.open(page + "#theme=light", "window.suture && suture.drawn > 0")
    expect(browser.evaluate("suture.run.cells > 0 && suture.run.frames > 1"), "no cells or frames were unpacked")
    # What the page draws must be what was stored: area of a drawn cell against the stored field.
    worst = browser.evaluate("""(() => { const run = suture.run, area = run.fields.find(f => f.name === 'area'); let worst = 0;
        for (const frame of [0, run.frames - 1]) { run.place(frame);
          for (let cell = 0; cell < run.cells; ++cell) { let sum = 0; const a = run.first_vertex[cell], b = run.first_vertex[cell + 1];
            for (let v = a; v < b; ++v) { const n = v + 1 === b ? a : v + 1; sum += run.x[v] * run.y[n] - run.x[n] * run.y[v]; }
            worst = Math.max(worst, Math.abs(sum / 2 / run.value(area, frame, cell) - 1)); } }
        suture.dirty = true; return worst; })()""")
    expect(worst < 2e-3, f"drawn and stored cell areas differ by {worst}")
    expect(len(browser.evaluate("document.getElementById('facts').textContent")) > 20, "no facts about the run")


def check_playing(browser):
    before, picture = browser.evaluate("suture.time"), pixels(browser)
    browser.press(" ", "Space", " ")
    expect(wait(browser, f"suture.time > {before} && suture.drawn > 3"), "space does not play")
    browser.press(" ", "Space", " ")
    expect(browser.evaluate("!suture.playing"), "space does not pause")
    expect(pixels(browser) != picture, "playing does not change the picture")


def measure_drawing(browser, count=300):
    """Frames, and the milliseconds of processor time one picture takes, of `count` spread over the run. Reported, not judged:
    it depends on the machine. 30 pictures per second leave 33 ms for each."""
    def seconds():
        return {m["name"]: m["value"] for m in browser.send("Performance.getMetrics")["metrics"]}["TaskDuration"]

    browser.send("Performance.enable", timeDomain="threadTicks")
    before = seconds()
    frames = browser.evaluate(f"""(() => {{ const before = suture.time, pixels = document.getElementById('stage').getContext('2d');
        for (let k = 0; k < {count}; ++k) {{ suture.time = suture.run.duration * k / {count - 1}; suture.draw();
          pixels.getImageData(0, 0, 1, 1); }}  // waits until the picture is there
        suture.time = before; suture.dirty = true; return suture.run.frames; }})()""")
    return frames, 1000.0 * (seconds() - before) / count


def measure_playing(browser, seconds=3):
    """Pictures per second while the page plays. Reported, not judged; the browser draws no more than 60."""
    return browser.evaluate(f"""new Promise(done => {{ suture.time = 0; suture.play(); const drawn = suture.drawn, begin = performance.now();
        setTimeout(() => {{ const rate = (suture.drawn - drawn) / (performance.now() - begin) * 1000;
          suture.pause(); suture.time = 0; suture.dirty = true; done(rate); }}, {1000 * seconds}); }})""")


def check_scrubbing(browser):
    box = browser.evaluate("(() => { const b = document.getElementById('timeline').getBoundingClientRect(); return [b.left, b.top, b.width]; })()")
    left, right = browser.evaluate("[suture.timeline.left, suture.timeline.right]")
    for share in (0.75, 0.25):
        browser.click(box[0] + left + share * (box[2] - left - right), box[1] + 30)
        seen = browser.evaluate("suture.time / suture.run.duration")
        expect(abs(seen - share) < 0.01, f"clicking the time line at {share} leads to {seen}")
    frame = browser.evaluate("Math.round(suture.run.frameAt(suture.time))")
    browser.press("ArrowRight")
    expect(browser.evaluate("suture.run.frameAt(suture.time)") == frame + 1, "the right arrow is not one frame")
    browser.press("End")
    expect(browser.evaluate("suture.time === suture.run.duration"), "the key End does not lead to the end")


def check_clicking(browser):
    for cell in (0, browser.evaluate("suture.run.cells - 1")):
        browser.press("Escape")
        expect(browser.evaluate("suture.selected === null"), "the key Escape leaves a cell selected")
        point = browser.evaluate(f"""(() => {{ suture.draw(); const run = suture.run; let x = 0, y = 0;
            const a = run.first_vertex[{cell}], b = run.first_vertex[{cell} + 1];
            for (let v = a; v < b; ++v) {{ x += run.x[v] / (b - a); y += run.y[v] / (b - a); }}
            const p = suture.stage.toPixel(x, y), r = document.getElementById('stage').getBoundingClientRect();
            return [p[0] + r.left, p[1] + r.top]; }})()""")
        browser.click(*point)
        expect(browser.evaluate("suture.selected") == cell, f"clicking cell {cell} selects {browser.evaluate('suture.selected')}")
        expect(browser.evaluate("!document.getElementById('cell-plots').hidden && suture.cellPlots[0].values.length === suture.run.frames"),
               f"cell {cell} has no history")
    photograph(browser, "light.png")


def check_fields(browser):
    seen = set()
    count = browser.evaluate("suture.fields.length")
    for key in range(1, count + 1):
        browser.press(str(key), f"Digit{key}", str(key))
        wait(browser, "!suture.dirty")
        seen.add(pixels(browser))
    expect(len(seen) == count, f"{count} fields give {len(seen)} different pictures")
    expect(browser.evaluate("document.getElementById('colour-label').textContent.length > 5"), "the colour bar has no label")


def check_themes(browser):
    colour = "getComputedStyle(document.body).backgroundColor"
    light = browser.evaluate(colour)
    browser.evaluate("document.getElementById('theme').click()")
    expect(browser.evaluate(colour) != light, "the theme button changes nothing")
    photograph(browser, "dark.png")
    browser.send("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark"}])
    browser.open(page, "window.suture && suture.drawn > 0")
    expect(browser.evaluate("document.documentElement.dataset.theme") == "dark", "prefers-color-scheme is not obeyed")


browser = Browser(program)
try:
    frames, cost, rate = 0, 0.0, 0.0
    for check in (check_loading, check_playing, check_scrubbing, check_clicking, check_fields, check_themes):
        check(browser)
        if check is check_playing:
            frames, cost = measure_drawing(browser)
            rate = measure_playing(browser)
    for problem in browser.problems:
        expect(False, problem)
finally:
    browser.close()
print(f"page: {len(problems)} problems" if problems else
      f"page: loads, plays, scrubs, clicks, colours, themes; {frames} frames, "
      f"{rate:.0f} pictures a second while playing, {cost:.1f} ms of processor time for one")
sys.exit(1 if problems else 0)
