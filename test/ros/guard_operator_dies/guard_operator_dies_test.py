#!/usr/bin/python3
"""Whoever sent a trajectory may die: it is flown to its end and held (BUG 10)."""
import os
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import GuardedTest, run  # noqa: E402


class OperatorDies(GuardedTest):
    def test_operator_dies(self):
        self.uav.take_off()
        with open(os.path.join(os.path.dirname(__file__), 'sender.py')) as program:
            sender = subprocess.Popen([sys.executable, '-'], stdin=program)
        self.uav.wait('motion', lambda: self.uav.state.velocity.x > 0.3)
        sender.kill()
        sender.wait()
        self.uav.sleep(8.0)
        self.assertAlmostEqual(self.uav.truth.x, 3.0, delta=0.1)
        self.assertFalse(self.uav.status.crashed)

if __name__ == '__main__':
    run(OperatorDies)
