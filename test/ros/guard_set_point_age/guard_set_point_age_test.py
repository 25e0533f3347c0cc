#!/usr/bin/python3
"""Set points that stop coming end in a hold (BUG 14)."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import GuardedTest, run  # noqa: E402


class SetPointAge(GuardedTest):
    def test_set_point_age(self):
        self.uav.take_off()
        for i in range(20):
            self.uav.go(0.1 * i, 0.0, 1.2)
            self.uav.sleep(0.1)
        self.assertEqual(self.uav.state.mode, 'flying')
        last = self.uav.now
        self.uav.wait_mode('holding')
        self.assertEqual(self.uav.state.mode_reason, 'set point old')
        self.assertLess(self.uav.now - last, 0.8)
        self.expect_holding()

if __name__ == '__main__':
    run(SetPointAge)
