#!/usr/bin/env bash
# sources.sh COMPILER VERSION OUT   copies what the models of fmu/muscle are compiled from into the
# folder OUT, for the FMUs that carry their sources: fmi2.cpp and fmi3.cpp, each the whole model as
# one source, and all files that they include.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
compiler=$1 version=$2 out=$3

rm -rf "$out.part"
mkdir -p "$out.part"
cd "$root"
for number in 2 3; do
  main=$out.part/fmi$number.cpp
  {
    echo "// The whole model as one source, for FMI $number.0. Made by Sinew $version. For GCC or Clang:"
    echo "//   g++ -std=c++20 -O2 -ffp-contract=off -fvisibility=hidden -fPIC -shared -I. fmi$number.cpp -o MODEL.so"
    printf '%s\n' '#if __cplusplus < 202002L' '#error "compile this with -std=c++20"' '#endif'
    echo "#define SINEW_VERSION \"$version\""
    sed '/^#/d; s/.*/#include "&"/' fmu/muscle/sources.txt
    echo "#include \"fmu/muscle/module/fmi$number.cpp\""
  } >"$main"
  "$compiler" -std=c++20 -MM -I. "$main" | tr ' ' '\n' | grep -E '^(sinew|fmu)/' >>"$out.part/files"
done
sort -u "$out.part/files" | while read -r file; do install -D -m 644 "$file" "$out.part/$file"; done
rm "$out.part/files"
rm -rf "$out"
mv "$out.part" "$out"
