# flatten.awk   awk -f flatten.awk [-v digits=4] summary.json
#
# Converts indented JSON, as Sinew writes it, into one value per line: "joints.hip.passiveness 0.9363", for
# grep, diff and expected.txt. Elements of lists have an index, "phases[0]". Numbers are rounded to `digits`.

function name(  text, i) {
  text = ""
  for (i = 1; i <= depth; ++i) text = text (kind[i] == "[" ? "[" at[i] "]" : (i > 1 ? "." : "") key[i])
  return text
}

BEGIN { if (!digits) digits = 4 }
{
  line = $0
  gsub(/^[ \t]+|,?[ \t\r]*$/, "", line)
  if (line ~ /^[]}]/) { --depth; next }

  if (depth && kind[depth] == "[") ++at[depth]
  if (match(line, /^"[^"]*":[ \t]*/)) {
    key[depth] = substr(line, 2, index(substr(line, 2), "\"") - 1)
    line = substr(line, RLENGTH + 1)
  }

  if (line == "{" || line == "[") {
    kind[++depth] = line
    at[depth] = -1
  } else if (line ~ /^-?[0-9.]+([eE][-+]?[0-9]+)?$/) {
    printf "%s %." digits "g\n", name(), line
  } else if (line != "") {
    gsub(/^"|"$/, "", line)
    print name(), line
  }
}
