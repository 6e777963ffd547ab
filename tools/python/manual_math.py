# SPDX-License-Identifier: BSD-3-Clause
"""Formulas of the documents as MathML, from the notation in which they stand in indented blocks.

    a b / (c d)         a fraction of all factors before the stroke over the group, or over all factors behind it
    a b/c d             a fraction of the two neighbours of a stroke without blanks
    x_i, x^2, e^{j k}   subscript and superscript; x^ and x^(y) a hat; x' a prime; x* a conjugate
    n x (k x E)         a cross product, where x stands between blanks; s.E, p . E a scalar product
    sum_i, sqrt(x)      signs; names of Greek letters; other words are text
    ",  ", "   "        between formulas of a line

A block is typeset as a whole, or stays as it is where it cannot be read.
"""
import html
import re

# Pages whose blocks are typeset, with their own symbols: name in the notation -> (letter, subscript or ""), or other notation.
OMEGA = {"w": ("ω", ""), "w0": ("ω", "0"), "wp": ("ω", "p")}
PAGES = {
    "sim/sea/README.md": {**OMEGA, "Hs": ("H", "s"), "B+": "B^{+}", "B-": "B^{-}"},
    "sim/motion/README.md": OMEGA,
    "sim/scattering/coefficients/README.md": {},
    "sim/scattering/radiation/README.md": {},
    "sim/scattering/solver/README.md": {},
    "radar/waveform/README.md": {},
    "radar/echo/README.md": {},
    "radar/rvmap/README.md": {},
    "classify/features/README.md": {},
}

GREEK = dict(zip("alpha beta gamma delta eps zeta eta theta kappa lambda mu nu xi pi rho sigma tau phi chi psi omega Gamma Delta Phi".split(), "αβγδεζηθκλμνξπρστφχψωΓΔΦ"))
FUNCTIONS = ("sin", "cos", "tan", "cot", "exp", "ln", "Re", "Im", "diag")  # applied to the next factor
PRODUCTS = ("jk", "jkR", "jks", "jx", "jkv", "dk", "du")  # written without blanks
OPERATORS = {"<=": "≤", ">=": "≥", "!=": "≠", "+-": "±", "-+": "∓", "...": "…", "-": "−"}
TOKEN = re.compile(r"""(?P<space>\s+) | (?P<number>\d+(?:\.\d+)?(?:e-?\d+)?) | (?P<name>[A-Za-z]+\d*(?:_(?:\{[^{}]*\}|[A-Za-z0-9]+(?:_[A-Za-z]+)*))?)
                     | (?P<operator><=|>=|!=|\+-|-\+|\.\.\.|[-+=<>,;./*'^(){}\[\]|])""", re.VERBOSE)
CLOSING = {"(": ")", "[": "]", "{": "}", "|": "|"}
RELATIONS = ("=", "<", ">", "<=", ">=", "!=", ",", ";")
TIMES, SPACE = "<mo>&#x2062;</mo>", '<mspace width="2em"></mspace>'
THIN = '<mspace width="0.17em"></mspace>'


class Unreadable(Exception):
    """The text is not in the notation."""


def row(parts):
    return parts[0] if len(parts) == 1 else f"<mrow>{''.join(parts)}</mrow>"


def sign(text):
    return f"<mo>{html.escape(OPERATORS.get(text, text))}</mo>"


class Formula:
    """A formula as MathML, by recursive descent: relations of sums of products of factors with their exponents."""

    def __init__(self, text, symbols):
        self.symbols, self.tokens, place = symbols, [], 0  # (kind, text, blank before)
        self.in_exponent = False  # where strokes stay
        blank = False
        while place < len(text):
            token = TOKEN.match(text, place)
            if not token:
                raise Unreadable(text[place:])
            if token.lastgroup == "space":
                blank = True
            else:
                self.tokens.append((token.lastgroup, token[0], blank))
                blank = False
            place = token.end()
        self.at, self.blank_behind = 0, blank
        self.mathml = row(self.relations(None))
        if self.at < len(self.tokens):
            raise Unreadable(self.peek())

    def peek(self, ahead=0):
        return self.tokens[self.at + ahead][1] if self.at + ahead < len(self.tokens) else None

    def blank(self, ahead=0):
        return self.tokens[self.at + ahead][2] if self.at + ahead < len(self.tokens) else self.blank_behind

    def take(self):
        self.at += 1
        return self.tokens[self.at - 1][1]

    def relations(self, end):
        parts = []
        while self.peek() not in (end, None):
            parts.append(sign(self.take()) if self.peek() in RELATIONS else self.sum(end))
        return parts

    def sum(self, end):
        parts = []
        while self.peek() not in (end, None, *RELATIONS):
            parts.append(sign(self.take()) if self.peek() in ("+", "-", "+-", "-+", "...") else self.product(end))
        return row(parts)

    def is_factor(self, end):
        kind = self.tokens[self.at][0] if self.at < len(self.tokens) else ""
        return kind in ("number", "name") or (self.peek() in CLOSING and self.peek() != end)

    def is_cross(self):
        """Whether the next token is an x between blanks with a factor behind it."""
        if self.peek() != "x" or not self.blank() or not self.blank(1) or self.at + 1 >= len(self.tokens):
            return False
        return self.tokens[self.at + 1][0] == "name" or self.peek(1) in ("(", "[")

    def product(self, end):
        """Factors side by side, scalar and cross products, fractions."""
        if not self.is_factor(end):
            raise Unreadable(str(self.peek()))
        parts, last = [], ""

        def append(part):
            if parts and not parts[-1].startswith(("<mtext", "<mo>")) and not part.startswith("<mtext"):
                parts.append(TIMES)
            parts.append(part)

        while self.is_factor(end) or self.peek() in (".", "/"):
            if self.peek() == "/" and self.in_exponent:
                parts.append(sign(self.take()))
            elif self.peek() == "/":
                wide = self.blank()
                self.take()
                group = self.peek() in CLOSING
                below = self.factor(end, stripped=True)
                while wide and not group and self.is_factor(end) and not self.is_word():
                    below += TIMES + self.factor(end)
                above = parts if wide else [parts.pop()]
                if len(above) == 1 and last:
                    above = [last]
                fraction = f"<mfrac><mrow>{''.join(above)}</mrow><mrow>{below}</mrow></mfrac>"
                if wide:
                    parts = []
                parts.append(fraction)
                last = ""
            elif self.peek() == "." or (parts and self.is_cross()):
                parts.append("<mo>·</mo>" if self.take() == "." else "<mo>×</mo>")
            else:
                start = self.at
                part = self.factor(end)
                behind, self.at = self.at, start
                last = self.factor(end, stripped=True) if self.peek() in CLOSING else ""
                self.at = behind
                append(part)
        return row(parts)

    def is_word(self):
        return self.tokens[self.at][0] == "name" and self.name(self.peek()).startswith("<mtext")

    def group(self, opening):
        """(MathML with its signs, without)."""
        inner = self.relations(CLOSING[opening])
        if self.peek() != CLOSING[opening] or not inner:
            raise Unreadable(f"{opening} without its end")
        self.take()
        high = "" if "<mfrac" in "".join(inner) else ' stretchy="false"'
        return f"<mrow><mo{high}>{opening}</mo>{''.join(inner)}<mo{high}>{CLOSING[opening]}</mo></mrow>", row(inner)

    def factor(self, end, stripped=False):
        kind, text, _ = self.tokens[self.at] if self.at < len(self.tokens) else ("", "", False)
        self.at += 1
        if kind == "number":
            base = f"<mn>{text}</mn>"
        elif kind == "name" and text == "sqrt" and self.peek() == "(":
            self.take()
            base = f"<msqrt>{self.group('(')[1]}</msqrt>"
        elif kind == "name" and text in FUNCTIONS:
            base = f"<mi>{text}</mi>"
            if self.peek() == "^":
                base = self.exponent(base)
            if not self.is_factor(end):
                return base
            thin = "" if self.peek() in CLOSING else THIN
            return f"<mrow>{base}<mo>&#x2061;</mo>{thin}{self.factor(end)}{thin}</mrow>"
        elif kind == "name":
            base = self.name(text)
        elif text in CLOSING:
            applied = self.at > 1 and self.tokens[self.at - 2][0] == "name" and not self.tokens[self.at - 1][2]
            signed, bare = self.group(text)
            fraction = re.fullmatch(r"<mfrac>(?:(?!<mfrac>).)*</mfrac>", bare) and not applied
            if text == "(" and (stripped or fraction) and self.peek() not in ("^", "*"):
                return bare
            base = signed
        else:
            raise Unreadable(text)
        while self.peek() in ("'", "*", "^") and not self.blank():
            if self.peek() == "'":
                primes = 0
                while self.peek() == "'":
                    self.take()
                    primes += 1
                base = f"<msup>{base}<mo>{'′' * primes}</mo></msup>"
            elif self.peek() == "*":
                self.take()
                base = f"<msup>{base}<mo>*</mo></msup>"
            else:
                base = self.exponent(base)
        return base

    def exponent(self, base):
        self.take()
        if self.peek() is None or self.blank() or self.peek() in (")", "]", "}", ",", ".", "|") or (self.peek() == "(" and base.startswith("<mi>")):
            return f"<mover>{base}<mo>^</mo></mover>"
        if self.peek() in ("{", "("):
            outer, self.in_exponent = self.in_exponent, True
            power = self.group(self.take())[1]
            self.in_exponent = outer
            return f"<msup>{base}<mrow>{power}</mrow></msup>"
        minus = sign(self.take()) if self.peek() == "-" else ""
        kind, text, _ = self.tokens[self.at] if self.at < len(self.tokens) else ("", "", False)
        if kind == "number":
            power = f"<mn>{self.take()}</mn>"
        elif kind == "name":
            power = self.name(self.take())
        elif text == "(":
            power = self.group(self.take())[0]
        else:
            raise Unreadable(text)
        return f"<msup>{base}<mrow>{minus}{power}</mrow></msup>"

    def name(self, text):
        name, _, below = text.partition("_")
        below = below.strip("{}")
        if name == "sum":
            index = "".join(f"<mi>{letter}</mi>" for letter in below) if below.isalpha() else Formula(below, self.symbols).mathml if below else ""
            return f"<munder><mo>∑</mo><mrow>{index}</mrow></munder>" if below else "<mo>∑</mo>"
        letters = re.fullmatch(r"([A-Za-z]+)(\d*)", name)
        if name in self.symbols:
            letter, index = self.symbols[name]
        elif letters[1] in GREEK or len(letters[1]) == 1:
            letter, index = GREEK.get(letters[1], letters[1]), letters[2]
        elif name in PRODUCTS:
            return f"<mrow>{''.join(self.name(letter) for letter in name)}</mrow>"
        elif name.islower() and not below and len(name) > 2 or name in ("of", "at", "to", "or", "by"):
            return f"<mtext>&#160;{name}&#160;</mtext>"
        elif "_" in below:
            return f"<mtext>{html.escape(text)}</mtext>"
        else:
            letter, index = name, ""
        if index and below:
            raise Unreadable(text)
        base = f"<mi>{letter}</mi>"
        if below:
            if re.fullmatch(r"[a-z]{2}", below):
                return f"<msub>{base}<mrow><mi>{below[0]}</mi><mi>{below[1]}</mi></mrow></msub>"
            simple = re.fullmatch(r"[A-Za-z]+|\d+", below)  # a letter, a number or a word
            return f"<msub>{base}{f'<mi>{below}</mi>' if simple else Formula(below, self.symbols).mathml}</msub>"
        return f"<msub>{base}<mi>{index}</mi></msub>" if index else base


def is_words(text):
    return "=" not in text and (re.match(r"[a-z]{4}", text) or not re.search(r"[|^/(]", text))


def piece_of(text, symbols):
    """A formula, or the words beside one."""
    if is_words(text):
        return f"<mtext>{html.escape(text)}</mtext>"
    try:
        return Formula(text, symbols).mathml
    except Unreadable:
        if "=" in text:
            raise
        return f"<mtext>{html.escape(text)}</mtext>"


def typeset(block, symbols):
    """A block of formulas, one in each line, as a paragraph; None where a line is none."""
    made = []
    for line in block.strip("\n").split("\n"):
        text = re.sub(r"\s+= ", " = ", line.strip())
        for name, other in symbols.items():
            text = text.replace(name + " ", other + " ") if isinstance(other, str) else text
        pieces = re.split(r"(?<=[,;])\s{2,}|\s{4,}|\s{2,}(?=\w+ = )", text)
        # Words behind a formula stand below it, where they can be broken.
        note = f"<small>{html.escape(pieces.pop())}</small>" if len(pieces) > 1 and is_words(pieces[-1]) else ""
        try:
            formulas = [piece_of(piece, symbols) for piece in pieces] if "=" in text else []
        except Unreadable:
            formulas = []
        if not formulas:
            return None
        made.append(f'<math display="block" alttext="{html.escape(" ".join(line.split()))}"><mrow>{SPACE.join(formulas)}</mrow></math>{note}')
    return "<p>" + "".join(made) + "</p>"


def typeset_blocks(path, body):
    """The HTML of a page with its indented blocks of formulas as MathML, if it is one of PAGES."""
    if str(path) not in PAGES:
        return body

    def block(match):
        return typeset(html.unescape(match[1]), PAGES[str(path)]) or match[0]

    return re.sub(r"<pre><code>(.*?)</code></pre>", block, body, flags=re.DOTALL)
