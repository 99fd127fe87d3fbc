# shellcheck shell=bash
# Builds a preset of CMakePresets.json. Source this file after say.sh.
#
#   build PRESET [TARGET...]                 into build/PRESET of the checkout; everything without a TARGET
#   build_without_tests PRESET TARGET...     the same where the packages of the tests may be missing
#   configure PRESET [CMAKE OPTION...]       the instructions alone, e.g. for a compile database

_CHECKOUT=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
# shellcheck source-path=SCRIPTDIR source=progress.sh
. "$_CHECKOUT/deploy/lib/progress.sh"

_configure() {
  local launcher=()
  if command -v ccache >/dev/null; then
    launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  fi
  (cd "$_CHECKOUT" && cmake --preset "$@" "${launcher[@]}")
}

configure() {
  quietly "$_CHECKOUT/build/$1/deploy-configure.log" _configure "$@" ||
    die "cmake could not configure the preset $1" "delete build/$1 if it comes from elsewhere, then try again"
}

_build() {
  local preset=$1 folder=$_CHECKOUT/build/$1
  with_progress "$folder/deploy-build.log" cmake --build "$folder" --parallel "$(nproc)" ${2:+--target "${@:2}"} ||
    die "the build failed" "the compiler's words stand above and in build/$preset/deploy-build.log"
}

build() {
  step "building build/$1 on $(nproc) cores"
  configure "$1" -DBUILD_TESTING=ON
  _build "$@"
}

# Tests that a folder has already are left in it: what they need was there.
_tests_of() {
  sed -n 's/^BUILD_TESTING:BOOL=//p' "$_CHECKOUT/build/$1/CMakeCache.txt" 2>/dev/null || true
}

build_without_tests() {
  local tests
  tests=$(_tests_of "$1")
  step "building build/$1 on $(nproc) cores"
  configure "$1" "-DBUILD_TESTING=${tests:-OFF}"
  _build "$@"
}
