#!/usr/bin/python3
"""Trajectories: every point acts at its time, refused ones change nothing."""
import os
import struct
import sys
import unittest

import rospy
import rostest
from trajectory_msgs.msg import MultiDOFJointTrajectory

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from uav import Uav, trajectory  # noqa: E402


class Hollow(MultiDOFJointTrajectory):
    """Declares 20 million points in 24 bytes, and has none."""

    def serialize(self, buff):
        buff.write(struct.pack('<6I', 0, 0, 0, 0, 0, 20000000))


class Trajectory(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node('trajectory_test')
        cls.uav = Uav()
        cls.uav.wait_until_ready()

    def test_points_act_at_their_times(self):
        begin = rospy.Time.from_sec(round(self.uav.now) + 20.0)
        self.uav.trajectory.publish(trajectory(begin, [
            (0.0, 0, 0, 1.0, 0.0), (4.0, 1.0, 0, 1.5, 0.0), (10.0, 1.0, 1.0, 1.5, 0.5)]))
        end = begin.to_sec() + 25.0
        self.uav.wait('the end of the trajectory', lambda: self.uav.now >= end)
        seen = {}
        for state in self.uav.states:
            if state.flying and state.header.stamp >= begin:
                p = state.desired_position
                seen.setdefault((p.x, p.y, p.z), state.header.stamp.to_sec() - begin.to_sec())
        self.assertEqual(list(seen), [(0, 0, 1.0), (1.0, 0, 1.5), (1.0, 1.0, 1.5)])
        for first_seen, due in zip(seen.values(), [0.0, 4.0, 10.0]):
            self.assertAlmostEqual(first_seen, due, delta=1e-6)
        self.assertLess(self.uav.error(), 0.1)

    def test_without_a_stamp_the_first_point_acts_now(self):
        self.uav.trajectory.publish(trajectory(rospy.Time(0), [(0.0, 0, 0, 1.2, 0.0)]))
        self.uav.wait('the new set point', lambda: self.uav.state.desired_position.z == 1.2)

    def test_refuses_trajectories_that_are_none(self):
        nan = float('nan')
        bad = [trajectory(rospy.Time(0), []),
               trajectory(rospy.Time(0), [(0.0, 0, 0, nan, 0.0)]),
               trajectory(rospy.Time(0), [(2.0, 0, 0, 2.0, 0.0), (1.0, 0, 0, 3.0, 0.0)]),
               Hollow()]
        before = self.uav.state
        for count, message in enumerate(bad, start=1):
            self.uav.trajectory.publish(message)
            self.uav.wait('refusal %d' % count, lambda: self.uav.state.dropped_set_points ==
                          before.dropped_set_points + count)
        self.assertEqual(self.uav.state.desired_position, before.desired_position)
        self.assertEqual(self.uav.state.trajectory_stamp, before.trajectory_stamp)


if __name__ == '__main__':
    rostest.rosrun('adaptive_quadrotor_control', 'trajectory', Trajectory, sys.argv)
