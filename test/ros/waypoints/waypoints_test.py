#!/usr/bin/python3
"""The waypoint node: a path from a live hover, cancelled half way, refused when senseless."""
import math
import os
import sys
import unittest

import rospy
import rostest
from adaptive_quadrotor_control.msg import PathProgress
from adaptive_quadrotor_control.srv import FlyPath
from geometry_msgs.msg import Point, PoseStamped
from nav_msgs.msg import Path
from std_srvs.srv import Trigger

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from uav import Uav, yaw_quaternion  # noqa: E402

SPEED, ACCELERATION = 2.0, 2.0


def path(*points, frame='world'):
    message = Path()
    message.header.frame_id = frame
    for x, y, z, yaw in points:
        pose = PoseStamped()
        pose.pose.position = Point(x, y, z)
        yaw_quaternion(pose.pose.orientation, yaw)
        message.poses.append(pose)
    return message


class Waypoints(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node('waypoints_test')
        cls.uav = Uav()
        cls.uav.wait_until_ready()
        rospy.wait_for_service('/uav/waypoints/fly_path', timeout=20)
        cls.fly = rospy.ServiceProxy('/uav/waypoints/fly_path', FlyPath)
        cls.cancel = rospy.ServiceProxy('/uav/waypoints/cancel', Trigger)
        cls.progress = []
        rospy.Subscriber('/uav/waypoints/progress', PathProgress, cls.uav._keep, cls.progress)
        cls.uav.wait('progress', lambda: cls.progress)

    def setUp(self):
        """Hovering where every path begins, with none being flown."""
        self.cancel()
        self.uav.go(0, 0, 1.0)
        self.uav.wait('the hover', lambda: self.uav.error() < 0.05 and self.speed() < 0.05)

    def speed(self):
        v = self.uav.state.velocity
        return math.hypot(v.x, v.y, v.z)

    def distance_to(self, x, y, z):
        p = self.uav.state.position
        return math.dist((p.x, p.y, p.z), (x, y, z))

    def flown(self, since):
        return [s for s in self.uav.states if s.header.stamp.to_sec() > since]

    def test_flies_a_path_within_its_limits(self):
        since, before = self.uav.now, len(self.progress)
        response = self.fly(path=path((2, 0, 1.5, 0), (2, 2, 2, 1.0), (0, 2, 1.5, 1.5)))
        self.assertTrue(response.success, response.message)
        self.uav.wait('the flying phase',
                      lambda: self.progress[-1].phase == PathProgress.FLYING)
        self.uav.wait('the path to be done', lambda: self.progress[-1].phase == PathProgress.DONE)
        self.uav.sleep(3.0)
        self.assertLess(self.distance_to(0, 2, 1.5), 0.1)
        for state in self.flown(since):
            v, a = state.desired_velocity, state.desired_acceleration
            self.assertLess(math.hypot(v.x, v.y, v.z), SPEED * 1.001)
            self.assertLess(math.hypot(a.x, a.y, a.z), ACCELERATION * 1.001)
        fractions = [p.fraction for p in self.progress[before:]
                     if p.phase == PathProgress.FLYING]
        self.assertEqual(fractions, sorted(fractions))
        self.assertEqual(self.progress[-1].fraction, 1.0)

    def test_limits_of_the_request_hold(self):
        slow = self.fly(path=path((2, 0, 1.0, 0)), speed=0.5)
        self.assertTrue(slow.success, slow.message)
        self.assertGreater(slow.duration, 4.0)  # 2 m at 0.5 m/s
        self.uav.wait('the flying phase',
                      lambda: self.progress[-1].phase == PathProgress.FLYING)
        self.uav.wait('the path to be done', lambda: self.progress[-1].phase == PathProgress.DONE)

    def test_cancelled_half_way_it_brakes_and_holds(self):
        response = self.fly(path=path((8, 0, 1.0, 0)))
        self.uav.wait('half the path', lambda: self.progress[-1].fraction > 0.5 and
                      self.progress[-1].phase == PathProgress.FLYING)
        since = self.uav.now
        self.assertTrue(self.cancel().success)
        self.uav.wait('the cancelled phase',
                      lambda: self.progress[-1].phase == PathProgress.CANCELLED)
        self.uav.sleep(response.duration)
        states = self.flown(since)
        self.assertEqual(self.uav.state.desired_velocity.x, 0.0)
        self.assertLess(self.uav.state.desired_position.x, 7.5)
        self.assertLess(self.uav.error(), 0.1)
        steps = [abs(b.desired_position.x - a.desired_position.x)
                 for a, b in zip(states, states[1:])]
        self.assertLess(max(steps), 0.15)  # the set point brakes, it does not jump
        self.assertFalse(self.cancel().success)

    def test_cancelled_beyond_the_limits_of_the_node_it_brakes(self):
        response = self.fly(path=path((8, 0, 1.0, 0)), speed=2.0 * SPEED)
        self.assertTrue(response.success, response.message)
        self.uav.wait('more speed than the node allows by itself',
                      lambda: abs(self.uav.state.desired_velocity.x) > 1.1 * SPEED)
        stopped = self.cancel()
        self.assertTrue(stopped.success, stopped.message)
        self.assertIn('stops in', stopped.message)
        self.uav.wait('the cancelled phase',
                      lambda: self.progress[-1].phase == PathProgress.CANCELLED)
        self.uav.sleep(response.duration)
        self.assertEqual(self.uav.state.desired_velocity.x, 0.0)
        self.assertLess(self.uav.state.desired_position.x, 7.5)  # short of the path's end
        self.uav.wait('the vehicle at rest there', lambda: self.uav.error() < 0.1)

    def test_refuses_senseless_paths(self):
        nan = float('nan')
        for bad, word in ((path(), 'no poses'), (path((nan, 0, 1, 0)), 'pose 0'),
                          (path((0, 0, 1, 0), frame='nowhere'), 'nowhere')):
            response = self.fly(path=bad)
            self.assertFalse(response.success)
            self.assertIn(word, response.message)
        self.assertFalse(self.fly(path=path((0, 0, 1, 0)), speed=-1.0).success)
        endless = self.fly(path=path((2, 0, 1, 0)), speed=1e-6)
        self.assertFalse(endless.success)
        self.assertIn('it must be <= 10000 s', endless.message)
        self.assertFalse(self.cancel().success)  # nothing is being flown


if __name__ == '__main__':
    rostest.rosrun('adaptive_quadrotor_control', 'waypoints', Waypoints, sys.argv)
