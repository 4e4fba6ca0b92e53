#!/bin/sh
# SPDX-License-Identifier: MIT
# Steps scenes that break by the engine of the page and by the native library: their saved states are the same bytes.
#   apps/page/check_bytes.sh build/wasm/page/sunder.wasm build/release/apps/host/sunder_host_hash
set -eu
here=$(cd "$(dirname "$0")" && pwd)
meshes=$here/../../meshes/scenes
wasm=$1 native=$2 failed=0
check() { # scene's file, steps
  in_host=$("$native" "$1" "$2")
  in_page=$(node "$here/hash.mjs" "$wasm" "$1" "$2")
  if [ "$in_page" = "$in_host" ]; then
    echo "ok     $(basename "$1" .json): $in_host"
  else
    echo "FAILED $(basename "$1" .json): native $in_host, page $in_page"
    failed=1
  fi
}
check "$here/scenes/plate.json" 110
check "$here/scenes/ring.json" 110
check "$meshes/monolith.json" 300
check "$meshes/bar.json" 300
check "$meshes/block.json" 1000
check "$meshes/ball.json" 60
exit $failed
