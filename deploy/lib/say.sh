# shellcheck shell=bash
# How the scripts of deploy/ speak. Source this file.
#
#   step WORDS                one line with the seconds since the script began
#   die WHAT HINT [CODE]      error and hint to standard error, then exit (1 unless CODE says more)
#   quietly LOG COMMAND...    on a terminal as it is; elsewhere into LOG, shown only on failure

# Enough to hold one compiler error with its notes.
_SAY_LOG_LINES=60

step() {
  printf '[%4d s] %s\n' "$SECONDS" "$*"
}

die() {
  printf 'error: %s\nHINT: %s\n' "$1" "$2" >&2
  exit "${3:-1}"
}

quietly() {
  local log=$1
  shift
  if [ -t 1 ]; then
    "$@"
    return
  fi
  mkdir -p "$(dirname "$log")"
  if ! "$@" >"$log" 2>&1; then
    tail -n "$_SAY_LOG_LINES" "$log" >&2
    return 1
  fi
}
