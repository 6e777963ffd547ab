#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""pages_test.py SEAGLINT SOURCE: the manual as tools/manual builds it: links and anchors lead somewhere, every chapter, key and command is there,
and headless Chromium shows it without errors, on a narrow window too. Exit code 77: a package of Debian is missing."""
import html.parser
import json
import pathlib
import subprocess
import sys
import tempfile
import time


class Page(html.parser.HTMLParser):
    def __init__(self, file):
        super().__init__()
        self.ids, self.links, self.pictures, self.text = set(), [], [], []
        self.feed(file.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        found = dict(attributes)
        if "id" in found:
            assert found["id"] not in self.ids, f"id {found['id']} twice"
            self.ids.add(found["id"])
        if tag == "a":
            self.links.append(found["href"])
        if tag == "img":
            self.pictures.append(found["src"])

    def handle_data(self, data):
        self.text.append(data)


def check_links(folder):
    pages = {file.name: Page(file) for file in folder.glob("*.html")}
    for name, page in pages.items():
        for link in page.links:
            if link.startswith(("http:", "https:")):
                continue
            target, _, part = link.partition("#")
            target = target or name
            assert target in pages, f"{name}: {link}"
            assert not part or part in pages[target].ids, f"{name}: {link}"
        for picture in page.pictures:
            assert (folder / picture).is_file(), f"{name}: {picture}"
    for _, place in json.loads((folder / "search.js").read_text(encoding="utf-8").removeprefix("const SEARCH = ").rstrip(";\n")):
        target, _, part = place.partition("#")
        assert part in pages[target].ids, place
    return pages


def check_contents(pages, seaglint, source):
    keys = json.loads(subprocess.run([seaglint, "keys", "--json"], check=True, capture_output=True, text=True).stdout)
    for entry in keys:
        assert any(entry["meaning"] in text for text in pages["keys.html"].text), entry["key"]
    usage = sum(text.count("Usage: seaglint") for text in pages["commands.html"].text)
    commands = len(list((source / "tools/cli").glob("command_*.cpp")))
    assert usage > commands, f"{usage} help texts of {commands} sources"
    readmes = [file for file in source.glob("**/README.md") if "build" not in file.relative_to(source).parts]
    assert len(pages) >= len(readmes) + 6, f"{len(pages)} pages of {len(readmes)} chapters"
    tables = sum(1 for page in pages.values() for text in page.text if text.lstrip().startswith("| ---") or text.lstrip().startswith("|---"))
    assert tables == 0, "a table stands as text"


def check_first_scenario(seaglint, source, folder):
    """The scenario of the first page is one."""
    text = (source / "README.md").read_text(encoding="utf-8")
    file = folder.with_name("study.yaml")
    file.write_text(text.split("```yaml\n")[1].split("```")[0], encoding="utf-8")
    checked = subprocess.run([seaglint, "check", file], capture_output=True, text=True)
    assert checked.returncode == 0 and "warning" not in checked.stderr, checked.stderr


def check_in_browser(folder, picture):
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.by import By
    options = webdriver.ChromeOptions()
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--window-size=1280,1200", "--host-resolver-rules=MAP * ~NOTFOUND"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    with webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options) as driver:
        driver.get((folder / "index.html").as_uri())
        search = driver.find_element(By.ID, "search")
        search.send_keys("sea gamma")
        hits = driver.find_elements(By.CSS_SELECTOR, "#found a")
        assert any(hit.text.endswith("sea.gamma") for hit in hits), [hit.text for hit in hits]
        next(hit for hit in hits if hit.text.endswith("sea.gamma")).click()
        end = time.monotonic() + 20
        while not driver.current_url.split("#")[0].endswith("keys.html"):
            assert time.monotonic() < end, driver.current_url
            time.sleep(0.1)
        for width in (1280, 400):
            driver.set_window_size(width, 1200)
            driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {"width": width, "height": 1200, "deviceScaleFactor": 1, "mobile": False})
            for page in sorted(folder.glob("*.html")):
                driver.get(page.as_uri())
                wide = driver.execute_script("return document.documentElement.scrollWidth - document.documentElement.clientWidth")
                assert wide <= 0, f"{page.name} is {wide} pixels wider than a window of {width}"
        errors = [entry for entry in driver.get_log("browser") if entry["level"] == "SEVERE"]
        assert not errors, errors
        if picture:
            driver.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
            driver.set_window_size(1280, 1500)
            for name in ("index", "tools_tutorials_mesh", "keys", "sim_sea"):
                driver.get((folder / f"{name}.html").as_uri())
                driver.save_screenshot(f"{picture}_{name}.png")


def check_refusal(seaglint, source, folder):
    """Pages of somebody else are not replaced."""
    folder.mkdir()
    (folder / "index.html").write_text("mine", encoding="utf-8")
    refused = subprocess.run([source / "tools/manual", "--program", seaglint, "-o", folder], capture_output=True, text=True)
    assert refused.returncode == 2 and "something else than a manual" in refused.stderr, refused
    assert (folder / "index.html").read_text(encoding="utf-8") == "mine"


def main(seaglint, source, picture=None):
    try:
        import markdown, selenium  # noqa: E401, F401
    except ImportError as error:
        print(f"skipped: {error} (packages python3-markdown, python3-selenium)")
        return 77
    if not pathlib.Path("/usr/bin/chromedriver").exists():
        print("skipped: package chromium-driver")
        return 77
    source = pathlib.Path(source).resolve()
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder) / "manual"
        subprocess.run([source / "tools/manual", "--program", seaglint, "-o", folder], check=True)
        subprocess.run([source / "tools/manual", "--program", seaglint, "-o", folder], check=True)  # in place of the first
        check_refusal(seaglint, source, folder.with_name("other"))
        pages = check_links(folder)
        check_contents(pages, seaglint, source)
        check_first_scenario(seaglint, source, folder)
        check_in_browser(folder, picture)
        print(f"{len(pages)} pages, {sum(file.stat().st_size for file in folder.rglob('*') if file.is_file()) / 1e6:.1f} MB")
    return 0


sys.exit(main(*sys.argv[1:]))
