"""Shell completion: the scripts for bash, zsh and fish, and what they ask the program.

A script hands the line over as it is; what may come next is found with the parser itself, so a new verb or option
completes at once. Where nothing is found the shell offers files.
"""

from __future__ import annotations

import argparse
import shlex
from collections.abc import Iterable, Iterator, Sequence

from amp_studio.scenarios import IDENTIFY, scenario_names

from .manual import example_names, families
from .parser import parser, verbs_of

ASKED = "__complete"
"""The hidden verb that the scripts call: ``__complete WORD…``, the last word being the one that is typed."""

_BASH = r"""# amp-studio completion for bash: amp-studio completion bash > ~/.local/share/bash-completion/completions/amp-studio
_amp_studio() {
    local line=${COMP_LINE:0:COMP_POINT} found
    mapfile -t COMPREPLY < <(AMP_STUDIO_BREAKS=$COMP_WORDBREAKS "${COMP_WORDS[0]}" __complete --line "$line" 2>/dev/null)
    [[ ${#COMPREPLY[@]} == 1 && ${COMPREPLY[0]} == *= ]] && compopt -o nospace
}
complete -o default -o bashdefault -F _amp_studio amp-studio
"""
_ZSH = r"""#compdef amp-studio
# amp-studio completion for zsh: amp-studio completion zsh > a folder of $fpath/_amp-studio
_amp_studio() {
    local -a found values
    found=("${(@f)$(${words[1]} __complete "${(@)words[2,CURRENT]}" 2>/dev/null)}")
    if [[ -z "${found[*]}" ]]; then
        _files
    else
        values=("${(@)found:#*=}")
        if [[ -n "${values[*]}" ]]; then compadd -- "${values[@]}"; fi
        values=("${(@M)found:#*=}")
        if [[ -n "${values[*]}" ]]; then compadd -S '' -- "${values[@]}"; fi
    fi
}
if [[ $zsh_eval_context[-1] == loadautofunc ]]; then _amp_studio "$@"; else compdef _amp_studio amp-studio; fi
"""
_FISH = r"""# amp-studio completion for fish: amp-studio completion fish > ~/.config/fish/completions/amp-studio.fish
function __amp_studio
    set -l typed (commandline -opc) (commandline -ct)
    set -l found ($typed[1] __complete $typed[2..-1] 2>/dev/null)
    if test -n "$found"
        printf '%s\n' $found
    else
        __fish_complete_path (commandline -ct)
    end
end
complete -c amp-studio -f -a '(__amp_studio)'
"""
SCRIPTS = {"bash": _BASH, "zsh": _ZSH, "fish": _FISH}


def completion_verb(options: argparse.Namespace) -> int:
    """Print the script of a shell."""
    print(SCRIPTS[options.shell], end="")
    return 0


def answer(words: Sequence[str], breaks: str) -> None:
    """Print what may come next, a line each; nothing if that is a file.

    bash gives the line (``--line TEXT``) and is answered from the last of its word ``breaks`` on, as it puts the answer
    there.
    """
    typed = list(words)
    if typed[:1] == ["--line"]:
        typed = _words_of(typed[1] if len(typed) > 1 else "")[1:]
    if not typed:
        return
    *before, current = typed
    begin = max((current.rfind(sign) for sign in breaks), default=-1) + 1 if words[:1] == ["--line"] else 0
    for found in dict.fromkeys(candidates(before, current)):
        if found.startswith(current):
            print(found[begin:])


def _words_of(line: str) -> list[str]:
    """Part a line that may end inside a word or a quote; the last word is the one that is typed, perhaps empty."""
    for closing in ("", "'", '"'):
        try:
            words = shlex.split(line + closing)
        except ValueError:
            continue
        return [*words, ""] if not closing and line[-1:].isspace() else words
    return []


def candidates(before: Sequence[str], current: str) -> Iterator[str]:
    """Yield what may come after the words ``before`` in the place of the one that is typed; more than fits is no matter."""
    top = parser()
    verbs = verbs_of(top)
    if not before:
        yield from (*verbs, "--help", "--version")
        return
    if before[0] not in verbs:
        return
    sub = verbs[before[0]]
    taking, values = _taken(sub, before[1:])
    if taking is not None:
        yield from _values(taking, values, current)
        return
    if current.startswith("-"):
        yield from (option for action in sub._actions for option in action.option_strings)
        return
    places = [action for action in sub._actions if not action.option_strings]
    at = min(len(values), len(places) - 1)
    if places and (len(values) < len(places) or places[at].nargs in ("*", "+")):
        yield from _values(places[at], values, current)


def _taken(sub: argparse.ArgumentParser, words: Sequence[str]) -> tuple[argparse.Action | None, list[str]]:
    """Return the option that waits for its value, if one does, and the words that are no options or values of some."""
    waiting: argparse.Action | None = None
    values = []
    for word in words:
        if waiting is not None:
            waiting = None
        elif word.startswith("-") and word != "-":
            option = sub._option_string_actions.get(word)
            waiting = option if option is not None and option.nargs is None else None
        else:
            values.append(word)
    return waiting, values


def _values(action: argparse.Action, values: Sequence[str], current: str) -> Iterable[str]:
    if action.choices is not None:
        return [str(choice) for choice in action.choices]
    if action.dest == "family" or (action.dest == "words" and not values):
        return families()
    if action.dest == "like":
        return example_names()
    if action.dest == "scenario":
        return (*scenario_names(), IDENTIFY)
    if not values:
        return ()
    if action.dest in (
        "param",
        "params",
        "tick",
        "untick",
        "assignments",
        "group",
        "table",
        "formula",
        "axis",
        "rule",
        "machine",
        "step",
        "at",
        "done",
        "not_done",
        "keep_defaults",
        "after",
    ):
        from .completion_facts import facts  # it needs the rooms

        return facts(action.dest, values[0], current)
    return ()
