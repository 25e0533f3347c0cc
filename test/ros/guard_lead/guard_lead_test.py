#!/usr/bin/python3
"""A trajectory of a far future is refused, one of the past begins now (BUG 14)."""
import os
import sys

import rospy

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import GuardedTest, run  # noqa: E402
from uav import trajectory  # noqa: E402


class Lead(GuardedTest):
    def test_lead(self):
        self.uav.take_off()
        before = self.uav.state.dropped_set_points
        hour = rospy.Duration(3600)
        points = [(0.0, 0.0, 0.0, 1.2, 0.0), (3.0, 1.0, 0.0, 1.2, 0.0)]
        self.uav.trajectory.publish(trajectory(rospy.Time.now() + hour, points))
        self.uav.wait('the refusal', lambda: self.uav.state.dropped_set_points > before)
        self.assertEqual(self.uav.state.set_points_pending, 0)
        self.assertEqual(self.uav.state.mode, 'holding')

if __name__ == '__main__':
    run(Lead)
