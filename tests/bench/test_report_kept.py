"""bench/report: a report that would be the same stays, and is made anew where anything of it or of what it is made of has changed."""
import pathlib
import tempfile
import unittest
import unittest.mock

from synthetic import Fresh, run, synthetic

import kept  # noqa: E402
import report  # noqa: E402


class Kept(Fresh):
    def setUp(self):
        super().setUp()
        synthetic(self.folder)
        self.made()

    def made(self):
        """Whether a report was made, and not kept; what is there is whole in both cases."""
        with unittest.mock.patch.object(report, "experiment_report", wraps=report.experiment_report) as making:
            self.assertEqual(run(self.folder), (0, ""))
        self.assertTrue(kept.is_kept(self.folder, kept.made_of(self.folder)))
        return making.called

    def test_what_has_not_changed_stays(self):
        for name in ("runs/osc-0-0.1/plot/report.html", "notes.txt"):  # of nobody's making, or of the plot of a run
            (self.folder / name).parent.mkdir(exist_ok=True)
            (self.folder / name).write_text("x")
        self.assertFalse(self.made())

    def assert_made_anew_after(self, name, changed):
        """Where the content of a file is changed, or the file goes for None. It is put back."""
        path = self.folder / name
        content = path.read_bytes()
        path.unlink() if changed is None else path.write_bytes(changed(content))
        self.assertFalse(kept.is_kept(self.folder, kept.made_of(self.folder)), name)
        path.write_bytes(content)

    def test_what_it_was_made_of(self):
        for name in ("results.csv", "cost.csv", "runs/osc-0-0.1/series.csv"):
            self.assert_made_anew_after(name, lambda content: content.replace(b"1", b"2", 1))
        (self.folder / "ensembles.csv").write_text("case\n")
        self.assertFalse(kept.is_kept(self.folder, kept.made_of(self.folder)))

    def test_what_was_made(self):
        for name in ("report.html", "verdict.csv", "figures/structure_osc.svg", "figures/made.json"):
            self.assert_made_anew_after(name, None)
            self.assert_made_anew_after(name, lambda content: b"[]")
        page = (self.folder / "report.html").read_bytes()
        (self.folder / "report.html").unlink()
        self.assertTrue(self.made())
        self.assertEqual((self.folder / "report.html").read_bytes(), page)

    def test_the_works_that_it_names(self):
        before = kept.made_of(self.folder)
        with tempfile.TemporaryDirectory() as other:
            path = pathlib.Path(other) / "references.bib"
            path.write_text("@book{a,\n}\n")
            with unittest.mock.patch.object(kept.bibliography, "file", return_value=path):
                self.assertNotEqual(kept.made_of(self.folder), before)

    def test_the_scripts(self):
        before = kept.made_of(self.folder)
        with tempfile.TemporaryDirectory() as other:
            (pathlib.Path(other) / "page.css").write_text("p{}")
            with unittest.mock.patch.object(kept, "__file__", str(pathlib.Path(other) / "kept.py")):
                self.assertNotEqual(kept.made_of(self.folder), before)


if __name__ == "__main__":
    unittest.main()
