# SPDX-License-Identifier: BSD-3-Clause
"""The reference of keys and commands, asked of the program."""
import html
import json
import re
import subprocess


def printed(program, *arguments):
    return subprocess.run([program, *arguments], check=True, capture_output=True, text=True).stdout


def anchor(words):
    return re.sub(r"[^a-z0-9]+", "-", words.lower()).strip("-")


def drawn(per):
    return f" May be drawn, once per {per}." if per else ""


def keys_page(program):
    """Every key of a scenario with default, allowed values and meaning, by sections: (title, HTML, [(heading, anchor)])."""
    sections, headings = {}, [("Keys of a scenario", "keys")]
    for entry in json.loads(printed(program, "keys", "--json")):
        words = entry["key"].split(".")
        depth = 3 if words[0] == "targets" and len(words) > 3 else 1
        sections.setdefault(".".join(words[:depth]) if len(words) > 1 else "", []).append(entry)
    parts = ['<h1 id="keys">Keys of a scenario</h1>',
             "<p>As <code>seaglint keys --json</code> lists them. <code>NAME</code> is the name of a target, <code>N</code> an index. "
             '<a href="sim_scenario.html">Scenario</a> describes sweeps, files and overrides.</p>']
    for section, entries in sections.items():
        title = section or "Top level"
        rows = "".join(f'<tr id="{anchor(e["key"])}"><td><code>{html.escape(e["key"][len(section) + 1 if section else 0:])}</code></td><td>{html.escape(e["default"]) or "–"}</td>'
                       f'<td>{html.escape(e["allowed"])}</td><td>{html.escape(e["meaning"] + drawn(e["drawn_per"]))}</td></tr>\n' for e in entries)
        parts.append(f'<h2 id="section-{anchor(title)}">{html.escape(title)}</h2>\n<div class="scroll"><table class="keys"><thead><tr><th>key</th><th>default</th><th>allowed</th><th>meaning</th></tr></thead><tbody>\n{rows}</tbody></table></div>')
        headings += [(title, "section-" + anchor(title)), *((e["key"], anchor(e["key"])) for e in entries)]
    return "Keys of a scenario", "\n".join(parts), headings


def subcommands(text):
    """Names below `Subcommands:` of a help text."""
    found = re.search(r"^Subcommands:\n((?:  .*\n)+)", text, re.MULTILINE)
    return re.findall(r"^  ([a-z]\S*)", found[1], re.MULTILINE) if found else []


def commands(program, *words):
    """(words of a command, its help text), depth first."""
    text = printed(program, *words, "--help")
    yield words, text
    for name in subcommands(text):
        yield from commands(program, *words, name)


def commands_page(program):
    """Every command with its help text: (title, HTML, [(heading, anchor)])."""
    headings, parts = [("Commands", "commands")], ['<h1 id="commands">Commands</h1>', "<p>The help texts of the program. Exit codes: 0 done, 1 the work failed, 2 the input is wrong, 130 Ctrl-C.</p>"]
    for words, text in commands(program):
        title = " ".join(("seaglint", *words))
        parts.append(f'<h2 id="{anchor(title)}">{title}</h2>\n<pre>{html.escape(text)}</pre>')
        headings.append((title, anchor(title)))
    return "Commands", "\n".join(parts), headings
