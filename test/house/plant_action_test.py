#!/usr/bin/python3
"""A new kind of PlantAction does not compile until every place that asks for the kind has decided.

Adds a kind to a copy of plant_action.h and hands each such source file to the compiler with it.
CXX is the compiler, INCLUDES its include folders, FOLDERS those of src/ that are built.
"""
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

SOURCE_TREE = pathlib.Path(__file__).resolve().parents[2]
HEADER = 'adaptive_quadrotor_control/simulation/plant_action.h'
# Of an action, not of what holds a payload.
VISIT = re.compile(r'std::visit\((?!.*mount)')
KINDS = 'AttachPayload|DetachPayload|SetWind|ApplyDisturbance|SetBody|SetRotor|SetBattery|SetGust|LoseCommands'


def sources():
    """(name, text) of every C++ file that is built."""
    for folder in os.environ['FOLDERS'].split(':'):
        for path in sorted((SOURCE_TREE / 'src' / folder).rglob('*')):
            if path.suffix in ('.h', '.cpp'):
                yield path, path.read_text()


class PlantAction(unittest.TestCase):
    def test_is_asked_for_its_kind_by_visits_alone(self):
        for path, text in sources():
            found = re.search(r'(get_if|holds_alternative)<(aqc::)?(%s)>' % KINDS, text)
            self.assertIsNone(found, '%s asks by %s; let it visit' % (path, found and found[0]))

    def test_with_a_new_kind_does_not_compile(self):
        visiting = [path for path, text in sources()
                    if VISIT.search(text) and re.search(KINDS, text)]
        self.assertGreaterEqual(len(visiting), 2)
        with tempfile.TemporaryDirectory() as folder:
            copy = pathlib.Path(folder) / HEADER
            copy.parent.mkdir(parents=True)
            text = (SOURCE_TREE / 'include' / HEADER).read_text()
            copy.write_text(re.sub(r'(using PlantAction =\s*std::variant<.*?)>;',
                                   r'struct CutPower {};\n\1, CutPower>;', text, flags=re.S))
            self.assertIn(', CutPower>;', copy.read_text())
            for path in visiting:
                with self.subTest(path.name):
                    self.refuses(path, folder)

    def refuses(self, path, folder):
        includes = [folder] + os.environ['INCLUDES'].split(':')
        command = [os.environ['CXX'], '-std=c++17', '-fsyntax-only', str(path)]
        result = subprocess.run(command + ['-I' + name for name in includes if name],
                                stderr=subprocess.PIPE, universal_newlines=True)
        self.assertTrue('CutPower' in result.stderr, 'a new kind passes unnoticed')
        self.assertNotIn('fatal error', result.stderr)
        for number, line in enumerate(path.read_text().splitlines(), 1):
            if VISIT.search(line):
                place = '%s:%d:' % (path, number)
                self.assertTrue(place in result.stderr, place + ' a new kind passes unnoticed')


if __name__ == '__main__':
    unittest.main()
