#!/usr/bin/python3
"""Says which links of a folder of pages lead nowhere, and what pages load from other hosts; fails if there are any:
check-site.py FOLDER"""
import html.parser
import pathlib
import sys
import urllib.parse


class Page(html.parser.HTMLParser):
    """The places of a page, what it links to, and what it loads."""

    def __init__(self, path):
        super().__init__()
        self.places, self.links, self.loads = {""}, [], []
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.places |= {given.get("id"), given.get("name")}
        loads = "src" if tag != "link" else "href" if given.get("rel") in ("stylesheet", "icon") else None
        if given.get(loads):
            self.loads.append(given[loads])
        if tag == "a" and given.get("href"):
            self.links.append(given["href"])


def main(folder):
    pages = {path.resolve(): Page(path) for path in folder.rglob("*.html")
             if "api" not in path.relative_to(folder).parts and path.name != "404.html"}
    wrong = []
    for path, page in pages.items():
        for link in page.links + page.loads:
            url = urllib.parse.urlsplit(link)
            if url.scheme or url.netloc:
                wrong += [(path, link)] if link in page.loads and url.scheme != "data" else []
                continue
            target = (path.parent / urllib.parse.unquote(url.path)).resolve() if url.path else path
            if target.is_dir():
                target /= "index.html"
            place = urllib.parse.unquote(url.fragment)
            if not target.exists() or (target in pages and place not in pages[target].places):
                wrong.append((path, link))
    for path, link in wrong:
        print(f"{path}: {link}", file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(main(pathlib.Path(sys.argv[1])))
