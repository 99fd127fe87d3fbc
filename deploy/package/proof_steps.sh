# shellcheck shell=bash
# The life of an installed package, step by step. Source this file after proof_plant.sh.
#
#   proof_install, proof_by_hand, proof_side_by_side, proof_upgrade, proof_remove,
#   proof_come_back, proof_purge

_REPORT=/srv/proof

# WHAT COMMAND...: COMMAND has to succeed.
expect() {
  local what=$1
  shift
  quietly "$_PROOF_ROOT.step.log" "$@" || die "not so: $what" "the words above say why; the root is gone after this"
  step "ok: $what"
}

refuse() {
  local what=$1
  shift
  if "$@" >/dev/null 2>&1; then
    die "not so: $what" "this was to be refused: $*"
  fi
  step "ok: $what"
}

_apt() {
  booted_root_run apt-get -q -y --no-install-recommends "$@" >"$_PROOF_ROOT$_REPORT/apt.log" 2>&1 || {
    cat "$_PROOF_ROOT$_REPORT/apt.log" >&2
    return 1
  }
}

_active() {
  booted_root_run systemctl is-active --quiet "$1"
}

_main_pid() {
  booted_root_run systemctl show --property MainPID --value "$1"
}

# FIELD of what dpkg knows of the package.
_installed() {
  booted_root_run dpkg-query --show --showformat "\${$1}" loopscope
}

_says() {
  grep -q "$1" "$_PROOF_ROOT$_REPORT/apt.log"
}

# Up to 30 s: what another process does takes its time.
_soon() {
  local attempt
  for attempt in {1..60}; do
    ! "$@" || return 0
    sleep 0.5
  done
  printf 'after %s tries: %s\n' "$attempt" "$*" >&2
  return 1
}

proof_install() {
  expect "apt installs the package and what it depends on" _apt install "$_REPORT/old.deb"
  expect "it says that it was not started" _says 'not started'
  refuse "the unit does not run without settings" _active loopscope.service
  expect "the unit is enabled" booted_root_run systemctl is-enabled --quiet loopscope.service
  expect "installing it again changes nothing" _apt install --reinstall "$_REPORT/old.deb"
  expect "the folder is root's and the group's" test "$(booted_root_run stat -c '%U:%G %a' /etc/loopscope)" = 'root:loopscope 750'
  expect "no file is a conffile" test -z "$(_installed Conffiles)"
}

_verdicts() {
  proof_sql loopscope "SELECT count(*) FROM loopscope.latest_verdict WHERE code = '$1'"
}

_by_hand_for_3_s() {
  # 124: ended by the time limit, after the program has ended in peace.
  local code=0
  proof_as_worker timeout --preserve-status --signal=TERM 3 loopscope run || code=$?
  [ "$code" -eq 0 ]
}

proof_by_hand() {
  expect "migrate" proof_as_owner loopscope migrate
  booted_root_run loopscope simulate sticking_valve --seed 1 --out "$_REPORT/FIC101.csv"
  expect "import" proof_as_owner loopscope import --create-table --loop FIC101 "$_REPORT/FIC101.csv"
  expect "check-config as the worker" proof_as_worker loopscope check-config
  expect "once" proof_as_worker loopscope once
  expect "SQL shows the verdict: valve_stiction" test "$(_verdicts valve_stiction)" = 1
  expect "run ends in peace when told to" _by_hand_for_3_s
}

_new_main_pid() {
  local now
  now=$(_main_pid "$1")
  [ "$now" != 0 ] && [ "$now" != "$2" ] && _active "$1"
}

_oldest_program_is() {
  proof_sql loopscope "CREATE OR REPLACE FUNCTION loopscope.oldest_program() RETURNS integer IMMUTABLE LANGUAGE sql RETURN $1"
}

# As a later release would leave the schema: expanded first, contracted afterwards.
proof_side_by_side() {
  local oldest
  oldest=$(proof_sql loopscope "SELECT loopscope.oldest_program()")
  proof_sql loopscope "INSERT INTO loopscope.schema_migration (version, name, sha256) VALUES (999, 'later', repeat('0', 64))"
  expect "a worker works on a later schema that was only added to" proof_as_worker loopscope once
  _oldest_program_is 999
  refuse "not on one that has taken away what it uses" proof_as_worker loopscope once
  _oldest_program_is "$oldest"
  proof_sql loopscope "DELETE FROM loopscope.schema_migration WHERE version = 999"
}

_settings_sum() {
  booted_root_run sh -c 'find /etc/loopscope -type f -exec sha256sum {} + | sort'
}

proof_upgrade() {
  local before pid
  before=$(_settings_sum) pid=$(_main_pid loopscope.service)
  booted_root_run systemctl stop loopscope@north.service
  expect "apt upgrades, nothing is asked" _apt install "$_REPORT/new.deb"
  expect "the new version is there" test "$(_installed Version)" != "$_PROOF_VERSION"
  expect "the settings are kept" test "$(_settings_sum)" = "$before"
  expect "what ran was restarted" _soon _new_main_pid loopscope.service "$pid"
  refuse "what stood still was not" _active loopscope@north.service
  booted_root_run systemctl enable --quiet --now loopscope@north.service
}

_no_worker() {
  ! booted_root_run pgrep -x loopscope >/dev/null
}

proof_remove() {
  expect "apt removes" _apt remove loopscope
  expect "nothing runs" _soon _no_worker
  expect "settings are kept" booted_root_run test -e /etc/loopscope/loopscope.json
}

# What remove has stopped and nobody has disabled.
proof_come_back() {
  expect "apt installs again after remove" _apt install "$_REPORT/new.deb"
  expect "the worker runs" _soon _active loopscope.service
  expect "so does the instance that is enabled" _soon _active loopscope@north.service
  expect "and the timer" _active loopscope-maintain.timer
  booted_root_run systemctl disable --quiet --now loopscope.service
  expect "disabled, removed" _apt remove loopscope
  expect "and installed again" _apt install "$_REPORT/new.deb"
  refuse "it does not start by itself" _active loopscope.service
  expect "but the instance does" _soon _active loopscope@north.service
}

proof_purge() {
  expect "the reports are kept until now" booted_root_run test -d /var/lib/loopscope
  expect "apt purges, with the packages that nothing else needs" _apt purge --autoremove loopscope
  refuse "no report is left to the next user of that number" booted_root_run test -e /var/lib/loopscope
  expect "the results are kept" test "$(_verdicts valve_stiction)" = 1
}
