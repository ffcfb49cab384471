#!/bin/sh
# no-undefined.sh NM OBJECT: fails, and removes OBJECT, if it needs a symbol from outside.
set -eu
undefined=$("$1" --undefined-only "$2")
if [ -n "$undefined" ]; then
  echo "$2 needs what a bare machine does not have:" >&2
  echo "$undefined" >&2
  rm -f "$2"
  exit 1
fi
