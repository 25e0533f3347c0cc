#!/usr/bin/python3
"""With neither odometry nor IMU it descends by what its rotors are told (BUG 6)."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import GuardedTest, run  # noqa: E402


class Blind(GuardedTest):
    def test_blind(self):
        self.uav.take_off()
        self.uav.spoil = lambda message: None
        self.uav.wait_mode('emergency descent')
        self.assertEqual(self.uav.state.mode_reason, 'odometry lost')
        self.expect_landed()
        self.assertIn(self.uav.state.mode_reason, ('blind end', 'touch-down'))

if __name__ == '__main__':
    run(Blind)
