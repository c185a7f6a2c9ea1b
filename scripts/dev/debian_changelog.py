#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the changelog of the Debian packages: the newest section of CHANGELOG.md in Debian's format, compressed.

    debian_changelog.py PACKAGE_VERSION MAINTAINER FILE

The date is that of the section, or of the last change of CHANGELOG.md if the section has not been released.
"""
import datetime
import email.utils
import gzip
import re
import sys
import textwrap
from pathlib import Path

CHANGELOG = Path(__file__).resolve().parents[2] / "CHANGELOG.md"


def newest_section(text):
    """Returns the release date of the first section (or None) and its items, without the markup of links and code."""
    title, body = re.search(r"^## (.*?)\n(.*?)(?=^## |\Z)", text, re.M | re.S).groups()
    date = re.search(r"\d{4}-\d\d-\d\d", title)
    items = re.findall(r"^- (.*?)(?=^- |^#|^$|\Z)", body, re.M | re.S)
    return date and date[0], [re.sub(r"\[(.*?)\]\(.*?\)", r"\1", " ".join(item.split())).replace("`", "") for item in items]


def main():
    version, maintainer, out = sys.argv[1:]
    date, items = newest_section(CHANGELOG.read_text())
    time = datetime.datetime.fromisoformat(date) if date else datetime.datetime.fromtimestamp(CHANGELOG.stat().st_mtime)
    lines = [f"halfspace ({version}) unstable; urgency=medium", ""]
    for item in items:
        lines += textwrap.wrap(item, 78, initial_indent="  * ", subsequent_indent="    ", break_long_words=False, break_on_hyphens=False)
    lines += ["", f" -- {maintainer}  {email.utils.format_datetime(time.replace(tzinfo=datetime.timezone.utc))}", ""]
    Path(out).write_bytes(gzip.compress("\n".join(lines).encode(), mtime=0))


if __name__ == "__main__":
    main()
