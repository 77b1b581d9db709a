# SPDX-License-Identifier: BSL-1.0
# Sourced by tests/run, examples/run and benchmarks/run. Everything it prints goes to stderr.

repository="$(cd -P "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
jobs="${SCARP_JOBS:-$(nproc)}"
build_packages=(g++ cmake ninja-build ccache libeigen3-dev libboost-dev libnanoflann-dev libfmt-dev doctest-dev
                libcli11-dev nlohmann-json3-dev libbenchmark-dev)
site_packages=(doxygen mkdocs mkdocs-material libjs-katex python3)

# A compiler cache accepts precompiled headers only when told that their time stamps do not matter.
export CCACHE_SLOPPINESS="${CCACHE_SLOPPINESS:-pch_defines,time_macros,include_file_mtime,include_file_ctime}"

complain() {
  echo "$(basename "$(dirname "$0")")/$(basename "$0"): $*" >&2
}

# install_missing PACKAGE... : installs those Debian packages that are not there yet
install_missing() {
  local missing=() package
  if ! command -v dpkg > /dev/null; then
    complain "no dpkg here (not a Debian system): going on with what is installed"
    return 0
  fi
  for package in "$@"; do
    if ! dpkg -s "$package" 2> /dev/null | grep '^Status: install ok installed' > /dev/null; then
      missing+=("$package")
    fi
  done
  if [ ${#missing[@]} -eq 0 ]; then return 0; fi
  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo > /dev/null; then
      complain "missing packages: ${missing[*]} (neither root nor sudo, cannot install them):" \
        "run 'apt-get install ${missing[*]}' as root, then try again"
      return 1
    fi
    as_root=(sudo)
  fi
  complain "installing ${missing[*]}"
  "${as_root[@]}" apt-get update >&2 || complain "apt-get update failed: trying with the lists that are there"
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y --no-install-recommends "${missing[@]}" >&2
}

# configure PRESET COMPILER [CMAKE ARGUMENT...] : warnings are no errors unless an argument says so
configure() {
  local preset="$1" compiler="$2" launcher=()
  shift 2
  if command -v ninja > /dev/null; then launcher+=(-G Ninja); fi
  if command -v ccache > /dev/null; then launcher+=(-D CMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
  # A build folder that was copied or moved together with its sources still belongs to the former ones.
  local folder="build/$preset" previous="" argument former
  for argument in "$@"; do
    if [ "$previous" = -B ]; then folder="$argument"; fi
    previous="$argument"
  done
  former="$(cd "$repository" && sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$folder/CMakeCache.txt" 2> /dev/null || true)"
  if [ -n "$former" ] && [ ! "$former" -ef "$repository" ]; then
    complain "$folder was made for the sources in '$former': configuring it anew"
    launcher+=(--fresh)
  fi
  (cd "$repository" && cmake --preset "$preset" -D CMAKE_CXX_COMPILER="$(command -v "$compiler")" -D SCARP_WERROR=OFF "${launcher[@]}" "$@") >&2
}
