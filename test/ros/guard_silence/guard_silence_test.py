#!/usr/bin/python3
"""Without odometry the vehicle descends by its IMU and stops its rotors (BUG 6)."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import GuardedTest, run  # noqa: E402


class Silence(GuardedTest):
    def test_silence(self):
        self.uav.take_off()
        begin = self.uav.now
        self.uav.spoil = lambda message: None
        self.uav.wait_mode('emergency descent')
        self.assertEqual(self.uav.state.mode_reason, 'odometry lost')
        self.assertLess(self.uav.state.odometry_silence, 0.8)
        self.uav.wait_mode('disarmed')
        self.uav.wait('the rotors to stand still', lambda: max(
            self.uav.motors[-1].angular_velocities) == 0.0)
        self.assertFalse(self.uav.status.crashed, self.uav.status.crash_reason)
        self.assertGreater(begin, 0.0)


if __name__ == '__main__':
    run(Silence)
