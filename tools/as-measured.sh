#!/usr/bin/env bash
# as-measured.sh SHIFT RATE 'CHANNEL=NAME*FACTOR~SIGMA'... <run.csv >measured.csv
#
# Converts the output of `sinew export RUN --csv` into the recording of a laboratory: only some channels,
# with other names and units, a clock that shows SHIFT s at the start of the run and is RATE % fast, and
# Gaussian noise of SIGMA. The same input gives the same bytes. With GERMAN=1 columns are separated by
# semicolons and numbers have a decimal comma.
#
#   sinew export runs/one-joint/1 --csv |
#     tools/as-measured.sh 2.5 0.3 '/joint/lever/angle=Winkel [deg]*57.29578~0.2' >measured.csv
set -euo pipefail
(( $# >= 3 )) || { sed -n '2,11s/^# \{0,1\}//p' "$0" >&2; exit 2; }
shift_s=$1 rate=$2
shift 2
awk -v shift_s="$shift_s" -v rate="$rate" -v german="${GERMAN:-0}" '
  function uniform() {  # 0 to 1; the multiplier of Park and Miller (1988)
    seed = (seed * 16807) % 2147483647
    return seed / 2147483647
  }
  function normal(   i, sum) {  # approximately normal: the sum of twelve uniform numbers minus 6
    for (i = 0; i < 12; ++i) sum += uniform()
    return sum - 6
  }
  function written(number,   text) {
    text = sprintf("%.7g", number)
    if (german) sub(/\./, ",", text)
    return text
  }
  function give_up(text) { print "as-measured.sh: " text > "/dev/stderr"; failed = 1; exit 1 }
  BEGIN { FS = ","; seed = 20001; separator = german ? ";" : "," }
  NR == FNR {  # the requested channels
    at = index($0, "="); star = match($0, /\*[^*]*$/); tilde = match($0, /~[^~]*$/)
    if (!at || !star || !tilde) give_up("found \"" $0 "\"; expected CHANNEL=NAME*FACTOR~SIGMA")
    channel[++wanted] = substr($0, 1, at - 1)
    name[wanted] = substr($0, at + 1, star - at - 1)
    factor[wanted] = substr($0, star + 1, tilde - star - 1)
    sigma[wanted] = substr($0, tilde + 1)
    next
  }
  !header++ {
    line = german ? "Zeit [s]" : "time [s]"
    for (w = 1; w <= wanted; ++w) {
      for (i = 2; i <= NF; ++i) if (index($i, channel[w] " [") == 1) column[w] = i
      if (!column[w]) give_up("found no column " channel[w] " in the CSV; expected a channel of the run")
      line = line separator name[w]
    }
    print line
    next
  }
  {
    line = written(shift_s + (1 + rate / 100) * $1)
    for (w = 1; w <= wanted; ++w) {
      noise = sigma[w] > 0 ? sigma[w] * normal() : 0
      line = line separator ($column[w] == "" ? "" : written(factor[w] * $column[w] + noise))
    }
    print line
  }
' <(printf '%s\n' "$@") -
