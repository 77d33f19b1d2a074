"""The check of names where sources are compiled together: what would mean something else is found, nothing else is."""
import importlib.util
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
SPEC = importlib.util.spec_from_file_location("joined", PROJECT / ".ci/joined.py")
joined = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(joined)

DECLARES = """namespace {
struct Gauss : pfaff::Gauss {};
constexpr int most = 3;
int twice(int x) {
  return 2 * x;
}
struct Later {};
}
"""


class Joined(unittest.TestCase):
    def clashes(self, other, one=DECLARES):
        return joined.clashes({"one.cpp": one, "other.cpp": other})

    def test_a_type_is_found_wherever_its_namespace_declares_it(self):
        for name in ("Gauss", "Later"):
            self.assertEqual(self.clashes(f"{name} made;\n"),
                             [f"other.cpp: uses the name '{name}', declared in unnamed namespaces of one.cpp"])

    def test_a_type_is_found_as_the_argument_of_a_template(self):
        self.assertEqual(len(self.clashes("namespace {\nstruct Chart : In<Gauss> {};\n}\n")), 1)

    def test_a_function_and_a_variable_are_found(self):
        self.assertEqual(len(self.clashes("int f() { return twice(1); }\n")), 1)
        self.assertEqual(len(self.clashes("int f() { return g(most); }\n")), 1)

    def test_a_source_that_declares_the_name_itself_means_its_own(self):
        self.assertEqual(self.clashes("int twice(int x);\nint f() { return twice(1); }\n"), [])
        self.assertEqual(self.clashes("int f(int most) { return g(most); }\n"), [])
        self.assertEqual(self.clashes("struct Gauss {};\nGauss made;\n"), [])

    def test_members_comments_and_texts_do_not_count(self):
        self.assertEqual(self.clashes('int f(A a) { return a.twice(1) + A::twice(2); }  // twice(1)\nauto x = "Gauss";\n'), [])

    def test_what_plug_ins_register_has_a_name_of_its_own_in_each_source(self):
        self.assertEqual(self.clashes("auto& x = registered;\n", "namespace {\nconst Method<M> registered{};\n}\n"), [])

    def test_the_project_has_no_clashes(self):
        self.assertEqual(joined.main(), 0)


if __name__ == "__main__":
    unittest.main()
