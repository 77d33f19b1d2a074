"""bench/micro/ratios.py: a ratio that exceeds its target fails, whatever else was measured."""
import contextlib
import importlib.util
import io
import json
import pathlib
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "bench" / "micro" / "ratios.py"
specification = importlib.util.spec_from_file_location("ratios", SCRIPT)
ratios = importlib.util.module_from_spec(specification)
specification.loader.exec_module(ratios)

LIMITED = [row for row in ratios.RATIOS if row.limit is not None]
# Rows of a time that is limited in no other row.
ALONE = [row for row in LIMITED if sum(other.numerator == row.numerator for other in LIMITED) == 1]


class Ratios(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.file = pathlib.Path(folder.name) / "times.json"
        self.times = {"/".join(key): 1.0 for row in LIMITED for key in (row.numerator, row.denominator)}  # no target is below 1
        for run, error in ratios.ERRORS_TO_REACH.items():
            self.times["/".join(ratios.error_of(run))] = error

    def check(self):
        self.file.write_text(json.dumps(self.times), encoding="utf-8")
        return self.run_with("--times", str(self.file))

    def run_with(self, *arguments):
        told, complained = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(told), contextlib.redirect_stderr(complained):
            try:
                status = ratios.main(arguments)
            except SystemExit as end:
                status = end.code
        return status, told.getvalue(), complained.getvalue()

    def line(self, told, row):
        return next(text for text in told.splitlines() if text.startswith(row.what + " "))

    def test_measurements_within_their_targets_pass(self):
        status, told, complained = self.check()
        self.assertEqual((status, complained), (0, ""))
        self.assertNotIn("missed", told)

    def test_one_false_measurement_fails_whichever_it_is(self):
        for row in (ALONE[0], ALONE[len(ALONE) // 2], ALONE[-1]):
            self.setUp()
            self.times["/".join(row.numerator)] = 1.26 * row.limit
            status, told, complained = self.check()
            self.assertEqual(status, 1, row.what)
            self.assertIn("exceeded by 26 %", self.line(told, row))
            self.assertIn("1 of the ratios exceed their targets by more than 25 %", complained)

    def test_a_run_that_does_not_reach_its_error_fails(self):
        run, error = next(iter(ratios.ERRORS_TO_REACH.items()))
        for false in (1.01 * error, float("nan"), None):
            self.setUp()
            key = "/".join(ratios.error_of(run))
            self.times.pop(key) if false is None else self.times.update({key: false})
            status, told, complained = self.check()
            self.assertEqual(status, 1, false)
            self.assertIn(f"{' '.join(run)}: expected an error of at most", told)
            self.assertIn("1 of the whole runs do not reach", complained)

    def test_errors_are_read_beside_times(self):
        run = {"run_type": "iteration", "run_name": "kepler-run/m-h1/static", "ns_per_run": 5.0, "energy_error": 1e-9}
        found = ratios.fastest([run, run | {"ns_per_run": 4.0}])
        self.assertEqual(found, {("kepler-run", "m-h1", "static"): 4.0,
                                 ("kepler-run", "m-h1", "static-energy-error"): 1e-9})

    def test_a_ratio_between_the_target_and_the_bound_is_marked_and_passes(self):
        row = LIMITED[-1]
        self.times["/".join(row.numerator)] = 1.24 * row.limit
        status, told, _ = self.check()
        self.assertEqual(status, 0)
        self.assertTrue(self.line(told, row).endswith("missed"))

    def test_a_target_without_a_measurement_fails(self):
        row = LIMITED[0]
        del self.times["/".join(row.numerator)]
        status, told, _ = self.check()
        self.assertEqual(status, 1)
        self.assertTrue(self.line(told, row).endswith("not measured"))

    def test_times_a_rod_decide_nothing(self):
        self.times["chain-3d-64/rattle/registered"] = 1000.0
        status, told, _ = self.check()
        self.assertEqual(status, 0)
        self.assertIn("exceeded by 2400 %", told)

    def test_a_ratio_stands_for_all_combinations_of_its_lists(self):
        entry = {"what": "{system} {method}", "numerator": "{system}/{method}/static", "denominator": "{system}/rk4/odeint",
                 "system": "systems", "method": ["verlet", {"method": "gauss", "limit": 2.0, "error": 1e-9}], "limit": 1.5}
        found = ratios.ratios_of(entry, {"systems": ["kepler", "pendulum"]})
        self.assertEqual([tuple(row) for row in found],
                         [(f"{system} {method}", (system, method, "static"), (system, "rk4", "odeint"), limit, error)
                          for system in ("kepler", "pendulum")
                          for method, limit, error in (("verlet", 1.5, None), ("gauss", 2.0, 1e-9))])

    def test_a_name_without_values_is_refused(self):
        entry = {"what": "{system}", "numerator": "{system}/rk4/static", "denominator": "kepler/rk4/static"}
        for wrong in ({}, {"system": "sistems"}, {"system": ["kepler"], "numerator": "{sistem}/rk4/static"}):
            with self.assertRaisesRegex(ValueError, r"targets.toml: \[\[ratio\]\] '{system}': '\w+' is missing; .*: systems$"):
                ratios.ratios_of(entry | wrong, {"systems": ["kepler"]})

    def test_what_google_benchmark_prints_is_read(self):
        runs = [{"run_type": "iteration", "run_name": "kepler/verlet/static", "ns_per_step": time} for time in (3.0, 2.0)]
        runs += [{"run_type": "aggregate", "run_name": "kepler/verlet/static_mean", "ns_per_step": 1.0},
                 {"run_type": "iteration", "run_name": "tree-12/solve/library", "ns_per_row": 5.0}]
        self.assertEqual(ratios.fastest(runs),
                         {("kepler", "verlet", "static"): 2.0, ("tree-12", "solve", "library"): 5.0})

    def program(self, runs, context):
        """A program that prints these runs as Google Benchmark does."""
        program = self.file.with_name("program")
        printed = json.dumps({"context": context, "benchmarks": runs})
        program.write_text(f"#!/bin/sh\ncat <<'END'\n{printed}\nEND\n", encoding="utf-8")
        program.chmod(0o755)
        return str(program)

    def runs(self):
        """One run of each benchmark that is needed."""
        errors = {"/".join(run): {"energy_error": error} for run, error in ratios.ERRORS_TO_REACH.items()}
        names = sorted({"/".join(key) for row in LIMITED for key in (row.numerator, row.denominator)} | errors.keys())
        return [{"run_type": "iteration", "run_name": name, "ns_per_step": 1.0} | errors.get(name, {}) for name in names]

    def test_a_check_compares_no_times(self):
        for context in ({}, {"optimised": "no"}):
            status, told, _ = self.run_with(self.program(self.runs(), context), "--check")
            self.assertEqual(status, 0, told)

    def test_a_check_finds_what_is_missing_inaccurate_or_stopped(self):
        def without(runs):
            runs.pop()

        def inaccurate(runs):
            next(run for run in runs if "energy_error" in run)["energy_error"] *= 1.01

        def stopped(runs):
            runs[0].update(error_occurred=True, error_message="the step did not converge")

        for fault, said in ((without, "expected a benchmark of this name"), (inaccurate, "expected an error of at most"),
                            (stopped, "the step did not converge")):
            runs = self.runs()
            fault(runs)
            status, told, _ = self.run_with(self.program(runs, {}), "--check")
            self.assertEqual(status, 1)
            self.assertIn(said, told)

    def test_times_of_a_program_without_optimisation_are_refused(self):
        status, _, complained = self.run_with(self.program(self.runs(), {"optimised": "no"}))
        self.assertEqual(status, 2)
        self.assertIn("built without optimisation", complained)
        self.assertNotIn("optimisation", self.run_with(self.program(self.runs(), {}))[2])

    def test_wrong_usage(self):
        self.assertEqual(self.run_with()[0], 2)
        self.assertEqual(self.run_with("program", "--times", "file")[0], 2)
        self.assertEqual(self.run_with("--check", "--times", "file")[0], 2)
        status, _, complained = self.run_with("--times", str(self.file.with_name("none.json")))
        self.assertEqual(status, 2)
        self.assertIn("none.json", complained)
        self.file.write_text("no times", encoding="utf-8")
        self.assertEqual(self.run_with("--times", str(self.file))[0], 2)


if __name__ == "__main__":
    unittest.main()
