# shellcheck shell=bash
# The folder that holds everything of the demo. Source this file after say.sh.
#
#   demo_folder_check FOLDER   ends the script unless the demo may use it: new, empty or its own

# It stands unquoted in connection strings, in JSON and in commands to paste.
_require_plain_name() {
  case $1 in
    *[!A-Za-z0-9/._-]*)
      die "the folder's name has more than letters, digits and . _ - /: $1" "choose another with --dir" 2
      ;;
  esac
}

# The server runs as this user, and only as the one that made the folder.
_demo_owner() {
  if [ "$(id -u)" -eq 0 ]; then
    printf 'postgres\n'
  else
    id -un
  fi
}

_refuse_folder_of_others() {
  die "$1 belongs to the user $(stat -c %U "$1")" \
    "run this as the user that made it, or choose another folder with --dir" 2
}

demo_folder_check() {
  _require_plain_name "$1"
  [ -e "$1" ] || return 0
  [ -d "$1" ] || die "not a folder, $1" "choose another with --dir" 2
  if [ ! -r "$1" ] || [ ! -w "$1" ]; then
    _refuse_folder_of_others "$1"
  elif [ -e "$1/initdb.log" ]; then
    [ "$(stat -c %U "$1")" = "$(_demo_owner)" ] || _refuse_folder_of_others "$1"
  elif [ -n "$(ls -A "$1")" ]; then
    die "the folder is not empty and holds no demo, $1" "choose another with --dir" 2
  fi
}
