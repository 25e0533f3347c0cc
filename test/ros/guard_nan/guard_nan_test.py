#!/usr/bin/python3
"""Numbers that are none for a while are silence: reckoned through, and forgotten."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import GuardedTest, run  # noqa: E402


class Nan(GuardedTest):
    def test_nan(self):
        self.uav.take_off()

        def spoiled(message):
            message.twist.twist.linear.x = float('nan')
            return message
        self.uav.spoil = spoiled
        self.uav.sleep(0.4)
        self.assertEqual(self.uav.state.mode, 'holding')
        self.uav.spoil = lambda message: message
        self.expect_holding()
        self.assertGreater(self.uav.state.dropped_odometry, 50)

if __name__ == '__main__':
    run(Nan)
