#!/usr/bin/python3
"""Whose death ends a flight, and what reaches the recorder's command line."""
import os
import signal
import subprocess
import sys
import unittest
from xmlrpc.client import ServerProxy

import rosgraph
import rospkg
import rospy
import rostest
from roslaunch.config import load_config_default
from roslaunch.core import local_machine
from roslaunch.node_args import create_local_process_args

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from uav import PACKAGE, Uav  # noqa: E402


def nodes(launch_file, *arguments):
    """What such a launch would start, by name."""
    path = os.path.join(rospkg.RosPack().get_path(PACKAGE), 'launch', launch_file)
    config = load_config_default([(path, list(arguments))], None, verbose=False)
    return {node.name: node for node in config.nodes}


def kill(name):
    _, _, pid = ServerProxy(rosgraph.Master('/test').lookupNode(name)).getPid('/test')
    os.kill(pid, signal.SIGKILL)


class LaunchFiles(unittest.TestCase):
    def test_only_what_flies_ends_the_flight_when_it_dies(self):
        launched = nodes('demo.launch', 'rviz:=true', 'record:=true')
        self.assertEqual({name for name, node in launched.items() if node.required},
                         {'plant', 'controller'})
        self.assertIn('mission', launched)
        self.assertIn('record', launched)
        self.assertTrue(nodes('demo.launch')['mission'].required)

    def test_a_bag_is_one_word_whatever_its_name(self):
        for bag in ('flight.bag', '/tmp/two words.bag', 'x --all -o /anywhere', 'a"b --all',
                    "a' --all", 'a\\" --all', 'a\\', '--all'):
            words = create_local_process_args(nodes('record.launch', 'bag:=' + bag)['record'],
                                              local_machine())
            self.assertEqual(words[1:3], ['--output-name=' + bag, '--buffsize=0'])
            self.assertNotIn('--all', words)

    def test_the_vehicle_flies_on_without_its_mission(self):
        launch = subprocess.Popen(
            ['roslaunch', PACKAGE, 'demo.launch', 'lock_step:=false', 'fly_on:=true',
             'real_time_factor:=5.0'], stdout=subprocess.DEVNULL)
        try:
            uav = Uav()
            uav.wait('the flight', lambda: uav.states and uav.state.flying and uav.now > 5.0)
            kill('/uav/mission')
            uav.sleep(20.0)
            self.assertIsNone(launch.poll())
            self.assertTrue(uav.state.flying)
            self.assertLess(uav.error(), 1.0)
        finally:
            launch.terminate()
            launch.wait()


if __name__ == '__main__':
    rospy.init_node('launch_files_test')
    rostest.rosrun(PACKAGE, 'launch_files', LaunchFiles, sys.argv)
