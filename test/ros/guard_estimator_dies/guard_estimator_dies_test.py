#!/usr/bin/python3
"""kill -9 of the estimator in motion: down on the IMU, without a crash (BUG 6)."""
import os
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import GuardedTest, run  # noqa: E402


class EstimatorDies(GuardedTest):
    def test_estimator_dies(self):
        with open(os.path.join(os.path.dirname(__file__), 'estimator.py')) as program:
            estimator = subprocess.Popen([sys.executable, '-'], stdin=program)
        self.uav.spoil = lambda message: None  # the other process passes it on
        self.uav.take_off()
        self.uav.go(8.0, 0.0, 2.0)
        self.uav.wait('speed', lambda: self.uav.state.velocity.x > 1.5)
        estimator.kill()
        estimator.wait()
        died = self.uav.now
        self.uav.wait_mode('emergency descent')
        self.assertLess(self.uav.now - died, 1.0)
        self.expect_landed()

if __name__ == '__main__':
    run(EstimatorDies)
