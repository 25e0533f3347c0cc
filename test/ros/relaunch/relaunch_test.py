#!/usr/bin/python3
"""A second simulation on a master that still knows the first one's parameters."""
import os
import subprocess
import sys
import unittest

import rospkg
import rospy
import rostest
import yaml

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from uav import PACKAGE, Uav  # noqa: E402

CONFIG = os.path.join(rospkg.RosPack().get_path(PACKAGE), 'config')


def config(kind, name):
    with open(os.path.join(CONFIG, kind, name + '.yaml')) as file:
        return yaml.safe_load(file)


class Relaunch(unittest.TestCase):
    def fly(self, scenario, controller, vehicle):
        """Launches it and waits until it says so itself; then takes it down again."""
        launch = subprocess.Popen(
            ['roslaunch', PACKAGE, 'simulation.launch', 'scenario:=' + scenario,
             'controller:=' + controller, 'vehicle:=' + vehicle, 'lock_step:=true'],
            stdout=subprocess.DEVNULL)
        try:
            uav = Uav()
            uav.wait_until_ready()
            self.assertEqual(uav.state.controller, controller)
            self.assertEqual(rospy.get_param('/uav/controller/gains'),
                             config('controller', controller))
            self.assertEqual(rospy.get_param('/uav/scenario'), config('scenario', scenario))
            self.assertEqual(rospy.get_param('/uav/vehicle'), config('vehicle', vehicle))
        finally:
            launch.terminate()
            launch.wait()

    def test_nothing_of_the_first_one_stays(self):
        self.fly('payload_transport', 'asmc', 'firefly')
        self.fly('hover_payload', 'geometric', 'pelican')


if __name__ == '__main__':
    rospy.init_node('relaunch_test')
    rostest.rosrun(PACKAGE, 'relaunch', Relaunch, sys.argv)
