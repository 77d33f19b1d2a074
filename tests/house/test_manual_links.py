"""The check of the manual's links: what leads nowhere is found and named, what leads somewhere passes."""
import sys
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(PROJECT / "docs" / "manual"))
import links  # noqa: E402


class Links(unittest.TestCase):
    def faults(self, body):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            (root / "docs").mkdir()
            (root / "index.html").write_text(body)
            (root / "docs" / "page.html").write_text('<h1 id="one">One</h1><a href="../index.html">up</a>')
            return links.faults(root)

    def test_what_is_there(self):
        self.assertEqual(self.faults('<h1 id="top">T</h1><a href="#top">a</a><a href="docs/page.html#one">b</a>'
                                     '<a href="https://doi.org/10.1000/x(1)">c</a><img src="docs/page.html">'), [])

    def test_what_is_not(self):
        for link, why in (("docs/pge.html", "no such page"), ("docs/page.html#two", "no such section"),
                          ("#two", "no such section"), ("https://nowhere", "not an address"), ("", "no such page"),
                          ("ftp://example.org", "not an address"), ("docs", "no such page")):
            faults = self.faults(f'text\n<a href="{link}">x</a>')
            self.assertEqual(len(faults), 1, (link, faults))
            self.assertTrue(faults[0].startswith("index.html:2: ") and why in faults[0], faults)

    def test_sections_are_named_as_on_github(self):
        self.assertEqual(links.section("`pfaff run`: what it's for, K(z,t)"), "pfaff-run-what-its-for-kzt")


if __name__ == "__main__":
    unittest.main()
