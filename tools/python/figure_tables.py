# SPDX-License-Identifier: BSD-3-Clause
"""Records of measured figures and the tables of the documents that show them, for tools/measure."""
import pathlib
import re
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
FIGURES = ROOT / "tests/figures"
RECORDS = ("accuracy", "speed")
DOCUMENTS = ("README.md", "tests/accuracy.md", "tests/bench/README.md", "sim/scattering/radiation/README.md")
BLOCK = re.compile(r"(<!-- table ([a-z_]+), written by tools/measure -->\n)(.*?)(<!-- end of table -->)", re.DOTALL)
PLACEHOLDER = re.compile(r"\{([a-z][a-z0-9_]*)\}")


class Failure(Exception):
    """A measurement or a table that cannot be made, with the reason."""


class Record:
    """Figures as the tables show them, by identifier, each with the part of the measurement that it comes from."""

    def __init__(self, name):
        self.path = FIGURES / f"{name}.tsv"
        self.commits, self.rows = {}, {}
        if not self.path.is_file():
            return
        for line in self.path.read_text().splitlines():
            if line.startswith("# commit of "):
                part, commit = line.removeprefix("# commit of ").split(": ")
                self.commits[part] = commit
            elif not line.startswith("#"):
                identifier, part, figure = line.split("\t")
                self.rows[identifier] = (part, figure)

    def replace(self, part, figures, commit):
        self.rows = {i: row for i, row in self.rows.items() if row[0] != part}
        self.rows.update({i: (part, figure) for i, figure in figures.items()})
        self.commits[part] = commit

    def write(self):
        lines = ["# Written by tools/measure: identifier, part of the measurement, figure as the tables show it."]
        lines += [f"# commit of {part}: {commit}" for part, commit in sorted(self.commits.items())]
        lines += ["\t".join((i, *row)) for i, row in sorted(self.rows.items())]
        self.path.write_text("\n".join(lines) + "\n")


def commit_name():
    """The commit that is measured, `with changes` if sources differ from it."""
    def git(*arguments):
        result = subprocess.run(("git", "-C", ROOT, *arguments), capture_output=True, text=True, check=True)
        return result.stdout.strip()

    try:
        changed = git("status", "--porcelain", "--untracked-files=no", "--", ":!*.md", ":!tests/figures")
        return git("rev-parse", "--short=7", "HEAD") + (" with changes" if changed else "")
    except (OSError, subprocess.CalledProcessError):
        return "unknown"


def rendered_tables():
    """The tables by name, from the templates and the records."""
    figures = {i: figure for name in RECORDS for i, (_, figure) in Record(name).rows.items()}
    tables, used = {}, set()
    for _, name, body, _ in BLOCK.findall((FIGURES / "tables.md").read_text()):
        names = set(PLACEHOLDER.findall(body))
        used |= names
        if missing := sorted(names - figures.keys()):
            raise Failure(f"tests/figures/tables.md: table {name} has figures of no record: {', '.join(missing)}")
        tables[name] = PLACEHOLDER.sub(lambda match: figures[match[1]], body)
    if unused := sorted(figures.keys() - used):
        raise Failure(f"tests/figures: recorded, but in no table: {', '.join(unused)}")
    return tables


def write_tables(only_look=False):
    """Writes the tables into the documents; returns the names of those that change."""
    tables, texts, changed = rendered_tables(), {}, []
    for document in DOCUMENTS:
        def table(match, document=document):
            if match[2] not in tables:
                raise Failure(f"{document}: tests/figures/tables.md has no table {match[2]}")
            body = tables.pop(match[2])
            if body != match[3]:
                changed.append(f"{document}: {match[2]}")
            return match[1] + body + match[4]

        texts[document] = BLOCK.sub(table, (ROOT / document).read_text())
    if tables:
        raise Failure(f"in no document: table {', '.join(tables)}")
    if not only_look:
        for document, text in texts.items():
            (ROOT / document).write_text(text)
    return changed
