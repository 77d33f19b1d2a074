"""The map of the code: a folder, an include or a script that the page does not have is named, and what is written agrees."""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
PAGE = """# Map
<!-- folders -->

| `core/numbers/` | numbers | nothing yet |
| `core/linear/` | matrices | |
| `core/gone/` | no longer there | |

<!-- end -->
between
<!-- report -->

<!-- end -->
"""
WRITTEN = """# Map
<!-- folders -->

| folder | what it holds | includes |
|---|---|---|
| `core/linear/` | matrices | numbers |
| `core/numbers/` | numbers |  |

<!-- end -->
between
<!-- report -->

| script | what it is for |
|---|---|
| `page.py` | The page: one file |

<!-- end -->
"""


class Map(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        self.write("core/numbers/real.hpp", "#pragma once\n")
        self.write("core/linear/lu.hpp", "#include <pfaff/core/numbers/real.hpp>\n")
        self.write("bench/report/page.py", '"""The page: one file. And more."""\n')
        self.write("docs/architecture.md", PAGE)

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def map(self, *options):
        done = subprocess.run([sys.executable, PROJECT / ".ci/map.py", "--root", self.root, *options],
                              capture_output=True, text=True, check=False)
        return done.returncode, done.stderr

    def test_what_is_written_agrees_and_keeps_what_is_written_by_hand(self):
        self.assertEqual(self.map()[0], 1)
        self.assertEqual(self.map("--write"), (0, ""))
        self.assertEqual((self.root / "docs/architecture.md").read_text(), WRITTEN)
        self.assertEqual(self.map(), (0, ""))

    def test_an_include_that_the_page_does_not_have_is_named(self):
        self.map("--write")
        self.write("core/numbers/quad.hpp", "#include <pfaff/core/errors.hpp>\n")
        status, said = self.map()
        self.assertEqual(status, 1)
        self.assertIn("docs/architecture.md:7: expected '| `core/numbers/` | numbers | core/ itself |'", said)

    def test_a_folder_that_nobody_has_described_is_named(self):
        self.map("--write")
        self.write("core/tape/tape.hpp", "#pragma once\n")
        for options in ((), ("--write",)):
            status, said = self.map(*options)
            self.assertEqual(status, 1)
            self.assertIn("expected a row '| `core/tape/` | what it holds | |'", said)

    def test_a_script_without_a_docstring_is_named(self):
        self.write("bench/report/loops.py", "import sys\n")
        self.assertIn("bench/report/loops.py: expected a docstring", self.map("--write")[1])


if __name__ == "__main__":
    unittest.main()
