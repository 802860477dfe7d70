"""Print the completion script of a shell."""

from __future__ import annotations

from amp_studio.cli.verb import Options, Verb, VerbArgument

_BASH = r"""# amp-studio completion for bash:
# amp-studio completion bash > ~/.local/share/bash-completion/completions/amp-studio
_amp_studio() {
    local line=${COMP_LINE:0:COMP_POINT} program=${COMP_WORDS[0]/#\~\//$HOME/}
    mapfile -t COMPREPLY < <(
        AMP_STUDIO_BREAKS=$COMP_WORDBREAKS "$program" __complete --line "$line" 2>/dev/null
    )
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
_FISH = r"""# amp-studio completion for fish:
# amp-studio completion fish > ~/.config/fish/completions/amp-studio.fish
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

_SCRIPTS = {"bash": _BASH, "zsh": _ZSH, "fish": _FISH}


# The scripts ask the program for each completion, so a newer program needs no newer script.
VERB = Verb(
    __doc__,
    VerbArgument("shell", choices=tuple(_SCRIPTS), help="bash, zsh or fish"),
    examples=("amp-studio completion bash",),
)


def run(options: Options) -> int:
    """Print the script of a shell."""
    print(_SCRIPTS[options.shell], end="")
    return 0
