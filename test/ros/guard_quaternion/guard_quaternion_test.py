#!/usr/bin/python3
"""A quaternion of nearly unit norm is normalised, another one refused (BUG 17f)."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import GuardedTest, run  # noqa: E402


class Quaternion(GuardedTest):
    def test_quaternion(self):
        self.uav.take_off()
        self.uav.spoil = lambda message: self.scaled(message, 1.01)
        self.uav.sleep(2.0)
        self.assertLess(self.uav.state.dropped_odometry, 25)  # a tenth of a second
        self.expect_holding()
        self.uav.spoil = lambda message: self.scaled(message, 2.0)
        self.uav.wait_mode('emergency descent')
        self.expect_landed()

    @staticmethod
    def scaled(message, factor):
        q = message.pose.pose.orientation
        q.x, q.y, q.z, q.w = (factor * c for c in (q.x, q.y, q.z, q.w))
        return message

if __name__ == '__main__':
    run(Quaternion)
