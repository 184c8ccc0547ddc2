#!/usr/bin/env python3
"""Writes what completes command lines in bash, of the texts of --help: commands, options, their values, and the names of
`voxmelt list`.

  completion.py PROGRAM OUT
"""
import sys
from pathlib import Path

import help_text

TEXT = """\
# Completes command lines of voxmelt in bash. It is made of the texts of --help.
_voxmelt() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command=${COMP_WORDS[1]}
  # --option=value is three words of bash.
  if [ "$word" = = ]; then word=
  elif [ "$before" = = ]; then before=${COMP_WORDS[COMP_CWORD-2]}; fi
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W "@COMMANDS@ --help --version" -- "$word"))
    return
  fi
  case "$command $before" in
@VALUES@
  esac
  case "$command $word" in
@OPTIONS@
@PLACES@
  esac
}

# Completes the names of `voxmelt list $1`, or the words $2, or files if $3 says so.
_voxmelt_names() {
  local names=$2
  if [ -n "$1" ]; then names+=" $("${COMP_WORDS[0]}" list "$1" 2> /dev/null | cut -d ' ' -f 1)"; fi
  COMPREPLY=($(compgen -W "$names" -- "$word"))
  if [ -n "$3" ]; then COMPREPLY+=($(compgen -f -- "$word")); compopt -o filenames 2> /dev/null; fi
}
complete -F _voxmelt voxmelt
"""


def offered(option):
    """The call that completes a value. Nobody completes a number."""
    if option.value in ("INT", "UINT", "FLOAT"):
        return ":"
    listed = option.lists()
    alone = listed == "implementations" or option.choices
    words = option.choices or [option.default] * bool(listed and option.default)
    return f"_voxmelt_names '{listed}' '{' '.join(words)}' {'' if alone else 'files'}".rstrip()


def cases(offers):
    """The lines of a `case`: all patterns with the same answer share one."""
    patterns = {}
    for pattern, answer in offers:
        patterns.setdefault(answer, []).append(pattern)
    return "\n".join(f"    {' | '.join(found)}) {answer} ;;" for answer, found in patterns.items())


def script(program):
    _, commands = help_text.commands_of(program)
    values, options, places = [], [], []
    for command in commands:
        values += [(f"'{command.name} {o.name}'", f"{offered(o)}; return") for o in command.options if o.value]
        names = " ".join(o.name for o in command.options)
        options.append((f"'{command.name} -'*", f"COMPREPLY=($(compgen -W '{names}' -- \"$word\"))"))
        places += [(f"'{command.name} '*", offered(o)) for o in command.places[:1]]
    text = TEXT.replace("@COMMANDS@", " ".join(command.name for command in commands))
    return text.replace("@VALUES@", cases(values)).replace("@OPTIONS@", cases(options)).replace("@PLACES@", cases(places))


if __name__ == "__main__":
    Path(sys.argv[2]).write_text(script(sys.argv[1]))
