#!/usr/bin/env bash
# package.sh BUILD FOLDER   makes the Debian packages of a build, installs them below a root of its
# own without being root, uses the installed files, removes them, and checks that nothing remains.
set -euo pipefail
cd "$(dirname "$0")/../.."
if ! command -v dpkg-deb >/dev/null; then
  echo "package: left out, for this system has no dpkg"
  exit
fi
build=$(cd "$1" && pwd)
mkdir -p "$2"
folder=$(cd "$2" && pwd)
root=$folder/root debs=$folder/debs
rm -rf "$root" "$debs" "$folder/again"
export SOURCE_DATE_EPOCH=1000000000  # the same both times, also after a commit in between

fail() { echo "package: $*" >&2; exit 1; }
packages() { dpkg-query --admindir="$root/var/lib/dpkg" -W -f '${Package} ${db:Status-Status}\n' 2>/dev/null; }
files() { (cd "$root" && find . -path ./var/lib/dpkg -prune -o -print | sort); }
# dpkg without root's rights, below the root; the dependencies of the packages are not installed.
dpkg_in_root() {
  PATH=$PATH:/usr/sbin:/sbin dpkg --root="$root" --force-not-root --force-depends \
    --force-script-chrootless --log="$folder/dpkg.log" "$@" >"$folder/dpkg.out" 2>&1 ||
    { cat "$folder/dpkg.out"; fail "dpkg $1 failed"; }
}

# 1. The packages. Compressed quickly: those for users are smaller.
make_into() {
  (cd "$build" && cpack -G DEB -B "$1" -D CPACK_DEBIAN_COMPRESSION_TYPE=gzip \
     ${2:+-D "CPACK_COMPONENTS_ALL=$2"}) >"$folder/cpack.log" 2>&1 || { cat "$folder/cpack.log"; fail "cpack failed"; }
  rm -rf "$1/_CPack_Packages"
}
make_into "$debs"
for name in sinew libsinew-dev python3-sinew; do
  compgen -G "$debs/${name}_*.deb" >/dev/null || fail "no $name among $(ls "$debs")"
done
make_into "$folder/again" program
cmp "$debs"/sinew_*.deb "$folder/again"/sinew_*.deb || fail "made twice, the package differs"

for deb in "$debs"/*.deb; do
  name=$(dpkg-deb -f "$deb" Package)
  list=$(dpkg-deb -c "$deb" | awk '{ print $6 }')
  for file in "./usr/share/doc/$name/copyright" "./usr/share/doc/$name/changelog.gz" "./usr/share/doc/$name/changelog.Debian.gz"; do
    grep -qx "$file" <<<"$list" || fail "$name lacks $file"
  done
  wrong=$(grep -vE '^\./usr/(bin|include|lib|share)?(/|$)' <<<"$list" || true)
  wrong+=$(grep -E '_test\.h$|__pycache__|\.pyc$|/local/|/test_[^/]*\.h$' <<<"$list" || true)
  [[ ! $wrong ]] || fail "$name holds $wrong"
done
zcat_of() { dpkg-deb --fsys-tarfile "$1" | tar -xO "$2" | zcat; }
version=$(dpkg-deb -f "$debs"/sinew_*.deb Version)
zcat_of "$debs"/sinew_*.deb ./usr/share/doc/sinew/changelog.Debian.gz | head -n 1 | grep -qF "sinew ($version) " ||
  fail "cmake/debian/changelog does not begin with version $version"
manual=$(zcat_of "$debs"/sinew_*.deb ./usr/share/man/man1/sinew.1.gz)
for word in run sweep check migrate 'identify static'; do
  grep -q "^\.SS \"sinew $word\"" <<<"$manual" || fail "sinew(1) lacks $word"
done
depends() { dpkg-deb -f "$debs/$1"_*.deb Depends; }
[[ $(depends sinew) == *libpagmo* && $(depends sinew) != *mpi* ]] || fail "sinew depends on $(depends sinew)"
[[ $(depends libsinew-dev) == *libceres-dev* ]] || fail "libsinew-dev depends on $(depends libsinew-dev)"
[[ $(depends python3-sinew) == *"sinew (= "*python3-numpy* ]] || fail "python3-sinew depends on $(depends python3-sinew)"

# 2. Installed below a root.
mkdir -p "$root"/var/lib/dpkg/{info,updates,triggers}
touch "$root"/var/lib/dpkg/{status,available}
before=$(files)
dpkg_in_root --install "$debs"/*.deb
[[ $(packages | grep -c ' installed$') == $(find "$debs" -name '*.deb' | wc -l) ]] || fail "not all are installed: $(packages)"
! grep -rIlF "$build" "$root/usr" || fail "these name the folder of the build"

# 3. Used, with nothing else in the environment.
mkdir "$folder/home" 2>/dev/null || true
cd "$folder/home"
alone() { env -i PATH="$root/usr/bin:/usr/bin:/bin" HOME="$folder/home" "$@"; }
alone sinew --version
share=$root/usr/share/sinew
alone sinew check "$share"/robots/*/*.toml "$share"/experiments/*.toml >"$folder/check.out" || { cat "$folder/check.out"; fail "shipped files"; }
rm -rf walk
alone sinew run "$share/experiments/walk-test-1.toml" -o walk --quiet >/dev/null
[[ -s walk/log.mcap && -s walk/summary.json ]] || fail "the walk left no log"
rm -rf arm
alone sinew list robots | grep 'leg/robot.toml' >/dev/null || fail "sinew list does not know the leg"
alone sinew new robot arm >/dev/null && alone sinew check arm/robot.toml >/dev/null || fail "a new robot is not in order"
alone sinew fmu export "$share/robots/leg/robot.toml" --muscle hip_flexor -o muscle.fmu --force >/dev/null
alone PYTHONPATH="$OLDPWD/fmu/tests" PYTHONDONTWRITEBYTECODE=1 "${PYTHON:-/usr/bin/python3}" -c '
from importer import Fmu
slave = Fmu("muscle.fmu").instantiate().initialize(inlet=True)
slave.step(0.0, 0.05)
assert slave.get("tension") > 10, slave.get("tension")' || fail "the FMU does not pull"
cd "$OLDPWD"
SINEW_PREFIX=$root/usr tools/examples.sh 04-consumer
python/tests/journey.sh "$root/usr"

# 4. Removed: nothing remains.
mapfile -t names < <(packages | awk '{ print $1 }')
dpkg_in_root --purge "${names[@]}"
after=$(files)
[[ $before == "$after" ]] || fail "removed, these are left: $(diff <(echo "$before") <(echo "$after"))"
[[ -z $(packages) ]] || fail "dpkg still knows $(packages)"
size=$(du -ck "$debs"/*.deb | awk 'END { printf "%.0f", $1 / 1000 }')
rm -rf "$root" "$folder/again"
echo "package: ${#names[@]} .deb, $size MB: installed, used and removed, and nothing is left"
