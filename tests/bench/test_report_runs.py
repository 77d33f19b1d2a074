"""bench/report: what is seen of one run, and the page that pfaff plot makes."""
import json
import math
import pathlib
import re
import unittest
import xml.etree.ElementTree

from synthetic import Balance, Fresh, ended, save

import frames  # noqa: E402
import matplotlib  # noqa: E402
import plot  # noqa: E402
import recording  # noqa: E402
import run_figures  # noqa: E402
import series  # noqa: E402
import wanted  # noqa: E402


def run_directory(folder, columns, rows, **summary):
    folder.mkdir(parents=True, exist_ok=True)
    save(folder / "series.csv", [columns] + [[repr(x) for x in row] for row in rows])
    (folder / "summary.json").write_text(json.dumps({
        "schema": 1, "system": "s", "integrator": "rk4", "step": "0.1", "precision": "double", "status": "converged",
        "invariants": [{"name": "energy", "unit": "J", "expected": "conserved", "class": "bounded"}]} | summary))
    return folder


def pendulum(folder, samples=200):
    """Two bobs on rods of length 1 that turn at different rates about the origin and about each other."""
    columns = ["t [s]", "x0 [m]", "y0 [m]", "x1 [m]", "y1 [m]", "px0 [kg m/s]", "py0 [kg m/s]", "px1 [kg m/s]",
               "py1 [kg m/s]", "energy [J]", "constraint [1]"]
    rows = []
    for k in range(samples):
        t = 0.05 * k
        a, b = (math.sin(t), -math.cos(t)), (math.sin(3 * t), -math.cos(3 * t))
        rows.append([t, *a, a[0] + b[0], a[1] + b[1], 0.0, 0.0, 0.0, 0.0, 1 + 1e-6 * math.sin(t), 1e-16])
    return run_directory(folder, columns, rows, links=[[0, [0.0, 0.0]], [1, 0]], constraints=[{"name": "constraint"}])


def oscillators(folder, samples=4000, step=0.05, slow=1.0):
    """Two oscillators, q1 = sin t and q2 = cos(w t) with w = sqrt 2: passages of q1 = 0 are at t = 2 pi k."""
    w = math.sqrt(2) * slow
    rows = [[t, math.sin(t), math.cos(w * t), math.cos(t), -w * math.sin(w * t), 1.5]
            for t in (0.03 + step * k for k in range(samples))]
    return run_directory(folder, ["t [s]", "q1 [m]", "q2 [m]", "p1 [kg m/s]", "p2 [kg m/s]", "energy [J]"], rows, plane=["q1", "q2"])


class Recordings(Fresh):
    def test_points_are_found_by_their_names(self):
        run = recording.read_recording(pendulum(self.folder))
        self.assertEqual(run.points(), [["x0", "y0"], ["x1", "y1"]])
        self.assertEqual(run.links, [(0, [0.0, 0.0]), (1, 0)])
        self.assertEqual(run.state[-1], "py1")

    def test_a_section_is_where_the_first_coordinate_rises_through_zero(self):
        run = recording.read_recording(oscillators(self.folder))
        self.assertEqual(run.points(), [])
        self.assertEqual(run.plane(), ("q1", "q2"))
        found, w = run.section(), math.sqrt(2)
        self.assertEqual(len(found), 31)
        for k, (q2, p2) in enumerate(found, 1):  # cubics through samples 0.05 apart are right to 0.05^4
            self.assertAlmostEqual(q2, math.cos(w * 2 * math.pi * k), delta=1e-5)
            self.assertAlmostEqual(p2, -w * math.sin(w * 2 * math.pi * k), delta=2e-5)

    def test_a_section_of_a_run_back_in_time_is_that_of_the_motion(self):
        found, w = recording.read_recording(oscillators(self.folder, step=-0.05)).section(), math.sqrt(2)
        self.assertEqual(len(found), 31)
        for k, (q2, p2) in enumerate(reversed(found), 1):  # errors as above
            self.assertAlmostEqual(q2, math.cos(w * 2 * math.pi * k), delta=1e-5)
            self.assertAlmostEqual(p2, w * math.sin(w * 2 * math.pi * k), delta=2e-5)

    def test_too_few_passages_and_samples_too_far_apart_make_no_section(self):
        self.assertEqual(recording.read_recording(oscillators(self.folder / "few", samples=900)).section(), [])
        self.assertEqual(recording.read_recording(oscillators(self.folder / "far", step=1.6)).section(), [])

    def test_samples_that_lie_far_apart_are_no_curve(self):
        def circle(step):
            return [math.cos(step * k) for k in range(50)], [math.sin(step * k) for k in range(50)]
        self.assertFalse(recording.coarse(*circle(0.1)))
        self.assertTrue(recording.coarse(*circle(1.0)))


class Frames(Fresh):
    def test_the_first_stretch_is_shown(self):
        figure = frames.Figure(recording.read_recording(pendulum(self.folder)))
        self.assertLess(figure.times[-1], 9.95)  # the whole run is longer
        self.assertGreaterEqual(len(figure.times), frames.LEAST)
        for k in range(len(figure.times)):
            for pair in figure.links:
                self.assertAlmostEqual(math.dist(*figure.ends(pair, k)), 1, places=12)

    def test_an_animation_holds_its_frames(self):
        figure = frames.Figure(recording.read_recording(pendulum(self.folder)))
        svg = frames.Animation(figure, "#123456", "gauss", "a & b", 3.0).svg("moving")
        root = xml.etree.ElementTree.fromstring(svg)
        rods, dots = (path for path in root.findall(".//{*}animate"))
        self.assertEqual(rods.get("dur"), "3s")
        times = [float(t) for t in rods.get("keyTimes").split(";")]
        self.assertEqual((times[0], times[-1]), (0, 1))
        self.assertEqual(times, sorted(times))
        for animate, each in ((rods, 2), (dots, 2)):
            values = animate.get("values").split(";")
            self.assertEqual(len(values), len(times))
            self.assertEqual({v.count("M") for v in values}, {each})
        self.assertIn("var(--gauss)", svg)
        self.assertNotIn("var(", frames.Animation(figure, "#123456", "gauss", "", 3.0).svg("moving", coloured=True))

    def test_how_fast_an_animation_is(self):
        figure = frames.Figure(recording.read_recording(pendulum(self.folder)))
        whole = figure.times[-1]
        self.assertEqual(frames.duration(figure, "s"), (whole, "in true time"))
        figure.times = [10 * t for t in figure.times]
        self.assertIn("faster than the motion", frames.duration(figure, "s")[1])


def plotted(folder, *options):
    """(exit status, stderr) of plot.py in this process."""
    return ended(plot, folder, *options)[::2]


class Pages(Fresh):
    def test_a_run_of_points(self):
        status, told = plotted(pendulum(self.folder))
        self.assertEqual(status, 0, told)
        made = self.folder / "plot"
        self.assertEqual({p.name for p in made.iterdir()}, {"animation.svg", "motion.png", "motion.svg", "plot.html",
                                                            "quantities.png", "quantities.svg"})
        page = Balance()
        page.feed((made / "plot.html").read_text())
        self.assertEqual(len(set(page.ids)), len(page.ids))
        self.assertFalse([link for link in page.links if not link.startswith("#")])  # nothing is fetched
        words = " ".join(page.words)
        for said in ("The motion", "Animation", "Against time", "energy: |I(t) − I(0)|, bounded [J]", "constraint", "t = 0 s"):
            self.assertIn(said, words)
        first = (made / "motion.svg").read_bytes()
        self.assertEqual(plotted(self.folder)[0], 0)
        self.assertEqual((made / "motion.svg").read_bytes(), first)

    def test_a_run_of_two_oscillators_has_a_portrait_and_a_section(self):
        self.assertEqual(plotted(oscillators(self.folder))[0], 0)
        page = (self.folder / "plot" / "plot.html").read_text()
        self.assertIn("q2 against q1", page)
        self.assertIn("Each point is one of 31 passages of q1 = 0 upwards.", page)

    def test_names_have_room_beside_the_next_panel(self):
        """A coordinate that has its unit alone is named above its panel."""
        columns = ["t [s]", "x_of_the_sun [m]", "x_of_the_moon [m]", "angle [rad]", "p [kg m^2/s]", "energy [J]"]
        run_directory(self.folder, columns, [[0.1 * k, 0.1 * k, -0.1 * k, 0.2 * k, 1.0, 1.0] for k in range(30)])
        drawing = run_figures.quantities(recording.read_recording(self.folder))[0]
        for wide in (True, False):
            canvas = drawing.draw(wide)
            self.assertEqual([a.get_title(loc="left") for a in canvas.axes][:3], ["coordinates [m]", "angle [rad]", "p [kg m²/s]"])
            names = [t.get_window_extent(canvas.renderer) for t in canvas.axes[0].texts]
            ends = [a.get_tightbbox(canvas.renderer).x0 for a in canvas.axes[1:2]] if wide else [canvas.width]
            self.assertEqual(len(names), 2)
            self.assertLess(max(box.x1 for box in names), ends[0])
            self.assertFalse(canvas.axes[1].texts)

    def test_coordinates_and_figures_for_papers(self):
        folder = oscillators(self.folder)
        self.assertEqual(plotted(folder, "--coordinates", "q1,p1", "--figures", "pdf,png", "--width", "85mm"), (0, ""))
        self.assertIn("p1 against q1", (folder / "plot" / "plot.html").read_text())
        self.assertEqual({p.name for p in (folder / "plot" / "paper").iterdir()},
                         {f"{kind}.{end}" for kind in ("motion", "quantities") for end in ("pdf", "png", "txt")})
        with matplotlib.rc_context(wanted.style_of(None)):
            canvas = run_figures.drawings(recording.read_recording(folder), ("q1", "p1"))[0].draw(241)
        self.assertEqual((canvas.width, canvas.font), (241, 7))
        for options, said in ((("--coordinates", "q1"), "expected two names with a comma between them, got 'q1'"),
                              (("--coordinates", "q1,P1"), "no coordinate 'P1'; did you mean 'p1'?"),
                              (("--figures", "gif"), "got 'gif'; did you mean 'pgf'?"), (("--width", "9cm"), "--figures names")):
            status, told = plotted(folder, *options)
            self.assertEqual((status, told.count("\n")), (2, 1), told)
            self.assertIn(said, told)

    def test_the_sentence_says_what_the_record_holds(self):
        folder = run_directory(
            self.folder, ["t [s]", "q [m]", "p [m/s]", "energy [J]", "heat [J]", "entropy", "free"],
            [[0.0, 1.0, 0.0, 2.0, 3.0, 0.0, 0.0], [0.5, 1.0, 0.0, 2.5, 1.0, 0.0, 0.0]],
            completed=5, status="not_converged", message="the iteration", error_max=0.25, invariants=[
                {"name": "energy", "unit": "J", "expected": "conserved", "class": "linear", "max": 0.5, "initial": 2.0, "scale": 4.0},
                {"name": "heat", "unit": "J", "expected": "decreasing", "initial": "3.0", "largest_rise": 0.0},
                {"name": "entropy", "unit": "1", "expected": "conserved", "max": None}, {"name": "free", "expected": "free"}])
        self.assertEqual(ended(plot, folder)[1]["sentence"], (
            "s, rk4: 5 steps to t = 0.5 s, where it ended early (the iteration); energy moves from the start by at most 0.5 J, "
            "which is 0.12 of its scale (linear); heat, which is expected to decrease, goes from 3 to 1 J and never rises; the relative error of "
            "the state is at most 0.25."))

    def test_a_run_backwards_is_drawn_against_the_time_since_its_start(self):
        rows = [[5.0 - 0.1 * k, math.cos(0.1 * k), 1 + 1e-6 * k, "" if k % 5 else 1e-4 * k] for k in range(21)]
        folder = run_directory(self.folder, ["t [s]", "q [m]", "energy [J]", "error"], rows, error_max=2e-3,
                               error_rows={"measured": 4, "of": 20})
        (folder / "series.csv").write_text((folder / "series.csv").read_text().replace("''", ""))
        one = series.read_series(folder / "series.csv", "energy", "double")
        for k, t in enumerate(one.time):
            self.assertAlmostEqual(t, 0.1 * k, places=12)
        self.assertEqual(series.run_times([0, 1, 2]), [0, 1, 2])
        drawn = run_figures.drawings(recording.read_recording(folder))[-1]
        self.assertIn("Errors are measured at 4 of 20 rows.", drawn.caption)
        svg = drawn.draw(True).svg("quantities")
        self.assertIn("time since the start [s]", svg)
        self.assertIn("at most 0.002 at 4 of 20 rows", ended(plot, folder)[1]["sentence"])

    def test_the_sentence_says_how_far_the_reference_reaches(self):
        for name, most, said in (("some", 0.1, "the relative error of the state is at most 0.1; errors end early: the solution ends."),
                                 ("none", None, "there are no errors: the solution ends.")):
            folder = run_directory(self.folder / name, ["t [s]", "q [m]"], [[0.0, 1.0], [0.5, 1.0]], invariants=[],
                                   error_max=most, reference_ended="the solution ends")
            self.assertTrue(ended(plot, folder)[1]["sentence"].endswith(said))

    def test_what_is_no_run_is_refused(self):
        for folder, said in ((self.folder / "nowhere", "expected the directory of a run"),
                             (run_directory(self.folder / "short", ["t [s]", "q [m]"], [[0.0, 1.0]], invariants=[]),
                              "expected a run of two samples or more, got 1"),
                             (run_directory(self.folder / "bad", ["q [m]"], [[0.0], [1.0]]), "'t [unit]'")):
            status, told = plotted(folder)
            self.assertEqual((status, told.count("\n")), (2, 1), told)
            self.assertIn(said, told)
            self.assertTrue(re.match("plot.py: ", told))
        self.assertFalse((pathlib.Path(self.folder) / "nowhere").exists())


if __name__ == "__main__":
    unittest.main()
