# SPDX-License-Identifier: BSD-3-Clause
"""embed_files.py OUT.cpp FUNCTION=FILE...: a source of C++ with the files of HTML pages as functions of tools/page/html.h.

A FILE is text as it stands; FUNCTION=gzip:FILE gives it compressed by gzip, in Base64. The bytes depend on the files alone.
"""
import base64
import gzip
import pathlib
import sys


def literal(name, file):
    if file.startswith("gzip:"):
        text = base64.b64encode(gzip.compress(pathlib.Path(file[5:]).read_bytes(), 9, mtime=0)).decode()
        pieces = [f'"{text[i:i + 16000]}"' for i in range(0, len(text), 16000)]
    else:
        text = pathlib.Path(file).read_text(encoding="utf-8")
        pieces = [f'R"page({line}\n)page"' for line in text.splitlines()]
    return f"std::string_view {name}() {{\n  return\n" + "\n".join(pieces) + ";\n}\n"


def main(out, *arguments):
    parts = [literal(*argument.split("=", 1)) for argument in arguments]
    pathlib.Path(out).write_text("// Made by tools/cmake/embed_files.py.\n#include \"tools/page/html.h\"\n"
                                 "#pragma GCC diagnostic ignored \"-Woverlength-strings\"\nnamespace seaglint {\n" + "\n".join(parts) + "}  // namespace seaglint\n", encoding="utf-8")


main(*sys.argv[1:])
