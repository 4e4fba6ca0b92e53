#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# README.md from a fresh clone on an empty Debian 12: its set-ups, then each of its lines, with times, exit codes and
# warnings. As root, with debootstrap installed and 6 GB free; an hour or more on two cores.
#   tests/readme/in_debootstrap.sh OUT.log [--test] [--setup-only] [--folder FOLDER]
#     --test         also ./bootstrap test, between ./bootstrap run and ./bootstrap all (much longer)
#     --setup-only   ends after the clone: an empty Debian, its apt, git
#     --folder       where the Debian is made, and stays; default: a new folder in /tmp, removed at the end
# The commit that is checked out is what runs. Packages come by this machine's own settings of apt and npm, copied when
# the script runs. Exit codes: 0 all is well, 1 something failed or warned (the log's last table names it), 2 usage.
set -euo pipefail

usage() { sed -n 's/^# \{0,1\}//; 3,10p' "$0" >&2; exit 2; }

repository=$(cd "$(dirname "$0")/../.." && pwd)
log='' with_test=no setup_only=no root=''
while [ $# -gt 0 ]; do
  case "$1" in
    --test) with_test=yes ;;
    --setup-only) setup_only=yes ;;
    --folder) root=${2:?a folder belongs to --folder}; shift ;;
    -*) usage ;;
    *) [ -z "$log" ] || usage; log=$1 ;;
  esac
  shift
done
[ -n "$log" ] || usage
if [ -z "$root" ]; then
  root=$(mktemp -d /tmp/sunder_debootstrap.XXXXXX)
  trap 'rm -rf "$root"' EXIT
fi
: >"$log"
table=$(mktemp)

say() { printf '\n== %s\n' "$*" | tee -a "$log"; }

# A private /proc, without which a program cannot find its own file, and terminals for apt; nothing is left mounted.
inside() {
  unshare --mount --fork --pid sh -c '
    root=$1; shift
    mount -t proc proc "$root/proc"
    mount -t devpts -o newinstance,ptmxmode=0666 devpts "$root/dev/pts" 2>/dev/null || true
    exec chroot "$root" "$@"' inside "$root" /usr/bin/env -i PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/root \
    LC_ALL=C.UTF-8 "${ways_out[@]}" "$@"
}
in_clone() { inside sh -c 'cd /root/sunder && exec "$@"' in_clone "$@"; }

# Lines of a file that warn: the compiler, CMake, npm, apt, and sunder.
warnings() { grep -cE '^[^[:alnum:]]*warning:|: warning:|^CMake [A-Za-z ]*Warning|^npm (WARN|warn)|^W: ' "$1" || true; }

# step LABEL COMMAND...: runs it, logs its output, and keeps a row for the table. Goes on where it fails.
failed=0
step() {
  local label=$1 start exit_code=0 output
  shift
  say "$label"
  output=$(mktemp)
  start=$(date +%s)
  "$@" >"$output" 2>&1 </dev/null || exit_code=$?
  cat "$output" >>"$log"
  row "$label" "$(($(date +%s) - start))" "$exit_code" "$(warnings "$output")"
  rm -f "$output"
}
row() {
  printf '%-52s %6s s   exit %-3s  %s warnings\n' "$1" "$2" "$3" "$4" | tee -a "$table"
  [ "$3" = 0 ] && [ "$4" = 0 ] || failed=1
}

# How packages are reached from here: names of hosts, proxies and certificates are this machine's.
ways_out=(DEBIAN_FRONTEND=noninteractive)
eval "$(apt-config shell http_proxy Acquire::http::Proxy https_proxy Acquire::https::Proxy)"
for name in http_proxy https_proxy; do
  [ -z "${!name:-}" ] || { export "${name?}"; ways_out+=("$name=${!name}"); }
done
if command -v npm >/dev/null; then
  ways_out+=("npm_config_registry=$(npm config get registry)")
fi
certificates=/etc/ssl/certs/ca-certificates.crt

sources() {  # of Debian 12 and its updates, one line each
  apt-get indextargets --format 'deb $(REPO_URI) $(RELEASE) $(COMPONENT)' 'Created-By: Packages' 'Origin: Debian' |
    awk '$3 ~ /^bookworm(-updates|-security)?$/' | sort -u
}

empty_debian() {
  local mirror
  mirror=$(sources | awk '$3 == "bookworm" { print $2; exit }')
  [ -n "$mirror" ] || { echo "apt of this machine has no source of Debian 12 (bookworm)"; return 1; }
  [ -x "$root/usr/bin/apt-get" ] || debootstrap --variant=minbase bookworm "$root" "$mirror" || return 1
  apt-config dump | grep -E '^Acquire::(https?|ftp|Check-|Retries|ForceIPv)' >"$root/etc/apt/apt.conf.d/90host" || true
  sources >"$root/etc/apt/sources.list"
  cp /etc/resolv.conf "$root/etc/resolv.conf"
  if [ -f "$certificates" ]; then
    # npm reads it; an apt that goes by https does too.
    mkdir -p "$root/etc/ssl/certs"
    cp "$certificates" "$root/etc/ssl/host-certificates.crt"
    [ -e "$root$certificates" ] || cp "$certificates" "$root$certificates"
  fi
}
[ ! -f "$certificates" ] || ways_out+=("NODE_EXTRA_CA_CERTS=/etc/ssl/host-certificates.crt")

clone() {
  rm -rf "$root/root/sunder"
  git clone --quiet --no-hardlinks "$repository" "$root/root/sunder"
  git -C "$root/root/sunder" log --oneline --max-count 1
}

# What `./bootstrap run` printed as the next things to type.
next_lines() { sed -n 's/^bootstrap:   \(build\/release\/.*\)/\1/p' "$log"; }

# No object of C++ was compiled twice by the set-ups together.
compiled_once() { ! grep -o 'Building CXX object [^ ]*' "$log" | sort | uniq -d | grep .; }

finish() {
  say "table ($(nproc) cores, $(date -u +%Y-%m-%d), $(git -C "$repository" log -1 --format=%h))"
  tee -a "$log" <"$table"
  rm -f "$table"
  exit "$failed"
}

step "an empty Debian 12" empty_debian
[ "$failed" = 0 ] || { tail -n 5 "$log"; finish; }
step "apt-get update" inside apt-get update
step "git clone" clone
[ "$setup_only" = no ] || finish

step "./bootstrap run" in_clone ./bootstrap run
mapfile -t next < <(next_lines)
[ ${#next[@]} -gt 0 ] || row "./bootstrap run names what to type next" 0 1 0
for line in "${next[@]}"; do step "$line" in_clone sh -c "$line"; done
# Only now, so that nothing that README's first set-up needs is there by way of it.
step "python3, for the list of lines" inside apt-get install -y -qq --no-install-recommends python3
lines="python3 -B tests/readme/readme_lines.py --scratch /root/scratch"
step "README's lines after ./bootstrap run" in_clone $lines --after "./bootstrap run"
step "configuring without network and without npm" in_clone unshare --net \
  cmake -S . -B /root/offline -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=OFF
[ "$with_test" = no ] || step "./bootstrap test" in_clone ./bootstrap test
step "./bootstrap all" in_clone ./bootstrap all
step "README's lines after ./bootstrap all" in_clone $lines --after "./bootstrap all"
step "./bootstrap run, a second time" in_clone ./bootstrap run
step "nothing was compiled twice" compiled_once
finish
