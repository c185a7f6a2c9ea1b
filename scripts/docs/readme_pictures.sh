#!/usr/bin/env bash
# Renders the pictures at the top of the README into docs/images.
#
#   scripts/docs/readme_pictures.sh [PROGRAM]     default: build/release/bin/halfspace
set -euo pipefail
cd "$(dirname "$0")/../.."
program=${1:-build/release/bin/halfspace}

render() {
  local name=$1
  shift
  "$program" render "$@" --size 640x480 --set samples=4 -o "docs/images/$name.jpg"
}
render earth earth --camera equator
render moon moon --camera terminator
render day-night day-night --set time.hours=17.5
render galaxy particles --set particles.arrangement=galaxy --set particles.count=30000 --set particles.radius=0.012 \
  --set front.position=0,2.9,2.5 --set background.color=0.003,0.003,0.008
du -cb docs/images/*.jpg | tail -n 1
