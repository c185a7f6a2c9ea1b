# SPDX-License-Identifier: Apache-2.0
"""Updates the generated sections of documents. A section NAME is the text between these two lines:

    <!-- generated: NAME -->
    <!-- /generated -->
"""
import datetime
import os
import platform
import re
import subprocess
import sys
from pathlib import Path

SECTION = re.compile(r"(<!-- generated: ([\w-]+) -->\n).*?(<!-- /generated -->)", re.DOTALL)


def cpu_name(cpuinfo):
    """Returns the name of the processor with its family and model. Processors with the same name ("AMD EPYC") can differ in speed by a
    factor of two.

    cpuinfo is the content of /proc/cpuinfo."""
    fields = {}
    for line in cpuinfo.splitlines():
        key, _, value = line.partition(":")
        fields.setdefault(key.strip(), value.strip())
    name = fields.get("model name", platform.machine())
    if "cpu family" not in fields:
        return name
    return f"{name} (family {fields['cpu family']}, model {fields['model']})"


def origin():
    """The date, commit and machine of a measurement that runs now, as a sentence without a period."""
    commit = subprocess.run(["git", "describe", "--always", "--dirty"], check=True, capture_output=True, text=True).stdout.strip()
    cpu = cpu_name(Path("/proc/cpuinfo").read_text(encoding="utf-8"))
    return f"Measured on {datetime.date.today()} at commit {commit} on {cpu}, {os.cpu_count()} cores"


def names(text):
    """The names of the sections of a text, in order."""
    return [match[2] for match in SECTION.finditer(text)]


def replaced(text, sections):
    """The text with new contents of its sections. A section that `sections` does not contain stays as it is."""
    return SECTION.sub(lambda m: m[1] + sections[m[2]].rstrip("\n") + "\n" + m[3] if m[2] in sections else m[0], text)


def update(path, sections):
    """Writes new contents into the sections of a file. The file must contain all of them."""
    text = Path(path).read_text(encoding="utf-8")
    missing = sorted(set(sections) - set(names(text)))
    if missing:
        sys.exit(f"{path}: missing sections {', '.join(missing)}; expected lines such as <!-- generated: {missing[0]} -->")
    Path(path).write_text(replaced(text, sections), encoding="utf-8")
