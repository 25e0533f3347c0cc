#!/usr/bin/python3
"""scripts/demo, scripts/fuzz and scripts/test refuse what they do not understand, in one line, before they do
anything; what they install and build. The folder of the scripts is in the environment variable
SCRIPTS."""
import os
import shutil
import socket
import subprocess
import tempfile
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

    def test_fuzzing_for_what_is_no_number_of_minutes_is_refused(self):
        for minutes in ('--magic', '0', '1.5', '-1', '1 2'):
            lines = self.refused('fuzz', *minutes.split())
            self.assertEqual(len(lines), 1, lines)
            self.assertIn("'%s'" % minutes, lines[0])

    def test_an_option_without_its_value_is_named(self):
        self.assertIn('--controller', self.refused('demo', '--controller')[0])

    def sandboxed(self, functions, command):
        """Runs a command of a copy of the scripts, with programs replaced by shell functions."""
        folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, folder)
        shutil.copytree(SCRIPTS, os.path.join(folder, 'scripts'))
        shutil.copytree(os.path.join(SCRIPTS, os.pardir, 'config'), os.path.join(folder, 'config'))
        self.temporary = os.path.join(folder, 'temporary')
        os.mkdir(self.temporary)
        script = 'set -a; %s; cd %s; %s' % (functions, folder, command)
        run = subprocess.run(['bash', '-c', script], timeout=60, stdout=subprocess.PIPE,
                             stderr=subprocess.PIPE, universal_newlines=True,
                             env=dict(os.environ, TMPDIR=self.temporary))
        return folder, run

    def test_the_demo_builds_what_rostopic_and_rosservice_need(self):
        folder, run = self.sandboxed(
            'dpkg-query() { echo installed; }; cmake() { echo "$@" >>called; [ "$1" = -S ]; }',
            'scripts/demo')
        self.assertIn('the build failed', run.stderr)
        with open(os.path.join(folder, 'called')) as file:
            configured, built = file.read().splitlines()
        self.assertIn('-DCMAKE_BUILD_TYPE=Release', configured)
        for target in ('adaptive_quadrotor_nodelets', 'plant_node', 'mission_node',
                       'adaptive_quadrotor_control_generate_messages_py'):
            self.assertIn(target, built.split())

    def test_an_installation_that_fails_is_told_and_logged_in_the_build_folder(self):
        folder, run = self.sandboxed(
            'dpkg-query() { return 1; }; id() { echo 0; }; '
            'apt-get() { :; }; env() { echo "no such package"; return 1; }',
            'source scripts/environment.sh; install_packages magic')
        self.assertNotEqual(run.returncode, 0)
        for words in ('no such package', 'cannot install: magic'):
            self.assertIn(words, run.stderr)
        with open(os.path.join(folder, 'build', 'install.log')) as file:
            self.assertEqual(file.read(), 'no such package\n')
        self.assertEqual(os.listdir(self.temporary), [])


if __name__ == '__main__':
    unittest.main()
