#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""pages_test.py SEAGLINT SOURCE: the manual as tools/manual builds it: links and anchors lead somewhere, every chapter, key and command is there,
every word is found by its search, and headless Chromium shows it without errors, on a narrow window too. Exit code 77: a package of Debian is missing."""
import html.parser
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True


class Page(html.parser.HTMLParser):
    def __init__(self, file):
        super().__init__()
        self.ids, self.links, self.pictures, self.text, self.article, self.in_math = set(), [], [], [], None, False
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
        if tag == "article":
            self.article = []
        if tag == "math":
            self.article.append(found["alttext"])
        self.in_math = self.in_math or tag == "math"

    def handle_endtag(self, tag):
        self.in_math = self.in_math and tag != "math"
        if tag == "article":
            self.article = tuple(self.article)

    def handle_data(self, data):
        self.text.append(data)
        if isinstance(self.article, list) and not self.in_math:
            self.article.append(data)


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
    return pages


def check_search_index(folder, pages):
    """The index has the whole text of every page, and every passage a place in it."""
    index = json.loads((folder / "search.js").read_text(encoding="utf-8").removeprefix("const SEARCH = ").rstrip(";\n"))
    assert {page for page, _, _ in index} | {"index.html"} == set(pages)
    for page, title, passages in index:
        assert all(place in pages[page].ids and (text or named) for place, _, text, named in passages), page
        indexed = "".join(word for _, heading, text, _ in passages for word in f"{heading} {text}".split())
        missing = [text for text in pages[page].article if "".join(text.split()) not in indexed]
        assert not missing, (page, missing)


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


def check_tables(seaglint, source, pages):
    """Defaults of the table of the sea are the program's; messages of the mesh guide are those of the sources."""
    keys = {entry["key"]: entry["default"] for entry in json.loads(subprocess.run([seaglint, "keys", "--json"], check=True, capture_output=True, text=True).stdout)}
    rows = re.findall(r"^\| `([\w.]+)` \| (.*?) ?\| ", (source / "tools/tutorials/sea_effects.md").read_text(encoding="utf-8"), re.MULTILINE)
    assert len(rows) > 35 and all(keys[key] == default for key, default in rows), [(key, default) for key, default in rows if keys.get(key) != default]
    assert "keys.html#sea-gamma" in pages["tools_tutorials_sea_effects.html"].links, "keys lead to their rows"
    texts = "".join(re.sub(r'"\s*\n\s*"', "", file.read_text(encoding="utf-8")) for folder in ("sim", "tools") for file in (source / folder).rglob("*.cpp"))
    guide = (source / "tools/tutorials/mesh_guide.md").read_text(encoding="utf-8").split("## What the program says")[1]
    messages = [part for row in re.findall(r"^\| (`.*?`) \|", guide, re.MULTILINE) for part in re.split(r"`, `| \.\.\. ", row.strip("`"))]
    assert len(messages) > 20 and all(message in texts for message in messages), [message for message in messages if message not in texts]
    for page in ("tools_tutorials_mesh_guide.html", "tools_tutorials_sea_effects.html", "tools_tutorials_glossary.html", "tools_tutorials_by_task.html#install"):
        assert page in pages["index.html"].links, page


def check_formulas(source, folder):
    """Fractions, applied functions, hats and products as the notation means them; what is no formula stays text."""
    sys.path.insert(0, str(source / "tools/python"))
    import manual_math
    plain = lambda text: re.sub(r"</?m(?:row|i|n|o|text|space)\b[^>]*>", "", manual_math.Formula(text, {}).mathml).replace("&#x2062;", " ").replace("&#x2061;", " ")
    over = lambda above, below: f"<mfrac>{above}{below}</mfrac>"
    for text, expected in (("a b / (c + d) - e/f", over("a b", "c+d") + "−" + over("e", "f")), ("a (b/c) d", "a " + over("b", "c") + " d"),
                           ("(j k / 2 pi) p", over("j k", "2 π") + " p"), ("a / (b) (c + d)", over("a", "b") + " (c+d)"),
                           ("cos b s.x^", "cos b s·<mover>x^</mover>"), ("phi^(q) + (l)^(1/2)", "<mover>φ^</mover> (q)+<msup>(l)1/2</msup>"),
                           ("n x (k^ x E_q)", "n×(<mover>k^</mover>×<msub>Eq</msub>)"), ("x'' + w x = |x'|", "<msup>x′′</msup>+w x=|<msup>x′</msup>|"),
                           ("w^-5 e^{-j pi/4}", "<msup>w−5</msup> <msup>e−j π/4</msup>")):
        assert plain(text) == expected, (text, plain(text), expected)
    for block in ("seaglint rcs -o FILE", "raft: {label: 1, n=2}", "a = (b", "a = b +/ c"):
        assert manual_math.typeset(block, {}) is None, block
    for page in manual_math.PAGES:
        name = "_".join(pathlib.Path(page).parent.parts) + ".html"
        assert 'display="block" alttext="' in (folder / name).read_text(encoding="utf-8"), page


def check_first_scenario(seaglint, source, folder):
    """The scenario of the first page is one."""
    text = (source / "README.md").read_text(encoding="utf-8")
    file = folder.with_name("study.yaml")
    file.write_text(text.split("```yaml\n")[1].split("```")[0], encoding="utf-8")
    checked = subprocess.run([seaglint, "check", file], capture_output=True, text=True)
    assert checked.returncode == 0 and "warning" not in checked.stderr, checked.stderr


def check_search(driver):
    """By the keyboard alone: a key, a word of the text, no such word."""
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
    find = lambda css: driver.find_elements(By.CSS_SELECTOR, css)
    type_keys = lambda *keys: driver.switch_to.active_element.send_keys(*keys)

    def wait_for(condition, what):
        end = time.monotonic() + 20
        while not condition():
            assert time.monotonic() < end, (what, driver.current_url)
            time.sleep(0.1)

    type_keys("/")
    assert driver.switch_to.active_element.get_attribute("id") == "search"
    type_keys("sea gamma")
    hits = [hit.text for hit in find("#found a")]
    assert hits[0].startswith("Keys of a scenario: sea.gamma\n") and "Peak enhancement of JONSWAP" in hits[0], hits
    assert not find("article")[0].is_displayed()
    type_keys(Keys.ENTER)
    wait_for(lambda: driver.current_url.endswith("keys.html#sea-gamma"), "the first passage is opened")
    # A word that no heading has, in the middle of a sentence; the second passage by the arrow.
    type_keys("/")
    type_keys("Trizna")
    assert [mark.text for mark in find("#found a:first-child mark")] and all("Trizna" in hit.text for hit in find("#found a")), "passages show the word"
    assert find("#found p")[0].text == f"{len(find('#found a'))} passages:"
    place = find("#found a")[1].get_attribute("href")
    type_keys(Keys.ARROW_DOWN)
    type_keys(Keys.ARROW_DOWN)
    type_keys(Keys.ENTER)
    wait_for(lambda: driver.current_url == place, "the second passage is opened")
    wait_for(lambda: find(":target") and "Trizna" in find(":target")[0].text and find(":target")[0].is_displayed(), "it is the place itself")
    # On the same page: the page comes back.
    type_keys("/")
    type_keys("trizna bragg")
    type_keys(Keys.ENTER)
    wait_for(lambda: find("article")[0].is_displayed() and "Bragg" in find(":target")[0].text, "a passage of the page itself")
    type_keys("/")
    type_keys("nosuchword")
    assert find("#found p")[0].text == "No passages." and not find("#found a")
    type_keys(Keys.ESCAPE)
    assert find("article")[0].is_displayed() and not find("#found")[0].is_displayed()


def check_in_browser(folder, picture):
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    options = webdriver.ChromeOptions()
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--window-size=1280,1200", "--host-resolver-rules=MAP * ~NOTFOUND"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    with webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options) as driver:
        driver.get((folder / "index.html").as_uri())
        check_search(driver)
        for width in (1280, 400):
            driver.set_window_size(width, 1200)
            driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {"width": width, "height": 1200, "deviceScaleFactor": 1, "mobile": False})
            for page in sorted(folder.glob("*.html")):
                driver.get(page.as_uri())
                wide = driver.execute_script("return document.documentElement.scrollWidth - document.documentElement.clientWidth")
                assert wide <= 0, f"{page.name} is {wide} pixels wider than a window of {width}"
                low = driver.execute_script("return [...document.querySelectorAll('math')].filter((m) => m.getBoundingClientRect().height < 15 || m.querySelector('merror')).map((m) => m.getAttribute('alttext'))")
                assert not low, (page.name, low)
        errors = [entry for entry in driver.get_log("browser") if entry["level"] == "SEVERE"]
        assert not errors, errors
        if picture:
            driver.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
            driver.set_window_size(1280, 1500)
            for name in ("index", "radar_waveform", "radar_rvmap", "sim_scattering_coefficients", "tools_tutorials_mesh_guide", "tools_tutorials_glossary", "tools_tutorials_sea_effects", "keys", "sim_sea"):
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
        check_search_index(folder, pages)
        check_contents(pages, seaglint, source)
        check_tables(seaglint, source, pages)
        check_formulas(source, folder)
        check_first_scenario(seaglint, source, folder)
        check_in_browser(folder, picture)
        print(f"{len(pages)} pages, {sum(file.stat().st_size for file in folder.rglob('*') if file.is_file()) / 1e6:.1f} MB")
    return 0


sys.exit(main(*sys.argv[1:]))
