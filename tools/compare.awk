# compare.awk   awk [-v relative=R] -f numbers.awk -f compare.awk EXPECTED FOUND
#
# Compares two texts line by line. Words must be equal, except for the width of blanks; numbers may differ as
# same_but_rounding() allows. Prints lines that differ; exit 1 if any does.

function blanks(text) {
  gsub(/[ \t\r]+/, " ", text)
  sub(/^ /, "", text)
  sub(/ $/, "", text)
  return text
}

function differ(at, a, b) {
  if (++different > most) return
  printf "line %d: expected %s\n            found %s\n", at, a, b
}

BEGIN {
  if (ARGC != 3) { print "usage: awk [-v relative=R] -f numbers.awk -f compare.awk EXPECTED FOUND"; exit 2 }
  most = 5  # number of differences shown
  while ((getline line < ARGV[1]) > 0) expected[++lines_expected] = line
  while ((getline line < ARGV[2]) > 0) found[++lines_found] = line
  if (lines_expected + 0 == 0) { print ARGV[1] ": empty or missing"; exit 1 }

  for (i = 1; i <= lines_expected && i <= lines_found; ++i)
    if (!same_but_rounding(blanks(expected[i]), blanks(found[i]), relative)) differ(i, expected[i], found[i])
  for (; i <= lines_expected; ++i) differ(i, expected[i], "the end")
  for (; i <= lines_found; ++i) differ(i, "the end", found[i])
  if (different > most) print "and " different - most " more lines"
  exit different ? 1 : 0
}
