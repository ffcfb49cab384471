# comments.awk - a header with its plain comments as those of Doxygen, line for line.
#
#   awk -f comments.awk sinew/air/muscle.h
#
# The first comment of a file is the file's. A comment in front of a declaration is for it and for
# those below it up to an empty line; one behind a declaration is for that alone. What a file is named
# after and has no comment of its own has the file's. Lines that are indented by two blanks or more
# stay as they are (equations, tables, examples). Comments in bodies of functions, and those that an
# empty line separates from what follows, are left out.

{ line[NR] = $0 }

# Sets `code` and `note` to the parts of a line before and after its //; returns whether it has one.
function split_line(text,    i, c, quote) {
  code = text; note = ""
  if (!index(text, "//")) return 0
  for (i = 1; i <= length(text); i++) {
    c = substr(text, i, 1)
    if (quote) {
      if (c == "\\") i++
      else if (c == quote) quote = ""
    } else if (c == "\"" || (c == "'" && substr(text, i - 1, 1) !~ /[0-9A-Za-z]/)) quote = c
    else if (substr(text, i, 2) == "//") {
      code = substr(text, 1, i - 1)
      note = substr(text, i + 2)
      return 1
    }
  }
  return 0
}

# Prose without what Doxygen would read as a command, a tag or the name of a class. `span`: it begins
# between two `, which may be in different lines.
function plain(words,    parts, n, i, rest, found, out) {
  n = split(words, parts, "`")
  for (i = 1; i <= n; i++) {
    if (i > 1) span = !span
    if (!span) {
      gsub(/[\\@<>#%]/, "\\\\&", parts[i])
      gsub(/\*/, "\\&lowast;", parts[i])
      gsub(/ ::/, " \\\\::", parts[i])
      # A word at the beginning of a sentence is no class; one with a hump is.
      rest = parts[i]; parts[i] = ""
      while (match(rest, /[A-Za-z_:]+/)) {
        found = substr(rest, RSTART, RLENGTH)
        parts[i] = parts[i] substr(rest, 1, RSTART - 1) (found ~ /^[A-Z][a-z]+:?$/ ? "%" : "") found
        rest = substr(rest, RSTART + RLENGTH)
      }
      parts[i] = parts[i] rest
    }
    out = out (i > 1 ? "`" : "") parts[i]
  }
  return out
}

# Makes text[1..n] of the comments in lines from..to, which begin at the sign //.
function read_comment(from, to,    i, list, shown) {
  n = 0
  for (i = from; i <= to; i++) {
    split_line(line[i])
    sub(/^ /, "", note)
    sub(/[ \t]+$/, "", note)
    text[++n] = note
  }
  list = 0
  for (i = 1; i <= n; i++) {
    if (text[i] ~ /^[-*] /) list = 1
    else if (text[i] !~ /^ /) list = 0
    as_is[i] = text[i] ~ /^ / && !list
  }
  for (i = 2; i < n; i++)  # an empty line between two of them is one of theirs
    if (text[i] == "" && as_is[i - 1] && as_is[i + 1]) as_is[i] = 1
  span = 0
  for (i = 1; i <= n; i++) if (!as_is[i]) text[i] = plain(text[i])
  shown = 0
  for (i = 1; i <= n; i++) {
    if (as_is[i]) text[i] = substr(text[i], 3)
    if (as_is[i] && !shown) {
      if (i == 1) text[1] = "@verbatim " text[1]
      else text[i - 1] = text[i - 1] " @details @verbatim"
    }
    if (!as_is[i] && shown) text[i] = "@endverbatim " text[i]
    shown = as_is[i]
  }
  if (shown) text[n] = text[n] " @endverbatim"
}

function joined(    i, out) {
  for (i = 1; i <= n; i++)
    out = out (i == 1 ? "" : as_is[i] || as_is[i - 1] || text[i] == "" ? "\\ilinebr " : " ") text[i]
  return out
}

# Prints the comment, with the text `before` its first line and the sign `opening`.
function print_comment(before, opening,    i) {
  for (i = 1; i <= n; i++)
    print (i == 1 ? before opening " " : "") text[i] (i == n ? " */" : "")
}

# Prints the variables of `double length = 0, rate = 0;` each with its own declaration and comment: the
# part of "[m], [m/s]" that is its, or the whole.
function print_each(code, words, but_first,    i, c, level, n, part, of, count, type, own) {
  sub(/ *; *$/, "", code)
  for (i = 1; i <= length(code); i++) {
    c = substr(code, i, 1)
    if (c ~ /[<({[]/) level++
    if (c ~ /[>)}\]]/) level--
    if (!n || (c == "," && !level)) n++
    if (c != "," || level) part[n] = part[n] c
  }
  type = part[1]
  sub(/ *[={].*/, "", type)
  sub(/[A-Za-z0-9_]+(\[.*)?$/, "", type)
  count = words ~ /^\[/ ? split(words, of, /, /) : 0
  for (i = 2; i <= count; i++) if (of[i] !~ /^\[/) count = 0
  for (i = 1; i <= n; i++) {
    sub(/^ +/, "", part[i])
    if (i > 1 || !but_first) printf " /** %s */", count == n ? of[i] : words
    printf " %s;", i == 1 ? part[i] : type part[i]
  }
  print ""
}

# Follows the braces of a line of code: what is open, and what has been read of a statement.
function follow(text,    i, c) {
  gsub(/"([^"\\]|\\.)*"/, "\"\"", text)
  gsub(/'([^'\\]|\\.)'/, "0", text)
  if (text ~ /^ *#/) return
  for (i = 1; i <= length(text); i++) {
    c = substr(text, i, 1)
    if (c == "{") {
      kind[depth + 1] = kind_of(statement)
      shared[++depth] = ""
      statement = ""
    } else if (c == "}") {
      if (depth) depth--
      statement = ""
    } else if (c == ";") statement = ""
    else if (statement != "" || c != " ") statement = statement c
  }
  if (statement != "") statement = statement " "
  if (statement ~ /^(public|protected|private): $/) statement = ""
}

function kind_of(words,    i, c, angle, out) {
  if (kind[depth] == "body") return "body"
  gsub(/alignas\([^()]*(\([^()]*\))?[^()]*\)/, "", words)
  for (i = 1; i <= length(words); i++) {  # text in <> is about parameters
    c = substr(words, i, 1)
    if (c == "<") angle++
    if (!angle) out = out c
    if (c == ">") angle--
  }
  if (" " out !~ / (namespace|class|struct|union|enum|extern) / || out ~ /[(=]/) return "body"
  return " " out ~ / enum / ? "enum" : "declares"
}

# The comment for a declaration that has none of its own: that above it, or that of the file.
function lent(code,    name) {
  if (kind[depth] != "declares" || statement != "" || code ~ /^ *($|[#}]|namespace|extern|using namespace|friend|static_assert|public:|private:|protected:)/)
    return ""
  if (code ~ /^ *(class|struct|enum class) [A-Za-z0-9_]+;/) return ""
  if (shared[depth] != "") return "/** " shared[depth] " */ "
  name = code ~ /^ *template *<.*> *$/ ? line[i + 1] : code
  name_line = name
  sub(/ *(final|: |\{|\().*/, "", name)
  sub(/.* /, "", name)
  while (match(name, /[a-z0-9][A-Z]/)) name = substr(name, 1, RSTART) "_" substr(name, RSTART + 1)
  if (tolower(name) == stem) return "/** " purpose " */ "
  if (name_line ~ /^ *(struct|enum) .*\{/) return "/** Described by its members. */ "
  return ""
}

END {
  depth = 0
  kind[0] = "declares"
  stem = FILENAME
  sub(/.*\//, "", stem); sub(/\.h$/, "", stem)
  for (i = 1; line[i] ~ /^\/\//; i++) ;
  if (i > 1) {
    sub(/^\/\/ [^ ]+\.h - /, "// ", line[1])
    line[1] = "// " toupper(substr(line[1], 4, 1)) substr(line[1], 5)
    read_comment(1, i - 1)
    for (k = 1; k <= n && text[k] != "" && text[k] !~ /^@/; k++) purpose = purpose " " text[k]
    sub(/ @details.*/, "", purpose)
    for (k = 1; k <= n; k++) print (k == 1 ? "/** " : "") text[k]
    path = FILENAME
    if (index(path, ENVIRON["PWD"] "/") == 1) path = substr(path, length(ENVIRON["PWD"]) + 2)
    print "@n@n<tt>\\#include \"" path "\"</tt> @file */"  # in place of #pragma once
    i++
  }
  while (i <= NR) {
    has = split_line(line[i])
    if (has && code ~ /^ *$/) {  # lines of its own
      for (end = i; end <= NR && line[end] ~ /^ *\/\//; end++) ;
      if (kind[depth] != "body" && line[end] ~ /^ *[^ }#]/) {
        read_comment(i, end - 1)
        match(line[i], /^ */)
        print_comment(substr(line[i], 1, RLENGTH), "/**")
        if (statement == "") { shared[depth] = joined(); own = 1 }
      } else for (k = i; k < end; k++) print ""
      i = end
      continue
    }
    if (line[i] == "") shared[depth] = ""
    # A class of a private part, defined below, is not public.
    if (code ~ /^ *(public|protected|private):/) access = code
    if (access ~ /private/ && match(code, /^ +(class|struct) [A-Za-z_]+;/)) {
      word = substr(code, RSTART, RLENGTH - 1); sub(/.* /, "", word)
      hidden[word] = 1
    }
    word = line[i] ~ /^template/ ? line[i + 1] : line[i]
    if (match(word, /^(class|struct) [^(:]*::[A-Za-z_]+ \{/)) {
      word = substr(word, 1, RLENGTH - 2); sub(/.*::/, "", word)
      if (word in hidden) {
        for (; line[i] != "};"; i++) print ""
        line[i] = code = ""
      }
    }
    first = statement == ""
    before = own ? "" : lent(code)
    had = own
    inner = kind[depth]
    follow(code)
    behind = has && inner != "body" && note !~ /^ namespace/ && (code ~ /[;,}] *$/ || inner == "enum")
    end = i + 1
    if (behind) {
        while (end <= NR && index(line[end], "//") == length(code) + 1 && substr(line[end], 1, length(code)) ~ /^ *$/) end++
      before = ""
    }
    own = own && statement != ""
    while (match(code, /(^|[^:A-Za-z_])signals::/)) {  # "signals:" is a word of Qt
      word = substr(code, RSTART, RLENGTH)
      sub(/signals/, "sinew::&", word)
      code = substr(code, 1, RSTART - 1) word substr(code, RSTART + RLENGTH)
    }
    several = first && code ~ /^ *[A-Za-z][^()]*[A-Za-z0-9_}], [a-z_][^()]*; *$/ && code !~ /^ *(using|friend|template)/
    if (!behind && several && (had || before != "")) print_each(code, shared[depth], had)
    else if (!behind) print before code
    else {
      shown = code
      read_comment(i, end - 1)
      words = joined()
      if (first && shown ~ /^ *enum/) print "/** " words " */ " shown
      else if (several) print_each(shown, words, 0)
      else print_comment(shown, "/**<")
    }
    i = end
  }
}
