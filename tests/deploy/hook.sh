# shellcheck shell=bash
# The example hook at work: a database with notices, a web server, and the hook itself. Source this
# file after say.sh.
#
#   hook_begin PROGRAM ENVFILE   makes them possible, or skips the test; removes them at its end
#   listener [WORD...]           starts the web server anew
#   start_hook [NAME=VALUE...]   its log stands in $folder/hook.log
#   stop_hook
#   announce LOOP CONFIRMED_AT [SUMMARY]
#   becomes WORDS COMMAND...     waits until the command succeeds, for half a minute
#   heard NUMBER                 whether the web server has taken as many

# shellcheck source-path=SCRIPTDIR source=database.sh
. "$(dirname "${BASH_SOURCE[0]}")/database.sh"

ROOT=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
HOOK=$ROOT/deploy/hooks/loopscope-hook
# shellcheck disable=SC2016  # dollar quotes of SQL
ODD='$$it'"'"'s "odd" & new <!channel>$$'
folder=$(mktemp -d)
listener='' hook=''

stop_listener() {
  [ -n "$listener" ] || return 0
  kill "$listener"
  wait "$listener" || true
}

# A web server that writes down what it gets. `refuse`: the first request gets 500. `never LOOP`:
# those about that loop get 413, now and always. `silent`: nobody gets an answer.
listener() {
  cat >"$folder/listener.py" <<'PYTHON'
import http.server, json, sys, time

class Listener(http.server.BaseHTTPRequestHandler):
    def do_POST(self):
        body = self.rfile.read(int(self.headers["Content-Length"])).decode()
        if sys.argv[2] == "silent":
            time.sleep(1000)
        answer = 204
        if sys.argv[2] == "refuse" and not self.server.refused_once:
            answer = 500
        if sys.argv[2] == "never" and sys.argv[3] in body:
            answer = 413
        self.server.refused_once = True
        json.loads(body)
        if answer == 204:
            open(sys.argv[1], "a").write(body + "\n")
        self.send_response(answer)
        self.end_headers()

    def log_message(self, *words):
        pass

server = http.server.HTTPServer(("127.0.0.1", 0), Listener)
server.refused_once = False
print(server.server_port, flush=True)
server.serve_forever()
PYTHON
  stop_listener
  : >"$folder/port"
  python3 "$folder/listener.py" "$folder/heard" "$@" >"$folder/port" &
  listener=$!
  becomes "the web server is up" test -s "$folder/port"
}

becomes() {
  local what=$1 tries
  shift
  for ((tries = 0; tries < 300; tries++)); do
    if "$@" 2>/dev/null; then
      return
    fi
    sleep 0.1
  done
  problem "within 30 s: $what"
}

heard() {
  [ "$(grep -c . "$folder/heard" || true)" = "$1" ]
}

start_hook() {
  env PGOPTIONS='-c role=loopscope_reader' LOOPSCOPE_HOOK_WEBHOOK="http://127.0.0.1:$(cat "$folder/port")/" \
    LOOPSCOPE_HOOK_STATE="$folder" LOOPSCOPE_HOOK_LOOK_S=0.2 LOOPSCOPE_HOOK_RETRY_S=1 "$@" \
    "${connection_as_environment[@]}" "$HOOK" >"$folder/hook.log" 2>&1 &
  hook=$!
}

stop_hook() {
  kill "$hook"
  wait "$hook" || true
}

# What announce_flags does: a notice, and the message in the same transaction. LOOP CONFIRMED_AT
# [SUMMARY], the last two as SQL.
announce() {
  ask "$connection" "BEGIN; INSERT INTO loopscope.flag_notice (loop_id, code, announced, slot_end, since, status, confidence,
      rank, score, summary, confirmed_at) SELECT loop_id, 'sensor_fault', true, now(), now(), 'watch', 0.9, 1, 0.5, ${3:-$ODD}, $2
    FROM loopscope.loop WHERE name = '$1'; NOTIFY loopscope_flagged, '{}'; NOTIFY loopscope_confirmed, '{}'; COMMIT"
}

cleanup() {
  local pid
  for pid in $hook $listener; do
    kill "$pid" 2>/dev/null || true
  done
  drop_database
  rm -rf "$folder"
}

hook_begin() {
  command -v python3 >/dev/null || skip "python3 is not installed: no web server to tell"
  command -v curl >/dev/null || skip "curl is not installed"
  trap cleanup EXIT
  make_database "$1" "$2"
  read -r -a connection_as_environment < <(sed -E 's/(^| )host=/ PGHOST=/; s/ port=/ PGPORT=/; s/ user=/ PGUSER=/; s/ dbname=/ PGDATABASE=/' <<<"$connection")
  psql --no-psqlrc -q "$connection" -f "$ROOT/deploy/roles.sql" -c 'SELECT loopscope.grant_rights()' -f "$ROOT/tests/support/told_plant.sql" >/dev/null 2>&1
  : >"$folder/heard"
}
