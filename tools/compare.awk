# compare.awk   awk [-v relative=R] -f compare.awk EXPECTED FOUND
#
# Are two texts the same, numbers apart from rounding? Words must agree, blanks need not. A number
# with a decimal point or an exponent may differ by one in the last digit that EXPECTED prints, or
# by `relative` of itself if that is more; whole numbers must agree. Prints what differs; exit 1.

function blanks(text) {
  gsub(/[ \t\r]+/, " ", text)
  sub(/^ /, "", text)
  sub(/ $/, "", text)
  return text
}

# One unit of the last printed digit: 0.01 of "3.14", 10 of "3.1e2", 0 of "3".
function last_digit(number,   exponent, point) {
  exponent = 0
  if (match(number, /[eE]/)) {
    exponent = substr(number, RSTART + 1) + 0
    number = substr(number, 1, RSTART - 1)
  } else if (!index(number, ".")) return 0
  point = index(number, ".")
  if (point) exponent -= length(number) - point
  return 10 ^ exponent
}

function differ(at, a, b) {
  if (++different > most) return
  printf "line %d: expected %s\n            found %s\n", at, a, b
}

function compare(at, a, b,   x, y, left, right, allowed, off, before_a, before_b) {
  left = a
  right = b
  while (match(a, pattern)) {
    before_a = substr(a, 1, RSTART - 1)
    x = substr(a, RSTART, RLENGTH)
    a = substr(a, RSTART + RLENGTH)
    if (!match(b, pattern)) { differ(at, left, right); return }
    before_b = substr(b, 1, RSTART - 1)
    y = substr(b, RSTART, RLENGTH)
    b = substr(b, RSTART + RLENGTH)

    allowed = last_digit(x) * 1.000001
    if (relative * (x < 0 ? -x : x) > allowed) allowed = relative * (x < 0 ? -x : x)
    off = x - y
    if (off < 0) off = -off
    if (blanks(before_a) != blanks(before_b) || off > allowed) { differ(at, left, right); return }
  }
  if (blanks(a) != blanks(b)) differ(at, left, right)
}

BEGIN {
  if (ARGC != 3) { print "usage: awk [-v relative=R] -f compare.awk EXPECTED FOUND"; exit 2 }
  most = 5  # differences that are shown
  pattern = "[-+]?[0-9]+([.][0-9]+)?([eE][-+]?[0-9]+)?"
  while ((getline line < ARGV[1]) > 0) expected[++lines_expected] = line
  while ((getline line < ARGV[2]) > 0) found[++lines_found] = line
  if (lines_expected + 0 == 0) { print ARGV[1] ": empty or missing"; exit 1 }

  for (i = 1; i <= lines_expected && i <= lines_found; ++i) compare(i, expected[i], found[i])
  for (; i <= lines_expected; ++i) differ(i, expected[i], "the end")
  for (; i <= lines_found; ++i) differ(i, "the end", found[i])
  if (different > most) print "and " different - most " more lines"
  exit different ? 1 : 0
}
