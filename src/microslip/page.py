"""One HTML page of sections, with its pictures inside: no network, no script."""

from __future__ import annotations

import base64
import html
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from string import Template

DONE, FAILED, STOPPED, LEFT_OUT = "done", "failed", "stopped", "left out"
"""what becomes of a section"""
STYLE = """\
:root { color-scheme: light; }
body { max-width: 62rem; margin: 2.5rem auto; padding: 0 1.5rem; color: #1a1a1a;
  background: #fff;
  font: 16px/1.5 "Source Sans 3", "Helvetica Neue", Arial, sans-serif; }
h1 { font-size: 1.7rem; margin: 0 0 .2rem; }
h2 { font-size: 1.2rem; margin: 2.6rem 0 .3rem; padding-top: .7rem;
  border-top: 1px solid #ccc; }
p { margin: .3rem 0 .8rem; max-width: 46rem; }
a { color: #0072b2; text-decoration: none; }
code, pre { font-family: "DejaVu Sans Mono", Consolas, monospace; }
code { font-size: .82em; background: #f3f3f3; padding: .1rem .3rem; }
pre { font-size: .72em; line-height: 1.35; background: #f8f8f8; padding: .7rem .9rem;
  margin: .6rem 0; white-space: pre-wrap; overflow-wrap: anywhere; }
img { width: 100%; height: auto; margin: .4rem 0; }
table { border-collapse: collapse; margin: 1rem 0; font-size: .88em; width: 100%; }
th, td { text-align: left; vertical-align: top; padding: .3rem .8rem .3rem 0;
  border-bottom: 1px solid #ddd; }
td:first-child { white-space: nowrap; }
.time { text-align: right; white-space: nowrap; padding-right: 0; }
.quiet, .left-out { color: #666; }
.failed, .stopped { color: #b03000; }
@media print {
  body { margin: 0; max-width: none; font-size: 10pt; }
  pre { font-size: 6.5pt; }
  h2, table { break-after: avoid; }
  img, tr { break-inside: avoid; }
}"""
PAGE = Template("""\
<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>$title</title>
<style>
$style
</style>
</head>
<body>
<h1>$title</h1>
<p class="quiet">$about</p>
<p><code>$command</code></p>
<table>
<tr><th>section</th><th>result</th><th class="time">time</th></tr>
$rows
</table>
$sections
</body>
</html>
""")
ROW = Template(
    '<tr><td><a href="#$name">$title</a></td><td class="$state">$result</td>'
    '<td class="time">$time</td></tr>'
)
SECTION = Template("""\
<h2 id="$name">$title</h2>
<p>$about</p>
$body""")


@dataclass(frozen=True, slots=True)
class Section:
    """One part of the page."""

    name: str
    """a word, unique on the page"""
    title: str
    about: str
    """a sentence on what it shows"""
    state: str
    """one of :data:`DONE`, :data:`FAILED`, :data:`STOPPED`, :data:`LEFT_OUT`"""
    result: str
    """in a line"""
    command: str = ""
    """that makes it anew"""
    text: str = ""
    pictures: Sequence[Path] = ()
    seconds: float | None = None


def page(title: str, about: str, command: str, sections: Sequence[Section]) -> str:
    """Return the page as HTML; pictures are PNG files, which become part of it.

    ``about`` and ``command`` say what was made when, and by what.
    """
    return PAGE.substitute(
        style=STYLE,
        rows="\n".join(_row(each) for each in sections),
        sections="\n".join(_section(each) for each in sections),
        title=html.escape(title),
        about=html.escape(about),
        command=html.escape(command),
    )


def _row(section: Section) -> str:
    """Return the row of a section in the table at the top."""
    words = {
        "name": section.name,
        "title": section.title,
        "state": section.state.replace(" ", "-"),
        "result": section.result,
        "time": "" if section.seconds is None else f"{section.seconds:.0f} s",
    }
    return ROW.substitute({k: html.escape(v) for k, v in words.items()})


def _section(section: Section) -> str:
    """Return heading, sentence, command, pictures and text of a section."""
    parts = []
    if section.command:
        parts.append(f"<p><code>{html.escape(section.command)}</code></p>")
    if section.state != DONE:
        kind = "quiet" if section.state == LEFT_OUT else "failed"
        parts.append(f'<p class="{kind}">{html.escape(section.result)}</p>')
    parts += [_picture(path, section.title) for path in section.pictures]
    if section.text:
        parts.append(f"<pre>{html.escape(section.text)}</pre>")
    words = {
        "name": section.name, "title": section.title, "about": section.about
    }  # fmt: skip
    escaped = {name: html.escape(value) for name, value in words.items()}
    return SECTION.substitute(escaped, body="\n".join(parts))


def _picture(path: Path, title: str) -> str:
    """Return a picture as part of the page."""
    content = base64.b64encode(path.read_bytes()).decode("ascii")
    return f'<img alt="{html.escape(title)}" src="data:image/png;base64,{content}">'
