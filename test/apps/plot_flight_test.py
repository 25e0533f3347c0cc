#!/usr/bin/python3
"""The program plot_flight as a user meets it, on files of fly.

Environment: FLY and PLOT_FLIGHT, paths of the programs. Bags are drawn in test/ros/display/display_test.py.
"""

import os
import re
import shutil
import subprocess
import tempfile
import unittest

FIGURES = {name + end for end in (".png", ".gnuplot") for name in (
    "position", "position_error", "attitude_error", "adaptation", "rotors")}


def read(*path):
    with open(os.path.join(*path), "rb") as file:
        return file.read()


class PlotFlight(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="plot flight test ")
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.flown = os.path.join(cls.folder, "flown")
        subprocess.run([os.environ["FLY"], "hover_payload", "--controller", "asmc,smc", "--out",
                        cls.flown], check=True, stdout=subprocess.DEVNULL, timeout=120)
        cls.asmc, cls.smc = (os.path.join(cls.flown, law + ".csv") for law in ("asmc", "smc"))

    def run_on(self, *files):
        """What the program said, and the folder it wrote into."""
        out = tempfile.mkdtemp(dir=self.folder)
        return subprocess.run([os.environ["PLOT_FLIGHT"], *files, "--out", out], timeout=120,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False,
                              universal_newlines=True), out

    def plot(self, *files):
        """Returns the folder of the figures."""
        result, out = self.run_on(*files)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertEqual(sorted(result.stdout.split("\n")[:-1]), sorted(
            os.path.join(out, name) for name in os.listdir(out) if name.endswith(".png")))
        return out

    def refused(self, *files):
        """One line on stderr, exit code 1, no picture; returns the line."""
        result, out = self.run_on(*files)
        self.assertEqual((result.returncode, result.stdout, os.listdir(out)), (1, "", []))
        self.assertRegex(result.stderr, r"\Aplot_flight: [^\n]+\n\Z")
        return result.stderr

    def refused_text(self, text):
        path = os.path.join(self.folder, "broken.csv")
        with open(path, "wb") as file:
            file.write(text)
        line = self.refused(self.asmc, path)
        self.assertIn("'" + path + "', line ", line)
        return line

    def test_the_figures_are_those_of_fly(self):
        out = self.plot(self.asmc, self.smc)
        self.assertEqual(set(os.listdir(out)), FIGURES)
        for figure in FIGURES:
            self.assertEqual(read(out, figure), read(self.flown, figure), figure)

    def test_curves_of_one_law_are_named_by_file_and_coloured_apart(self):
        renamed = os.path.join(self.folder, "heavier.csv")
        shutil.copy(self.asmc, renamed)
        twin = os.path.join(self.folder, "elsewhere", "asmc.csv")
        os.makedirs(os.path.dirname(twin))
        shutil.copy(self.smc, twin)
        for files, names in (((self.asmc, renamed), ("asmc", "heavier")),
                             ((self.asmc, twin), ("asmc (flown)", "asmc (elsewhere)"))):
            script = read(self.plot(*files), "position.gnuplot").decode()
            styles = dict(re.findall(r"NaN with lines (lc rgb '#\w+') .*title '(.*?)'", script))
            self.assertLessEqual(set(names), set(styles.values()))
            self.assertEqual(len(styles), 3)  # with the set point

    def test_a_csv_file_that_is_alone_is_drawn(self):
        alone = os.path.join(self.folder, "alone.csv")
        shutil.copy(self.asmc, alone)
        out = self.plot(alone)
        self.assertEqual(set(os.listdir(out)), FIGURES)
        self.assertNotIn(b"limit", read(out, "rotors.gnuplot"))
        self.assertNotIn(b"true mass", read(out, "adaptation.gnuplot"))

    def test_broken_files_are_refused_in_one_line(self):
        whole = read(self.asmc)
        self.assertIn("is empty", self.refused_text(b""))
        self.assertIn("'z [m]' is missing", self.refused_text(whole.replace(b",z [m],", b",", 1)))
        self.assertIn("line 4: 'x [m]' is 'abc'; it must be a number",
                      self.refused_text(re.sub(rb"\n0\.008,[^,]*,", rb"\n0.008,abc,", whole)))
        self.assertRegex(self.refused_text(whole[:len(whole) // 2]),
                         r"has \d+ fields; it must have \d+")
        self.assertIn("'t [s]' is '0.001'; it must be later than in the line before, '0.004'",
                      self.refused_text(whole.replace(b"\n0.008,", b"\n0.001,", 1)))

    def test_other_mistakes(self):
        self.assertIn("called the same", self.refused(self.asmc, self.asmc))
        self.assertIn("cannot read", self.refused(os.path.join(self.flown, "position.png")))
        for files in ([], [os.path.join(self.folder, "missing.csv")]):
            result, _ = self.run_on(*files)
            self.assertNotEqual(result.returncode, 0)
            self.assertNotEqual(result.stderr, "")


if __name__ == "__main__":
    unittest.main()
