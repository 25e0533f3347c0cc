#!/usr/bin/python3
"""A stamp ahead of now or behind it by far is refused; the flight goes on (BUG 1)."""
import os
import sys

import rospy

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import GuardedTest, run  # noqa: E402


class Stamps(GuardedTest):
    def test_stamps(self):
        self.uav.take_off()
        before = self.uav.state.dropped_odometry
        for shift in (1000.0, -1000.0, 10.0):
            shifts = [shift]

            def once(message):
                if shifts:
                    stamp = message.header.stamp.to_sec() + shifts.pop()
                    message.header.stamp = rospy.Time.from_sec(max(stamp, 0.001))
                return message
            self.uav.spoil = once
            self.uav.sleep(2.0)
        self.assertGreaterEqual(self.uav.state.dropped_odometry, before + 3)
        self.assertEqual(self.uav.state.mode, 'holding')
        self.assertAlmostEqual(self.uav.state.position.z, 1.1, delta=0.2)
        self.assertFalse(self.uav.status.crashed)


if __name__ == '__main__':
    run(Stamps)
