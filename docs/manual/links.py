"""The links of a directory of HTML pages: which of them lead nowhere."""
import re
from html.parser import HTMLParser
from urllib.parse import unquote, urlsplit


def section(heading):
    """The name of a section as GitHub makes it: small letters, digits, hyphens and underscores."""
    return "".join(c for c in heading.strip().lower().replace(" ", "-") if c.isalnum() or c in "-_")


class Page(HTMLParser):
    """What a page links to, and the places in it that can be linked to."""

    def __init__(self, path):
        super().__init__()
        self.addresses, self.sections = [], set()
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attrs):
        for name, value in attrs:
            if name in ("href", "src"):
                self.addresses.append((self.getpos()[0], value or ""))
            elif name == "id":
                self.sections.add(value)


def is_external_address(address):
    parts = urlsplit(address)
    return (parts.scheme in ("http", "https") and re.fullmatch(r"[\w-]+(\.[\w-]+)+(:\d+)?", parts.netloc) is not None
            and not re.search(r"[\s<>\"]", address))


def faults(directory):
    """One line for each link that leads nowhere, in every page below the directory."""
    pages = {path.resolve(): Page(path) for path in sorted(directory.rglob("*.html"))}
    found = []
    for path, page in pages.items():
        for line, address in page.addresses:
            where = f"{path.relative_to(directory.resolve())}:{line}: {address or 'an empty link'}"
            if re.match(r"[a-z]+:", address):
                if not is_external_address(address):
                    found.append(where + ": not an address of the web")
                continue
            file, _, name = address.partition("#")
            target = (path.parent / unquote(file)).resolve() if file else path
            if not address or not target.is_file():
                found.append(where + ": no such page or file")
            elif name and target in pages and unquote(name) not in pages[target].sections:
                found.append(where + ": no such section")
    return found
