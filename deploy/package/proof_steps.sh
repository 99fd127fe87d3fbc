# shellcheck shell=bash
# The life of an installed package, step by step. Source this file after proof_plant.sh.
#
#   proof_install, proof_by_hand, proof_units, proof_secrets, proof_upgrade, proof_remove, proof_purge

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

_verdict_newer_than() {
  [ "$(proof_sql loopscope "SELECT count(*) FROM loopscope.analysis WHERE created_at > '$1'")" -gt 0 ]
}

_new_main_pid() {
  local now
  now=$(_main_pid "$1")
  [ "$now" != 0 ] && [ "$now" != "$2" ] && _active "$1"
}

_second_loop_is_judged() {
  [ "$(proof_sql loopscope "SELECT count(DISTINCT loop_id) FROM loopscope.analysis")" = 2 ]
}

proof_units() {
  local pid
  expect "systemctl start, READY=1" booted_root_run systemctl start loopscope.service
  booted_root_run loopscope simulate deadband --seed 2 --out "$_REPORT/TIC301.csv"
  proof_as_owner loopscope import --loop TIC301 "$_REPORT/TIC301.csv" >/dev/null
  expect "the unit judges a new loop, with the password from its credential" _soon _second_loop_is_judged
  expect "systemctl reload" booted_root_run systemctl reload loopscope.service
  pid=$(_main_pid loopscope.service)
  booted_root_run kill -KILL "$pid"
  expect "killed, it comes back" _soon _new_main_pid loopscope.service "$pid"
  expect "a second instance runs beside it" booted_root_run systemctl start loopscope@north.service
  expect "maintain runs under the owner" booted_root_run systemctl start loopscope-maintain.service
  expect "the timer can be enabled" booted_root_run systemctl enable --quiet --now loopscope-maintain.timer
}

# The worker's unit, but reading one file is all that its instance `probe` does.
_worker_reads() {
  put /etc/loopscope/probe.json 0640 loopscope </dev/null
  put '/etc/systemd/system/loopscope@probe.service.d/probe.conf' 0644 root <<EOT
[Service]
Type=oneshot
Restart=no
ExecPaths=/usr/bin/cat
ExecStart=
ExecStart=/usr/bin/cat $1
StandardOutput=null
EOT
  booted_root_run systemctl daemon-reload
  booted_root_run systemctl start loopscope@probe.service
}

_forget_probe() {
  booted_root_run rm -r /etc/loopscope/probe.json '/etc/systemd/system/loopscope@probe.service.d'
  booted_root_run systemctl reset-failed 'loopscope@probe.service' || true
}

# Root, but where the worker is.
_starts_a_shell() {
  booted_root_run nsenter --target "$(_main_pid loopscope.service)" --mount /bin/sh -c true
}

proof_secrets() {
  expect "the worker reads its settings" _worker_reads /etc/loopscope/loopscope.json
  expect "and its passwords" _worker_reads /run/credentials/loopscope@probe.service/pgpass
  refuse "but not their source" _worker_reads /etc/loopscope/pgpass
  refuse "nor the owner's" _worker_reads /etc/loopscope/owner/pgpass
  booted_root_run mv /etc/loopscope/pgpass /etc/loopscope/pgpass.away
  expect "without a file of passwords it starts as well" _worker_reads /run/credentials/loopscope@probe.service/pgpass
  booted_root_run mv /etc/loopscope/pgpass.away /etc/loopscope/pgpass
  _forget_probe
  refuse "no program can be started there" _starts_a_shell
  refuse "no password stands in the environment or the command line" booted_root_run sh -c \
    "cat /proc/$(_main_pid loopscope.service)/environ /proc/$(_main_pid loopscope.service)/cmdline | grep -a secret"
  refuse "nor in the journal" booted_root_run sh -c 'journalctl --no-pager | grep secret'
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
  booted_root_run systemctl start loopscope@north.service
}

_no_worker() {
  ! booted_root_run pgrep -x loopscope >/dev/null
}

proof_remove() {
  expect "apt removes" _apt remove loopscope
  expect "nothing runs" _soon _no_worker
  expect "settings are kept" booted_root_run test -e /etc/loopscope/loopscope.json
}

proof_purge() {
  expect "apt purges, with the packages that nothing else needs" _apt purge --autoremove loopscope
  expect "the results are kept" test "$(_verdicts valve_stiction)" = 1
}
