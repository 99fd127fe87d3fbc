# shellcheck shell=bash
# How the tests of deploy/ speak: every problem is named, all of them before the test ends.
#
#   problem WORDS       counts one
#   skip WORDS          ends the test as skipped, visibly
#   skip_rest WORDS     the same at the end, for a part of the test: problems before it count first
#   finish              0 without problems, else 1

_PROBLEMS=0
_SKIPPED=77

problem() {
  printf 'PROBLEM: %s\n' "$*" >&2
  _PROBLEMS=$((_PROBLEMS + 1))
}

skip() {
  printf 'SKIPPED: %s\n' "$*"
  exit "$_SKIPPED"
}

skip_rest() {
  finish && skip "$@"
}

finish() {
  printf '%d problems\n' "$_PROBLEMS"
  [ "$_PROBLEMS" -eq 0 ]
}

# PROGRAM WORD...: the commands that its help lists.
subcommands() {
  "$@" --help | awk '/^Subcommands:/ { on = 1; next } on && /^  [a-z]/ { print $1 }'
}

# Each line that stands in the first list and not in the second.
missing_from() {
  comm -23 <(sort -u <<<"$1") <(sort -u <<<"$2") | sed '/^$/d'
}
