# SPDX-License-Identifier: Apache-2.0
"""The command `halfspace` of the wheel: runs the program in the folder of the package.

It does not import the package, which would load NumPy. The program checks the processor itself.
"""

import os
import sys


def main():
    program = os.path.join(os.path.dirname(os.path.abspath(__file__)), "halfspace", "halfspace")
    try:
        os.execv(program, ["halfspace", *sys.argv[1:]])
    except OSError as error:
        sys.exit(f"halfspace: {program}: {error.strerror}; expected the program of the wheel")
