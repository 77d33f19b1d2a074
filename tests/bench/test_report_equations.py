"""bench/report: equations in prose as MathML, and what is none as it is written."""
import json
import tomllib
import unittest
import xml.etree.ElementTree as ElementTree

from synthetic import SCRIPTS, Fresh, run, synthetic

import equation  # noqa: E402

SPACE = "{http://www.w3.org/1998/Math/MathML}"


def tree(source):
    return ElementTree.fromstring(equation.mathml(source))


def words(element):
    return "".join(element.itertext()).replace("\u2062", "·").replace("\u2061", "")


def found(element, tag):
    return list(element.iter(SPACE + tag))


class Equations(unittest.TestCase):
    def test_derivatives_greek_letters_and_products(self):
        math = tree("r'' + nu r' + r = 0")
        self.assertEqual(words(math), "r′′+ν·r′+r=0")
        self.assertEqual([words(e) for e in found(math, "msup")], ["r′′", "r′"])
        self.assertEqual(math.get("aria-label"), "r'' + nu r' + r = 0")

    def test_sizes_sums_and_vector_products(self):
        math = tree("q_i'' = -sum m_j q_j/|q_i - q_j|^3")
        power = [e for e in found(math, "msup") if words(e).startswith("|")][0]
        self.assertEqual([words(part) for part in power], ["|qi−qj|", "3"])
        self.assertEqual(words(math), "qi′′=−∑mj·qj/|qi−qj|3")
        self.assertEqual(words(tree("z times I z")), "z×I·z")
        with self.assertRaises(equation.NotRead):
            equation.mathml("|q")

    def test_powers_indices_and_groups(self):
        math = tree("e^{-2 nu t} q_1^2 (p + 1)/2 <= 3.5")
        power, = found(math, "msup")
        self.assertEqual([words(part) for part in power], ["e", "−2·ν·t"])
        both, = found(math, "msubsup")
        self.assertEqual([words(part) for part in both], ["q", "1", "2"])
        self.assertEqual(words(math), "e−2·ν·t·q12·(p+1)/2≤3.5")

    def test_matrices_are_tables(self):
        math = tree("K = e^{nu t} [[0, -1], [1, 0]]")
        rows = found(math, "mtr")
        self.assertEqual([[words(cell) for cell in row] for row in rows], [["0", "−1"], ["1", "0"]])

    def test_functions_are_upright_and_letters_are_not(self):
        math = tree("sin r + sqrt(x) < 1")
        upright = {words(e): e.get("mathvariant") for e in found(math, "mi")}
        self.assertEqual(upright, {"sin": "normal", "r": None, "x": None})
        self.assertEqual(words(found(math, "msqrt")[0]), "x")
        self.assertEqual(words(math), "sinr+x<1")

    def test_deep_brackets_are_shown_as_they_are_written(self):
        for before, after in (("(", ")"), ("{", "}"), ("sqrt(", ")"), ("x^{", "}"), ("[[", "]]")):
            for depth in (41, 1000, 20000):
                source = f"${before * depth}x{after * depth}$"
                with self.subTest(before=before, depth=depth):
                    self.assertEqual(equation.prose(source), source)
            self.assertIn("<math", equation.prose(f"${before * 20}x{after * 20}$"))
        self.assertEqual(equation.prose("(" * 20000 + "{"), "(" * 20000 + "{")

    def test_what_is_no_equation_is_shown_as_it_is_written(self):
        for source in ("", "x^", "x^-1", "(x", "x)", "[[1, 2], [3]]", "[[1, 2]", "x # y", "sqrt x", "x^2^3", "'", "{}", "<b>é"):
            with self.subTest(source=source):
                with self.assertRaises(equation.NotRead):
                    equation.mathml(source)
                shown = equation.prose(f"a < b: ${source}$.")
                self.assertNotIn("<math", shown)
                self.assertTrue(shown.startswith("a &lt; b: $"))
                self.assertNotIn("<b>", shown)

    def test_dollar_signs_stand_in_pairs(self):
        self.assertEqual(equation.prose("costs 5 $ <now>"), "costs 5 $ &lt;now&gt;")
        self.assertEqual(equation.prose("$x$ for 5 $").count("<math"), 1)
        self.assertTrue(equation.prose("$x$ for 5 $").endswith("for 5 $"))
        self.assertEqual(equation.prose("$x$ and $y$").count("<math"), 2)

    def test_every_equation_of_an_experiment_that_ships_is_read(self):
        equations = 0
        for path in sorted(SCRIPTS.parent.glob("experiments/*.toml")):
            experiment = tomllib.loads(path.read_text(encoding="utf-8"))
            shown = [part["equation"] for part in [experiment, *experiment.get("case", [])] if "equation" in part]
            for text in [experiment["description"], *experiment.get("notes", []), *shown]:
                self.assertNotIn("$", equation.prose(text).replace("aria-label", ""), path.name)
                equations += equation.prose(text).count("<math")
        self.assertGreater(equations, 5)


class Pages(Fresh):
    def test_the_page_shows_equations_of_description_and_notes(self):
        folder = synthetic(self.folder)
        path = folder / "experiment.json"
        head = json.loads(path.read_text())
        head["description"], head["notes"] = "The law $r'' + r = 0$, a < b.", ["With $nu > 0$."]
        path.write_text(json.dumps(head))
        self.assertEqual(run(folder)[0], 0)
        page = (folder / "report.html").read_text(encoding="utf-8")
        shown = [ElementTree.fromstring(part.split("</math>")[0].join(("<math", "</math>"))) for part in page.split("<math")[1:]]
        self.assertEqual([words(m) for m in shown], ["r′′+r=0", "ν>0"])
        self.assertIn("a &lt; b.", page)
        self.assertNotIn("$r", page)


if __name__ == "__main__":
    unittest.main()
