# shellcheck shell=bash
# Shows how far a build is. Source this file after say.sh, in a script that has set pipefail.
#
#   with_progress LOG COMMAND...   runs COMMAND, which calls ninja, all its words into LOG: files done
#                                  of all and about how many seconds are left; the end of LOG when it fails
#
# On a terminal one line that changes, elsewhere a line every _PROGRESS_PIPE_S seconds.

_PROGRESS_TERMINAL_S=1
_PROGRESS_PIPE_S=10
_PROGRESS_LOOK_S=1

# Seconds, if what is left takes as long a file as what is done.
_progress_left() {
  local left=$(((_progress_at - _progress_began) * (_progress_all - _progress_done) / _progress_done))
  printf '%d' "$((left - SECONDS + _progress_at))"
}

_progress_words() {
  local files="$_progress_done of $_progress_all files" left
  if [ "$_progress_done" -eq 0 ]; then
    printf 'no file done yet'
  elif [ "$_progress_done" -eq "$_progress_all" ]; then
    printf '%s' "$files"
  elif left=$(_progress_left) && [ "$left" -gt 0 ]; then
    printf '%s, about %d s left' "$files" "$left"
  else
    printf '%s, longer than estimated' "$files"
  fi
}

_progress_tell() {
  _progress_told=$SECONDS
  if [ -t 1 ]; then
    _progress_end_of_line='\n'
    printf '\r\033[K%s' "$(step "$(_progress_words)")"
  else
    step "$(_progress_words)"
  fi
}

# A line of ninja, "[done/all] what"; that it looks at its own instructions is no file.
_progress_note() {
  if [[ $1 =~ ^\[([0-9]+)/([0-9]+)\]\ (.*) ]] && [[ ${BASH_REMATCH[3]} != Re-* ]]; then
    _progress_done=${BASH_REMATCH[1]} _progress_all=${BASH_REMATCH[2]} _progress_at=$SECONDS
  fi
}

# Lines from standard input into the file $1; tells how far it is, also while no line comes.
_progress_follow() {
  local every=$_PROGRESS_PIPE_S line='' part code
  [ ! -t 1 ] || every=$_PROGRESS_TERMINAL_S
  _progress_began=$SECONDS _progress_told=$SECONDS _progress_done=0 _progress_all=0
  _progress_end_of_line=''
  while :; do
    code=0
    IFS= read -r -t "$_PROGRESS_LOOK_S" part || code=$?
    line+=$part
    # 1 is the end; above 128: in that time came nothing, or a part of a line.
    [ "$code" -ne 1 ] || break
    if [ "$code" -eq 0 ]; then
      printf '%s\n' "$line" >>"$1"
      _progress_note "$line"
      line=''
    fi
    [ $((SECONDS - _progress_told)) -lt "$every" ] || _progress_tell
  done
  printf '%s' "$line" >>"$1"
  _progress_end
}

_progress_end() {
  if [ "$_progress_all" -gt 0 ] && [ "$_progress_done" -eq "$_progress_all" ]; then
    _progress_tell
  fi
  printf '%b' "$_progress_end_of_line"
}

with_progress() {
  local log=$1
  shift
  mkdir -p "$(dirname "$log")"
  : >"$log"
  if ! NINJA_STATUS='[%f/%t] ' "$@" 2>&1 </dev/null | _progress_follow "$log"; then
    tail -n "$_SAY_LOG_LINES" "$log" >&2
    return 1
  fi
}
