#!/usr/bin/python3
"""Of two estimators that disagree one is heard, and the other when the first is silent."""
import os
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import GuardedTest, run  # noqa: E402


class Sources(GuardedTest):
    def test_sources(self):
        self.uav.take_off()
        with open(os.path.join(os.path.dirname(__file__), 'second_source.py')) as program:
            second = subprocess.Popen([sys.executable, '-'], stdin=program)
        try:
            before = self.uav.state.dropped_odometry
            self.uav.wait('refusals', lambda: self.uav.state.dropped_odometry > before + 100)
            self.uav.sleep(1.0)
            self.assertLess(abs(self.uav.truth.x), 0.2, 'the second source is 0.3 m off')
            self.uav.spoil = lambda message: None
            self.uav.wait('the second source to be heard', lambda: self.uav.truth.x > 0.2)
            self.expect_holding()
        finally:
            second.kill()
            second.wait()

if __name__ == '__main__':
    run(Sources)
