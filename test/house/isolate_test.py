#!/usr/bin/python3
"""scripts/isolate: what listens inside is out of reach from outside, and the other way round. The
folder of the scripts is in the environment variable SCRIPTS."""
import os
import socket
import subprocess
import sys
import unittest

ISOLATE = os.path.join(os.environ['SCRIPTS'], 'isolate')
# Listens everywhere, as roscpp's XML-RPC does; hears itself; then stays until its input ends.
LISTENER = '''
import os, socket, sys
server = socket.socket()
server.bind(("0.0.0.0", 0))
server.listen(5)
socket.create_connection(server.getsockname(), 5).close()
print(server.getsockname()[1], os.environ.get("ROS_IP"), flush=True)
sys.stdin.read()
'''
CALLER = 'import socket, sys; socket.create_connection(("127.0.0.1", int(sys.argv[1])), 5)'


def reachable(port):
    try:
        socket.create_connection(('127.0.0.1', port), 5).close()
        return True
    except ConnectionRefusedError:
        return False


class Isolate(unittest.TestCase):
    def setUp(self):
        run = subprocess.run([ISOLATE, 'true'], stderr=subprocess.PIPE, universal_newlines=True)
        if 'no network namespace' in run.stderr or 'is missing' in run.stderr:
            self.skipTest(run.stderr.strip())
        self.assertEqual(run.returncode, 0, run.stderr)

    def listener(self, *prefix):
        """Port of a listener started so, and its ROS_IP."""
        process = subprocess.Popen([*prefix, sys.executable, '-c', LISTENER],
                                   stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.addCleanup(process.communicate)
        port, address = process.stdout.readline().split()
        return int(port), address.decode()

    def test_a_listener_inside_is_not_reachable_from_outside(self):
        port, address = self.listener(ISOLATE)
        self.assertFalse(reachable(port))
        self.assertEqual(address, '127.0.0.1')
        self.assertTrue(reachable(self.listener()[0]), 'the same without isolation')

    def test_a_listener_outside_is_not_reachable_from_inside(self):
        port, _ = self.listener()
        call = [sys.executable, '-c', CALLER, str(port)]
        self.assertEqual(subprocess.run(call).returncode, 0)
        run = subprocess.run([ISOLATE, *call], stderr=subprocess.PIPE)
        self.assertIn(b'ConnectionRefusedError', run.stderr)

    def test_the_exit_code_is_that_of_the_command(self):
        self.assertEqual(subprocess.run([ISOLATE, 'sh', '-c', 'exit 7']).returncode, 7)

    def test_it_needs_a_command(self):
        for words in ([], ['--magic']):
            run = subprocess.run([ISOLATE, *words], stderr=subprocess.PIPE)
            self.assertEqual(run.returncode, 2)
            self.assertIn(b'usage', run.stderr)


if __name__ == '__main__':
    unittest.main()
