"""What a mutation test changes in the expressions of a rule, one thing after the other."""

import os
import re
from collections.abc import Iterator

EVERY_MUTANT = os.environ.get("AMP_STUDIO_FULL") == "1"
"""Without it only comparisons, logic and negations are changed, and `EACH` of those is tried."""
EACH = 1 if EVERY_MUTANT else 32
"""Every how many mutants of a rule are tried."""

OFTEN = {
    "<": ("<=", ">="),
    "<=": ("<", ">"),
    ">": (">=", "<="),
    ">=": (">", "<"),
    "==": ("!=",),
    "!=": ("==",),
    "&&": ("||",),
    "||": ("&&",),
    "!": ("",),
}
SELDOM = {
    "true": ("false",),
    "false": ("true",),
    ".all(": (".exists(",),
    ".exists(": (".all(",),
    "min(": ("max(",),
    "max(": ("min(",),
    " + ": (" - ",),
    " - ": (" + ",),
    " * ": (" / ",),
    " / ": (" * ",),
}
PLACE = re.compile(
    r"(?P<choice>'[^']*')|(?P<often><=|>=|==|!=|&&|\|\||<|>|!)"
    r"|(?P<seldom>\btrue\b|\bfalse\b|\.all\(|\.exists\(|\bmin\(|\bmax\(| [-+*/] )"
    r"|(?<![\w.])(?P<number>\d+\.\d+|(?<=\w\[)\d+(?=\])|\d+(?![\w.,\]]))"  # not of a list of all positions
)

CONNECTED = re.compile(r"'[^']*'|&&|\|\||[([{,?:)\]}]")
"""What begins or ends an operand of "and" and "or", and texts, which may have any of these in them."""
GUARD = re.compile(r"\(?[^&|]+ [!=]= null\)?|\w+ < size\(\w+\)")
"""What asks whether something is there at all. Without it a rule that meets nothing is an error,
so there is no finding."""


def variations(text: str) -> Iterator[tuple[str, str]]:
    """Yield an expression with one thing changed, and what that was."""
    for found in PLACE.finditer(text):
        for instead in instead_of(found):
            before, after = text[: found.start()], text[found.end() :]
            if instead == "<=" and after.startswith(" size("):
                continue  # one position more is an error of the index, which exists() passes over
            yield before + instead + after, f"…{before[-25:]}[{found[0]} → {instead}]{after[:25]}…"
    for start, end, neutral in operands(text) if EVERY_MUTANT else ():
        if not GUARD.fullmatch(text[start:end].strip()):
            change = f"…{text[:start][-12:]}[{text[start:end].strip()} → {neutral}]"
            yield f"{text[:start]} {neutral} {text[end:].lstrip()}", change


def operands(text: str) -> Iterator[tuple[int, int, str]]:
    """Yield where the operands of "and" and "or" are, each with what it must be to decide nothing."""
    open_ones = [[0]]
    """For each bracket, where the operands of the present chain begin, and the operators between them."""
    for found in [*CONNECTED.finditer(text), None]:
        sign = found[0] if found else ""
        if sign.startswith("'"):
            continue
        chain = open_ones[-1]
        end = found.start() if found else len(text)
        if sign in ("&&", "||"):
            chain += [end, sign, end + 2]
            continue
        if sign in ("(", "[", "{"):
            open_ones.append([end + 1])
            continue
        chain.append(end)
        for n in range(0, len(chain) - 1, 3) if len(chain) > 2 else ():
            beside = [chain[m] for m in (n - 1, n + 2) if 0 < m < len(chain) - 1]
            yield chain[n], chain[n + 1], "true" if "&&" in beside else "false"
        if sign in (",", "?", ":"):
            open_ones[-1] = [end + 1]
        else:
            open_ones.pop()


def instead_of(found: re.Match[str]) -> tuple[str, ...]:
    """Return what is put in the place of an operator, a choice, a number and so on."""
    if found["often"]:
        return OFTEN[found[0]]
    if not EVERY_MUTANT:
        return ()
    if found["seldom"]:
        return SELDOM[found[0]]
    if found["choice"]:
        return ("'other'",)
    return (repr(float(found[0]) + 1) if "." in found[0] else str(int(found[0]) + 1),)
