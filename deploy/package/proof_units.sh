# shellcheck shell=bash
# What systemd makes of the units. Source this file after proof_steps.sh.
#
#   proof_units, proof_maintain, proof_watchdog, proof_secrets, proof_reports

_second_loop_is_judged() {
  [ "$(proof_sql loopscope "SELECT count(DISTINCT loop_id) FROM loopscope.analysis")" = 2 ]
}

# PATH WORDS: whether the answer has them. The root has no curl.
_http() {
  # shellcheck disable=SC2016  # the inner shell's
  booted_root_run bash -c 'exec 3<>/dev/tcp/127.0.0.1/9470 &&
    printf "GET %s HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n" "$1" >&3 && grep -q "$2" <&3' http "$1" "$2"
}

proof_units() {
  local pid
  expect "systemctl start, READY=1" booted_root_run systemctl start loopscope.service
  booted_root_run loopscope simulate deadband --seed 2 --out "$_REPORT/TIC301.csv"
  proof_as_owner loopscope import --loop TIC301 "$_REPORT/TIC301.csv" >/dev/null
  expect "the unit judges a new loop, with the password from its credential" _soon _second_loop_is_judged
  expect "it answers /livez" _http /livez 200
  expect "and /metrics" _http /metrics loopscope_build_info
  expect "systemctl reload" booted_root_run systemctl reload loopscope.service
  pid=$(_main_pid loopscope.service)
  booted_root_run kill -KILL "$pid"
  expect "killed, it comes back" _soon _new_main_pid loopscope.service "$pid"
  expect "a second instance runs beside it" booted_root_run systemctl start loopscope@north.service
}

_waits_to_try_again() {
  [ "$(booted_root_run systemctl show --property SubState --value "$1")" = auto-restart ]
}

# Without its password it fails as it does without a server.
proof_maintain() {
  expect "maintain runs under the owner" booted_root_run systemctl start loopscope-maintain.service
  booted_root_run mv /etc/loopscope/owner/pgpass /etc/loopscope/owner/pgpass.away
  refuse "it fails where the database refuses it" booted_root_run systemctl start loopscope-maintain.service
  expect "and is to be tried again" _waits_to_try_again loopscope-maintain.service
  booted_root_run mv /etc/loopscope/owner/pgpass.away /etc/loopscope/owner/pgpass
  expect "which a person need not wait for" booted_root_run systemctl restart loopscope-maintain.service
  expect "the timer can be enabled" booted_root_run systemctl enable --quiet --now loopscope-maintain.timer
}

# A drop-in as `systemctl edit` makes it, so that this takes no minute; it has to win over the
# package's own.
proof_watchdog() {
  local pid drop_in=/etc/systemd/system/loopscope.service.d
  printf '[Service]\nWatchdogSec=4\nTimeoutAbortSec=1\n' | put $drop_in/override.conf 0644 root
  booted_root_run systemctl daemon-reload
  booted_root_run systemctl restart loopscope.service
  pid=$(_main_pid loopscope.service)
  sleep 8
  expect "twice the watchdog's time later it still runs" test "$(_main_pid loopscope.service)" = "$pid"
  booted_root_run kill -STOP "$pid"
  expect "frozen, it is ended and comes back" _soon _new_main_pid loopscope.service "$pid"
  booted_root_run rm -r $drop_in
  booted_root_run systemctl daemon-reload
  booted_root_run systemctl restart loopscope.service
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
  booted_root_run systemctl reset-failed 'loopscope@*.service'
}

# Root, but where the worker is.
_starts_there() {
  booted_root_run nsenter --target "$(_main_pid loopscope.service)" --mount "$@"
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
  refuse "no shell can be started there" _starts_there /bin/sh -c true
  refuse "no interpreter" _starts_there /usr/bin/python3.11 -c ''
  refuse "no password stands in the environment or the command line" booted_root_run sh -c \
    "cat /proc/$(_main_pid loopscope.service)/environ /proc/$(_main_pid loopscope.service)/cmdline | grep -a secret"
  refuse "nor in the journal" booted_root_run sh -c 'journalctl --no-pager | grep secret'
}

_journal_says() {
  # Not grep -q, which may end before journalctl has said all: that would count as its failure.
  booted_root_run journalctl --no-pager --unit loopscope.service | grep "$1" >/dev/null
}

_report_is_there() {
  booted_root_run sh -c 'ls /var/lib/loopscope/loopscope-*.html /var/lib/loopscope/loopscope-*.pdf'
}

_may_start_python() {
  booted_root_run systemctl show --property ExecPaths "$1" | grep -q python
}

# Pictures and PDFs are for sites that ask for them.
proof_reports() {
  local drop_in=/etc/systemd/system/loopscope.service.d
  expect "a report waits for leave to start what draws it" _soon _journal_says 'may not be started'
  booted_root_run install -D -m 0644 /usr/share/doc/loopscope/examples/reports.conf $drop_in/reports.conf
  booted_root_run systemctl daemon-reload
  booted_root_run systemctl restart loopscope.service
  expect "with it the page and its PDF are written" _soon _report_is_there
  refuse "maintain has no interpreter all the same" _may_start_python loopscope-maintain.service
  booted_root_run rm -r $drop_in
  booted_root_run systemctl daemon-reload
  booted_root_run systemctl restart loopscope.service
}
