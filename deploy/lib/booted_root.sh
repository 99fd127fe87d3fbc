# shellcheck shell=bash
# systemd as the first process of a root that bare_root_make made, so that units run there as they
# would on a host. Source this file after say.sh; call it inside bare_root_namespaced.
#
#   booted_root_start ROOT       boots it; the root has to have the package systemd
#   booted_root_run COMMAND...   in the booted system, with nothing of this environment
#
# Network: a loopback of its own and nothing else. What apt-get is to install there has to be
# downloaded before, by bare_root_run.

_BOOT_SECONDS=60

_BOOT_SCRIPT=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/boot_root

booted_root_start() {
  local began=$SECONDS state
  unshare --mount --pid --cgroup --uts --ipc --net --fork --kill-child \
    "$_BOOT_SCRIPT" "$1" </dev/null >"$1.boot.log" 2>&1 &
  _boot_parent=$!
  while [ $((SECONDS - began)) -lt "$_BOOT_SECONDS" ]; do
    _booted_init=$(pgrep -P "$_boot_parent" || true)
    state=$(booted_root_run systemctl is-system-running 2>/dev/null || true)
    [ "$state" = running ] && return 0
    sleep 0.5
  done
  tail -n 20 "$1.boot.log" >&2
  die "systemd did not come up in the root, state ${state:-none}" "this machine may forbid cgroup2 or namespaces"
}

booted_root_run() {
  [ -n "$_booted_init" ] || return 1
  nsenter --target "$_booted_init" --all env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin \
    LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive "$@" </dev/null
}
