// cli/completion_scripts.h - what the shells run to complete a line of sinew. Words between @ are
// put in by cli/completion.cpp: @rows@, @chosen@, @functions@, @keyed@, @all@.
#pragma once

#include <string_view>

namespace sinew::cli {

// bash and zsh understand the same of these. They fill `at`, the commands of the line, and what may
// follow: `commands`, `options`, those of the options that take a value, and `choices` of a word.
constexpr std::string_view shell_functions =
    R"script(# What may follow the command $1, and its option $2.
_sinew_words() {
  case "$1" in
@rows@  esac
  case "${1}:${2}" in
@chosen@  esac
}

# What may follow the words of the line.
_sinew_line() {
  local word
  _sinew_words '' ''
  for word in "$@"; do
    [[ " $commands " == *" $word "* ]] || continue
    at=${at:+$at }$word
    _sinew_words "$at" ''
  done
}

# Keys of the first file in the line, which are the words behind the program $1. bash would run a
# `$(…)` in a word, so that a key of any other letters is left out.
_sinew_keys() {
  local program=$1 word
  shift
  for word in "$@"; do
    word=${word/#\~/$HOME}
    if [[ $word == *.toml && -f $word ]]; then
      "$program" show "$word" --json 2>/dev/null |
        sed -n 's/^ *"key": "\([][A-Za-z0-9_.-]*\)",*$/\1/p'
      return
    fi
  done
}

# The words that the key $2 can have, as the program $1 says; one with a blank is left out.
_sinew_choices() {
  [[ -n $2 && $2 != *[!][A-Za-z0-9_.-]* ]] || return
  "$1" keys "$2" --json 2>/dev/null |
    sed -n '/"choices"/,/]/s/^ *"\([A-Za-z0-9_.-]*\)",*$/\1/p' | sort -u
}
)script";

constexpr std::string_view bash_script =
    R"script(# bash completion of sinew, made by `sinew completion bash`

@functions@
_sinew() {
  local at='' commands='' options='' valued='' choices=''
  local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}
  COMPREPLY=()
  _sinew_line "${COMP_WORDS[@]:1:COMP_CWORD-1}"
  _sinew_words "$at" "$before"
  case $before in
    @keyed@)
      mapfile -t COMPREPLY < <(compgen -S = -W "$(_sinew_keys "$1" "${COMP_WORDS[@]:1}")" -- "$current")
      compopt -o nospace 2>/dev/null
      return ;;
  esac
  [[ $before == -* && " $valued " == *" $before "* ]] && return  # a file, or a word of one's own
  if [[ $before == = || $current == = ]]; then  # a value behind its key
    local last=$((COMP_CWORD - 1))
    [[ $current == = ]] && last=$COMP_CWORD current=''
    case ${COMP_WORDS[last - 2]} in
      @keyed@) choices=$(_sinew_choices "$1" "${COMP_WORDS[last - 1]}") ;;
    esac
  elif [[ $current == -* ]]; then
    choices=$options
  elif [[ $at == show ]]; then
    choices=$(_sinew_keys "$1" "${COMP_WORDS[@]:1:COMP_CWORD-1}")
  elif [[ $commands ]]; then
    choices=$commands
  fi
  mapfile -t COMPREPLY < <(compgen -W "$choices" -- "$current")
}
complete -o default -F _sinew sinew
)script";

constexpr std::string_view zsh_script = R"script(#compdef sinew
# zsh completion of sinew, made by `sinew completion zsh`

@functions@
_sinew() {
  local at='' commands='' options='' valued='' choices=''
  local before=${words[CURRENT-1]} current=${words[CURRENT]}
  _sinew_line "${(@)words[2,CURRENT-1]}"
  _sinew_words "$at" "$before"
  case $before in
    @keyed@)
      if compset -P '*='; then  # a value behind its key
        compadd -- ${(f)"$(_sinew_choices "${words[1]}" "${current%%=*}")"}
        return
      fi
      compadd -S = -- ${(f)"$(_sinew_keys "${(@)words}")"}
      return ;;
  esac
  if [[ $before == -* && " $valued " == *" $before "* ]]; then
    _files
  elif [[ $current == -* ]]; then
    compadd -- ${=options}
  elif [[ -n $commands ]]; then
    compadd -- ${=commands}
  elif [[ -n $choices ]]; then
    compadd -- ${=choices}
  else
    _files
  fi
}

if [[ $zsh_eval_context[-1] == loadautofunc ]]; then
  _sinew "$@"
else
  compdef _sinew sinew
fi
)script";

constexpr std::string_view fish_script =
    R"script(# fish completion of sinew, made by `sinew completion fish`

# Are the commands of the line the words that follow?
function __sinew_at
    set -l at
    for word in (commandline -opc)[2..-1]
        contains -- "$at $word" @all@; or continue
        set at "$at $word"
    end
    test "$at" = "$argv[1]"
end

# Keys of the first file in the line, each with its "="; behind the "=" the words that the key can have.
function __sinew_keys
    set -l words (commandline -opc)
    set -l key (string match -r '^[A-Za-z0-9_.-]+(?==)' -- (commandline -ct))
    if test -n "$key"
        $words[1] keys $key --json 2>/dev/null | sed -n '/"choices"/,/]/s/^ *"\([A-Za-z0-9_.-]*\)",*$/'$key'=\1/p' | sort -u
        return
    end
    for word in $words[2..-1]
        if string match -q '*.toml' -- $word; and test -f $word
            $words[1] show $word --json 2>/dev/null | sed -n 's/^ *"key": "\([][A-Za-z0-9_.-]*\)",*$/\1=/p'
            return
        end
    end
end

)script";

}  // namespace sinew::cli
