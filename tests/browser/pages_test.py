#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""pages_test.py SEAGLINT SOURCE: the report of a small run, a comparison and hot spots in headless Chromium, from files and without a
network, by what they show after clicks and keys. Exit code 77: a package of Debian is missing."""
import pathlib
import subprocess
import sys
import tempfile
import time

SMALL = ("--set", "learning.epochs=3")


def browser(*preferences):
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    options = webdriver.ChromeOptions()
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--window-size=1280,1600", "--host-resolver-rules=MAP * ~NOTFOUND"):
        options.add_argument(argument)
    for key, value in preferences:
        options.add_experimental_option(key, value)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)


def wait(condition, what, seconds=60):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, what
        time.sleep(0.1)


def check_report(page, picture):
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
    with browser() as driver:
        driver.get(page.as_uri())
        find = lambda css: driver.find_elements(By.CSS_SELECTOR, css)
        shown = lambda: [int(e.get_attribute("data-sample")) for e in find("#explorer [data-sample]") if e.is_displayed()]
        driver.execute_script("document.getElementById('explorer').scrollIntoView()")
        wait(lambda: len(shown()) == 2, "one map of each target")
        before = shown()
        assert not any(e.is_displayed() for e in find("#maps .static img")), "the pictures give way to the maps"
        # The map of the page has its strongest cell at 0 dB and is as large as its axes.
        heat = driver.execute_script("const t = document.querySelector('#explorer [data-sample]').data[0]; return [Math.max(...t.z.flat()), t.z.length === t.y.length && t.z[0].length === t.x.length];")
        assert heat == [0, True], heat
        slider = find("#aspect")[0]  # by the keyboard
        slider.send_keys(Keys.ARROW_RIGHT if slider.get_attribute("value") == "0" else Keys.ARROW_LEFT)
        wait(lambda: shown() and shown() != before, "another aspect shows other maps")
        find("#explorer input[type=checkbox]")[0].click()
        wait(lambda: len(shown()) == 1, "a target that is switched off has no map")
        driver.execute_script("document.getElementById('scatter').scrollIntoView()")
        points = lambda: int((find("#scatter [data-points]") or [driver.find_element(By.TAG_NAME, "body")])[0].get_attribute("data-points") or -1)
        wait(lambda: points() == 40, "every sample is a point")
        find("#scatter input[type=checkbox]")[1].click()
        wait(lambda: points() == 20, "a target that is switched off has no points")
        find("#scatter input[type=checkbox]")[1].click()
        wait(lambda: points() == 40, "and has them again")
        # A click of the mouse on a point opens its map, or that of one within plotly's 20 pixels.
        x, y, near = driver.execute_script("""const plot = document.querySelector('#scatter [data-points]'), { xaxis, yaxis } = plot._fullLayout, [a, b] = [plot.data[0].x[0], plot.data[0].y[0]];
          const box = plot.getBoundingClientRect(), at = [xaxis._offset + xaxis.d2p(a), yaxis._offset + yaxis.d2p(b)];
          return [at[0] - box.width / 2, at[1] - box.height / 2, plot.data.flatMap((t) => t.x.map((x, i) => [x, t.y[i], t.customdata[i]])).filter(([x, y]) => Math.hypot(xaxis.d2p(x) - xaxis.d2p(a), yaxis.d2p(y) - yaxis.d2p(b)) < 21).map((p) => String(p[2]))];""")
        ActionChains(driver).move_to_element_with_offset(find("#scatter [data-points]")[0], x, y).pause(0.5).click().perform()
        chosen = lambda: [e.get_attribute("data-sample") for e in find(".chosen [data-sample]")]
        wait(lambda: chosen() and find("#sample")[0].get_attribute("value") == chosen()[0], "a click opens a map")
        assert chosen()[0] in near, (chosen(), near)
        find("#sample")[0].clear()
        find("#sample")[0].send_keys("99", Keys.TAB)
        wait(lambda: "no sample 99" in find(".chosen p")[0].text, "an unknown sample is named")
        driver.execute_script("document.getElementById('accuracy').scrollIntoView()")
        wait(lambda: find("#accuracy figure.drawn .interactive .trace, #accuracy figure.drawn .interactive .scatterlayer"), "accuracy curves")
        curves = lambda: driver.execute_script("return [...document.querySelectorAll('#accuracy figure.drawn .interactive')].map((p) => p.data.map((t) => t.name))")
        wait(lambda: sum(any("AUC" in name for name in names) for names in curves()) == 2, "a ROC for each protocol")
        assert driver.execute_script("return document.documentElement.scrollWidth <= document.documentElement.clientWidth"), "nothing is wider than the window"
        errors = [entry for entry in driver.get_log("browser") if entry["level"] == "SEVERE"]
        assert not errors, errors
        seconds = driver.execute_script("const t = performance.getEntriesByType('navigation')[0]; return t.domContentLoadedEventEnd / 1000")
        print(f"{page.stat().st_size / 1e6:.2f} MB, document ready after {seconds:.2f} s")
        driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
        assert all(e.is_displayed() for e in find("figure img")) and not any(e.is_displayed() for e in find(".interactive")), "paper has the pictures"
        driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})
        if picture:
            driver.execute_script("window.scrollTo(0, 0)")
            driver.save_screenshot(picture)


def check_hot_spots(seaglint, source, folder):
    """A report with meshes: the reflector array of quick.yaml beside the same reflector at another spacing."""
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
    scenario = folder / "corners.yaml"
    mesh = f"mesh: {source}/assets/icosahedral_reflector.glb, motion: {{model: float}}"
    scenario.write_text(f"""seaglint: 1
name: corners
view: {{azimuth_deg: [10, 60], elevation_deg: 2}}
targets: {{near: {{label: 1, {mesh}}}, apart: {{label: 0, {mesh}, layout: {{line: {{count: 2, spacing_m: 40}}}}}}}}
dataset: {{maps_per_case: 4, realisations_per_case: 4}}
learning: {{epochs: 1}}
""", encoding="utf-8")
    subprocess.run([seaglint, "run", scenario, "-o", folder / "corners"], check=True, stdout=subprocess.DEVNULL)
    with browser() as driver:
        driver.get((folder / "corners/report.html").as_uri())
        find = lambda css: driver.find_elements(By.CSS_SELECTOR, css)
        driver.execute_script("document.getElementById('hot-spots').scrollIntoView()")
        shown = lambda: (find("#hot-spots [data-shown]") or [driver.find_element(By.TAG_NAME, "body")])[0].get_attribute("data-shown")
        wait(lambda: shown() == "0,0", "the first target at the first view")
        surface = lambda: driver.execute_script("const t = document.querySelector('#hot-spots [data-shown]').data[0]; return [t.i.length, t.intensity.length, Math.max(...t.i, ...t.j, ...t.k) + 1 === t.x.length, Math.max(...t.x) - Math.min(...t.x), t.intensity]")
        facets, levels, indexed, extent, first = surface()
        assert facets == levels == 60 and indexed and abs(extent - 0.795061) < 1e-4, (facets, levels, indexed, extent)
        find("#hot-spot-view")[0].send_keys(Keys.ARROW_RIGHT)
        wait(lambda: shown() == "0,1", "another view")
        assert surface()[4] != first, "another view has other levels"
        find("#hot-spot-target")[0].send_keys(Keys.ARROW_DOWN)
        wait(lambda: shown() == "1,1", "the other target")
        errors = [entry for entry in driver.get_log("browser") if entry["level"] == "SEVERE"]
        assert not errors, errors


def check_hot_spot_page(seaglint, source, folder):
    """The page of one aspect: what a keyboard chooses and turns, in a narrow window and on paper."""
    import json
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
    page = folder / "spots.html"
    subprocess.run([seaglint, "rcs", "--target", f"{source}/assets/icosahedral_reflector.glb", "--frequency-ghz", "16", "--azimuth-deg", "30", "--elevation-deg", "3", "-o", folder / "spots.csv",
                    "--export-hot-spots", page], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    assert page.stat().st_size < 5e6
    with browser() as driver:
        driver.get(page.as_uri())
        find = lambda css: driver.find_elements(By.CSS_SELECTOR, css)
        plot = lambda name: (find("#hot-spots [data-shown]") or [find("body")[0]])[0].get_attribute("data-" + name)
        wait(lambda: plot("shown") == "0,0,0", "the largest of the elements")
        centres = json.loads(plot("centres"))
        assert len(centres) == 5 and centres[0][:2] == ["cell_03", 3] and abs(centres[0][2] - 21.0) < 0.3, centres
        scene = lambda: driver.execute_script("const p = document.querySelector('#hot-spots .js-plotly-plot'); return [p.layout.scene.camera.eye, p.layout.scene.annotations, p.data.map((t) => t.name)]")
        wait(lambda: len(scene()[1]) == 5, "names of the five strongest")
        eye, names, traces = scene()
        direction = [(12 * v) for v in (0.864832, 0.499312, 0.052336)]  # of azimuth 30 deg, elevation 3 deg
        assert all(abs(eye[c] - v) < 1e-3 for c, v in zip("xyz", direction)), eye
        assert any("cell_03" in name["text"] and "3 bounces<br>21.0 dBsm" in name["text"] for name in names), names
        assert traces[1:4] == ["reflections", "edge diffraction", "z = 0"], traces
        # No name covers another.
        boxes = sorted([b["x"], b["x"] + b["width"]] for b in driver.execute_script("return [...document.querySelectorAll('#hot-spots .annotation-text-g .bg')].map((e) => e.getBoundingClientRect().toJSON())"))
        assert len(boxes) == 5 and all(a[1] <= b[0] + 1 for a, b in zip(boxes, boxes[1:])), boxes
        find("#hot-spot-element")[0].send_keys(Keys.ARROW_DOWN)
        wait(lambda: plot("shown") == "0,0,1", "hh")
        find("#hot-spot-azimuth")[0].send_keys(Keys.ARROW_RIGHT)
        wait(lambda: scene()[0]["y"] > direction[1] + 0.05, "turned by a key")
        find("#hot-spot-radar")[0].send_keys(Keys.ENTER)
        wait(lambda: abs(scene()[0]["y"] - direction[1]) < 1e-3, "seen from the radar again")
        driver.set_window_size(500, 1200)
        time.sleep(0.5)
        assert driver.execute_script("return document.documentElement.scrollWidth <= document.documentElement.clientWidth"), "nothing is wider than a narrow window"
        driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
        assert [e.is_displayed() for e in find(".static img")] == [True] and not any(e.is_displayed() for e in find(".interactive")), "paper has the picture"
        assert not [entry for entry in driver.get_log("browser") if entry["level"] == "SEVERE"]


def check_without_scripts(page):
    from selenium.webdriver.common.by import By
    with browser(("prefs", {"profile.managed_default_content_settings.javascript": 2})) as driver:
        driver.get(page.as_uri())
        assert all(e.is_displayed() for e in driver.find_elements(By.CSS_SELECTOR, "figure img")), "pictures without scripts"
        assert not driver.find_elements(By.CSS_SELECTOR, ".drawn")


def check_comparison(seaglint, source, folder):
    from selenium.webdriver.common.by import By
    run = lambda *arguments: subprocess.run([seaglint, *arguments], check=True, stdout=subprocess.DEVNULL)
    target = ("--target", f"{source}/assets/icosahedral_reflector.glb")
    run("rcs", *target, "--frequency-ghz", "9:9.2:0.02", "--azimuth-deg", "10", "--elevation-deg", "2", "--export-as", "feko", "-o", folder / "a.csv")
    run("compare", folder / "a_h.ffe", *target, "--incidence", "monostatic", "-o", folder / "compared")
    with browser() as driver:
        driver.get((folder / "compared/compare.html").as_uri())
        find = lambda css: driver.find_elements(By.CSS_SELECTOR, css)
        wait(lambda: find("#comparison [data-shown]"), "curves of both")
        series = driver.execute_script("return document.querySelector('#comparison .js-plotly-plot').data.map((t) => [t.name, t.x.length, t.line.color])")
        assert ["a_h.ffe", 11, "#000000"] in series and ["seaglint", 11, "#0072b2"] in series, series
        assert "--reference-polarisation h?" in find(".verdict")[0].text, "v was assumed, h was transmitted"
        assert not [entry for entry in driver.get_log("browser") if entry["level"] == "SEVERE"]


def check_choices(seaglint, source, folder):
    """A comparison over azimuth, elevation and frequency: what the page shows for the choices of a keyboard, in a narrow window and on paper."""
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
    run = lambda *arguments: subprocess.run([seaglint, *arguments], check=True, stdout=subprocess.DEVNULL)
    target = ("--target", f"{source}/assets/icosahedral_reflector.glb")
    run("rcs", *target, "--frequency-ghz", "9.5:10.5:0.25", "--azimuth-deg", "0:30:1", "--elevation-deg", "2:5:3", "--edges", "off", "-o", folder / "b.csv")
    run("compare", folder / "b.csv", *target, "-o", folder / "chosen")
    page = folder / "chosen/compare.html"
    assert page.stat().st_size < 5e6
    with browser() as driver:
        driver.get(page.as_uri())
        find = lambda css: driver.find_elements(By.CSS_SELECTOR, css)
        shown = lambda: (find("#comparison [data-shown]") or [find("body")[0]])[0].get_attribute("data-shown")
        wait(lambda: shown() == "hh, frequency 9.5 GHz, elevation 2 deg", "the first cut")
        assert [e.get_attribute("id") for e in find("#comparison select") if e.is_displayed()] == ["comparison-polarisation", "comparison-frequency", "comparison-elevation"]
        assert not any(e.is_displayed() for e in find(".static img")), "the pictures give way to the curves"
        verdict, first_heading = find("header .verdict")[0], find("h2")[0]
        assert verdict.text.startswith("The RCS computed by seaglint agrees with b.csv within") and verdict.location["y"] < first_heading.location["y"]
        difference = "const [a, b, d] = document.querySelector('#comparison .js-plotly-plot').data; return Math.max(...d.y.map((v, i) => Math.abs(v - b.y[i] + a.y[i])));"
        assert driver.execute_script(difference) < 1e-9
        images = lambda: driver.execute_script("return [...document.querySelectorAll('#comparison .maps .js-plotly-plot')].map((p) => [p.data[0].z.length, p.data[0].z[0].length, p.data[0].zmin, p.data[0].zmax])")
        assert [size[:2] for size in images()] == [[5, 31]] * 3, images()
        assert images()[0] == images()[1] and images()[2][2] == -images()[2][3], "one scale of both levels, an even one of the differences"
        find("#comparison-frequency")[0].send_keys(Keys.ARROW_DOWN)
        wait(lambda: shown() == "hh, frequency 9.75 GHz, elevation 2 deg", "the next frequency")
        find("#comparison-polarisation")[0].send_keys("vv")
        wait(lambda: shown() == "vv, frequency 9.75 GHz, elevation 2 deg", "another polarisation at that frequency")
        find("#comparison-elevation")[0].send_keys(Keys.ARROW_DOWN)
        wait(lambda: shown() == "vv, frequency 9.75 GHz, elevation 5 deg", "another elevation")
        heads = [[cell.text for cell in table.find_elements(By.CSS_SELECTOR, "thead th")] for table in find("table")]
        assert any(head[:3] == ["part", "bounces", "mechanism"] for head in heads), heads
        driver.set_window_size(500, 1200)
        time.sleep(0.5)
        assert driver.execute_script("return document.documentElement.scrollWidth <= document.documentElement.clientWidth"), "nothing is wider than a narrow window"
        driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
        assert len([e for e in find(".static img") if e.is_displayed()]) == 4 and not any(e.is_displayed() for e in find(".interactive")), "paper has the pictures"
        assert not [entry for entry in driver.get_log("browser") if entry["level"] == "SEVERE"]


def main(seaglint, source, picture=None):
    try:
        import selenium  # noqa: F401
    except ImportError as error:
        print(f"skipped: {error} (package python3-selenium)")
        return 77
    if not pathlib.Path("/usr/bin/chromedriver").exists():
        print("skipped: package chromium-driver")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        run = pathlib.Path(folder) / "run"
        subprocess.run([seaglint, "run", f"{source}/scenarios/points.yaml", "-o", run, *SMALL], check=True, stdout=subprocess.DEVNULL)
        page = run / "report.html"
        assert page.stat().st_size < 5e6
        check_report(page, picture)
        check_without_scripts(page)
        check_comparison(seaglint, source, pathlib.Path(folder))
        check_choices(seaglint, source, pathlib.Path(folder))
        check_hot_spots(seaglint, source, pathlib.Path(folder))
        check_hot_spot_page(seaglint, source, pathlib.Path(folder))
    return 0


sys.exit(main(*sys.argv[1:]))
