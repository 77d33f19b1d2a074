"""The mutation suite: its list fits the sources, and its script plants, judges, restores and resumes as it says.

The script runs here on a small project with a program of its own; a stand-in for cmake copies that program.
"""
import os
import re
import subprocess
import sys
import tempfile
import tomllib
import unittest
from fnmatch import fnmatchcase
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
RUN = PROJECT / "tests/mutation/run"
PROGRAMS = [f"{room}_tests" for room in
            ("core", "brackets", "formulations", "systems", "integrators", "runs", "bench", "verify", "derive",
             "papers", "app", "verification")]

# Builds what stands in engine.txt into a program and test programs that look at their copy of it.
CMAKE = """#!/bin/sh
if [ "$1" = -S ]; then mkdir -p "$4/tests" && touch "$4/build.ninja"; exit; fi
grep -q syntax engine.txt && exit 1
cp engine.txt "$2/engine.txt"
cat >"$2/pfaff" <<'END'
#!/bin/sh
built=$(dirname "$0")/engine.txt
case "$*" in *wait*) sleep 60 ;; esac
grep -q 'sign = +' "$built"
END
cat >"$2/tests/any" <<'END'
#!/bin/sh
built=$(dirname "$0")/../engine.txt
case "$*" in *list_tests*) printf 'Suite.\\n'; case "$*" in *Nothing*) ;; *) printf '  Test\\n' ;; esac; exit ;; esac
case "$0 $*" in *core_tests*Factor*|*core_tests*'=* '*) grep -q 'factor = 2' "$built" || exit 1 ;; esac
case "$0 $*" in *bench_tests*'=* '*) grep -q 'limit = 3' "$built" || exit 1 ;; esac
END
for program in PROGRAMS; do cp "$2/tests/any" "$2/tests/$program"; done
chmod +x "$2/pfaff" "$2/tests/"*
""".replace("PROGRAMS", " ".join(PROGRAMS))
ENGINE = "sign = +\nfactor = 2\nlimit = 3\nunseen = 4\n"


def entry(name, old, new, verify="verlet", tests=("core_tests", "Factor.*")):
    return (f'[[mutation]]\nname = "{name}"\nfile = "engine.txt"\nold = "{old}"\nnew = "{new}"\nbreaks = "It."\n'
            f'verify = ["{verify}"]\ntests = [["{tests[0]}", "{tests[1]}"]]\n')


class Mutations(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.root = self.folder / "project"
        (self.root / "tests").mkdir(parents=True)
        (self.root / "engine.txt").write_text(ENGINE)
        (self.folder / "bin").mkdir()
        (self.folder / "bin/cmake").write_text(CMAKE)
        (self.folder / "bin/cmake").chmod(0o755)

    def commit(self):
        for command in (["init", "-q"], ["add", "."],
                        ["-c", "user.name=A", "-c", "user.email=a@b", "commit", "-q", "-m", "An engine"]):
            subprocess.run(["git", "-C", self.root, *command], check=True)

    def run_script(self, mutations, *options):
        (self.folder / "mutations.toml").write_text(mutations)
        path = f"{self.folder / 'bin'}:{os.environ['PATH']}"
        done = subprocess.run([sys.executable, RUN, "--root", self.root, "--mutations",
                               self.folder / "mutations.toml", *options],
                              capture_output=True, text=True, check=False, env={**os.environ, "PATH": path})
        return done.returncode, done.stdout, done.stderr

    def plant(self, mutations, *options):
        return self.run_script(mutations, "--build", self.folder / "build", "--results", self.folder / "results.md",
                               *options)

    def rows(self):
        lines = (self.folder / "results.md").read_text().splitlines()
        return {cells[0]: cells[1:3] for line in lines if line.startswith("| ")
                for cells in [[cell.strip() for cell in line.strip("|").split("|")]]}

    # The list.
    def test_every_mutation_of_the_project_can_be_planted(self):
        done = subprocess.run([sys.executable, RUN, "--check"], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_the_checks_that_mutations_name_are_there(self):
        forms = {"TEST": "{}.{}", "TYPED_TEST": "{}/0.{}", "TEST_P": "All/{}.{}/0"}
        tests = {(f"{file.parent.name}_tests", forms[form].format(suite, test))
                 for file in (PROJECT / "tests").glob("*/*.cpp")
                 for form, suite, test in re.findall(r"^\s*(TEST|TYPED_TEST|TEST_P)\((\w+),\s*(\w+)\)",
                                                     file.read_text(), re.M)}
        plugins = {"systems", "brackets", "formulations", "integrators", "controls"}
        for room in ("systems", "brackets", "formulations", "integrators"):
            for file in (PROJECT / room).rglob("*.cpp"):
                plugins.update(re.findall(r'\.name = "([^"]+)"|MethodAlias \w+\{\w+, "([^"]+)"', file.read_text()))
        plugins = {name for found in plugins for name in ([found] if isinstance(found, str) else found)}
        mutations = tomllib.loads((PROJECT / "tests/mutation/mutations.toml").read_text())["mutation"]
        for mutation in mutations:
            self.assertLessEqual(set(mutation["verify"]), plugins, mutation["name"])
            for program, filters in mutation["tests"]:
                for part in filters.split(":"):
                    self.assertTrue(any(program == where and fnmatchcase(test, part) for where, test in tests),
                                    f"{mutation['name']}: {program} has no test {part}")

    def test_what_fits_passes(self):
        self.assertEqual(self.run_script(entry("a", "sign = +", "sign = -"), "--check"), (0, "", ""))

    def test_an_old_text_that_occurs_twice_is_refused(self):
        (self.root / "engine.txt").write_text("sign = +\nsign = +\n")
        status, _, said = self.run_script(entry("a", "sign = +", "sign = -"), "--check")
        self.assertEqual(status, 1)
        self.assertIn("mutations.toml: a: 'old' occurs 2 times in engine.txt; expected once", said)

    def test_an_old_text_that_is_not_there_is_refused(self):
        status, _, said = self.run_script(entry("a", "sign = *", "sign = -"), "--check")
        self.assertEqual(status, 1)
        self.assertIn("a: 'old' occurs 0 times in engine.txt; expected once", said)

    def test_a_mutation_that_changes_nothing_is_refused(self):
        status, _, said = self.run_script(entry("a", "sign = +", "sign = +"), "--check")
        self.assertEqual(status, 1)
        self.assertIn("a: 'new' is the same as 'old'", said)

    def test_names_keys_and_programs_are_checked(self):
        good = entry("a", "sign = +", "sign = -")
        for mutations, said in ((good + good, "a: the name is taken"), (good.replace("old =", "olt ="), "expected old"),
                                (good.replace("core_tests", "cor_tests"), "cor_tests"),
                                (good.replace('"a"', '"A b"'), "kebab-case"), ("", "no mutations"),
                                (good.replace("engine.txt", "motor.txt"), "no file motor.txt")):
            status, _, error = self.run_script(mutations, "--check")
            self.assertEqual(status, 1, mutations)
            self.assertIn(said, error)
        self.assertEqual(self.run_script(good.replace("[[", "[["[:1]), "--check")[0], 2)
        status, _, error = self.run_script(entry("sign", "sign = +", "sign = -"), "--list", "sing")
        self.assertEqual((status, error), (2, "mutation: unknown mutation 'sing'; did you mean 'sign'?\n"))

    # The judgement.
    def test_each_way_of_being_noticed_and_a_survivor(self):
        self.commit()
        mutations = (entry("by-verify", "sign = +", "sign = -") + entry("by-tests", "factor = 2", "factor = 1") +
                     entry("by-the-compiler", "sign = +", "syntax") +
                     entry("by-another", "limit = 3", "limit = 4") +
                     entry("survivor", "unseen = 4", "unseen = 5"))
        status, said, error = self.plant(mutations)
        self.assertEqual((status, error), (1, ""))
        rows = self.rows()
        self.assertEqual(rows["by-verify"], ["yes", "no"])
        self.assertEqual(rows["by-tests"], ["no", "core_tests"])
        self.assertEqual(rows["by-the-compiler"], ["compiler", "compiler"])
        self.assertEqual(rows["by-another"], ["no", "all of bench_tests"])
        self.assertEqual(rows["survivor"], ["no", "no"])
        self.assertIn("4 of 5 killed: 1 by verify, 2 by tests, 1 by the compiler", said)
        self.assertIn("survivors: survivor\n", said)
        self.assertEqual((self.folder / "build/tree/engine.txt").read_text(), ENGINE)
        self.assertEqual((self.root / "engine.txt").read_text(), ENGINE)

    def test_what_is_done_is_not_done_again_unless_named(self):
        self.commit()
        first, second = entry("first", "sign = +", "sign = -"), entry("second", "factor = 2", "factor = 1")
        self.assertEqual(self.plant(first)[0], 0)
        with (self.folder / "results.md").open("a") as table:
            table.write("| second | ye")  # a row that an interruption has cut off
        (self.folder / "build/tree/engine.txt").write_text("left by an interruption\n")
        status, said, _ = self.plant(first + second)
        self.assertEqual(status, 0)
        self.assertNotIn("first:", said)
        self.assertEqual(self.rows()["second"], ["no", "core_tests"])
        self.assertIn("1/1 first:", self.plant(first + second, "first")[1])

    def test_results_of_another_commit_are_refused(self):
        self.commit()
        mutation = entry("a", "sign = +", "sign = -")
        self.plant(mutation)
        (self.root / "more.txt").write_text("more\n")
        self.commit()
        status, _, error = self.plant(mutation)
        self.assertEqual(status, 2)
        self.assertIn("results of something else", error)

    def test_checks_that_fail_without_a_fault_stop_the_run(self):
        (self.root / "engine.txt").write_text(ENGINE.replace("factor = 2", "factor = 1"))
        self.commit()
        status, _, error = self.plant(entry("a", "sign = +", "sign = -"))
        self.assertEqual(status, 2)
        self.assertIn("without a fault core_tests Factor.* does not pass (failed)", error)

    def test_a_whole_program_that_fails_without_a_fault_kills_nothing(self):
        (self.root / "engine.txt").write_text(ENGINE.replace("limit = 3", "limit = 4"))
        self.commit()
        status, _, error = self.plant(entry("a", "sign = +", "sign = -") + entry("b", "unseen = 4", "unseen = 5"))
        self.assertEqual(status, 2)
        self.assertIn("without a fault bench_tests * does not pass (failed)", error)
        self.assertEqual(list(self.rows()), ["mutation", "a"])

    def test_a_filter_without_tests_stops_the_run(self):
        self.commit()
        status, _, error = self.plant(entry("a", "sign = +", "sign = -", tests=("core_tests", "Nothing.*")))
        self.assertEqual(status, 2)
        self.assertIn("core_tests has no test Nothing.*; expected a filter that finds one", error)

    def test_a_check_that_does_not_end_is_ended(self):
        self.commit()
        status, _, error = self.plant(entry("a", "sign = +", "sign = -", verify="wait"), "--limit", "0.2")
        self.assertEqual(status, 2)
        self.assertIn("without a fault verify wait does not pass (late)", error)


if __name__ == "__main__":
    unittest.main()
