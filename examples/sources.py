"""What the sources print beside what is computed: python examples/sources.py [--out DIR] [--docs]"""

import argparse
from pathlib import Path

from trochoid.sources.book import chapters, summary
from trochoid.sources.page import markdown
from trochoid.sources.report import render

options = argparse.ArgumentParser(description="Compute every published number of the sources.")
options.add_argument("--out", type=Path, default=Path("out/sources"), help="folder of report.html")
options.add_argument("--docs", action="store_true", help="write docs/sources.md anew as well")
given = options.parse_args()

made = chapters()
rows = summary(made)
widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
for name, *numbers in rows:
    cells = [f"{number:>{width}}" for number, width in zip(numbers, widths[1:], strict=True)]
    print("  ".join([f"{name:{widths[0]}}", *cells]))

given.out.mkdir(parents=True, exist_ok=True)
report = given.out / "report.html"
report.write_text(render(made), encoding="utf-8")
print(f"wrote {report}")
if given.docs:
    page = Path(__file__).parents[1] / "docs" / "sources.md"
    page.write_text(markdown(made), encoding="utf-8")
    print(f"wrote {page}")
