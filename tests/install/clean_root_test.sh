#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The Debian package on a system that has nothing else: a root of its own (mmdebstrap, packages mmdebstrap and
# uidmap), `apt install ./seaglint_*.deb`, a run from an empty folder, removal. Needs root; some minutes and 2 GB in
# /tmp. Argument: build folder. The sources of packages are those of this machine.
set -euo pipefail
build=$(realpath "$1")
work=$(mktemp -d -t seaglint_root_XXXXXX)
trap 'rm -rf "$work"' EXIT
(cd "$build" && cpack -B "$work/packages" >"$work/log" 2>&1) || { cat "$work/log"; exit 1; }
package=$(ls "$work"/packages/seaglint_*.deb)
mapfile -t sources < <(ls /etc/apt/sources.list.d/debian.sources /etc/apt/sources.list 2>/dev/null)

# Within the new root, by mmdebstrap's hooks: packages are configured, then the commands run.
cat >"$work/use" <<'USE'
set -eu
cd "$(mktemp -d)"
seaglint --version
seaglint paths
seaglint run quick.yaml -o x --set dataset.maps_per_case=4 --set dataset.realisations_per_case=2 --set learning.epochs=1 2>/dev/null | tail -3
test -s x/report.html
python3 -c 'import seaglint; print(seaglint.Dataset("x"), seaglint.rcs("assets/icosahedral_reflector.glb", 1e10).shape)'
man -w seaglint 2>/dev/null || test -s /usr/share/man/man1/seaglint.1 || echo "no manual pages on this system"
USE
mmdebstrap --variant=apt --aptopt="$(apt-config dump | grep -E '^(Acquire|Dir::Etc::(netrc|trusted))' || true)" \
  --customize-hook="copy-in $package $work/use /tmp" \
  --customize-hook='chroot "$1" sh -c "apt-get install -y -qq --no-install-recommends /tmp/seaglint_*.deb python3-numpy python3-h5py >/dev/null && sh /tmp/use && apt-get remove -y -qq seaglint >/dev/null && test ! -e /usr/share/seaglint && echo removed"' \
  bookworm "$work/root.tar" "${sources[@]}"
