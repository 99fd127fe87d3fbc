# shellcheck shell=bash
# A minimal Debian 12 in a folder, to prove things on. Source this file after say.sh.
#
#   bare_root_namespaced COMMAND...   runs COMMAND FOLDER in namespaces of its own; FOLDER is removed
#                                     at the end, however that comes
#   bare_root_make ROOT               debootstrap, from the apt sources of this machine
#   bare_root_run ROOT COMMAND...     chroot, with nothing of this environment
#
# With the first process of the namespaces go all mounts and processes: none stays.

_require_bare_root_tools() {
  local tool
  [ "$(id -u)" -eq 0 ] || die "debootstrap and chroot need root" "run it as root or with sudo"
  for tool in debootstrap unshare; do
    command -v "$tool" >/dev/null || die "$tool is missing" "apt-get install debootstrap util-linux"
  done
}

# Where this machine gets bookworm from, in whatever way its sources are written.
_bookworm_mirror() {
  # shellcheck disable=SC2016  # apt-get replaces these, not the shell
  apt-get indextargets --format '$(REPO_URI) $(RELEASE)' 'Created-By: Packages' |
    awk '$2 == "bookworm" { print $1; exit }'
}

# The root is to fetch packages as this machine does, and to have nothing else of it.
_copy_apt_sources() {
  local root=$1 kind
  rm -f "$root/etc/apt/sources.list"
  for kind in /etc/apt/sources.list /etc/apt/sources.list.d/*.list /etc/apt/sources.list.d/*.sources \
    /etc/apt/keyrings /etc/apt/trusted.gpg.d; do
    [ ! -e "$kind" ] || cp -rL --parents "$kind" "$root"
  done
  apt-config dump | grep -E '^Acquire::(http|https|Check-|Retries)' >"$root/etc/apt/apt.conf.d/00from-host" || true
  cp -L /etc/hosts /etc/resolv.conf "$root/etc/"
}

bare_root_make() {
  local root=$1 from
  from=$(_bookworm_mirror)
  [ -n "$from" ] || die "no apt source of this machine offers bookworm" "add one to /etc/apt/sources.list.d"
  step "debootstrap"
  quietly "$root.log" debootstrap --variant=minbase bookworm "$root" "$from" ||
    die "debootstrap failed" "its words stand above"
  _copy_apt_sources "$root"
  mount -t proc proc "$root/proc"
  mount -t tmpfs tmpfs "$root/dev/shm"
  step "$(chroot "$root" dpkg-query -W | wc -l) packages in the bare system"
}

bare_root_run() {
  local root=$1
  shift
  env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
    chroot "$root" "$@" </dev/null
}

_bare_root_clean_up() {
  if [ -n "$_bare_root_worker" ]; then
    kill -KILL "$_bare_root_worker" 2>/dev/null || true
    wait "$_bare_root_worker" 2>/dev/null || true
  fi
  rm -rf --one-file-system "$_bare_root_folder"
}

# In the background, so that a signal to this script is heard at once.
bare_root_namespaced() {
  _require_bare_root_tools
  _bare_root_worker='' _bare_root_folder=$(mktemp -d /var/tmp/loopscope-bare.XXXXXX)
  trap _bare_root_clean_up EXIT
  trap 'exit 130' INT TERM HUP
  unshare --mount --pid --fork --kill-child --mount-proc "$@" "$_bare_root_folder" </dev/null &
  _bare_root_worker=$!
  wait "$_bare_root_worker"
}
