#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Renders the pictures of docs/explanation/shadows.md: each shadow-map artifact, and the same scene without it.
#
#   scripts/docs/shadow_pictures.sh [PROGRAM [DIRECTORY]]
set -euo pipefail
cd "$(dirname "$0")/../.."
program=${1:-build/release/bin/halfspace}
out=${2:-docs/explanation/shadows}
scenes=$(mktemp -d)
trap 'rm -r "$scenes"' EXIT
mkdir -p "$out"

# picture NAME SCENE KEY=VALUE…
picture() {
  local name=$1 scene=$2
  shift 2
  "$program" render "$scene" --size 400x250 "${@/#/--set=}" -o "$out/$name.png"
}

# A small plate high above a large one that is close to the ground. At the outline of the small plate, one texel contains two depths.
cat > "$scenes/plates.json" <<'END'
{ "version": 1, "ambient": 0.15,
  "cameras": { "main": { "position": [1.2, 0.72, 2.4], "target": [0, 0.02, -0.2], "fov": 45, "near": 0.1, "far": 100 } },
  "lights": { "sun": { "direction": [0, 1, 0] } },
  "objects": { "ground": { "shape": "plane", "size": 12 },
               "high": { "shape": "cube", "size": 1.4, "scale": [1, 0.01, 1], "position": [0.1, 6, 0] },
               "low": { "shape": "cube", "size": 5, "scale": [1, 0.01, 1], "position": [0, 0.9, 0], "color": [0.6, 0.26, 0.16] } },
  "shadow": { "resolution": 512, "radius": 4 } }
END
# A ring and stakes on a plane that extends to the horizon.
cat > "$scenes/stakes.json" <<'END'
{ "version": 1, "ambient": 0.15,
  "cameras": { "main": { "position": [0, 1.4, 0], "target": [0, 0.5, -4], "fov": 45, "near": 0.1, "far": 400 } },
  "lights": { "sun": { "direction": [1, 1.1, 0.4] } },
  "objects": { "ground": { "shape": "plane", "size": 200, "color": [0.5, 0.52, 0.5] },
               "ring": { "shape": "torus", "radius": 0.45, "tube": 0.07, "position": [0.35, 0.5, -3.2], "rotation": [90, 25, 0], "color": [0.8, 0.62, 0.3] },
               "stake": { "shape": "cube", "size": 0.16, "scale": [1, 6, 1], "position": [-0.9, 0.48, -3.6], "color": [0.6, 0.26, 0.16],
                         "instances": [ {}, { "position": [2.6, 0, -1] }, { "position": [1.2, 0, -4] }, { "position": [-1, 0, -6] } ] } },
  "background": { "color": [0.34, 0.52, 0.8] },
  "shadow": { "method": "hard", "resolution": 2048 } }
END

picture acne shadow-plane shadow.method=hard shadow.bias=none
picture acne-cured shadow-plane
picture peter-panning shadow-contact camera=close sun.size=0 shadow.bias=constant shadow.constant=100
picture peter-panning-cured shadow-contact camera=close sun.size=0
picture leak "$scenes/plates.json" shadow.method=vsm
picture leak-cured "$scenes/plates.json" shadow.method=moments
picture aliasing "$scenes/stakes.json"
picture aliasing-cured "$scenes/stakes.json" shadow.cascades=4
