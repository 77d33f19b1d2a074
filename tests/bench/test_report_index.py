"""bench/report: the verdict as data, and the index of several experiments."""
import json
import pathlib
import tempfile
import unittest

from synthetic import Balance, Fresh, ended, load, reading, run, synthetic

import index  # noqa: E402
import index_page  # noqa: E402
import verdict  # noqa: E402
import verdict_data  # noqa: E402


class Data(Fresh):
    def test_rows_say_what_the_verdict_says(self):
        """Errors and costs of `synthetic`: mid takes 100 h and has the error 0.1 h^2, rk 50 h and 0.1 h^4 (fastest 40)."""
        shown = reading.Experiment(synthetic(self.folder))
        rows = {row["method"]: row for row in verdict_data.rows(verdict.Verdict(shown, shown.cases[0]))}
        self.assertEqual({m: r["structure_kept"] for m, r in rows.items()}, {"mid": "yes", "rk": "no", "bad": "no"})
        self.assertEqual((rows["rk"]["family"], rows["rk"]["order_claimed"], rows["rk"]["failed"]), ("other", 4, 0))
        self.assertEqual((rows["bad"]["failed"], rows["bad"]["runs"]), (1, 3))
        self.assertAlmostEqual(rows["rk"]["structure_power"], 5, places=6)
        self.assertEqual((rows["rk"]["drift_class"], rows["rk"]["drifts"]), ("drifting", "yes"))
        # 0.1 h^4 = 1e-3 at h = 10^-1/2, where the run costs 40 ns for each of 40/h steps.
        # A target counts as reached from 1 + 1e-8 times it on, which is 2.5e-9 of the cost.
        self.assertAlmostEqual(rows["rk"]["cost_to_1e-03"] / (40 * 40 * 10**0.5), 1, delta=3e-9)
        self.assertIsNone(rows["mid"]["cost_to_1e-12"])

    def test_the_ratio_is_that_of_costs(self):
        """At 1e-5 rk and bad have the same errors and are ranked, and bad is made to take twice as long."""
        synthetic(self.folder)
        self.edit("cost.csv", "ns_per_step_min", lambda x: "80", lambda row: row[1] == "bad")
        shown = reading.Experiment(self.folder)
        rows = {row["method"]: row for row in verdict_data.rows(verdict.Verdict(shown, shown.cases[0]))}
        self.assertEqual({m: r["target"] for m, r in rows.items()}, dict.fromkeys(rows, 1e-5))
        self.assertEqual([m for m, r in rows.items() if r["cheapest"]], ["rk"])
        self.assertEqual((rows["rk"]["ratio"], rows["mid"]["ratio"]), (1.0, None))
        self.assertAlmostEqual(rows["bad"]["ratio"], 2, places=12)

    def test_files_hold_the_rows(self):
        synthetic(self.folder)
        self.assertEqual(run(self.folder)[0], 0)
        table = load(self.folder / "verdict.csv")
        cases = json.loads((self.folder / "report.json").read_text())["cases"]
        self.assertEqual(len(table), 1 + sum(len(c["methods"]) for c in cases))
        self.assertEqual(table[0], list(cases[0]["methods"][0]))
        for cells, row in zip(table[1:], (r for c in cases for r in c["methods"])):
            self.assertEqual(cells, ["" if v is None else str(v) for v in row.values()])


class Index(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        for name in ("one", "two and more"):
            run(synthetic(cls.folder / name))
            head = json.loads((cls.folder / name / "experiment.json").read_text())
            (cls.folder / name / "experiment.json").write_text(json.dumps(head | {"name": name.split()[0]}))
        cls.status, cls.made, cls.told = ended(index, cls.folder / "index.html", cls.folder / "one", cls.folder / "two and more")
        cls.page = Balance()
        cls.page.feed((cls.folder / "index.html").read_text())

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def test_every_report_has_its_picture_sentences_and_link(self):
        self.assertEqual((self.status, self.told), (0, ""))
        self.assertEqual(self.page.open, [])
        self.assertEqual(len(self.page.ids), len(set(self.page.ids)))
        words = " ".join(" ".join(self.page.words).split())
        for name, folder in (("one", "one"), ("two", "two%20and%20more")):
            said = json.loads((self.folder / folder.replace("%20", " ") / "report.json").read_text())["cases"]
            self.assertIn(name, self.page.ids)
            self.assertIn(f"{folder}/report.html", self.page.links)
            self.assertIn(f"{folder}/report.html#case-osc", self.page.links)
            self.assertIn(said[1]["sentence"], words)
        self.assertIn("A & B <script>", words)
        self.assertNotIn("url(#small", (self.folder / "index.html").read_text())
        self.assertFalse([x for x in self.page.links if not x.startswith("#") and not (
            self.folder / x.partition("#")[0].replace("%20", " ")).exists()])

    def test_a_cell_says_what_the_row_says(self):
        row = {"method": "m", "family": "gauss", "structure_kept": "no", "quantity": "energy", "drift_class": "linear", "drift": 1e-3,
               "drifts": "yes", "error": None, "failed": 0, "runs": 3, "ratio": 2.44, "cheapest": ""}
        shown = index_page.cell(row, {"title": "T<"})
        self.assertIn('title="m, T&lt;; does not keep the structure; energy linear 1.0e-03"', shown)
        self.assertIn('<td class="bad"', shown)
        self.assertIn("2.4 ↗<", shown)  # also where no colour is seen
        self.assertNotIn("↗", index_page.cell(row | {"drifts": "not known"}, {"title": ""}))
        self.assertIn("mk open", shown)
        self.assertIn("mk full", index_page.cell(row | {"structure_kept": "yes"}, {"title": ""}))
        self.assertIn("mk open", index_page.cell(row | {"structure_kept": ""}, {"title": ""}))  # there is none to keep
        self.assertIn("failed", index_page.cell(row | {"ratio": None, "failed": 3}, {"title": ""}))
        self.assertEqual(index_page.cell(None, {}), "<td></td>")

    def test_rows_stand_by_family_and_order(self):
        """Of one family: mid claims at most 3, the others 4."""
        source = (self.folder / "index.html").read_text()
        places = [source.index(f'<th scope="row"><span class="c-other">{name}<') for name in ("mid", "bad", "rk")]
        self.assertEqual(places, sorted(places))

    def test_a_name_has_one_row_whatever_families_its_methods_have(self):
        class Shown:
            head, link = {"name": "x"}, "x"
            def __init__(self, family):
                self.problems = [{"case": "c", "title": "C", "methods": [
                    {"method": "m", "family": family, "order_claimed": 2, "structure_kept": "yes", "quantity": "", "drift_class": "",
                     "drift": None, "drifts": "no", "error": None, "failed": 0, "runs": 1, "ratio": None, "cheapest": ""}]}]
        table = index_page.table([Shown("gauss"), Shown("other"), Shown("gauss")])
        self.assertEqual(table.count('<th scope="row">'), 1)
        self.assertIn('<span class="c-gauss">m</span>', table)

    def test_exponents_are_raised(self):
        for said, shown in (("10^−6 x", "10<sup>−6</sup> x"), ("t^0.50 ± 0.1)", "t<sup>0.50 ± 0.1</sup>)"), ("e^0.04 K.", "e<sup>0.04 K</sup>."),
                            ("a^b", "a^b")):
            self.assertEqual(index_page.powers(said), shown)

    def test_what_is_wrong_is_said(self):
        for arguments, said in (((), "expected the path of the page"), ((self.folder / "x.html", self.folder / "none"), "experiment.json")):
            status, _, told = ended(index, *arguments)
            self.assertEqual((status, told.count("\n")), (2, 1), told)
            self.assertIn(said, told)
        self.assertFalse((self.folder / "x.html").exists())


if __name__ == "__main__":
    unittest.main()
