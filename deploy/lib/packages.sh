# shellcheck shell=bash
# Installs Debian packages that are missing. Source this file after say.sh.
#
#   need_packages LIST...   every package that deploy/packages/LIST names, one a line, # comments
#
# Nothing missing: no network, no root. Otherwise apt-get, by sudo for an ordinary user.

_PACKAGE_LISTS=$(cd "$(dirname "${BASH_SOURCE[0]}")/../packages" && pwd)

# Debian starts a cluster `main` with the first postgresql-15. Ours is a private one, so this file
# stands while apt-get runs; a cluster that exists already is not touched by it.
_NO_MAIN_CLUSTER=/etc/postgresql-common/createcluster.d/loopscope-no-main-cluster.conf

_packages_named() {
  local list
  for list in "$@"; do
    sed -e 's/#.*//' -e 's/[[:space:]]//g' -e '/^$/d' "$_PACKAGE_LISTS/$list"
  done
}

_is_installed() {
  [ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

_missing_packages() {
  local package
  while read -r package; do
    _is_installed "$package" || printf '%s\n' "$package"
  done < <(_packages_named "$@")
}

_as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  else
    sudo "$@"
  fi
}

_require_means_to_install() {
  if ! command -v apt-get >/dev/null; then
    die "packages are missing and there is no apt-get: $*" "install what corresponds to them on your system"
  fi
  if [ "$(id -u)" -ne 0 ] && ! command -v sudo >/dev/null; then
    die "packages are missing and neither root nor sudo is there to install them: $*" \
      "run as root:  apt-get install --no-install-recommends $*"
  fi
}

_forbid_main_cluster() {
  _as_root mkdir -p "$(dirname "$_NO_MAIN_CLUSTER")" &&
    printf 'create_main_cluster = false\n' | _as_root tee "$_NO_MAIN_CLUSTER" >/dev/null
}

_apt_install() {
  _as_root apt-get -q update &&
    _as_root env DEBIAN_FRONTEND=noninteractive \
      apt-get -q -y --no-install-recommends install "$@" </dev/null
}

# A subshell, so that the file goes away however apt-get ends.
_install() (
  if ! _is_installed postgresql-15; then
    trap '_as_root rm -f "$_NO_MAIN_CLUSTER"' EXIT
    _forbid_main_cluster || return
  fi
  _apt_install "$@"
)

need_packages() {
  local missing=() log
  mapfile -t missing < <(_missing_packages "$@")
  [ "${#missing[@]}" -gt 0 ] || return 0
  _require_means_to_install "${missing[@]}"
  step "installing ${missing[*]}"
  case " ${missing[*]} " in
    *" postgresql-15 "*) step "PostgreSQL is new here: its packages will not make the cluster \`main\`" ;;
  esac
  log=$(mktemp)
  if ! quietly "$log" _install "${missing[@]}"; then
    die "apt-get failed" "its words stand above; a second run takes up where this one ended"
  fi
  rm -f "$log"
}
