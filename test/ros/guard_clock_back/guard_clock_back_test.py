#!/usr/bin/python3
"""Stamps that go back for ever end plans of their time, not the flight (BUG 1)."""
import os
import sys

import rospy

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import GuardedTest, run  # noqa: E402


class ClockBack(GuardedTest):
    def test_clock_back(self):
        self.uav.take_off()
        self.uav.go(3.0, 0.0, 1.5)
        self.uav.sleep(1.0)

        def back(message):
            message.header.stamp -= rospy.Duration(2.5)
            return message
        self.uav.spoil = back
        self.uav.wait('the clock step', lambda: self.uav.state.mode_reason == 'clock step')
        self.expect_holding()
        self.assertGreater(self.uav.truth.z, 0.9)

if __name__ == '__main__':
    run(ClockBack)
