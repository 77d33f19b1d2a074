"""bench/report: figures and tables for papers, and the labels of figures."""
import re
import shutil
import subprocess
import unittest
import unittest.mock
import xml.etree.ElementTree

from synthetic import Fresh, ended, reading, report, synthetic

import canvas  # noqa: E402
import labels  # noqa: E402
import matplotlib  # noqa: E402
import papers  # noqa: E402
import scales  # noqa: E402
import verdict  # noqa: E402
import verdict_latex  # noqa: E402
import wanted  # noqa: E402
import work_precision  # noqa: E402
from files import InputError  # noqa: E402


def paper(folder, *options):
    """(exit status, stderr) of report.py with options."""
    return ended(report, folder, *options)[::2]


class Papers(Fresh):
    def test_files_have_the_width_and_text_stays_text(self):
        synthetic(self.folder)
        status, told = paper(self.folder, "--figures", "pdf,svg", "--width", "85mm")
        self.assertEqual(status, 0, told)
        made = self.folder / "figures" / "paper"
        self.assertEqual({p.suffix for p in made.iterdir()}, {".pdf", ".svg", ".txt", ".tex", ".bib"})
        root = xml.etree.ElementTree.parse(made / "work_precision_osc.svg").getroot()
        self.assertTrue(root.get("width").endswith("pt"))
        self.assertAlmostEqual(float(root.get("width")[:-2]), 85 * 72 / 25.4, delta=0.01)
        words = "".join(root.itertext())
        self.assertIn("time of the run", words)
        self.assertNotIn("Oscillator", words.replace(root.find("{*}desc").text, ""))  # no title inside
        content = (made / "drift_osc.pdf").read_bytes()
        self.assertIn(b"/FontFile2", content)  # TrueType, which can be searched and edited, and not Type 3
        self.assertNotIn(b"/Type3", content)
        told = (made / "work_precision_osc.txt").read_text()
        for said in ("Pareto front", "Holds for Oscillator to t = 40 s", "GCC 12, -O3; pfaff compare synthetic"):
            self.assertIn(said, told)
        self.assertFalse((self.folder / "report.html").exists())

    def test_a_table_says_what_the_page_says(self):
        synthetic(self.folder)
        shown = reading.Experiment(self.folder)
        tex = verdict_latex.latex_table(verdict.Verdict(shown, shown.cases[0]))
        rows = [line for line in tex.splitlines() if line.endswith(r"\\")]
        self.assertEqual(len({line.count("&") for line in rows}), 1)
        self.assertEqual(len(rows), 4)
        self.assertIn(r"rk & $h^{5.0}$ & drifting $2\cdot 10^{-6}$", tex)
        self.assertIn("mid & kept & near", tex)
        self.assertEqual(verdict_latex.escaped("a_b & 50 %"), r"a\_b \& 50 \%")

    def test_exponents_are_formulas_in_papers_alone(self):
        self.assertEqual(scales.power_of_ten(-16), "10⁻¹⁶")
        with papers.settings(wanted.wanted({"--figures": "pdf"}), self.folder / "figures"):
            self.assertEqual(scales.power_of_ten(-16), "$10^{-16}$")
        self.assertEqual(scales.power_of_ten(3), "10³")

    def test_what_is_wrong_is_said(self):
        synthetic(self.folder)
        for options, said in ((("--figures", "gif"), "--figures: expected some of pdf, svg, pgf, png, got 'gif'; did you mean 'pgf'?"),
                              (("--figures", "pdf", "--width", "85"), "--width: expected a width between 50mm and 350mm"),
                              (("--figures", "pdf", "--width", "3mm"), "--width"), (("--width", "85mm"), "--figures names"),
                              (("--figures",), "--figures: expected a value"), (("--other", "x"), "expected one argument"),
                              (("--figures", "pdf", "--style", "/nowhere/x"), "/nowhere/x")):
            status, told = paper(self.folder, *options)
            self.assertEqual((status, told.count("\n")), (2, 1), told)
            self.assertIn(said, told)

    def test_a_style_changes_its_keys_alone_and_misspelt_ones_are_refused(self):
        style = self.folder / "mine.mplstyle"
        style.write_text("font.size: 9\n")
        own, mine = wanted.style_of(None), wanted.style_of(str(style))
        self.assertEqual({k for k in mine if mine[k] != own.get(k)}, {"font.size"})
        with matplotlib.rc_context(own):
            small = canvas.sizes(241.0)
        with matplotlib.rc_context(mine):
            large = canvas.sizes(241.0)
        self.assertEqual((small.font, large.font), (7, 9))
        self.assertAlmostEqual(large.unit / small.unit, 9 / 7)
        for text, said in (("font.siez: 9\n", "matplotlib has no key 'font.siez'; did you mean 'font.size'?"),
                           ("font.size: large\n", "font.size: large"), ("font.size 9\n", "font.size 9"), ("\xff", "UTF-8")):
            style.write_bytes(text.encode("latin-1"))
            with self.assertRaises(InputError) as refused:
                wanted.style_of(str(style))
            self.assertIn(said, str(refused.exception))

    def test_without_latex_the_other_kinds_are_made(self):
        synthetic(self.folder)
        with unittest.mock.patch.object(shutil, "which", lambda program: None):
            status, made, told = ended(report, self.folder, "--figures", "pgf,pdf,svg")
            self.assertEqual(status, 0, told)
            self.assertEqual(made["left_out"], "figures of the kind pgf were left out, because pgf needs LaTeX, with which it "
                             "measures text, and none is installed")
            self.assertEqual({p.suffix for p in (self.folder / "figures" / "paper").iterdir()}, {".pdf", ".svg", ".txt", ".tex", ".bib"})
            self.assertEqual(ended(wanted, "--figures", "pgf")[0], 2)  # nothing is left to be made
        with unittest.mock.patch.object(shutil, "which", lambda program: f"/bin/{program}"):
            self.assertEqual(ended(wanted, "--figures", "pgf,pdf")[1], {"left_out": ""})

    @unittest.skipUnless(shutil.which("pdflatex"), "LaTeX is not installed")
    def test_latex_takes_them(self):
        synthetic(self.folder)
        self.assertEqual(paper(self.folder, "--figures", "pdf,pgf")[0], 0)
        made = self.folder / "figures" / "paper"
        (made / "paper.tex").write_text("\n".join([
            r"\documentclass{article}\usepackage{booktabs,graphicx,pgf}\begin{document}",
            r"\includegraphics{work_precision_osc.pdf}\input{work_precision_osc.pgf}\input{drift_osc.pgf}",
            r"\input{structure_osc.pgf}\input{verdict_osc.tex}\end{document}"]))
        done = subprocess.run(["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "paper.tex"], cwd=made,
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout[-800:])
        self.assertFalse(re.search(r"^!", done.stdout, flags=re.M))


class Labels(Fresh):
    def test_pushed_apart(self):
        out = labels.pushed_apart([5, 5, 5, 40], 10, 0, 60)
        ordered = sorted(out)
        self.assertTrue(all(b - a >= 10 - 1e-4 for a, b in zip(ordered, ordered[1:])), out)
        self.assertAlmostEqual(out[3], 40, delta=5)

    def test_six_lines_have_colour(self):
        shown = reading.Experiment(synthetic(self.folder, extra_methods=12))
        said = verdict.Verdict(shown, shown.cases[0])
        self.assertEqual(len(said.named()), 6)
        self.assertIn("bad", said.named())  # whose run failed
        self.assertEqual(len(set(said.in_order([r.label for r in said.rows]))), 15)
        canvas = work_precision.drawings(said)[0].draw(True)
        self.assertEqual(len(canvas.titles), 15)  # a line for each method, with its runs in the title
        self.assertEqual(said.named()[0], said.best(said.target)[0].label)


if __name__ == "__main__":
    unittest.main()
