#!/usr/bin/python3
"""A controller that dies in the air and is started again takes over (BUG 8)."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import GuardedTest, kill_node, run  # noqa: E402


class Restart(GuardedTest):
    def test_restart(self):
        self.uav.take_off()
        self.assertTrue(self.uav.go_to(0.0, 0.0, 8.0).success)
        self.uav.wait('8 m', lambda: self.uav.truth.z > 7.8)
        count = len(self.uav.states)
        kill_node('/uav/controller')
        self.uav.wait('its successor', lambda: len(self.uav.states) > count + 10 and
                      self.uav.state.mode == 'holding')
        self.assertEqual(self.uav.state.mode_reason, 'airborne')
        self.uav.sleep(4.0)
        self.assertGreater(self.uav.truth.z, 2.0)
        self.assertLess(abs(self.uav.state.velocity.z), 0.2)
        self.assertFalse(self.uav.status.crashed, self.uav.status.crash_reason)
        self.uav.obey('land')
        self.uav.wait_mode('landing')

if __name__ == '__main__':
    run(Restart)
