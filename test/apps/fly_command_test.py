#!/usr/bin/python3
"""The program fly as a user meets it: what it writes, and what it says about mistakes.

Environment: FLY, path of the program; AQC_TEST_CONFIG, path of the folder config/.
"""

import csv
import json
import os
import pty
import re
import shutil
import struct
import subprocess
import tempfile
import unittest

FLY = os.environ["FLY"]
CONFIG = os.environ["AQC_TEST_CONFIG"]

SCENARIO = """
name: short
title: "It's short: 0.4 kg at 2 s"
vehicle: pelican_thesis
controllers: [asmc, geometric]
duration: 4.0
control_rate: 100.0
plant_rate: 1000.0
set_point_rate: 100.0
start: {position: [0.0, 0.0, 0.1], yaw_deg: 0.0}
payloads:
  box: {mass: 0.4, size: [0.1, 0.1, 0.1], offset: [0.0, 0.0, -0.15]}
mission:
  - step: {at: 0.5, position: [0.5, 0.0, 1.0]}
  - attach: {at: 2.0, payload: box}
metrics: {from: 1.0}
published:
  asmc: {position: [0.1, 0.2, 0.3], attitude_deg: [1.0, 2.0, 3.0]}
"""


def read(*path):
    with open(os.path.join(*path), encoding="utf-8") as file:
        return file.read()


class FlyTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="fly test ")  # a blank must not hurt
        self.addCleanup(shutil.rmtree, self.folder)
        self.scenario = self.write("short.yaml", SCENARIO)

    def write(self, name, text):
        path = os.path.join(self.folder, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def fly(self, *arguments, **options):
        return subprocess.run([options.pop("program", FLY), *arguments], cwd=self.folder,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, universal_newlines=True, timeout=120,
                              check=False, **options)

    def refused(self, *arguments, **options):
        """One line on stderr, exit code 1; returns the line."""
        result = self.fly(*arguments, **options)
        self.assertEqual(result.returncode, 1, result)
        self.assertRegex(result.stderr, r"\Afly: [^\n]+\n\Z")
        return result.stderr

    def refused_scenario(self, old, new):
        self.assertIn(old, SCENARIO)
        path = self.write("changed.yaml", SCENARIO.replace(old, new))
        return self.refused(path, "--no-plots")

    def refused_vehicle(self, pattern, new):
        original = read(CONFIG, "vehicle", "pelican_thesis.yaml")
        text, count = re.subn(pattern, new, original, flags=re.MULTILINE)
        self.assertGreater(count, 0, pattern)
        return self.refused(self.scenario, "--vehicle", self.write("changed.yaml", text))


class Flights(FlyTest):
    def test_default_folder_holds_csv_figures_and_scripts(self):
        result = self.fly(self.scenario)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        out = os.path.join(self.folder, "flight", "short")
        figures = ["position", "position_error", "attitude_error", "adaptation", "rotors"]
        expected = {"asmc.csv", "geometric.csv", "flight.yaml"}
        expected |= {figure + end for figure in figures for end in (".png", ".gnuplot")}
        self.assertEqual(set(os.listdir(out)), expected)
        for figure in figures:
            with open(os.path.join(out, figure + ".png"), "rb") as file:
                data = file.read()
            self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n", figure)
            self.assertEqual(data[-8:-4], b"IEND", figure)
            width, height = struct.unpack(">II", data[16:24])
            self.assertEqual(width, 1600, figure)
            self.assertTrue(500 <= height <= 2000, (figure, height))
            self.assertGreater(len(data), 10000, figure)

    def test_table_has_a_row_a_controller_and_the_published_one(self):
        text = self.fly(self.scenario, "--no-plots").stdout
        self.assertIn("It's short: 0.4 kg at 2 s", text)
        self.assertIn("from 1 s to the end at 4 s", text)
        self.assertRegex(text, r"(?m)^asmc +[\d.]+ .*\n  published +0\.100 +0\.200 +0\.300 +1\.00 ")
        self.assertRegex(text, r"(?m)^  difference +[-+]\d+ %")
        self.assertRegex(text, r"(?m)^geometric ")
        self.assertEqual(text.count("published"), 1)
        self.assertNotIn("\033", text)
        self.assertLessEqual(max(map(len, text.splitlines())), 130)

    def test_csv_reads_back(self):
        self.fly(self.scenario, "--controller", "asmc", "--out", "out", "--no-plots")
        self.assertEqual(sorted(os.listdir(os.path.join(self.folder, "out"))),
                         ["asmc.csv", "flight.yaml"])
        rows = list(csv.DictReader(read(self.folder, "out", "asmc.csv").splitlines()))
        self.assertEqual(len(rows), 400)
        self.assertEqual([row["t [s]"] for row in rows[:3]], ["0", "0.01", "0.02"])
        self.assertEqual(rows[0]["set_z [m]"], "")
        self.assertEqual(rows[-1]["set_z [m]"], "1")
        self.assertEqual([rows[i]["payload_mass [kg]"] for i in (199, 201, -1)], ["0", "0.4", "0.4"])
        self.assertAlmostEqual(float(rows[-1]["z [m]"]), 1.0, delta=0.5)

    def test_json_follows_the_schema_and_repeats(self):
        flights = []
        for name in ("a.json", "b.json"):
            self.fly(self.scenario, "--no-plots", "--json", name)
            metrics = json.loads(read(self.folder, name))
            self.assertEqual(metrics["scenario"], "short")
            flights.append(metrics["flights"])
        for flight in flights[0] + flights[1]:
            self.assertGreater(flight.pop("real_time_factor"), 0.0)
        self.assertEqual(flights[0], flights[1])
        self.assertEqual([flight["controller"] for flight in flights[0]], ["asmc", "geometric"])
        flight = flights[0][0]
        self.assertEqual(set(flight), {"controller", "rms", "peak_altitude_error", "crash_time",
                                       "settled_altitude_error", "final_lateral_error", "crashed", "grounded_from",
                                       "refusals", "duration"})
        self.assertEqual(set(flight["rms"]), {"x", "y", "z", "roll", "pitch", "yaw"})
        self.assertEqual((flight["crashed"], flight["crash_time"], flight["duration"]),
                         (False, None, 4.0))

    def test_files_serve_as_controllers(self):
        law = self.write("mine.yaml", read(CONFIG, "controller", "asmc.yaml"))
        vehicle = os.path.join(CONFIG, "vehicle", "hummingbird.yaml")
        result = self.fly(self.scenario, "-c", law + ",asmc", "-v", vehicle, "--no-plots")
        self.assertRegex(result.stdout, r"(?m)^mine ")
        self.assertIn("hummingbird", result.stdout)

    def test_installed_program_finds_installed_config(self):
        prefix = os.path.join(self.folder, "prefix")
        program = os.path.join(prefix, "lib", "adaptive_quadrotor_control", "fly")
        config = os.path.join(prefix, "share", "adaptive_quadrotor_control", "config")
        os.makedirs(os.path.dirname(program))
        shutil.copy(FLY, program)
        shutil.copytree(CONFIG, config)
        shutil.copy(self.scenario, os.path.join(config, "scenario", "only_here.yaml"))
        result = self.fly("only_here", "--no-plots", program=program)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("only_here", self.refused("only_there", program=program))

    def test_terminal_gets_colours(self):
        ours, theirs = pty.openpty()
        environment = dict(os.environ, TERM="xterm")
        environment.pop("NO_COLOR", None)
        with subprocess.Popen([FLY, self.scenario, "--no-plots"], cwd=self.folder, stdout=theirs,
                              stderr=subprocess.DEVNULL, env=environment) as process:
            os.close(theirs)
            text = b""
            try:
                while True:
                    text += os.read(ours, 4096)
            except OSError:  # how Linux says that the other end is closed
                os.close(ours)
        self.assertEqual(process.returncode, 0)
        self.assertIn(b"\033[1m", text)


class Mistakes(FlyTest):
    def test_usage(self):
        for arguments in ([], ["--nonsense", self.scenario], [self.scenario, "one too many"]):
            result = self.fly(*arguments)
            self.assertGreater(result.returncode, 1)
            self.assertNotEqual(result.stderr, "")
        self.assertEqual(self.fly("--help").returncode, 0)

    def test_unknown_names_are_answered_with_known_ones(self):
        self.assertIn("unknown scenario 'lost'; there are: aggressive_manoeuvre",
                      self.refused("lost"))
        self.assertIn("unknown controller 'pid'; there are: asmc, composite, geometric",
                      self.refused(self.scenario, "-c", "asmc,pid"))
        self.assertIn("unknown vehicle 'kite'; there are: ",
                      self.refused(self.scenario, "-v", "kite"))
        self.assertIn("'./lost.yaml' does not exist", self.refused("./lost.yaml"))
        self.assertIn("'asmc' is given twice", self.refused(self.scenario, "-c", "asmc,asmc"))

    def test_broken_scenario_files(self):
        for text, complaint in (("", "is empty"), ("# nothing\n", "must hold a map"),
                                ("a: [1,\nb: }", "is not YAML: line "), ("name: x\n", "missing"),
                                (SCENARIO + "colour: red\n", "colour' is unknown")):
            self.assertRegex(self.refused(self.write("broken.yaml", text)), complaint)
        self.assertIn("is a folder", self.refused(self.folder + "/"))

    def test_wrong_scenarios(self):
        self.assertIn("times must not go backwards", self.refused_scenario("{at: 2.0,", "{at: 0.1,"))
        self.assertIn("duration", self.refused_scenario("duration: 4.0", "duration: .nan"))
        self.assertIn("control steps", self.refused_scenario("duration: 4.0", "duration: 1000000"))
        self.assertIn("unknown controller 'pid'", self.refused_scenario("asmc, geo", "pid, geo"))
        self.assertIn("no controllers", self.refused_scenario("[asmc, geometric]", "[]"))

    def test_wrong_vehicles(self):
        rotors = self.refused_vehicle(r"angles_deg: \[.*\]", "angles_deg: [0.0, 120.0, 240.0]")
        self.assertIn("lists 3 rotors", rotors)
        self.assertRegex(self.refused_vehicle(r"^mass: [\d.]+", "mass: -2.0"), "mass' is '-2.0'")

    def test_unwritable_places(self):
        below_a_file = os.path.join(self.scenario, "out")
        self.assertIn("cannot write", self.refused(self.scenario, "--out", below_a_file))
        self.assertIn("cannot write",
                      self.refused(self.scenario, "--no-plots", "--json", below_a_file))
        self.assertIn("No space left",
                      self.refused(self.scenario, "--no-plots", "--json", "/dev/full"))
        with open("/dev/full", "w", encoding="utf-8") as full:
            result = subprocess.run([FLY, self.scenario, "--no-plots"], cwd=self.folder,
                                    stdout=full, stderr=subprocess.PIPE, check=False)
        self.assertEqual(result.returncode, 1)
        self.assertIn(b"standard output", result.stderr)

    def test_missing_gnuplot_costs_only_the_figures(self):
        line = self.refused(self.scenario, "--json", "m.json", env={"PATH": self.folder})
        self.assertIn("gnuplot is not installed", line)
        out = os.listdir(os.path.join(self.folder, "flight", "short"))
        self.assertIn("asmc.csv", out)
        self.assertIn("position.gnuplot", out)
        self.assertFalse([name for name in out if name.endswith(".png")])
        self.assertEqual(len(json.loads(read(self.folder, "m.json"))["flights"]), 2)


if __name__ == "__main__":
    unittest.main()
