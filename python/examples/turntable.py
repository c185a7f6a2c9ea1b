#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Pictures of a model from all sides.

  turntable.py MODEL FOLDER
"""

import sys
from pathlib import Path

import halfspace

scene = halfspace.Scene.load(sys.argv[1], turn_seconds=2)
folder = Path(sys.argv[2])
folder.mkdir(parents=True, exist_ok=True)
for number, picture in enumerate(scene.frames(48, size=(640, 360), fps=24)):
    picture.save(folder / f"turn_{number:04}.png")
