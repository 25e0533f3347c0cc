#!/usr/bin/python3
"""scripts/demo and scripts/test refuse what they do not understand, in one line, before they do
anything. The folder of the scripts is in the environment variable SCRIPTS."""
import os
import socket
import subprocess
import unittest

SCRIPTS = os.environ['SCRIPTS']


class Scripts(unittest.TestCase):
    def refused(self, *command):
        run = subprocess.run([os.path.join(SCRIPTS, command[0]), *command[1:]], timeout=60,
                             stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True)
        self.assertNotEqual(run.returncode, 0)
        self.assertEqual(run.stdout, '')
        return run.stderr.splitlines()

    def test_unknown_names_are_answered_with_those_that_exist(self):
        for option, known in (('--controller', 'asmc'), ('--scenario', 'aggressive_manoeuvre')):
            lines = self.refused('demo', option, 'magic')
            self.assertEqual(len(lines), 1, lines)
            self.assertIn("'magic'", lines[0])
            self.assertIn(known, lines[0])

    def test_a_port_in_use_is_named(self):
        with socket.socket() as server:
            server.bind(('127.0.0.1', 0))
            server.listen()
            port = str(server.getsockname()[1])
            lines = self.refused('demo', '--port', port)
        self.assertEqual(len(lines), 1, lines)
        self.assertIn(port, lines[0])
        self.assertIn('in use', lines[0])

    def test_senseless_numbers_are_named(self):
        for option, value in (('--port', 'seven'), ('--real-time-factor', 'fast'),
                              ('--real-time-factor', '-1')):
            lines = self.refused('demo', option, value)
            self.assertEqual(len(lines), 1, lines)
            self.assertIn("'%s'" % value, lines[0])

    def test_unknown_options_are_answered_with_the_usage(self):
        lines = self.refused('demo', '--magic')
        self.assertIn("'--magic'", lines[0])
        self.assertIn('usage', lines[1])
        self.assertIn("'--magic'", self.refused('test', '--magic')[0])

    def test_an_option_without_its_value_is_named(self):
        self.assertIn('--controller', self.refused('demo', '--controller')[0])


if __name__ == '__main__':
    unittest.main()
