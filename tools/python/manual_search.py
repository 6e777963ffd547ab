# SPDX-License-Identifier: BSD-3-Clause
"""Full-text search of the manual: the passages of its pages as an index that is made with them, and the script that searches it in a page."""
import html.parser
import json
import re

STYLE = """
nav input { width: 100%; padding: 4px 6px; font: inherit; }
#found { grid-column: 2; grid-row: 1; max-width: 1000px; min-width: 0; }
#found ol { list-style: none; padding: 0; margin: 8px 0; }
#found a { display: block; padding: 6px 10px; border-bottom: 1px solid var(--line); color: var(--ink); overflow-wrap: anywhere; }
#found a b { display: block; color: var(--accent); }
#found a:focus { outline: 3px solid var(--accent); outline-offset: -3px; background: var(--tint); }
#found mark { background: #ffe58a; color: inherit; }
.searching article { display: none; }
article :target { background: #fff8e6; box-shadow: 0 0 0 4px #fff8e6; }
@media (max-width: 800px) { .searching nav details { display: none; } }
@media print { #found { display: none; } .searching article { display: block; } }
"""

# The best first: titles and headings, passages that begin with the words, that contain them as whole words, as parts of words, and those of
# which a heading contains some of the words.
SCRIPT = """
const input = document.getElementById("search"), found = document.getElementById("found"), list = found.querySelector("ol"), count = found.querySelector("p");
const kShown = 40;

const escaped = (word) => word.replace(/[.*+?^${}()|[\\]\\\\]/g, "\\\\$&");

function rank(words, whole, title, heading, text, named) {
  const where = (title + " " + heading).toLowerCase(), body = text.toLowerCase();
  if (!words.every((word) => where.includes(word) || body.includes(word))) return -1;
  if (words.every((word) => heading.toLowerCase().includes(word))) return heading === title && named ? 0 : named ? 1 : 4;
  if (!words.some((word) => body.includes(word))) return named && words.some((word) => heading.toLowerCase().includes(word)) ? 3 : -1;
  if (body.startsWith(words.join(" "))) return 1;
  if (whole.every((word) => word.test(text))) return 2;
  return words.every((word) => body.includes(word)) ? 3 : 4;
}

function excerpt(text, any) {
  const at = Math.max(text.search(any), 0), from = at < 80 ? 0 : text.indexOf(" ", at - 70) + 1, to = text.indexOf(" ", from + 240);
  const shown = document.createElement("span"), piece = (from > 0 ? "... " : "") + text.slice(from, to < 0 ? undefined : to) + (to < 0 ? "" : " ...");
  for (const [index, part] of piece.split(any).entries()) shown.append(index % 2 ? Object.assign(document.createElement("mark"), { textContent: part }) : part);
  return shown;
}

function search() {
  const words = input.value.toLowerCase().split(/\\s+/).filter(Boolean);
  document.body.classList.toggle("searching", words.length > 0);
  found.hidden = words.length === 0;
  if (words.length === 0) return;
  const whole = words.map((word) => new RegExp("(?<![\\\\p{L}\\\\d_])" + escaped(word) + "(?![\\\\p{L}\\\\d_])", "iu")), any = new RegExp("(" + words.map(escaped).join("|") + ")", "i");
  const hits = [];
  for (const [page, title, passages] of SEARCH)
    for (const [place, heading, text, named] of passages) {
      const order = rank(words, whole, title, heading, text, named);
      if (order >= 0) hits.push([order, page + "#" + place, heading === title ? title : title + ": " + heading, text]);
    }
  hits.sort((a, b) => a[0] - b[0]);
  count.textContent = hits.length > kShown ? `${hits.length} passages, the first ${kShown}:` : hits.length === 1 ? "1 passage:" : `${hits.length || "No"} passage${hits.length ? "s:" : "s."}`;
  list.replaceChildren(...hits.slice(0, kShown).map(([, place, name, text]) => {
    const item = document.createElement("li"), link = Object.assign(document.createElement("a"), { href: place });
    link.append(Object.assign(document.createElement("b"), { textContent: name }), excerpt(text, any));
    item.append(link);
    return item;
  }));
}

function close() {
  input.value = "";
  search();
}

input.addEventListener("input", search);
addEventListener("pageshow", search);  // a text that the browser kept
list.addEventListener("click", (event) => { if (event.target.closest("a")?.pathname === location.pathname) close(); });
document.addEventListener("keydown", (event) => {
  const links = [...list.querySelectorAll("a")], at = links.indexOf(document.activeElement), inside = document.activeElement === input;
  if (event.key === "/" && !inside) input.focus();
  else if (event.key === "Escape" && !found.hidden) { close(); input.focus(); }
  else if (found.hidden || (!inside && at < 0)) return;
  else if (event.key === "ArrowDown") links[Math.min(at + 1, links.length - 1)]?.focus();
  else if (event.key === "ArrowUp" && at >= 0) (at === 0 ? input : links[at - 1]).focus();
  else if (event.key === "Enter" && inside) links[0]?.click();
  else return;
  event.preventDefault();
});
"""

INPUT = '<input id="search" type="search" placeholder="search: /" aria-label="Search" aria-controls="found" autocomplete="off">'
FOUND = '<section id="found" aria-label="Found" hidden><p role="status"></p><ol></ol></section>'


def numbered(body):
    """The HTML of a page with an id on every paragraph, item, row and block, for links to them."""
    number = 0

    def tag(match):
        nonlocal number
        number += 1
        return f'<{match[1]} id="at-{number}">'

    return re.sub(r"<(p|li|tr|pre)>", tag, body)


class Passages(html.parser.HTMLParser):
    """[id, heading, text, whether the heading is its own] of every heading, whose text is empty, and of every paragraph, item, row and block of
    a numbered page. Rows of keys have headings of their own; formulas are found in the notation of the documents."""

    HEADINGS = ("h1", "h2", "h3", "h4", "h5", "h6")
    BLOCKS = HEADINGS + ("p", "li", "tr", "pre")

    def __init__(self, title, body, headings):
        super().__init__()
        self.names = {place: name for name, place in headings}
        self.heading, self.found, self.open, self.in_math = title, [], [], False
        self.feed(body)
        for passage in self.found:
            passage[2] = " ".join(passage[2].split()).removesuffix(" ·")
        self.found = [passage for passage in self.found if passage[2] or passage[3]]

    def handle_starttag(self, tag, attributes):
        if tag == "math":
            self.found[self.open[-1][1]][2] += f" {dict(attributes)['alttext']} "
            self.in_math = True
        if tag not in self.BLOCKS:
            return
        place = dict(attributes)["id"]
        if tag in self.HEADINGS:
            self.heading = self.names[place]
        self.open.append((tag, len(self.found)))
        self.found.append([place, self.names.get(place, self.heading), "", int(place in self.names)])

    def handle_endtag(self, tag):
        if tag == "math":
            self.in_math = False
        elif self.open and tag in ("td", "th"):
            self.found[self.open[-1][1]][2] += " · "
        elif self.open and tag == self.open[-1][0]:
            self.open.pop()

    def handle_data(self, data):
        if self.open and not self.in_math and self.open[-1][0] not in self.HEADINGS:
            self.found[self.open[-1][1]][2] += data


def index_script(pages):
    """search.js of pages [(page, title, passages)]."""
    return "const SEARCH = " + json.dumps(pages, ensure_ascii=False, separators=(",", ":")) + ";\n"
