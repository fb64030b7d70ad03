#!/usr/bin/env python3
"""Follows every link and picture within the built book: `check-links.py FOLDER` names those that lead nowhere."""

import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit


class Page(HTMLParser):
    """The places of a page, and what it refers to."""

    def __init__(self, path):
        super().__init__()
        self.places, self.references = {""}, []
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attrs):
        attrs = dict(attrs)
        if "id" in attrs:
            self.places.add(attrs["id"])
        reference = {"a": "href", "img": "src"}.get(tag)
        if attrs.get(reference):
            self.references.append(attrs[reference])


def main(folder):
    """Prints the references that lead nowhere."""
    made_of_others = {"print.html", "toc.html", "404.html"}
    pages = {path.name: Page(path) for path in folder.glob("*.html") if path.name not in made_of_others}
    lost = []
    for name, page in pages.items():
        for reference in page.references:
            url = urlsplit(reference)
            if url.scheme or url.netloc:
                continue
            target = unquote(url.path) or name
            found = (folder / target).exists()
            if target in pages:
                found = unquote(url.fragment) in pages[target].places
            if not found:
                lost.append(f"{name}: {reference}")
    print(*lost, f"{len(pages)} pages, {len(lost)} links lead nowhere", sep="\n")
    return 1 if lost or not pages else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
