# shellcheck shell=bash
# A private PostgreSQL cluster in a folder of its own, for the demo and the tests. Source this file.
#
#   private_cluster_start FOLDER [durable|volatile]   make it if need be and start it
#   private_cluster_conninfo FOLDER                   print how to connect as its superuser
#   private_cluster_running FOLDER                    true while it runs
#   private_cluster_stop FOLDER                       stop it, keep the data
#   private_cluster_remove FOLDER                     stop it and delete the folder
#
# The cluster has no TCP port: it listens on a socket inside the folder, which only its owner (and
# root) can enter, so every connection that reaches it may be trusted. Nothing of the system's
# PostgreSQL is touched except its programs. The server refuses to run as root, so under root it
# runs as the user postgres, which has to be able to reach FOLDER.
# PRIVATE_CLUSTER_MORE_OPTIONS: further options of the server (" -c name=value"), for tests.
# `volatile` trades safety against power loss for speed: for tests only.

# The kernel's sockaddr_un holds 107 bytes; the socket's name takes "/.s.PGSQL.5432" of them.
_PRIVATE_CLUSTER_LONGEST_FOLDER=93
_PRIVATE_CLUSTER_PORT=5432

_private_cluster_fail() {
  printf 'error: %s\nHINT: %s\n' "$1" "$2" >&2
  return 1
}

# The folder of initdb and pg_ctl: LOOPSCOPE_PG_BIN, else Debian's newest, else that of the PATH.
_private_cluster_programs() {
  local candidate
  if [ -n "${LOOPSCOPE_PG_BIN:-}" ]; then
    candidate=$LOOPSCOPE_PG_BIN
  else
    candidate=$(find /usr/lib/postgresql -mindepth 2 -maxdepth 2 -name bin 2>/dev/null |
      sort -t / -k 5 -n | tail -n 1)
  fi
  if [ -z "$candidate" ] && command -v initdb >/dev/null; then
    candidate=$(dirname "$(command -v initdb)")
  fi
  if [ ! -x "$candidate/initdb" ] || [ ! -x "$candidate/pg_ctl" ]; then
    _private_cluster_fail "PostgreSQL's server programs were not found${candidate:+ in $candidate}" \
      "install them (Debian: apt-get install postgresql-15) or set LOOPSCOPE_PG_BIN to their folder"
    return 1
  fi
  printf '%s\n' "$candidate"
}

# Runs a server program as the user that owns the cluster, from a folder which that user can enter.
_private_cluster_as_owner() {
  if [ "$(id -u)" -eq 0 ]; then
    (cd / && runuser -u postgres -- "$@")
  else
    (cd / && "$@")
  fi
}

_private_cluster_check_folder() {
  case $1 in
    /*[\'\\]*) _private_cluster_fail "the folder's name has a quote or a backslash, $1" "choose another name" ;;
    /*) ;;
    *) _private_cluster_fail "not an absolute folder, $1" "give the whole path" ;;
  esac || return 1
  if [ "$(printf '%s' "$1" | wc -c)" -gt "$_PRIVATE_CLUSTER_LONGEST_FOLDER" ]; then
    _private_cluster_fail "the folder's path is longer than $_PRIVATE_CLUSTER_LONGEST_FOLDER bytes, $1" \
      "a unix socket has to fit into it: choose a shorter one, for example under /tmp"
    return 1
  fi
}

_private_cluster_make_folder() {
  local folder=$1
  mkdir -p "$folder" && chmod 0700 "$folder" || return 1
  [ "$(id -u)" -eq 0 ] || return 0
  if ! id postgres >/dev/null 2>&1; then
    _private_cluster_fail "the user postgres does not exist" \
      "run as an ordinary user, or install PostgreSQL's Debian package, which makes that user"
    return 1
  fi
  chown postgres: "$folder" || return 1
  if ! _private_cluster_as_owner test -w "$folder"; then
    _private_cluster_fail "the user postgres cannot enter $folder" \
      "the server does not run as root: choose a folder that postgres can reach, for example under /tmp"
    return 1
  fi
}

_private_cluster_initialise() {
  local programs=$1 folder=$2
  # A run that was cut short leaves a folder without PG_VERSION, which initdb would refuse.
  rm -rf "$folder/data"
  # --no-locale keeps the order of text and the words of messages the same on every machine.
  if ! _private_cluster_as_owner "$programs/initdb" --pgdata="$folder/data" --username=postgres \
    --auth=trust --encoding=UTF8 --no-locale --no-instructions >"$folder/initdb.log" 2>&1; then
    _private_cluster_fail "initdb failed, $folder" "see $folder/initdb.log"
    return 1
  fi
}

private_cluster_running() {
  local folder=$1 programs
  programs=$(_private_cluster_programs) || return 1
  "$programs/pg_isready" --quiet --host="$folder" --port="$_PRIVATE_CLUSTER_PORT"
}

_private_cluster_options() {
  printf '%s' "-c listen_addresses='' -c port=$_PRIVATE_CLUSTER_PORT"
  printf '%s' " -c unix_socket_directories='$1' -c unix_socket_permissions=0700"
  printf '%s' " -c shared_buffers=128MB -c max_wal_size=2GB"
  if [ "$2" = volatile ]; then
    printf '%s' " -c fsync=off -c full_page_writes=off -c synchronous_commit=off"
  fi
  printf '%s' " ${PRIVATE_CLUSTER_MORE_OPTIONS:-}"
}

private_cluster_start() {
  local folder=$1 durability=${2:-durable} programs attempt
  _private_cluster_check_folder "$folder" || return 1
  programs=$(_private_cluster_programs) || return 1
  _private_cluster_make_folder "$folder" || return 1
  [ -s "$folder/data/PG_VERSION" ] || _private_cluster_initialise "$programs" "$folder" || return 1
  # Several tries: a server that was killed a moment ago may still look alive.
  for attempt in 1 2 3 4 5 6; do
    if private_cluster_running "$folder"; then
      return 0
    fi
    [ "$attempt" -eq 1 ] || sleep 1
    if _private_cluster_as_owner "$programs/pg_ctl" start --pgdata="$folder/data" --wait \
      --timeout=60 --silent --log="$folder/server.log" \
      --options="$(_private_cluster_options "$folder" "$durability")" >/dev/null 2>&1; then
      return 0
    fi
  done
  _private_cluster_fail "the server did not start, $folder" "see $folder/server.log"
}

private_cluster_conninfo() {
  printf "host=%s port=%s user=postgres dbname=postgres\n" "$1" "$_PRIVATE_CLUSTER_PORT"
}

private_cluster_stop() {
  local folder=$1 programs
  [ -s "$folder/data/PG_VERSION" ] || return 0
  programs=$(_private_cluster_programs) || return 1
  # By its process, not by its socket: one that is only starting has to be stopped too.
  if ! _private_cluster_as_owner "$programs/pg_ctl" status --pgdata="$folder/data" >/dev/null 2>&1; then
    return 0
  fi
  # fast: sessions that are still open are ended, so that a forgotten one cannot hold the stop up.
  if ! _private_cluster_as_owner "$programs/pg_ctl" stop --pgdata="$folder/data" --mode=fast \
    --wait --timeout=60 --silent; then
    _private_cluster_fail "the server did not stop, $folder" "see $folder/server.log"
    return 1
  fi
}

private_cluster_remove() {
  local folder=$1
  [ -e "$folder" ] || return 0
  # Never delete a folder that this file did not make.
  if [ ! -s "$folder/data/PG_VERSION" ] && [ ! -e "$folder/initdb.log" ]; then
    _private_cluster_fail "not a private cluster, $folder" "delete it by hand if it is really one"
    return 1
  fi
  private_cluster_stop "$folder" || return 1
  rm -rf "$folder"
}
