# shellcheck shell=bash
# Programs out of Debian packages that are not installed. Source this file after packages.sh.
#
#   need_extracted   every program of deploy/packages/extracted, into build/tools of the checkout,
#                    unless it is there or on the PATH
#
# Installing `prometheus` would make a user and start a server that nobody asked for; its promtool
# alone is a file. The download needs no root; a list of packages that is older than the archive
# is brought up to date first.

_TOOLS=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)/build/tools

_download() {
  apt-get -q download "$1" || { _as_root apt-get -q update && apt-get -q download "$1"; }
}

# A subshell, for its folder.
_extract() (
  folder=$(mktemp -d)
  trap 'rm -rf "$folder"' EXIT
  cd "$folder" || return
  _download "$1" && dpkg-deb --extract ./*.deb unpacked &&
    mkdir -p "$_TOOLS" && install -m 0755 "unpacked/$2" "$_TOOLS"
)

need_extracted() {
  local package path
  while read -r package path; do
    if [ -x "$_TOOLS/$(basename "$path")" ] || command -v "$(basename "$path")" >/dev/null; then
      continue
    fi
    step "taking $(basename "$path") out of the package $package"
    quietly "$_TOOLS/$package.log" _extract "$package" "$path" ||
      die "$(basename "$path") cannot be had" "apt-get has to reach the package $package"
  done < <(sed -e 's/#.*//' -e '/^[[:space:]]*$/d' "$_PACKAGE_LISTS/extracted")
}
