#!/usr/bin/python3
"""Odometry that comes back in the air ends the descent, without a jump."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import GuardedTest, run  # noqa: E402


class Recovery(GuardedTest):
    def test_recovery(self):
        self.uav.take_off()
        self.assertTrue(self.uav.go_to(0.0, 0.0, 2.5).success)
        self.uav.sleep(5.0)
        self.uav.spoil = lambda message: None
        self.uav.wait_mode('emergency descent')
        self.uav.spoil = lambda message: message
        self.uav.wait_mode('holding')
        self.assertEqual(self.uav.state.mode_reason, 'odometry back')
        self.uav.sleep(3.0)
        self.assertLess(self.uav.error(), 0.2)
        self.assertGreater(self.uav.state.position.z, 1.2)


if __name__ == '__main__':
    run(Recovery)
