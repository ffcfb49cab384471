# transcripts.awk - the two parts of tools/transcripts.sh that read a transcript.
#
#   awk -v work=DIR -v root=REPOSITORY -f numbers.awk -f transcripts.awk split FILE
#     writes DIR/<n>.command for each command of FILE, and DIR/<n>.fresh if a heading precedes it; prints
#     the number of commands
#   awk … judge FILE
#     compares the output of the commands (DIR/<n>.out, .err and .code) with that expected in FILE, prints
#     the differences, and writes FILE with the actual output into DIR/accepted; exit 1 if any differs

function indented(line) { return substr(line, 1, 2) == "  " }
function is_command(line) { return substr(line, 1, 4) == "  $ " }
function is_continued(line) { return substr(line, 1, 4) == "  > " || line == "  >" }

# Reads FILE into lines[1..count]; block[n] is the line of the n-th command.
function read_transcript(file,   line) {
  while ((getline line < file) > 0) {
    lines[++count] = line
    if (is_command(line)) block[++blocks] = count
  }
  if (!count) { print file ": empty or missing"; exit 2 }
}

# Returns the line after the command of block n.
function after_command(n,   at) {
  for (at = block[n] + 1; at <= count && is_continued(lines[at]); ++at);
  return at
}

# Returns the line after the expected output of block n, which ends at prose or at the next command. A blank
# line belongs to the output only if more output follows.
function after_output(n,   at, last) {
  last = after_command(n)
  for (at = last; at <= count && (indented(lines[at]) || lines[at] == "") && !is_command(lines[at]); ++at)
    if (lines[at] != "") last = at + 1
  return last
}

function split_transcript(   n, at, text) {
  for (n = 1; n <= blocks; ++n) {
    text = substr(lines[block[n]], 5)
    for (at = block[n] + 1; at < after_command(n); ++at) text = text "\n" substr(lines[at], 5)
    print text > (work "/" n ".command")
    close(work "/" n ".command")
    for (at = (n > 1 ? block[n - 1] : 0) + 1; at < block[n]; ++at)
      if (lines[at] ~ /^# /) { print "" > (work "/" n ".fresh"); close(work "/" n ".fresh") }
  }
  print blocks + 0
}

# Returns whether a line of output is as expected: "[..]" matches any text; all else must be equal except for
# the rounding of numbers.
function fits(expected, found,   at, part, where) {
  at = index(expected, "[..]")
  if (!at) return same_but_rounding(expected, found, 0)
  part = substr(expected, 1, at - 1)
  if (substr(found, 1, length(part)) != part) return 0
  found = substr(found, length(part) + 1)
  expected = substr(expected, at + 4)
  while ((at = index(expected, "[..]")) > 0) {
    part = substr(expected, 1, at - 1)
    where = index(found, part)
    if (!where) return 0
    found = substr(found, where + length(part))
    expected = substr(expected, at + 4)
  }
  return length(found) >= length(expected) && substr(found, length(found) - length(expected) + 1) == expected
}

# Returns whether the expected lines from i on match the actual lines from j on; a line "..." matches any number
# of lines.
function fit_from(i, j,   k) {
  while (i <= wanted) {
    if (want[i] == "...") {
      for (k = j; k <= have + 1; ++k) if (fit_from(i + 1, k)) return 1
      return 0
    }
    if (j > have || !fits(want[i], got[j])) { if (j > farthest) farthest = j; return 0 }
    ++i; ++j
  }
  if (j > have) return 1
  if (j > farthest) farthest = j
  return 0
}

function replaced(text, from, to,   out, at) {
  while ((at = index(text, from)) > 0) {
    out = out substr(text, 1, at - 1) to
    text = substr(text, at + length(from))
  }
  return out text
}

function add_found(line) {
  line = replaced(replaced(line, work "/here", "$HERE"), root, "$ROOT")
  sub(/ +$/, "", line)
  got[++have] = line
}

# Reads the output of a command and its exit code into got[1..have], in the form of a transcript.
function read_found(name,   line, code) {
  have = 0
  while ((getline line < (name ".out")) > 0) add_found(line)
  while (have && got[have] == "") --have  # blank lines at the end equal those before prose
  while ((getline line < (name ".err")) > 0) add_found("! " line)
  getline code < (name ".code")
  if (code != 0) add_found("[exit " code "]")
  close(name ".out"); close(name ".err"); close(name ".code")
}

function judge_transcript(file,   n, at, line, bad, written, next_at) {
  written = 1
  for (n = 1; n <= blocks; ++n) {
    wanted = have = farthest = 0
    for (at = after_command(n); at < after_output(n); ++at) want[++wanted] = substr(lines[at], 3)
    read_found(work "/" n)
    next_at = after_output(n)
    if (fit_from(1, 1)) {
      for (; written < next_at; ++written) print lines[written] > (work "/accepted")
      continue
    }
    ++bad
    printf "%s:%d: $ %s\n", file, block[n], substr(lines[block[n]], 5)
    for (at = 1; at <= wanted; ++at) print "    expected | " want[at]
    for (at = 1; at <= have; ++at) print (at == farthest ? "  * found    | " : "    found    | ") got[at]
    if (farthest > have) print "  * found    the end"
    for (; written < after_command(n); ++written) print lines[written] > (work "/accepted")
    for (at = 1; at <= have; ++at) print (got[at] == "" ? "" : "  " got[at]) > (work "/accepted")
    written = next_at
  }
  for (; written <= count; ++written) print lines[written] > (work "/accepted")
  if (bad) exit 1
}

BEGIN {
  read_transcript(ARGV[2])
  if (ARGV[1] == "split") split_transcript()
  else judge_transcript(ARGV[2])
  exit
}
