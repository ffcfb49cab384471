#!/usr/bin/env bash
# man.sh PROGRAM VERSION   prints the manual page sinew(1), generated from the help of all subcommands.
set -euo pipefail
program=$1 version=$2

help_of() { (exec -a sinew "$program" "$@" --help); }

# Escapes characters that roff would interpret; alignment is kept.
as_text() { sed -e 's/\\/\\e/g' -e 's/-/\\-/g' -e "s/^\([.']\)/\\\\\&\1/"; }

section() {  # section WORDS...: prints the section of a command
  local help
  help=$(help_of "$@")
  printf '.SS "sinew %s"\n' "$*"
  sed '/^$/,$d' <<<"$help" | as_text
  printf '.PP\n.nf\n'
  sed '1,/^$/d' <<<"$help" | grep -v '^  -h, --help' | as_text
  printf '.fi\n'
}

cat <<END
.TH SINEW 1 "" "sinew $version" "User Commands"
.SH NAME
sinew \\- robots driven by braided pneumatic actuators
.SH SYNOPSIS
.B sinew
.I SUBCOMMAND
[\\fIOPTIONS\\fR]
.SH DESCRIPTION
Simulates, identifies, tunes and controls robots that are pulled by braided pneumatic actuators, also
called McKibben muscles. Results go to standard output, progress and messages to standard error.
.SH SUBCOMMANDS
END
while read -ra words; do section "${words[@]}"; done < <("$program" help commands)
cat <<'END'
.SH TOPICS
END
for name in units files channels next; do
  printf '.SS "sinew help %s"\n.nf\n' "$name"
  "$program" help "$name" | as_text
  printf '.fi\n'
done
cat <<'END'
.SH EXIT STATUS
0 done, 1 failed, 2 wrong usage.
.SH FILES
.TP
.I ../share/sinew
robots and experiments, relative to the program's folder
.TP
.I ../share/doc/sinew
documentation
END
