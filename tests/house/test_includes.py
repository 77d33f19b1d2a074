"""The check of includes: what breaks a rule of the house is found and named, what keeps them passes."""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]


class Includes(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = Path(self.folder.name)
        self.write("core/numbers/real.hpp", "#pragma once\n#include <vector>\nusing Numbers = std::vector<double>;\n")
        self.write("core/linear/lu.hpp", "#pragma once\n#include <pfaff/core/numbers/real.hpp>\ninline Numbers lu() { return {}; }\n")
        self.write("brackets/canonical.hpp", "#pragma once\n#include <pfaff/core/linear/lu.hpp>\n")

    def tearDown(self):
        self.folder.cleanup()

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def listed(self, name):
        self.write("listed", name + "\n")
        return self.root / "listed"

    def run_on(self, *options):
        return subprocess.run([sys.executable, PROJECT / ".ci/includes.py", "--root", self.root, *options],
                              capture_output=True, text=True, check=False)

    def check(self, *options):
        done = self.run_on(*options)
        return done.returncode, done.stderr

    def test_what_keeps_the_rules_passes(self):
        self.assertEqual(self.check(), (0, ""))

    def test_only_what_a_change_may_have_broken_is_compiled(self):
        self.write("core/linear/lu.hpp", "#pragma once\n#include <pfaff/core/numbers/real.hpp>\nMatrix lu();\n")
        self.write("core/numbers/quad.hpp", "#pragma once\n")
        self.assertEqual(self.check("--changed", self.listed("core/numbers/quad.hpp")), (0, ""))
        status, said = self.check("--changed", self.listed("core/numbers/real.hpp"))  # which the broken one includes
        self.assertEqual(status, 1)
        self.assertIn("core/linear/lu.hpp does not compile by itself", said)

    def test_what_includes_a_header_that_is_gone_is_compiled(self):
        self.write("brackets/canonical.hpp", "#pragma once\n#include <pfaff/core/linear/gone.hpp>\n")
        status, said = self.check("--changed", self.listed("core/linear/gone.hpp"))
        self.assertEqual(status, 1)
        self.assertIn("brackets/canonical.hpp does not compile by itself", said)

    def test_readers_of_a_header_are_those_that_include_it_or_else_those_of_its_includers(self):
        self.write("core/linear/lu.cpp", "#include <pfaff/core/linear/lu.hpp>\n")
        self.write("brackets/canonical.cpp", "#include <pfaff/brackets/canonical.hpp>\n")
        for name, expected in (("core/linear/lu.hpp", ["core/linear/lu.cpp"]), ("core/numbers/real.hpp", ["core/linear/lu.cpp"]),
                                 ("brackets/canonical.hpp", ["brackets/canonical.cpp"]), ("brackets/canonical.cpp", ["brackets/canonical.cpp"]),
                                 ("README.md", [])):
            with self.subTest(name):
                done = self.run_on("--readers", self.listed(name))
                self.assertEqual((done.returncode, done.stdout.split()), (0, expected))

    def test_an_arrow_that_runs_back_is_named(self):
        self.write("core/registry/registry.cpp", "#include <vector>\n#include <pfaff/brackets/canonical.hpp>\n")
        status, said = self.check("--no-compile")
        self.assertEqual(status, 1)
        self.assertIn("core/registry/registry.cpp:2: core includes brackets/canonical.hpp", said)

    def test_a_formulation_that_includes_a_bracket_is_named(self):
        self.write("formulations/dirac.cpp", '#include <pfaff/brackets/canonical.hpp>\n')
        self.assertEqual(self.check("--no-compile")[0], 1)

    def test_what_includes_the_library_of_studies_without_being_of_it_is_named(self):
        self.write("verify/check.hpp", "#pragma once\n")
        self.write("derive/tuning/tuned.hpp", "#pragma once\n#include <pfaff/verify/check.hpp>\n")
        self.assertEqual(self.check("--no-compile"), (0, ""))
        for name, fault in (("bench/runner/record.hpp", "bench includes verify/check.hpp; expected brackets"),
                            ("app/verify.cpp", "includes verify/check.hpp of the library of studies")):
            with self.subTest(name):
                self.write(name, "#include <pfaff/verify/check.hpp>\n")
                status, said = self.check("--no-compile")
                self.assertEqual(status, 1)
                self.assertIn(f"{name}:1: {fault}", said)

    def test_a_cycle_of_folders_is_named_with_its_includes(self):
        self.write("core/numbers/quad.hpp", '#pragma once\n#include "../linear/lu.hpp"\n')
        status, said = self.check("--no-compile")
        self.assertEqual(status, 1)
        self.assertIn("cycle of folders core/linear -> core/numbers -> core/linear", said)
        self.assertIn("core/numbers/quad.hpp:2 includes core/linear/lu.hpp", said)

    def test_a_header_that_needs_another_before_it_is_named(self):
        self.write("core/linear/norm.hpp", "#pragma once\ninline double norm(const Numbers& x) { return x[0]; }\n")
        status, said = self.check()
        self.assertEqual(status, 1)
        self.assertIn("core/linear/norm.hpp does not compile by itself", said)

    def test_a_header_after_a_precompiled_one_needs_its_own_includes_too(self):
        self.write("core/linear/named.hpp", "#pragma once\n#include <pfaff/core/numbers/real.hpp>\n"
                   "inline Numbers of(const std::map<int, Numbers>& x) { return x.at(0); }\n")
        status, said = self.check()
        self.assertEqual(status, 1)
        self.assertIn("core/linear/named.hpp does not compile by itself", said)

    def test_the_project_keeps_its_arrows(self):
        done = subprocess.run([sys.executable, PROJECT / ".ci/includes.py", "--no-compile"],
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.stderr, "")


if __name__ == "__main__":
    unittest.main()
