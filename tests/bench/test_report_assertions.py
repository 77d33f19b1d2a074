"""bench/report: sentences are made of yes and no alone, and what they assert is true of the files they are made from."""
import itertools
import json
import pathlib
import sys
import unittest

from synthetic import CLAIM_COLUMNS, Fresh, describe, load, parsed, reading, run, save, synthetic

import drift_sentence  # noqa: E402
import first_screen  # noqa: E402
import sentence  # noqa: E402
import verdict  # noqa: E402
import wording  # noqa: E402

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "app"))

import assertions  # noqa: E402

VALUES = (True, False, None)


class Two(Fresh):
    """The oscillator's case with two methods, of which a property is or is not so or is not known."""

    def setUp(self):
        super().setUp()
        synthetic(self.folder, steps=(0.2, 0.1))
        head = json.loads((self.folder / "experiment.json").read_text())
        head["methods"], head["cases"] = head["methods"][:2], head["cases"][:1]
        (self.folder / "experiment.json").write_text(json.dumps(head))
        rows = load(self.folder / "results.csv")
        save(self.folder / "results.csv", [r for r in rows if r[0] in ("case", "osc") and r[2] != "bad"])

    def said(self, clauses):
        shown = reading.Experiment(self.folder)
        made = clauses(verdict.Verdict(shown, shown.cases[0]))
        return "; ".join(wording.plain_text(c.words) for c in made), made

    def borne_out(self):
        """The files bear out every assertion of the report."""
        shown = reading.Experiment(self.folder)
        said = first_screen.data(shown, [verdict.Verdict(shown, case) for case in shown.cases])
        (self.folder / "report.json").write_text(said)
        self.assertEqual(assertions.faults(self.folder), [])

    def test_structure(self):
        cell = {True: "2e-16", False: "1e-6", None: ""}
        right = {(True, True): "both methods keep the symplectic structure",
                 (False, False): "no method keeps the symplectic structure",
                 (True, False): ("only mid keeps the symplectic structure", "all but rk keep the symplectic structure"),
                 (False, True): ("only rk keeps the symplectic structure", "all but mid keep the symplectic structure")}
        head = json.loads((self.folder / "experiment.json").read_text())
        head["methods"][0]["systems"][0]["preserves"] = ["none"]
        (self.folder / "experiment.json").write_text(json.dumps(head))
        for mid, rk in itertools.product(VALUES, VALUES):
            with self.subTest(mid=mid, rk=rk):
                for method, value in (("mid", mid), ("rk", rk)):
                    self.edit("results.csv", "structure_residual", lambda x: cell[value], lambda row: row[2] == method)
                words, made = self.said(sentence.structure)
                if None in (mid, rk):
                    self.assertEqual((words, made), ("", []))
                else:
                    self.assertIn(words, right[mid, rk])
                    self.assertEqual(set(made[0].subject), {m for m, v in (("mid", mid), ("rk", rk)) if v})
                self.borne_out()

    def test_drift(self):
        name = {True: "drifting", False: "near", None: "unused"}
        self.edit("results.csv", "energy:max", lambda x: "1e-3")
        right = {(True, True): "mid and rk let the energy drift (drifting)", (False, False): "no method lets the energy drift away",
                 (True, False): "mid lets the energy drift (drifting), the other does not",
                 (False, True): "rk lets the energy drift (drifting), the other does not"}
        for mid, rk in itertools.product(VALUES, VALUES):
            for unknown in ("unused", ""):  # a class that does not tell, and none
                with self.subTest(mid=mid, rk=rk, unknown=unknown):
                    for method, value in (("mid", mid), ("rk", rk)):
                        self.edit("results.csv", "energy:class", lambda x: unknown if value is None else name[value],
                                  lambda row: row[2] == method)
                    words, made = self.said(drift_sentence.drift)
                    if None in (mid, rk):
                        self.assertEqual((words, made), ("", []))
                    else:
                        self.assertEqual(words, f"at equal cost, 10 µs, {right[mid, rk]}")
                    self.borne_out()

    def test_a_move_against_the_direction(self):
        """Energy that is expected to decrease: it does, it rises, or there is no series."""
        series = {(m, h): self.folder / "runs" / f"osc-{k}-{h}" / "series.csv" for k, m in enumerate(("mid", "rk")) for h in (0.2, 0.1)}
        for path in self.folder.glob("runs/*/summary.json"):
            path.write_text(path.read_text().replace('"conserved"', '"decreasing"', 1))
        whole = {key: load(path) for key, path in series.items()}
        for mid, rk in itertools.product(VALUES, VALUES):
            with self.subTest(mid=mid, rk=rk):
                for (method, h), path in series.items():
                    value = {"mid": mid, "rk": rk}[method]
                    path.unlink(missing_ok=True)
                    if value is not None:
                        change = 0.01 if value else -0.01
                        save(path, [whole[method, h][0]] + [[r[0], r[1], repr(1 + change * float(r[0])), *r[3:]]
                                                            for r in whole[method, h][1:]])
                words, made = self.said(drift_sentence.drift)
                if None in (mid, rk):
                    self.assertEqual((words, made), ("", []))
                else:
                    self.assertEqual("no method lets it rise" in words, not (mid or rk))
                    self.assertEqual(set(made[0].subject), {m for m, v in (("mid", mid), ("rk", rk)) if v})
                self.borne_out()

    def test_cheapest(self):
        """Both have runs on both sides of an error, one is better already at its coarsest, or never reaches it."""
        both, better, never = ("1e-4", "1e-7"), ("1e-9", "1e-10"), ("1e-2", "1e-3")
        for mid, rk in itertools.product((both, better, never), repeat=2):
            with self.subTest(mid=mid, rk=rk):
                for method, errors in (("mid", mid), ("rk", rk)):
                    for step, error in zip(("0.2", "0.1"), errors):
                        self.edit("results.csv", "error_max", lambda x: error, lambda row: row[2] == method and row[5] == step)
                words, _ = self.said(sentence.cheapest)
                self.assertEqual(bool(words), mid == rk)  # the same errors at the same cost are a tie
                self.assertIn("cost the same" if words else "", words)
                self.borne_out()


class Questions(Fresh):
    def ask(self, answer):
        path = self.folder / "experiment.json"
        head = json.loads(path.read_text())
        head["cases"][0] |= {"question": "Who keeps what?", "answer": answer}
        path.write_text(json.dumps(head))
        return run(self.folder)

    def test_the_first_screen_answers_the_question(self):
        synthetic(self.folder)
        for answer, told in (("energy", "At equal cost, 10 µs, rk and bad let the energy drift (drifting), the other does not."),
                             ("structure", "Only mid keeps the symplectic structure."),
                             ("growth", "The runs do not tell with which power of time errors grow."),
                             ("frequencies", "The runs do not tell which frequencies are right.")):
            self.assertEqual(self.ask(answer)[0], 0)
            said = json.loads((self.folder / "report.json").read_text())["cases"][0]
            self.assertEqual((said["question"], said["answer"]), ("Who keeps what?", answer))
            self.assertTrue(said["sentence"].lower().startswith(told.lower()), said["sentence"])
            self.assertIn("Who keeps what?", parsed(self.folder).text)
            self.assertEqual(assertions.faults(self.folder), [])

    def test_where_nothing_is_conserved_the_first_screen_says_so(self):
        synthetic(self.folder)
        path = self.folder / "experiment.json"
        head = json.loads(path.read_text())
        head["cases"][0].pop("conserved")
        path.write_text(json.dumps(head))
        self.assertEqual(self.ask("energy")[0], 0)
        said = json.loads((self.folder / "report.json").read_text())["cases"][0]["sentence"]
        self.assertEqual(said, "The runs do not tell which methods let the conserved quantity drift away: no quantity is conserved in "
                         "all of them.")
        self.assertEqual(assertions.faults(self.folder), [])

    def test_an_unknown_answer_is_refused(self):
        synthetic(self.folder)
        status, told = self.ask("weather")
        self.assertEqual(status, 2)
        self.assertIn("case osc: expected 'answer' to be one of cost, energy", told)

    def test_a_sentence_that_the_files_deny_is_found(self):
        """Each assertion of the report is falsified in turn: it is said of others, and not of those of whom it was."""
        synthetic(self.folder)
        self.edit("results.csv", "error_max", lambda x: "1e-16", lambda row: row[2] == "mid")
        self.assertEqual(run(self.folder)[0], 0)
        path = self.folder / "report.json"
        whole = path.read_text()
        made = [a for case in json.loads(whole)["cases"] for a in case["assertions"]]
        self.assertEqual({a["relation"] for a in made}, {"cheapest", "drifts", "keeps", "moves-against", "no-dearer"})
        for k in range(len(made)):
            report = json.loads(whole)
            a = [a for case in report["cases"] for a in case["assertions"]][k]
            others = [label for label in a["rows"] if label not in a["subject"]]
            a["subject"], a["not"] = a.get("not", others or ["rk"]), a["subject"]
            path.write_text(json.dumps(report))
            self.assertEqual(len(assertions.faults(self.folder)), 1, a["words"])


class Bare(Fresh):
    """Experiments of which hardly anything can be said: the report says that, and nothing else."""

    def report(self):
        status, told = run(self.folder)
        self.assertEqual(status, 0, told)
        self.assertEqual(assertions.faults(self.folder), [])
        return [(c["sentence"] + " " + c["below"], c["assertions"]) for c in
                json.loads((self.folder / "report.json").read_text())["cases"]]

    def test_one_method(self):
        synthetic(self.folder)
        rows = load(self.folder / "results.csv")
        save(self.folder / "results.csv", [r for r in rows if r[2] in ("method", "rk")])
        for said, made in self.report():
            self.assertEqual(made, [])
            self.assertIn("No method is called cheapest: one method alone finished a run.", said)

    def test_all_failed(self):
        synthetic(self.folder)
        self.edit("results.csv", "status", lambda x: "singular")
        for said, made in self.report():
            self.assertEqual((said, made), ("No method is called cheapest: no run finished. ", []))

    def test_no_reference(self):
        synthetic(self.folder)
        self.edit("results.csv", "error_max", lambda x: "")
        path = self.folder / "experiment.json"
        path.write_text(path.read_text().replace('"conserved": "energy"', '"conserved": ""'))
        for said, made in self.report():
            self.assertIn("No method is called cheapest: no error is known here.", said)
            self.assertNotIn("cheapest", [a["relation"] for a in made])

    def test_a_finding_that_fails_stands_beside_the_sentence(self):
        synthetic(self.folder)
        save(self.folder / "findings.csv", [CLAIM_COLUMNS, [
            "osc", "energy:max", "rk", "stays-below", "1", "", "1e-9", "", "3", "0", "3", "no", "1000"]])
        describe(self.folder)
        self.assertIn("1 finding that the experiment states does not hold.", self.report()[0][0])


if __name__ == "__main__":
    unittest.main()
