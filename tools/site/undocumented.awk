# undocumented.awk - the warnings of Doxygen that are errors: all but those for names without a comment,
# and those for functions, classes, structs, enums and concepts.
#
#   awk -f undocumented.awk searchdata.xml doxygen.txt
#
# A struct or enum without a comment, which comments.awk has marked, needs one unless each of its members
# has one. Constructors that are default, operators, begin() and the like need none.

FILENAME ~ /xml$/ {
  if (/<field name="type">(class|struct|union|concept|function|enum)</) { count++; struct = /struct/ }
  if (/<field name="name">/) { name = $0; gsub(/.*<field name="name">|<\/field>.*/, "", name) }
  if (struct && /<field name="text">Described by its members/) bare[name] = 1
  next
}
/is not documented/ {
  if (/\(variable\)/ && match($0, / of (struct|class) .* is not/)) {
    name = substr($0, RSTART, RLENGTH)
    gsub(/^ of (struct|class) | is not$/, "", name)
    if (!(name in bare)) next
  } else if (!/Compound|\(function\)|\(enumeration\)/) next
  else if (/operator|[: ]~|=(default|delete)| of file | (begin|end|empty|size|[a-z_]*fields)\(/) next
}
!seen[$0]++ { print; wrong++ }
END {
  if (wrong) exit 1
  print "names: each of " count " has a comment"
}
