"""The check of what the pages show: what is not printed is seen, and what rounding and clocks change is not held against a page."""
import unittest

from shown_output import agree, steps_of

TABLE = ["method  drift    ns/step", "GF 2    6.3e-06  146"]


class ShownOutput(unittest.TestCase):
    def test_commands_with_their_here_documents_and_what_stands_below(self):
        page = "```console\n$ cat > a <<'END'\nx\n```\nEND\n$ pfaff a\none\ntwo\n```\ntext\n```\n$ not run\n```\n"
        self.assertEqual(steps_of(page), [("cat > a <<'END'\nx\n```\nEND", []), ("pfaff a", ["one", "two"])])

    def test_numbers_agree_to_two_digits(self):
        self.assertTrue(agree(["drift max 2.6e-11"], ["drift   max 2.63e-11"]))
        self.assertTrue(agree(["error 0.00011, t = 1"], ["error 0.000108, t = 1"]))
        self.assertFalse(agree(["drift max 2.6e-11"], ["drift max 5.5e-13"]))
        self.assertFalse(agree(["rms .000371 0.000371"], ["rms .000371 0.000705"]))
        self.assertFalse(agree(["drift 2.6e-5"], ["drift 2.7e-5"]))
        self.assertFalse(agree(["slope 2.6e-5"], ["slope -2.6e-5"]))

    def test_whole_numbers_and_words_are_the_same(self):
        self.assertFalse(agree(["after 1000 steps"], ["after 1001 steps"]))
        self.assertFalse(agree(["drift 6.4e-05, bounded"], ["drift 6.4e-05, linear"]))
        self.assertFalse(agree(["gauss2"], ["gauss3"]))

    def test_what_rounding_leaves_agrees_to_its_size(self):
        self.assertTrue(agree(["slope -2.5e-19"], ["slope 3.1e-18"]))
        self.assertFalse(agree(["drift 1.9e-34"], ["drift 3.1e-16"]))
        self.assertFalse(agree(["drift 3.1e-16"], ["drift 3.1e-9"]))

    def test_timings_are_not_compared_and_what_stands_before_them_is(self):
        self.assertTrue(agree(TABLE, [TABLE[0], "GF 2  6.3e-06  812"]))
        self.assertFalse(agree(TABLE, [TABLE[0], "GF 2  7.3e-06  146"]))
        self.assertFalse(agree([*TABLE, "", "steps 3"], [*TABLE, "", "steps 4"]))

    def test_lines_may_be_left_out_only_where_the_page_says_so(self):
        lines = ["energy bounded", "", "written to"]
        self.assertTrue(agree(["energy bounded", "", "written to"], lines))
        self.assertTrue(agree(["...", "written to"], lines))
        self.assertTrue(agree(["...", "", "...", "written to", "..."], lines))
        self.assertFalse(agree(["energy bounded", "written to"], lines))
        self.assertFalse(agree(["energy bounded", ""], lines))
        self.assertFalse(agree(["written to", "..."], lines))


if __name__ == "__main__":
    unittest.main()
