#!/usr/bin/python3
"""Nodes that are given wrong parameters say so in one line and do not start."""
import os
import subprocess
import sys
import unittest

import rosgraph
import rospkg
import rospy
import rostest
import yaml

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from uav import executable  # noqa: E402

CONFIG = os.path.join(rospkg.RosPack().get_path('adaptive_quadrotor_control'), 'config')
NODELET = ['rosrun', 'nodelet', 'nodelet', 'standalone', 'adaptive_quadrotor_control/Controller',
           '__name:=controller']
PLANT = [executable('plant_node'), '__name:=plant']
MISSION = [executable('mission_node'), '__name:=mission']


def config(kind, name):
    with open(os.path.join(CONFIG, kind, name + '.yaml')) as file:
        return yaml.safe_load(file)


class Refusal(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node('refusal_test')

    def setUp(self):
        rospy.set_param('/vehicle', config('vehicle', 'pelican_thesis'))
        rospy.set_param('/scenario', config('scenario', 'hover_payload'))
        rospy.set_param('/controller', {'gains': config('controller', 'asmc')})
        rospy.set_param('/plant', {'lock_step': True})
        rospy.set_param('/use_sim_time', True)

    def refused(self, command, *words, env=None):
        run = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=40,
                             env=dict(os.environ, **(env or {})))
        lines = [line for line in run.stdout.decode().splitlines() if 'FATAL' in line]
        self.assertNotEqual(run.returncode, 0, run.stdout)
        self.assertTrue(lines, run.stdout)
        for word in words:
            self.assertIn(word, lines[0])

    def test_controller_refuses_a_negative_leak(self):
        rospy.set_param('/controller/gains/mass_estimate/leak', -1.0)
        self.refused(NODELET, '/controller/gains/mass_estimate/leak', '-1', '> 0')

    def test_controller_refuses_a_missing_gain(self):
        rospy.delete_param('/controller/gains/position/slope')
        self.refused(NODELET, '/controller/gains/position/slope', 'missing')

    def test_controller_refuses_an_unknown_name(self):
        rospy.set_param('/controller/gains/position/slop', 1.0)
        self.refused(NODELET, '/controller/gains/position/slop', 'unknown')

    def test_controller_refuses_a_text_for_a_number(self):
        rospy.set_param('/controller/rate', 'fast')
        self.refused(NODELET, '/controller/rate', 'fast', 'number')

    def test_controller_refuses_an_unknown_law(self):
        rospy.set_param('/controller/gains/law', 'magic')
        self.refused(NODELET, '/controller/gains/law', 'magic', 'asmc', 'geometric', 'smc')

    def test_controller_refuses_three_rotors(self):
        rospy.set_param('/vehicle/rotors/angles_deg', [0.0, 120.0, 240.0])
        self.refused(NODELET, '/vehicle/rotors/angles_deg', '3 rotors', '4 to')

    def refused_switched(self, change, *words):
        gains = config('controller', 'switched')
        change(gains)
        rospy.set_param('/controller', {'gains': gains})
        self.refused(NODELET, *words)

    def test_controller_refuses_a_gain_that_is_not_positive_definite(self):
        self.refused_switched(
            lambda gains: gains['subsystems'][1].update(error_gain=[150.0, 150.0, -150.0, 150.0]),
            '/controller/gains/subsystems[1]/error_gain', '-150', 'positive definite')

    def test_controller_refuses_a_leak_that_is_too_small(self):
        self.refused_switched(lambda gains: gains['subsystems'][2].update(leak=[0.6, 0.6, 0.1, 0.6]),
                              '/controller/gains/subsystems[2]/leak', '0.1', 'varrho / 2')

    def test_controller_refuses_a_chatter_bound_below_one(self):
        self.refused_switched(lambda gains: gains.update(chatter_bound=0.5),
                              '/controller/gains/chatter_bound', '0.5', '>= 1')

    def test_controller_refuses_an_unknown_initial_subsystem(self):
        self.refused_switched(lambda gains: gains.update(initial_subsystem=4),
                              '/controller/gains/initial_subsystem', '4', '<= 3')

    def test_mission_refuses_an_impossible_subsystem(self):
        scenario = config('scenario', 'vertical_lift')
        scenario['mission'][2]['switch']['subsystem'] = 0
        rospy.set_param('/scenario', scenario)
        self.refused(MISSION, '/scenario/mission[2]/switch/subsystem', "'0'", '>= 1')

    def test_plant_refuses_a_negative_mass(self):
        rospy.set_param('/vehicle/mass', -2.0)
        self.refused(PLANT, '/vehicle/mass', '-2', '>= 0.001')

    def test_plant_refuses_lock_step_without_simulated_time(self):
        rospy.set_param('/use_sim_time', False)
        self.refused(PLANT, '/plant/lock_step', '/use_sim_time')

    def test_mission_refuses_times_that_go_backwards(self):
        scenario = config('scenario', 'aggressive_manoeuvre')
        scenario['mission'][1]['step']['at'] = 1.0
        rospy.set_param('/scenario', scenario)
        self.refused(MISSION, '/scenario/mission[1]/step/at', '1 s', 'backwards')

    def test_nodes_say_that_there_is_no_master(self):
        uri = 'http://127.0.0.1:1'
        for command in (PLANT, MISSION):
            self.refused(command, 'no ROS master', uri, env={'ROS_MASTER_URI': uri})


if __name__ == '__main__':
    assert rosgraph.is_master_online()
    rostest.rosrun('adaptive_quadrotor_control', 'refusal', Refusal, sys.argv)
