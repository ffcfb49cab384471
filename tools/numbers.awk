# numbers.awk - functions for comparing two lines of text whose numbers may differ by rounding.

# Returns one unit of the last printed digit: 0.01 for "3.14", 10 for "3.1e2", 0 for "3".
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

# Returns whether two lines have the same words and the same numbers. A number with a decimal point or
# an exponent may differ by one in the last digit that `a` prints, or by `relative` of itself if that
# is more; whole numbers must be equal.
function same_but_rounding(a, b, relative,   number, before, x, y, allowed, off) {
  number = "[-+]?[0-9]+([.][0-9]+)?([eE][-+]?[0-9]+)?"
  while (match(a, number)) {
    before = substr(a, 1, RSTART - 1)
    x = substr(a, RSTART, RLENGTH)
    a = substr(a, RSTART + RLENGTH)
    if (!match(b, number) || substr(b, 1, RSTART - 1) != before) return 0
    y = substr(b, RSTART, RLENGTH)
    b = substr(b, RSTART + RLENGTH)
    if (x == y) continue
    allowed = last_digit(x) * 1.000001
    if (relative * (x < 0 ? -x : x) > allowed) allowed = relative * (x < 0 ? -x : x)
    off = x - y
    if (off < 0) off = -off
    if (off > allowed) return 0
  }
  return a == b
}
