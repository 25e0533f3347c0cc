#!/usr/bin/python3
"""A heading that turns about by itself is never believed (BUG 12)."""
import math
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import GuardedTest, run  # noqa: E402


class Heading(GuardedTest):
    def test_heading(self):
        self.uav.take_off()

        def turned(message):
            q = message.pose.pose.orientation
            q.x, q.y, q.z, q.w = -q.y, q.x, q.w, -q.z  # by 180 deg about z
            twist = message.twist.twist
            twist.linear.x, twist.linear.y = -twist.linear.x, -twist.linear.y
            return message
        self.uav.spoil = turned
        self.uav.wait_mode('emergency descent')
        self.expect_landed()
        self.assertLess(math.hypot(self.uav.truth.x, self.uav.truth.y), 1.0)

if __name__ == '__main__':
    run(Heading)
