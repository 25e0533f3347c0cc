#!/usr/bin/python3
"""A trajectory that ends in motion is braked to its last point (BUG 14)."""
import os
import sys

import rospy

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import GuardedTest, run  # noqa: E402
from uav import trajectory  # noqa: E402


class MotionEnd(GuardedTest):
    def test_motion_end(self):
        self.uav.take_off()
        message = trajectory(rospy.Time.now(), [
            (0.1 * i, 0.1 * i, 0.0, 1.2, 0.0) for i in range(31)])
        for point in message.points:
            point.velocities[0].linear.x = 1.0
        self.uav.trajectory.publish(message)
        self.uav.wait('motion', lambda: self.uav.state.velocity.x > 0.5)
        self.uav.sleep(7.0)
        self.assertAlmostEqual(self.uav.truth.x, 3.0, delta=0.1)
        self.assertLess(abs(self.uav.state.velocity.x), 0.1)

if __name__ == '__main__':
    run(MotionEnd)
