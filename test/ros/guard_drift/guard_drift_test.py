#!/usr/bin/python3
"""An estimate that drifts away slowly is followed without an alarm: nobody could tell."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import GuardedTest, run  # noqa: E402


class Drift(GuardedTest):
    def test_drift(self):
        self.uav.take_off()
        begin = self.uav.now

        def drifting(message):
            message.pose.pose.position.x += 0.1 * (message.header.stamp.to_sec() - begin)
            message.twist.twist.linear.x += 0.1
            return message
        self.uav.spoil = drifting
        self.uav.sleep(6.0)
        self.expect_holding()
        self.assertLess(self.uav.state.dropped_odometry, 25)  # a tenth of a second
        drifted = 0.1 * (self.uav.now - begin)
        self.assertAlmostEqual(self.uav.truth.x, -drifted, delta=0.2)


if __name__ == '__main__':
    run(Drift)
