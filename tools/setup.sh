# SPDX-License-Identifier: BSD-3-Clause
# Sourced by the scripts in tools: installs missing packages, configures and builds build/release.
set -euo pipefail
export LC_ALL=C.UTF-8  # decimal points in awk's output
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# install_packages KIND...: installs the missing packages of these kinds of tools/packages.txt.
install_packages() {
  local missing=() kind package
  while read -r kind package; do
    [[ " $* " == *" $kind "* ]] || continue
    [[ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" == installed ]] || missing+=("$package")
  done < <(grep -v '^#' tools/packages.txt)
  [[ ${#missing[@]} -eq 0 ]] && return 0
  local as_root=()
  if [[ $(id -u) -ne 0 ]]; then
    as_root=(sudo)
    echo "Installing packages with sudo: ${missing[*]}"
  else
    echo "Installing packages: ${missing[*]}"
  fi
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}

# build_release TARGET...: configures build/release and builds the targets (all of them without arguments).
build_release() {
  cmake --preset release >build-configure.log 2>&1 || { cat build-configure.log; rm -f build-configure.log; return 1; }
  mkdir -p build/release && mv build-configure.log build/release/configure.log
  cmake --build --preset release ${1:+--target "$@"}
}
