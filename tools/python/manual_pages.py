# SPDX-License-Identifier: BSD-3-Clause
"""The pages of the manual: Markdown of the tree as HTML with links between the pages and typeset formulas, and a frame with contents and search."""
import html
import os
import pathlib
import re
import shutil

import manual_math
import manual_reference
import manual_search
import markdown
from figure_tables import ROOT

STYLE = """
main { max-width: none; display: grid; grid-template-columns: 250px minmax(0, 1fr); gap: 36px; padding-top: 20px; }
article { max-width: 1000px; min-width: 0; }
nav { display: block; font-size: 14px; padding: 0; position: sticky; top: 12px; align-self: start; max-height: 96vh; overflow-y: auto; }
nav summary { font-weight: 600; color: var(--ink); margin-top: 8px; }
nav ul { list-style: none; margin: 2px 0 2px 10px; padding: 0; }
nav li { margin: 1px 0; }
nav a[aria-current] { font-weight: 600; color: var(--ink); }
article code { background: var(--tint); border-radius: 3px; padding: 0 3px; font-size: 0.92em; overflow-wrap: anywhere; }
article pre code { background: none; padding: 0; font-size: inherit; overflow-wrap: normal; }
td:first-child code, th code { overflow-wrap: normal; }
math[display=block] + small { display: block; margin: 0 24px; text-align: center; color: var(--soft); }
math[display=block] { display: block math; margin: 10px 24px; overflow-x: auto; overflow-y: hidden; font-size: 1.08em; }
article img { max-width: 100%; height: auto; }
table.keys td:nth-child(3) { max-width: 260px; }
table.keys td:first-child { white-space: nowrap; }
p, ul { max-width: 100ch; }
@media (max-width: 800px) { main { display: block; } nav { position: static; max-height: none; } }
@media print { main { display: block; } nav { display: none; } }
"""

CURRENT = ' aria-current="page"'
TUTORIALS = ("by_task", "gallery", "data_set", "report", "pytorch", "iq", "clutter", "mesh_guide", "mesh", "own_ship", "hfss_cst", "sea_states")
REFERENCE = ("sea_effects", "glossary")
CHAPTERS = ("scenarios/benchmarks.md", "tests/accuracy.md", "tests/experiments.md")  # beside the READMEs
STAGES = ("sim/core", "sim/scenario", "sim/geometry", "sim/sea", "sim/motion", "sim/scattering", "sim/canonical", "sim/cavity", "sim/field_tables", "sim/field_export",
          "radar/README.md", "radar/waveform", "radar/echo", "radar/rvmap", "classify/dataset", "classify/features", "classify/cnn", "classify/model")


def documents():
    """(group, Markdown files) in the order of the contents."""
    readmes = [path.relative_to(ROOT) for path in ROOT.glob("**/README.md") if path.relative_to(ROOT).parts[0] != "build" and path.parent != ROOT]
    chapters = sorted(readmes + [pathlib.Path(name) for name in CHAPTERS], key=lambda path: (path.parent, path.name != "README.md", path.name))

    def below(*folders):
        return [path for folder in folders for path in chapters if path.is_relative_to(folder)]

    def pages(*names):
        return [pathlib.Path(f"tools/tutorials/{name}.md") for name in names]

    return [("Tutorials", pages(*TUTORIALS)),
            ("Reference", [pathlib.Path("keys"), pathlib.Path("commands"), *pages(*REFERENCE), pathlib.Path("CONVENTIONS.md"), *below("scenarios", "assets")]),
            ("The pipeline", below(*STAGES)),
            ("Tools", below("tools")),
            ("Tests", below("tests")),
            ("Project", [pathlib.Path(name) for name in ("README.md", "CHANGELOG.md", "CONTRIBUTING.md", "RELEASING.md")])]


def page_name(path):
    """The page of a Markdown file of the tree: sim/sea/README.md -> sim_sea.html."""
    words = [word for word in path.with_suffix("").parts if word != "README"]
    return ("_".join(words) or "readme").lower() + ".html"


def separated(text):
    """Blank lines before tables and lists that follow a paragraph, which CommonMark does not need; without comments and names of blocks."""
    text = re.sub(r"<!--.*?-->\n?", "\n", text, flags=re.DOTALL)
    lines, before, fenced = [], "", False
    for line in text.split("\n"):
        if line.startswith("```"):
            fenced = not fenced
            line = line.split(" ")[0]
        kinds = [next((kind for kind, start in (("table", "|"), ("list", "* ")) if of.startswith(start)), "") for of in (before, line)]
        if not fenced and kinds[1] and kinds[0] != kinds[1] and before.strip() and not before.startswith("  "):
            lines.append("")
        lines.append(line)
        before = line
    return "\n".join(lines)


class Links:
    """Mends the links and pictures of a page; keeps pictures to copy."""

    def __init__(self, pages):
        self.pages, self.pictures = pages, {}  # of files of the tree

    def target(self, folder, link):
        file, _, part = link.partition("#")
        if re.match(r"[a-z]+:", link) or not file:
            return link
        path = pathlib.Path(os.path.normpath(folder / file))
        for candidate in (path, path / "README.md"):
            if candidate in self.pages:
                return self.pages[candidate] + ("#" + part if part else "")
        return None

    def mend(self, folder, text):
        def link(match):
            target = self.target(folder, html.unescape(match[1]))
            return f'<a href="{html.escape(target)}">{match[2]}</a>' if target else match[2]

        def picture(match):
            path = pathlib.Path(os.path.normpath(folder / match[1]))
            self.pictures[path] = "pictures/" + "_".join(path.parts)
            return f'src="{self.pictures[path]}"'

        text = re.sub(r'<a href="([^"]*)">(.*?)</a>', link, text, flags=re.DOTALL)
        return re.sub(r'src="([^":]*)"', picture, text)


def converted(path, links):
    """(title, HTML, headings) of a Markdown file."""
    converter = markdown.Markdown(extensions=["tables", "fenced_code", "toc", "sane_lists"])
    body = converter.convert(separated((ROOT / path).read_text(encoding="utf-8")))
    body = links.mend(path.parent, manual_math.typeset_blocks(path, body)).replace("<table>", '<div class="scroll"><table>').replace("</table>", "</table></div>")
    headings = []

    def collect(tokens):
        for token in tokens:
            headings.append((html.unescape(token["name"]), token["id"]))
            collect(token["children"])

    collect(converter.toc_tokens)
    return headings[0][0], body, headings


def contents(groups, titles, current):
    parts = ['<nav aria-label="Contents"><a href="index.html"><b>seaglint</b></a><br>' + manual_search.INPUT]
    for group, pages in groups:
        items = "".join(f'<li><a href="{page}"{CURRENT if page == current else ""}>{html.escape(titles[page])}</a></li>' for page in pages)
        parts.append(f'<details{" open" if current in pages or group in ("Tutorials", "Reference") else ""}><summary>{group}</summary><ul>{items}</ul></details>')
    return "\n".join(parts) + "</nav>"


def frame(title, navigation, body):
    style = (ROOT / "tools/page/style.css").read_text(encoding="utf-8") + STYLE + manual_search.STYLE
    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<link rel="icon" href="data:,">
<title>{html.escape(title)} - seaglint</title>
<style>{style}</style>
</head>
<body>
<main>
{navigation}
{manual_search.FOUND}
<article>
{body}
</article>
</main>
<script src="search.js"></script>
<script>{manual_search.SCRIPT}</script>
</body>
</html>
"""


def index_body(groups, titles, version, by_task):
    """The first page: the table of tasks of the page `by_task`, (name, HTML), and the contents."""
    page, body = by_task
    tasks = re.search(r'<div class="scroll"><table>.*?</table></div>', body, re.DOTALL)[0].replace('href="#', f'href="{page}#')
    parts = [f"<h1>seaglint: manual</h1><p>{html.escape(version)}. A simulator for radar engineers: synthetic data of ships and of corner-reflector decoys at sea as a frequency-agile radar sees them, and what tells them apart.</p>",
             f"<p>The key <code>/</code> searches the text of all pages; arrows and Enter choose a passage, Escape leaves.</p>{tasks}"]
    for group, pages in groups:
        parts.append(f"<h2>{group}</h2><ul>" + "".join(f'<li><a href="{page}">{html.escape(titles[page])}</a></li>' for page in pages) + "</ul>")
    return "\n".join(parts)


def key_links(body, places):
    """The HTML of a page with links from keys of a scenario in code, with all their words, to their rows on the page of keys."""
    def link(match):
        breakable = re.sub("([._])", "\\1<wbr>", match[1])
        return f'<a href="keys.html#{places[match[1]]}"><code>{breakable}</code></a>' if match[1] in places else match[0]

    return re.sub(r"<code>([a-z_]+(?:\.\w+)+)</code>(?!</a>)", link, body)


def build(program, output):
    """Writes all pages into `output`, in place of an earlier manual once all are written; returns the first page."""
    groups = documents()
    pages = {path: page_name(path) for _, paths in groups for path in paths}
    links = Links(pages)
    made = {}  # page -> (title, body, headings)
    for path, page in pages.items():
        if path.suffix == ".md":
            made[page] = converted(path, links)
    made[page_name(pathlib.Path("keys"))] = manual_reference.keys_page(program)
    made[page_name(pathlib.Path("commands"))] = manual_reference.commands_page(program)
    titles = {page: title for page, (title, _, _) in made.items()}
    places = dict(made["keys.html"][2])
    made = {page: (title, key_links(body, places), headings) for page, (title, body, headings) in made.items()}
    listed = [(group, [pages[path] for path in paths]) for group, paths in groups]
    by_task = pages[pathlib.Path("tools/tutorials/by_task.md")]
    first_page = index_body(listed, titles, manual_reference.printed(program, "--version").strip(), (by_task, made[by_task][1]))
    made = {page: (title, manual_search.numbered(body), headings) for page, (title, body, headings) in made.items()}
    search = [(page, title, manual_search.Passages(title, body, headings).found) for page, (title, body, headings) in made.items()]
    made_in = output.with_name(output.name + ".new")
    shutil.rmtree(made_in, ignore_errors=True)
    (made_in / "pictures").mkdir(parents=True)
    (made_in / "search.js").write_text(manual_search.index_script(search), encoding="utf-8")
    for path, name in links.pictures.items():
        shutil.copy(ROOT / path, made_in / name)
    for page, (title, body, _) in made.items():
        (made_in / page).write_text(frame(title, contents(listed, titles, page), body), encoding="utf-8")
    (made_in / "index.html").write_text(frame("Manual", contents(listed, titles, ""), first_page), encoding="utf-8")
    shutil.rmtree(output, ignore_errors=True)
    made_in.rename(output)
    return output / "index.html"
