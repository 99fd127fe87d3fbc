# shellcheck shell=bash
# The linters of tests/lint/run. Source this file from the top of the checkout, after
# deploy/lib/build.sh.
#
#   lint_files_since REVISION   finds the files: all of them without a REVISION
#   lint_clang_format, lint_clang_tidy, lint_shellcheck, lint_top_level   not 0 when something is found


# Where its commands are g++'s: a pragma that clang does not know, and its words about wide vectors
# (as in the preset fuzz).
_LINT_TIDY_ARGUMENTS=(--quiet --extra-arg=-Wno-unknown-pragmas --extra-arg=-Wno-psabi
  --extra-arg=-Wno-unknown-warning-option --extra-arg=-Wno-unused-command-line-argument)
_LINT_DATABASE=build/separate
_LINT_NO_REVISION=3

_lint_require_revision() {
  git rev-parse --quiet --verify "$1^{commit}" >/dev/null ||
    die "no commit before this one to compare with, $1" \
      "a shallow clone has none: git fetch --unshallow, or leave --changed out" "$_LINT_NO_REVISION"
}

lint_files_since() {
  _LINT_SINCE=$1
  git rev-parse --is-inside-work-tree >/dev/null 2>&1 ||
    die "not a git checkout, $PWD" "the linters look at tracked files: clone the repository" "$_LINT_NO_REVISION"
  if [ -z "$1" ]; then
    mapfile -t _LINT_FILES < <(git ls-files)
  else
    _lint_require_revision "$1"
    mapfile -t _LINT_FILES < <({ git diff --name-only --diff-filter=ACMR "$1" &&
      git ls-files --others --exclude-standard; } | sort -u)
  fi
}

# Those that match a regular expression, one a line.
_lint_files() {
  [ "${#_LINT_FILES[@]}" -eq 0 ] || printf '%s\n' "${_LINT_FILES[@]}" | grep -E "$1" || true
}

# COMMAND WORD... on every file of standard input, on all cores.
_lint_each() {
  local files
  mapfile -t files
  step "${#files[@]} files"
  [ "${#files[@]}" -eq 0 ] || printf '%s\0' "${files[@]}" | xargs -0 -P "$(nproc)" -n "$_lint_at_once" "$@"
}

lint_clang_format() {
  local _lint_at_once=50
  _lint_files '\.(cpp|hpp|inc)$' | _lint_each clang-format --dry-run -Werror
}

# What stands at the top is read first: nothing comes there by accident. Folders are those that
# tests/architecture allows.
lint_top_level() {
  local files found=0 file
  mapfile -t files < <(git ls-files | grep -v /)
  step "${#files[@]} files"
  for file in "${files[@]}"; do
    case $file in
      .* | CMakeLists.txt | CMakePresets.json | README.md | CHANGELOG.md | CONTRIBUTING.md | LICENSE) ;;
      *)
        printf 'error: no file of this name stands at the top level, %s\nHINT: move it into a folder, or git rm it\n' "$file" >&2
        found=1
        ;;
    esac
  done
  return "$found"
}

# By name, by their first line, or by what they say to shellcheck.
_lint_is_shell() {
  local first
  [ -f "$1" ] || return 1
  IFS= read -r first <"$1" 2>/dev/null || return 1
  [[ $1 == *.sh || $first =~ ^#!.*[/\ ](ba)?sh || $first == '# shellcheck shell='* ]]
}

# A script is judged with what it sources, so that one that changed is enough to look at all: that takes
# seconds.
lint_shellcheck() {
  local file changed=no all=() _lint_at_once=20
  for file in "${_LINT_FILES[@]}"; do
    ! _lint_is_shell "$file" || changed=yes
  done
  while [ "$changed" = yes ] && read -r file; do
    ! _lint_is_shell "$file" || all+=("$file")
  done < <(git ls-files)
  printf '%s\n' "${all[@]}" | sed '/^$/d' | _lint_each shellcheck -x
}

# Of a header: its own source file, else the first that includes it.
_lint_source_of() {
  local own=${1%.*}.cpp
  if [ -f "$own" ]; then
    printf '%s\n' "$own"
  else
    git grep -lF "#include \"$1\"" -- '*.cpp' | head -n 1
  fi
}

_lint_sources() {
  local file
  _lint_files '\.cpp$'
  # Of all files each header is included by one.
  [ -n "${1:-}" ] || return 0
  while read -r file; do
    _lint_source_of "$file"
  done < <(_lint_files '\.(hpp|inc)$')
}

# Names out of standard input that the compile database has; a file that no target compiles cannot be
# parsed, and is a finding.
_lint_known() {
  python3 -c 'import json, os, sys
known = {os.path.relpath(entry["file"]) for entry in json.load(open(sys.argv[1]))}
names = sorted(set(sys.stdin.read().split()))
print("\n".join(name for name in names if name in known))
unknown = [name for name in names if name not in known]
for name in unknown:
    print(f"error: no target compiles it, {name}\nHINT: add it to a CMakeLists.txt, or remove it", file=sys.stderr)
sys.exit(1 if unknown else 0)' "$_LINT_DATABASE/compile_commands.json"
}

lint_clang_tidy() {
  local _lint_at_once=1 sources
  sources=$(_lint_sources "$_LINT_SINCE")
  [ -n "$sources" ] || { step "0 files" && return; }
  need_packages build test bench
  configure separate -DBUILD_TESTING=ON >&2
  _lint_known <<<"$sources" | sed '/^$/d' |
    _lint_each tests/lint/tidy_file -p "$_LINT_DATABASE" "${_LINT_TIDY_ARGUMENTS[@]}"
}
