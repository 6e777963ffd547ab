#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""pages_test.py SEAGLINT SOURCE: the report of a small run and a comparison in headless Chromium, from files and without a
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
        drawn = lambda: driver.find_elements(By.CSS_SELECTOR, "figure.drawn .interactive .scatterlayer")
        wait(lambda: len(drawn()) >= 1, "curves of both")
        series = driver.execute_script("return document.querySelector('figure.drawn .interactive').data.map((t) => [t.name, t.x.length])")
        assert ["a_h.ffe", 11] in series, series
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
        check_hot_spots(seaglint, source, pathlib.Path(folder))
    return 0


sys.exit(main(*sys.argv[1:]))
