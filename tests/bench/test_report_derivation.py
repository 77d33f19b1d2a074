"""bench/report: figures and page of an experiment that compares how equations are derived."""
import json
import math
import pathlib
import tempfile
import unittest
import xml.etree.ElementTree

from synthetic import load, parsed, run

import derivation  # noqa: E402
import derivation_figures  # noqa: E402
from files import InputError  # noqa: E402


def study(folder):
    """Two methods, of which one grows like K and the other like K^2, and whose trees grow like e^(K/2)."""
    folder = pathlib.Path(folder)
    head = {"schema": 1, "kind": "derivation", "name": "derive", "title": "Equations", "description": "Words.", "system": "chain",
            "reference": [], "citation": [], "notes": ["A note."], "quick": False, "versions": {"pfaff": "0.1.0"},
            "methods": [{"name": "ldl", "title": "factored"}, {"name": "minors", "title": "closed"}],
            "published": [{"label": "inverse (4.6)", "factor": 0.028, "rate": 0.49}]}
    rows = [",".join(derivation.RESULT_COLUMNS)]
    costs = [",".join(derivation.COST_COLUMNS)]
    for name, power in (("ldl", 1), ("minors", 2)):
        for k in (1, 2, 4, 8, 16, 32, 64):
            tree = "" if k == 64 else f"{100 * math.exp(k / 2):.17g}"  # beyond doubles
            rows.append(f"{name},{k + 1},{k},{6 * (k + 1)},{100 * k**power},{120 * k**power},{tree}")
            costs.append(f"{name},{k + 1},{1e-5 * k**power:.9g}")
    fits = [",".join(derivation.FIT_COLUMNS), "ldl,operations,power,4,8,64,1.0,0.99,1.01", "ldl,tree,exponential,3,8,32,0.5,0.4,0.6"]
    (folder / "experiment.json").write_text(json.dumps(head))
    for name, lines in (("results.csv", rows), ("cost.csv", costs), ("fits.csv", fits)):
        (folder / name).write_text("\n".join(lines) + "\n")
    return folder


class Derivations(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = study(cls.temporary.name)
        cls.status, cls.stderr = run(cls.folder)
        cls.page = parsed(cls.folder)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def test_files(self):
        self.assertEqual(self.status, 0, self.stderr)
        self.assertEqual({p.name for p in (self.folder / "figures").iterdir()},
                         {f"growth_{what}.{end}" for what in ("operations", "seconds", "tree") for end in ("svg", "png")}
                         | {"small.svg", "made.json"})
        for path in (self.folder / "figures").glob("*.svg"):
            xml.etree.ElementTree.parse(path)

    def test_the_verdict_is_data(self):
        rows = load(self.folder / "verdict.csv")
        said = json.loads((self.folder / "report.json").read_text())["cases"][0]
        self.assertEqual([row[1] for row in rows[1:]], [m["method"] for m in said["methods"]])
        self.assertIn(said["sentence"].split(" ")[1], [row[1] for row in rows])

    def test_page_stands_alone(self):
        self.assertEqual(self.page.open, [])
        self.assertEqual(len(self.page.ids), len(set(self.page.ids)))
        self.assertTrue(self.page.tags.isdisjoint({"link", "img", "iframe"}))

    def test_page_says_how_it_grows(self):
        source = (self.folder / "report.html").read_text(encoding="utf-8")
        for said in ("take 6400 operations", "grow like K<sup>1.00</sup>", "grew like e<sup>0.49 K</sup>", "± 0.01", "A note.",
                     "pfaff compare derive"):
            self.assertIn(said, source)

    def test_lines_are_named_with_their_growth(self):
        operations = (self.folder / "figures" / "growth_operations.svg").read_text(encoding="utf-8")
        self.assertIn("ldl  K¹·⁰⁰", operations)
        seconds = (self.folder / "figures" / "growth_seconds.svg").read_text(encoding="utf-8")
        self.assertIn("inverse (4.6), published", seconds)

    def test_fibonacci_numbers(self):
        self.assertEqual(derivation_figures.fibonacci(6), [1, 2, 3, 5, 8, 13])

    def test_faults_are_named(self):
        for name, old, new, said in (("results.csv", "ldl,2,1,", "ldl,2,0,", "column constraints: expected 1 or more"),
                                     ("fits.csv", "ldl,tree", "ldl,wood", "got 'wood'"),
                                     ("cost.csv", "1e-05", "soon", "column seconds: expected a number"),
                                     ("results.csv", "minors,2", "major,2", "method 'major' is not in experiment.json")):
            with tempfile.TemporaryDirectory() as temporary:
                path = study(temporary) / name
                path.write_text(path.read_text().replace(old, new, 1))
                with self.assertRaises(InputError) as caught:
                    derivation.Study(temporary)
                self.assertIn(said, str(caught.exception))


if __name__ == "__main__":
    unittest.main()
