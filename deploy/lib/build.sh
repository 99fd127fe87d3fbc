# shellcheck shell=bash
# Builds a preset of CMakePresets.json. Source this file after say.sh.
#
#   build PRESET [TARGET...]    into build/PRESET of the checkout; everything without a TARGET

_CHECKOUT=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)

_configure() {
  local launcher=()
  if command -v ccache >/dev/null; then
    launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  fi
  (cd "$_CHECKOUT" && cmake --preset "$1" "${launcher[@]}")
}

build() {
  local preset=$1 folder=$_CHECKOUT/build/$1
  step "building build/$preset on $(nproc) cores"
  quietly "$folder/deploy-configure.log" _configure "$preset" ||
    die "cmake could not configure the preset $preset" "delete build/$preset if it comes from elsewhere, then try again"
  quietly "$folder/deploy-build.log" cmake --build "$folder" --parallel "$(nproc)" ${2:+--target "${@:2}"} ||
    die "the build failed" "the compiler's words stand above and in build/$preset/deploy-build.log"
}
