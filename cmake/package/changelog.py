#!/usr/bin/env python3
"""Writes changelog.gz, a changelog of Debian's form, of CHANGELOG.md: its newest version.

  changelog.py CHANGELOG.md MAINTAINER OUT
"""
import gzip
import re
import sys
import textwrap
from datetime import datetime
from pathlib import Path


def entry(version, month, text, maintainer):
    points = [" ".join(point.split()) for point in re.findall(r"^- (.*(?:\n  .*)*)", text, re.M)]
    points = [re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", point).replace("**", "") for point in points]
    rows = [textwrap.fill(point, 78, initial_indent="  * ", subsequent_indent="    ") for point in points]
    date = datetime.strptime(month, "%B %Y").strftime("%a, %d %b %Y 00:00:00 +0000")
    return f"voxmelt ({version}) stable; urgency=medium\n\n" + "\n".join(rows) + f"\n\n -- {maintainer}  {date}\n"


if __name__ == "__main__":
    page, maintainer, out = Path(sys.argv[1]), sys.argv[2], Path(sys.argv[3])
    newest = re.search(r"^## (\S+) \((\w+ \d+)\)\n(.*?)(?=^## |\Z)", page.read_text(), re.M | re.S)
    text = entry(*newest.groups(), maintainer)
    out.write_bytes(gzip.compress(text.encode(), 9, mtime=0))
